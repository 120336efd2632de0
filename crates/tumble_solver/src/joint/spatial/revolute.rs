//! Revolute joint of space: keeps two anchors together and lets the bodies turn about one axis (a hinge).
//!
//! ```text
//! C₁₂₃ = x_b + r_b − x_a − r_a       as the spherical joint                              [m]
//! C₄ = q · u,   C₅ = p · u           p, q ⊥ axis, of a;  u the axis, of b                [1]
//! ```

use glam::DMat3;
use tumble_math::Spatial;

use super::right_angle;
use crate::SolverBody;
use crate::joint::{JointEnds, JointRow, revolute};

/// Appends the five rows of a hinge about the first column of a frame, given in world axes as a and as b carry it.
pub fn push_rows(
    ends: &JointEnds<Spatial>,
    frames: [&DMat3; 2],
    bodies: &[SolverBody<Spatial>],
    rows: &mut Vec<JointRow<Spatial>>,
) {
    revolute::push_rows(ends, bodies, rows);
    let [of_a, of_b] = frames;
    rows.push(right_angle(ends, of_a.z_axis, of_b.x_axis, bodies));
    rows.push(right_angle(ends, of_a.y_axis, of_b.x_axis, bodies));
}
