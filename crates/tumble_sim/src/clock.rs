//! Time, counted in steps so that it never drifts.

use bevy_ecs::prelude::*;

/// The simulated time.
///
/// A step is taken in one part, unless [`time_of_impact`](crate::Settings::time_of_impact) cuts it at impacts; every system of the
/// step moves by [`part`](Self::part).
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Steps taken so far.
    pub step: u64,
    /// Length of a step Δt [s].
    pub dt: f64,
    part: f64,
    done: f64,
    /// What is left of the step after the part [s].
    left: f64,
    part_before: f64,
}

impl Clock {
    /// A clock at time 0.
    pub fn new(dt: f64) -> Self {
        Self { step: 0, dt, part: dt, done: 0.0, left: 0.0, part_before: dt }
    }

    /// Length of the part of the step being taken [s].
    pub fn part(&self) -> f64 {
        self.part
    }

    /// Length of the part before [s].
    pub fn part_before(&self) -> f64 {
        self.part_before
    }

    /// Whether no part of the step is done yet.
    pub fn at_start_of_step(&self) -> bool {
        self.done == 0.0
    }

    /// Time at the start of the part being taken; between steps, the present [s].
    pub fn time(&self) -> f64 {
        self.step as f64 * self.dt + self.done
    }

    /// Time at the end of the part being taken [s].
    pub fn time_after_part(&self) -> f64 {
        if self.left > 0.0 { self.time() + self.part } else { (self.step + 1) as f64 * self.dt }
    }

    /// Makes the part being taken end early, after a shorter time [s].
    pub(crate) fn cut(&mut self, part: f64) {
        self.left += self.part - part;
        self.part = part;
    }

    /// Ends the part being taken; the next one is what is left of the step. True when nothing is.
    pub(crate) fn end_part(&mut self) -> bool {
        self.part_before = self.part;
        if self.left > 0.0 {
            self.done += self.part;
            (self.part, self.left) = (self.left, 0.0);
            return false;
        }
        (self.step, self.done, self.part) = (self.step + 1, 0.0, self.dt);
        true
    }
}
