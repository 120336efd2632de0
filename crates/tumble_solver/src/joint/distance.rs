//! Distance joint: keeps two anchors a fixed length apart (a massless rod).
//!
//! ```text
//! C = |d| − L             d = x_b + r_b − x_a − r_a,  n = d / |d|                          [m]
//! Ċ = n · ḋ               ḋ = v_b + ω_b × r_b − v_a − ω_a × r_a                            [m/s]
//! J̇ v = n · (ω_b × (ω_b × r_b) − ω_a × (ω_a × r_a)) + (|ḋ|² − (n · ḋ)²) / |d|              [m/s²]
//! K = m_a⁻¹ + m_b⁻¹ + (r_a × n) · I_a⁻¹ (r_a × n) + (r_b × n) · I_b⁻¹ (r_b × n)            [1/kg]
//! ```
//!
//! The last term of J̇ v is ṅ · ḋ with ṅ = (ḋ − (n · ḋ) n) / |d|.

use tumble_math::{Dim, Linear, Vector};

use super::{JointEnds, JointError, JointRow};
use crate::SolverBody;

/// Appends the row of a distance joint of the given length [m].
pub fn push_rows<D: Dim>(
    ends: &JointEnds<D>,
    length: f64,
    bodies: &[SolverBody<D>],
    rows: &mut Vec<JointRow<D>>,
) -> Result<(), JointError> {
    let JointEnds { a, b, gap, .. } = *ends;
    if !(length.is_finite() && length > 0.0) {
        return Err(JointError::BadParameter { a, b, quantity: "length" });
    }
    let normal = gap.try_normalize().ok_or(JointError::NoDirection { a, b })?;
    let distance = gap.length();
    let across = {
        let velocity = ends.velocity(bodies);
        velocity - normal * normal.dot(velocity)
    };
    let row = ends.along(normal, bodies);
    rows.push(JointRow { error: distance - length, drift: row.drift + across.dot(across) / distance, ..row });
    Ok(())
}
