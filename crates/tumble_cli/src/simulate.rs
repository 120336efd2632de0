//! A scene from its first step to its last, or as far as it gets.

use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use tumble_record::{Record, Recording, Sampling};
use tumble_scene::expect::{Verdict, evaluate, watched_steps};
use tumble_scene::format::Scene;
use tumble_scene::{FromScene, Loaded, SceneDim};
use tumble_sim::{BodyTable, Simulation, StepError};

use crate::args::Overrides;
use crate::failure::Failure;
use crate::interrupt;
use crate::source::Source;

/// Steps that a run may have. The audit of each stays in memory, about 0.2 kB, so that this many need 20 GB; and a slip in `dt` is told at once.
const MOST_STEPS: f64 = 1e8;

/// A scene that was read and built, and is ready to run.
pub struct Prepared<D: SceneDim> {
    /// The scene, as overridden.
    pub loaded: Loaded<D>,
    /// Its simulation, before the first step; it records every `every`-th step, and those that expectations look at.
    pub simulation: Simulation<D>,
    /// Its name.
    pub name: String,
    /// Steps between two samples that are kept.
    pub every: u32,
    /// Steps that are sampled.
    sampling: Sampling,
    steps: u64,
}

/// A run, as far as it got.
pub struct Run<D: SceneDim> {
    /// What happened.
    pub recording: Recording<D>,
    /// What a user should know about it.
    pub notices: Vec<String>,
    /// Time on the clock.
    pub wall_time: Duration,
    /// How it ended.
    pub ending: Ending,
}

/// How a run ended.
#[derive(Debug, PartialEq)]
pub enum Ending {
    /// All steps were taken.
    Complete,
    /// Somebody wanted it to end.
    Interrupted,
    /// A step failed.
    Failed(StepError),
}

impl<D: SceneDim> Prepared<D> {
    /// Builds a scene that was read; it samples what its expectations look at, so that `every` changes no verdict.
    pub fn new(source: &Source, loaded: Loaded<D>, overrides: &Overrides, every: Option<u32>) -> Result<Self, Failure> {
        Self::sampled(source, loaded, overrides, every, |scene| watched_steps(scene, scene.contact))
    }

    /// Builds a scene that was read; it samples every `every`-th step, and those of the spans.
    pub fn sampled(
        source: &Source,
        mut loaded: Loaded<D>,
        overrides: &Overrides,
        every: Option<u32>,
        spans: impl FnOnce(&Scene<D>) -> Vec<RangeInclusive<u64>>,
    ) -> Result<Self, Failure> {
        let label = source.label();
        let scene = &mut loaded.scene;
        scene.contact = overrides.contact.unwrap_or(scene.contact);
        scene.dt = overrides.dt.unwrap_or(scene.dt);
        scene.duration = overrides.duration.unwrap_or(scene.duration);
        let every = every.unwrap_or(scene.every);
        let steps = (scene.duration / scene.dt).round();
        if scene.duration < scene.dt {
            let message =
                format!("{label}: the duration {} s is shorter than one step of {} s", scene.duration, scene.dt);
            return Err(Failure::Arguments(message));
        }
        if steps > MOST_STEPS {
            let message = format!(
                "{label}: {} s in steps of {} s are {steps:.1e} steps; at most {MOST_STEPS:.0e} are run",
                scene.duration, scene.dt
            );
            return Err(Failure::Arguments(message));
        }
        let sampling = Sampling::every(every).and(spans(scene));
        let built = |error| Failure::of_build(&label, error);
        let mut simulation = Simulation::from_loaded(&loaded).map_err(built)?;
        simulation.record_sampled(sampling.clone()).map_err(|error| built(error.into()))?;
        let name = source.stem().to_string_lossy().into_owned();
        Ok(Self { loaded, simulation, name, every, sampling, steps: steps as u64 })
    }

    /// What is recorded so far.
    pub fn recording(&mut self) -> Option<&Recording<D>> {
        self.simulation.recording()
    }

    /// Takes all steps, or as many as possible.
    pub fn run(&mut self, progress: Progress) -> Run<D> {
        let bar = progress.bar(self.steps);
        let start = Instant::now();
        let mut ending = Ending::Complete;
        for step in 1..=self.steps {
            if interrupt::is_wanted() {
                ending = Ending::Interrupted;
                break;
            }
            if let Err(error) = self.simulation.step() {
                ending = Ending::Failed(error);
                break;
            }
            if let Some(bar) = &bar {
                bar.set_position(step);
            }
        }
        let wall_time = start.elapsed();
        if let Some(bar) = bar {
            bar.finish_and_clear();
        }
        let steps = self.simulation.clock().step;
        let mut recording = self.simulation.take_recording().unwrap_or_default();
        // The present of a step that failed halfway is the state neither before nor after it.
        if matches!(ending, Ending::Failed(_)) && !self.sampling.takes(steps) {
            recording.samples.pop();
        }
        recording.scene = self.name.clone();
        recording.about.clone_from(&self.loaded.scene.about);
        let world = self.simulation.world();
        let notices = self.simulation.notices().sentences(world.resource::<BodyTable>(), self.loaded.scene.dt);
        Run { recording, notices, wall_time, ending }
    }

    /// What came of the scene's expectations.
    pub fn verdict(&self, recording: &Recording<D>) -> Verdict {
        evaluate(&self.loaded.scene, self.loaded.scene.contact, recording)
    }
}

/// Whether somebody watches a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// A bar on standard error, if that is a terminal.
    Shown,
    /// None.
    Hidden,
}

impl Progress {
    fn bar(self, steps: u64) -> Option<ProgressBar> {
        let style = ProgressStyle::with_template("{wide_bar} {percent}% of {len} steps, {eta} left").ok()?;
        let bar = (self == Self::Shown).then(|| ProgressBar::new(steps).with_style(style))?;
        // Drawn nowhere, it need not be told of every step.
        (!bar.is_hidden()).then_some(bar)
    }
}

/// Keeps of a recording every `every`-th step, and the last.
pub fn thin<D: SceneDim>(recording: &mut Recording<D>, every: u32) {
    let last = recording.samples.last().map(|sample| sample.step);
    recording.samples.retain(|sample| sample.step.is_multiple_of(u64::from(every)) || Some(sample.step) == last);
}
