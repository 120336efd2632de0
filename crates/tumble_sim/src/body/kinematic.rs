//! Kinematic bodies that follow keyframes.

use bevy_ecs::prelude::*;
use glam::DVec2;
use tumble_math::{Linear, PlanarRotation};

use super::{AngularVelocity, LinearVelocity, Orientation, Position, PreviousVelocity};
use crate::Clock;

/// Where a body is to be at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe<V, W> {
    /// Simulated time [s].
    pub time: f64,
    /// Position in world axes [m].
    pub position: V,
    /// Angle from the world axes, accumulated over turns [rad].
    pub angle: W,
}

/// A path for a kinematic body: straight and even between keyframes, at rest before the first and after the last.
///
/// Times must rise. The body gets the velocity that takes it to the path's place at the end of each step, so what it touches is
/// pushed with the right speed.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct Keyframes<V, W>(pub Vec<Keyframe<V, W>>)
where
    V: Send + Sync + 'static,
    W: Send + Sync + 'static;

impl<V: Linear, W: Linear> Keyframes<V, W> {
    /// Position and angle at a time; `None` without keyframes.
    pub fn at(&self, time: f64) -> Option<(V, W)> {
        let after = self.0.partition_point(|frame| frame.time <= time);
        if after == 0 {
            return self.0.first().map(|frame| (frame.position, frame.angle));
        }
        let from = &self.0[after - 1];
        let Some(to) = self.0.get(after) else { return Some((from.position, from.angle)) };
        let part = (time - from.time) / (to.time - from.time);
        Some((from.position + (to.position - from.position) * part, from.angle + (to.angle - from.angle) * part))
    }
}

/// Gives bodies the velocity that takes them along their keyframes in this part of the step.
pub fn follow_keyframes(
    clock: Res<Clock>,
    mut bodies: Query<(
        &Keyframes<DVec2, f64>,
        &Position<DVec2>,
        &Orientation<PlanarRotation>,
        &mut LinearVelocity<DVec2>,
        &mut AngularVelocity<f64>,
        Option<&mut PreviousVelocity<DVec2, f64>>,
    )>,
) {
    for (path, position, orientation, mut velocity, mut angular_velocity, previous) in &mut bodies {
        let Some((target, angle)) = path.at(clock.time_after_part()) else { continue };
        velocity.bypass_change_detection().0 = (target - position.0) * (1.0 / clock.part());
        angular_velocity.bypass_change_detection().0 = (angle - orientation.0.angle()) * (1.0 / clock.part());
        if let Some(mut previous) = previous {
            let previous = previous.bypass_change_detection();
            (previous.linear, previous.angular) = (velocity.0, angular_velocity.0);
        }
    }
}
