//! Fixed joint of space: keeps two anchors together and the bodies from turning against each other (a weld).
//!
//! ```text
//! C₁₂₃ = x_b + r_b − x_a − r_a                         as the spherical joint            [m]
//! C₄ = z_a · y_b,   C₅ = x_a · z_b,   C₆ = y_a · x_b   x, y, z of a shared frame         [1]
//! ```

use glam::DMat3;
use tumble_math::Spatial;

use super::right_angle;
use crate::SolverBody;
use crate::joint::{JointEnds, JointRow, revolute};

/// Appends the six rows of a weld; the frame is given in world axes as a and as b carry it.
pub fn push_rows(
    ends: &JointEnds<Spatial>,
    frames: [&DMat3; 2],
    bodies: &[SolverBody<Spatial>],
    rows: &mut Vec<JointRow<Spatial>>,
) {
    revolute::push_rows(ends, bodies, rows);
    push_turning_rows(ends, frames, bodies, rows);
}

/// Appends the three rows that keep two bodies from turning against each other.
pub(super) fn push_turning_rows(
    ends: &JointEnds<Spatial>,
    [of_a, of_b]: [&DMat3; 2],
    bodies: &[SolverBody<Spatial>],
    rows: &mut Vec<JointRow<Spatial>>,
) {
    rows.push(right_angle(ends, of_a.z_axis, of_b.y_axis, bodies));
    rows.push(right_angle(ends, of_a.x_axis, of_b.z_axis, bodies));
    rows.push(right_angle(ends, of_a.y_axis, of_b.x_axis, bodies));
}
