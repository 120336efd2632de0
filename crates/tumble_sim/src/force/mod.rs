//! Forces: components read by systems in [`StepSystems::AccumulateForces`](crate::StepSystems). Forces last one step.

mod applied;
mod drag;
mod gravity;
mod spring;

pub use applied::{AppliedForce, Axes, Course, apply_forces};
pub use drag::{LinearDrag, QuadraticDrag, apply_linear_drag, apply_quadratic_drag};
pub use gravity::{GravityScale, apply_gravity, apply_scaled_gravity, gravity_potential};
pub use spring::{Anchor, Spring, apply_springs, spring_potential};
