//! Fixed joint of the plane: keeps two anchors together and the bodies at one angle to each other (a weld).
//!
//! ```text
//! C₁₂ = x_b + r_b − x_a − r_a        as the revolute joint             [m]
//! C₃ = θ_b − θ_a − θ₀                                                  [rad]
//! Ċ₃ = ω_b − ω_a,   J̇ v = 0,   K₃₃ = I_a⁻¹ + I_b⁻¹                     [rad/s], [1/(kg·m²)]
//! ```

use tumble_math::{Linear, Planar};

use super::{JointEnds, JointRow, revolute};
use crate::SolverBody;

/// Appends the three rows of a fixed joint; `turned` is by how much b has turned against a too far, θ_b − θ_a − θ₀ [rad].
pub fn push_rows(
    ends: &JointEnds<Planar>,
    turned: f64,
    bodies: &[SolverBody<Planar>],
    rows: &mut Vec<JointRow<Planar>>,
) {
    revolute::push_rows(ends, bodies, rows);
    rows.push(angle_row(ends, turned));
}

/// The row that keeps the angle between two bodies.
pub(super) fn angle_row(ends: &JointEnds<Planar>, turned: f64) -> JointRow<Planar> {
    JointRow {
        a: ends.a,
        b: ends.b,
        linear: Linear::ZERO,
        angular_a: 1.0,
        angular_b: 1.0,
        error: turned,
        drift: 0.0,
        impulse: 0.0,
    }
}
