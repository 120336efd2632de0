//! Joints of space that hold directions: [`revolute`], [`fixed`], [`prismatic`]. A [spherical](super::revolute) joint holds none.
//!
//! Directions are held through a frame that the bodies share: at the start one and the same, later as each of them has carried it along.
//! One row keeps a column p of a's copy at a right angle to a column u of b's:
//!
//! ```text
//! C = p · u                            sine of the angle that is wrong                      [1]
//! Ċ = ṗ · u + p · u̇ = (u × p) · (ω_b − ω_a),      ṗ = ω_a × p,  u̇ = ω_b × u                [1/s]
//! J̇ v = (u̇ × p + u × ṗ) · (ω_b − ω_a)                                                       [1/s²]
//! K = γ · (I_a⁻¹ + I_b⁻¹) γ,                        γ = u × p                               [1/(kg·m²)]
//! ```
//!
//! With the copies alike γ is the third column, so that the impulse of a row is the angular impulse about it.

pub mod fixed;
pub mod prismatic;
pub mod revolute;

use glam::DVec3;
use tumble_math::Spatial;

use super::{JointEnds, JointRow};
use crate::SolverBody;

/// The row that keeps a direction of a and a direction of b, in world axes, at a right angle.
fn right_angle(
    ends: &JointEnds<Spatial>,
    of_a: DVec3,
    of_b: DVec3,
    bodies: &[SolverBody<Spatial>],
) -> JointRow<Spatial> {
    let [turning_a, turning_b] = [ends.a, ends.b].map(|body| bodies[body as usize].angular_velocity);
    let about = of_b.cross(of_a);
    let about_rate = turning_b.cross(of_b).cross(of_a) + of_b.cross(turning_a.cross(of_a));
    JointRow {
        a: ends.a,
        b: ends.b,
        linear: DVec3::ZERO,
        angular_a: about,
        angular_b: about,
        error: of_a.dot(of_b),
        drift: about_rate.dot(turning_b - turning_a),
        impulse: 0.0,
    }
}
