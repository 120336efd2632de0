//! Prismatic joint of the plane: lets b slide along an axis of a, without turning against it (a slider).
//!
//! ```text
//! C₁ = n · d              d = x_b + r_b − x_a − r_a,  n ⊥ axis, both turning with a           [m]
//! Ċ₁ = n · ḋ + ṅ · d = n · (v_b + ω_b × r_b − v_a − ω_a × (r_a + d))                          [m/s]
//! J̇ v = n · (ω_b × (ω_b × r_b) − ω_a × (ω_a × r_a)) + 2 ṅ · ḋ − ω_a² n · d,  ṅ = ω_a × n      [m/s²]
//! K₁₁ = m_a⁻¹ + m_b⁻¹ + ((r_a + d) × n)² I_a⁻¹ + (r_b × n)² I_b⁻¹                             [1/kg]
//! C₂ = θ_b − θ_a − θ₀                  as the fixed joint                                     [rad]
//! ```

use tumble_math::{Dim, Linear, Planar};

use super::{JointEnds, JointError, JointRow, fixed};
use crate::SolverBody;

/// Appends the two rows of a prismatic joint.
///
/// `axis` is the direction of sliding, fixed in a, in world axes; `turned` is θ_b − θ_a − θ₀ [rad].
pub fn push_rows(
    ends: &JointEnds<Planar>,
    axis: <Planar as Dim>::Vector,
    turned: f64,
    bodies: &[SolverBody<Planar>],
    rows: &mut Vec<JointRow<Planar>>,
) -> Result<(), JointError> {
    let JointEnds { a, b, arm_a, gap, .. } = *ends;
    let axis = axis.try_normalize().ok_or(JointError::BadParameter { a, b, quantity: "axis" })?;
    // Turned by a right angle.
    let normal = Planar::spin(1.0, axis);
    let turning = bodies[a as usize].angular_velocity;
    let normal_rate = Planar::spin(turning, normal);
    let row = ends.along(normal, bodies);
    let drift = row.drift + 2.0 * normal_rate.dot(ends.velocity(bodies)) - turning * turning * Linear::dot(normal, gap);
    rows.push(JointRow { angular_a: Planar::torque(arm_a + gap, normal), drift, ..row });
    rows.push(fixed::angle_row(ends, turned));
    Ok(())
}
