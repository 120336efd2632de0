//! Timing and counting.

use std::time::Instant;

use tumble_bench::memory::held_bytes;
use tumble_sim::{Geometry, Simulation, StepError};

/// Time of one step.
#[derive(Clone, Copy, Debug)]
pub struct Timing {
    /// Microseconds a step.
    pub microseconds: f64,
}

impl Timing {
    /// Slower than anything.
    pub const SLOWEST: Self = Self { microseconds: f64::INFINITY };

    /// The faster of two.
    pub fn faster(self, other: Self) -> Self {
        Self { microseconds: self.microseconds.min(other.microseconds) }
    }

    /// Ratio to another.
    pub fn over(self, other: Self) -> f64 {
        self.microseconds / other.microseconds
    }
}

/// Time of a step: the fastest of several rounds of `steps`.
pub fn time_steps<D: Geometry>(simulation: &mut Simulation<D>, steps: u32, rounds: u32) -> Result<Timing, StepError> {
    simulation.step()?;
    let mut fastest = Timing::SLOWEST;
    for _ in 0..rounds {
        let started = Instant::now();
        for _ in 0..steps {
            simulation.step()?;
        }
        let microseconds = started.elapsed().as_secs_f64() * 1e6 / f64::from(steps);
        fastest = fastest.faster(Timing { microseconds });
    }
    Ok(fastest)
}

/// Bytes that one more body costs: the difference between 2000 and 1000 bodies, after a few steps.
pub fn bytes_per_body(build: impl Fn(usize) -> Simulation) -> Result<f64, StepError> {
    let bytes_of = |count: usize| -> Result<usize, StepError> {
        let before = held_bytes(crate::ALLOCATOR);
        let mut simulation = build(count);
        for _ in 0..3 {
            simulation.step()?;
        }
        let held = held_bytes(crate::ALLOCATOR) - before;
        drop(simulation);
        Ok(held)
    };
    Ok((bytes_of(2_000)? as f64 - bytes_of(1_000)? as f64) / 1_000.0)
}
