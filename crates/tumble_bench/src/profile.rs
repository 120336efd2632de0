//! Where the time of a step goes, phase by phase: clock readings between the phases, without a hand in the simulation.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use bevy_ecs::schedule::IntoScheduleConfigs;
use tumble_sim::{Geometry, Simulation, StepSystems};

const PHASES: [StepSystems; 6] = [
    StepSystems::AccumulateForces,
    StepSystems::ComputeAccelerations,
    StepSystems::FilterVelocities,
    StepSystems::UpdatePositions,
    StepSystems::DetectCollisions,
    StepSystems::ResolveImpulses,
];

/// Time spent in each phase so far. Clones share it, so that it outlives the simulation.
#[derive(Clone, Default)]
pub struct Profile(Arc<Mutex<Spent>>);

#[derive(Default)]
struct Spent {
    phases: [Duration; PHASES.len()],
    steps: u32,
    last: Option<Instant>,
}

impl Profile {
    /// Takes the time of every phase of a simulation from now on.
    pub fn watch<D: Geometry>(&self, simulation: &mut Simulation<D>) {
        let begin = self.clone();
        simulation.add_systems((move || begin.begin_step()).before(PHASES[0]));
        for (phase, set) in PHASES.into_iter().enumerate() {
            let profile = self.clone();
            let reading = (move || profile.end_phase(phase)).after(set);
            match PHASES.get(phase + 1) {
                Some(next) => simulation.add_systems(reading.before(*next)),
                None => simulation.add_systems(reading),
            }
        }
    }

    fn begin_step(&self) {
        let mut spent = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        spent.steps += 1;
        spent.last = Some(Instant::now());
    }

    fn end_phase(&self, phase: usize) {
        let mut spent = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let now = Instant::now();
        let since = spent.last.replace(now).map_or(Duration::ZERO, |last| now - last);
        spent.phases[phase] += since;
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spent = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let sum: Duration = spent.phases.iter().sum();
        for (phase, time) in PHASES.iter().zip(spent.phases) {
            let name = format!("{phase:?}");
            let milliseconds = time.as_secs_f64() * 1e3 / f64::from(spent.steps.max(1));
            let part = 100.0 * time.as_secs_f64() / sum.as_secs_f64().max(f64::MIN_POSITIVE);
            writeln!(formatter, "{name:<20} {milliseconds:10.6} ms a step  {part:5.1} %")?;
        }
        Ok(())
    }
}
