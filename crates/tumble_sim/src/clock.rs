//! Time, counted in steps so that it never drifts.

use bevy_ecs::prelude::*;

/// The simulated time.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Steps taken so far.
    pub step: u64,
    /// Length of a step Δt [s].
    pub dt: f64,
}

impl Clock {
    /// Time at the start of the step being taken; between steps, the present [s].
    pub fn time(&self) -> f64 {
        self.step as f64 * self.dt
    }

    /// Time at the end of the step being taken [s].
    pub fn time_after_step(&self) -> f64 {
        (self.step + 1) as f64 * self.dt
    }
}
