//! Prismatic joint of space: lets b slide along an axis of a, without turning against it (a slider).
//!
//! ```text
//! C₁₂ = n · d             d = x_b + r_b − x_a − r_a,  two n ⊥ axis, turning with a            [m]
//! Ċ₁₂ = n · ḋ + ṅ · d = n · (v_b + ω_b × r_b − v_a − ω_a × (r_a + d))                         [m/s]
//! J̇ v = n · (ω_b × (ω_b × r_b) − ω_a × (ω_a × r_a)) + 2 ṅ · ḋ + (ω_a × ṅ) · d,  ṅ = ω_a × n   [m/s²]
//! K = m_a⁻¹ + m_b⁻¹ + γ_a · I_a⁻¹ γ_a + γ_b · I_b⁻¹ γ_b,  γ_a = (r_a + d) × n,  γ_b = r_b × n  [1/kg]
//! C₃₄₅                    as the fixed joint                                                  [1]
//! ```

use glam::{DMat3, DVec3};
use tumble_math::Spatial;

use super::fixed;
use crate::SolverBody;
use crate::joint::{JointEnds, JointRow};

/// Appends the five rows of a slider along the first column of a frame, given in world axes as a and as b carry it.
pub fn push_rows(
    ends: &JointEnds<Spatial>,
    frames: [&DMat3; 2],
    bodies: &[SolverBody<Spatial>],
    rows: &mut Vec<JointRow<Spatial>>,
) {
    rows.push(across(ends, frames[0].y_axis, bodies));
    rows.push(across(ends, frames[0].z_axis, bodies));
    fixed::push_turning_rows(ends, frames, bodies, rows);
}

/// The row that keeps b's anchor from leaving a's along a normal that turns with a.
fn across(ends: &JointEnds<Spatial>, normal: DVec3, bodies: &[SolverBody<Spatial>]) -> JointRow<Spatial> {
    let turning = bodies[ends.a as usize].angular_velocity;
    let normal_rate = turning.cross(normal);
    let row = ends.along(normal, bodies);
    let bent = 2.0 * normal_rate.dot(ends.velocity(bodies)) + turning.cross(normal_rate).dot(ends.gap);
    JointRow { angular_a: (ends.arm_a + ends.gap).cross(normal), drift: row.drift + bent, ..row }
}
