//! Forces and torques that follow a course over time: constant, for a while, or growing (the quiz's push, L12).

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Rotation};

use crate::body::{Force, InDim, Orientation, Torque};
use crate::{Clock, Integrator, Settings};

/// Axes in which a force is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// World axes: the force keeps its direction.
    #[default]
    World,
    /// Body axes: the force turns with the body.
    Body,
}

/// When a force acts, and how strongly.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// First instant [s].
    pub from: f64,
    /// First instant without it; infinite for ever [s].
    pub until: f64,
    /// Factor over time: straight lines between (time [s], factor [1]) with rising times, held outside; empty means 1.
    pub factor: Vec<(f64, f64)>,
}

impl Default for Course {
    /// Always, at full strength.
    fn default() -> Self {
        Self { from: 0.0, until: f64::INFINITY, factor: Vec::new() }
    }
}

impl Course {
    /// From one time until another [s].
    pub fn window(from: f64, until: f64) -> Self {
        Self { from, until, ..Self::default() }
    }

    /// A factor that follows straight lines between (time [s], factor [1]).
    pub fn lines(factor: impl Into<Vec<(f64, f64)>>) -> Self {
        Self { factor: factor.into(), ..Self::default() }
    }

    /// The factor at a time; 0 outside the window [1].
    pub fn at(&self, time: f64) -> f64 {
        if !(self.from..self.until).contains(&time) {
            return 0.0;
        }
        let after = self.factor.partition_point(|(at, _)| *at <= time);
        match (after.checked_sub(1).map(|i| self.factor[i]), self.factor.get(after)) {
            (Some((t0, f0)), Some(&(t1, f1))) => f0 + (f1 - f0) * ((time - t0) / (t1 - t0)),
            (Some((_, held)), None) | (None, Some(&(_, held))) => held,
            (None, None) => 1.0,
        }
    }
}

/// A force at a point of a body, and a torque; an entity of its own.
///
/// Courses are read where the integrator takes the acceleration: symplectic Euler at the end of the step, ballistic at its start.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct AppliedForce<D: Dim> {
    /// The body.
    pub body: Entity,
    /// Where the force acts, in the body frame [m].
    pub point: D::Vector,
    /// The force at factor 1 [N].
    pub force: D::Vector,
    /// The torque at factor 1, besides that of the force [N·m].
    pub torque: D::Angular,
    /// Axes of the force.
    pub axes: Axes,
    /// When and how strongly.
    pub course: Course,
}

/// Adds all applied forces.
pub fn apply_forces<D: Dim<Vector: InDim>>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    applied: Query<&AppliedForce<D>>,
    mut bodies: Query<(&Orientation<D::Rotation>, &mut Force<D::Vector>, &mut Torque<D::Angular>)>,
) {
    let time = match settings.moves_by() {
        Integrator::SymplecticEuler => clock.time_after_part(),
        Integrator::Ballistic => clock.time(),
    };
    for applied in &applied {
        let factor = applied.course.at(time);
        let Ok((orientation, mut force, mut torque)) = bodies.get_mut(applied.body) else { continue };
        let mut push = applied.force * factor;
        if applied.axes == Axes::Body {
            push = orientation.0.rotate(push);
        }
        let arm = orientation.0.rotate(applied.point);
        force.bypass_change_detection().0 += push;
        torque.bypass_change_detection().0 += D::torque(arm, push) + applied.torque * factor;
    }
}
