//! Forces and torques that follow a course over time: constant, for a while, or piecewise linear (the quiz's growing push, L12).

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Rotation};

use crate::Clock;
use crate::body::{Force, InDim, Orientation, Torque};

/// Axes in which a force is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// World axes: the force keeps its direction.
    #[default]
    World,
    /// Body axes: the force turns with the body.
    Body,
}

/// A quantity over time.
#[derive(Clone, Debug, PartialEq)]
pub enum ForceCourse<T> {
    /// The same at all times.
    Constant(T),
    /// The same from one time to another [s], else nothing.
    Window {
        /// First instant [s].
        from: f64,
        /// First instant without it [s].
        until: f64,
        /// The quantity.
        value: T,
    },
    /// Straight lines between (time [s], value) with rising times; nothing before the first and after the last.
    Lines(Vec<(f64, T)>),
}

impl<T: Linear> ForceCourse<T> {
    /// The quantity at a time.
    pub fn at(&self, time: f64) -> T {
        match self {
            Self::Constant(value) => *value,
            Self::Window { from, until, value } => {
                if (*from..*until).contains(&time) {
                    *value
                } else {
                    T::ZERO
                }
            }
            Self::Lines(points) => {
                let after = points.partition_point(|(at, _)| *at <= time);
                match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
                    (Some((t0, v0)), Some(&(t1, v1))) => v0 + (v1 - v0) * ((time - t0) / (t1 - t0)),
                    // The last point still counts at its own time.
                    (Some((at, value)), None) if at == time => value,
                    _ => T::ZERO,
                }
            }
        }
    }
}

/// A force at a point of a body, and a torque; an entity of its own.
///
/// Courses are read at the end of the step, where symplectic Euler's velocities are.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct AppliedForce<D: Dim> {
    /// The body.
    pub body: Entity,
    /// Where the force acts, in the body frame [m].
    pub point: D::Vector,
    /// The force [N].
    pub force: ForceCourse<D::Vector>,
    /// The torque, in world axes [N·m].
    pub torque: ForceCourse<D::Angular>,
    /// Axes of the force.
    pub axes: Axes,
}

/// Adds all applied forces.
pub fn apply_forces<D: Dim<Vector: InDim>>(
    clock: Res<Clock>,
    applied: Query<&AppliedForce<D>>,
    mut bodies: Query<(&Orientation<D::Rotation>, &mut Force<D::Vector>, &mut Torque<D::Angular>)>,
) {
    let time = clock.time_after_step();
    for applied in &applied {
        let Ok((orientation, mut force, mut torque)) = bodies.get_mut(applied.body) else { continue };
        let mut push = applied.force.at(time);
        if applied.axes == Axes::Body {
            push = orientation.0.rotate(push);
        }
        let arm = orientation.0.rotate(applied.point);
        force.bypass_change_detection().0 += push;
        torque.bypass_change_detection().0 += D::torque(arm, push) + applied.torque.at(time);
    }
}
