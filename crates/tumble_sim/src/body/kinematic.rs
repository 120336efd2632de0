//! Kinematic bodies that follow keyframes.

use bevy_ecs::prelude::*;
use tumble_math::{Angular, Dim, Linear, Rotation};

use super::{AngularVelocity, InDim, LinearVelocity, Orientation, Position, PreviousVelocity};
use crate::Clock;

/// Where a body is to be at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe<V, R> {
    /// Simulated time [s].
    pub time: f64,
    /// Position in world axes [m].
    pub position: V,
    /// Rotation from body to world axes; in the plane its angle counts turns.
    pub rotation: R,
}

/// A path for a kinematic body: straight and even between keyframes, at rest before the first and after the last.
///
/// In space the body turns evenly about one axis from a keyframe to the next, the shorter way: keyframes should be less than half a turn
/// apart. Times must rise. The body gets the velocity that takes it to the path's place at the end of each step, so what it
/// touches is pushed with the right speed.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct Keyframes<V, R>(pub Vec<Keyframe<V, R>>)
where
    V: Send + Sync + 'static,
    R: Send + Sync + 'static;

impl<V: Linear, R: Send + Sync + Copy + 'static> Keyframes<V, R> {
    /// Position and rotation at a time; `None` without keyframes.
    pub fn at<W: Angular>(&self, time: f64) -> Option<(V, R)>
    where
        R: Rotation<W>,
    {
        let after = self.0.partition_point(|frame| frame.time <= time);
        if after == 0 {
            return self.0.first().map(|frame| (frame.position, frame.rotation));
        }
        let from = &self.0[after - 1];
        let Some(to) = self.0.get(after) else { return Some((from.position, from.rotation)) };
        let part = (time - from.time) / (to.time - from.time);
        let turn = from.rotation.angle_to(&to.rotation) * part;
        Some((from.position + (to.position - from.position) * part, from.rotation.turned(turn)))
    }
}

/// Gives bodies the velocity that takes them along their keyframes in this part of the step.
pub fn follow_keyframes<D: Dim<Vector: InDim>>(
    clock: Res<Clock>,
    mut bodies: Query<(
        &Keyframes<D::Vector, D::Rotation>,
        &Position<D::Vector>,
        &Orientation<D::Rotation>,
        &mut LinearVelocity<D::Vector>,
        &mut AngularVelocity<D::Angular>,
        Option<&mut PreviousVelocity<D::Vector, D::Angular>>,
    )>,
) {
    for (path, position, orientation, mut velocity, mut angular_velocity, previous) in &mut bodies {
        let Some((target, rotation)) = path.at(clock.time_after_part()) else { continue };
        velocity.bypass_change_detection().0 = (target - position.0) * (1.0 / clock.part());
        angular_velocity.bypass_change_detection().0 = orientation.0.angle_to(&rotation) * (1.0 / clock.part());
        if let Some(mut previous) = previous {
            let previous = previous.bypass_change_detection();
            (previous.linear, previous.angular) = (velocity.0, angular_velocity.0);
        }
    }
}
