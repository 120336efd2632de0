//! What is measured of a run.

use tumble_math::Linear;
use tumble_record::{BodyKind, Recording, Sample, energy_drift};
use tumble_scene::SceneDim;
use tumble_scene::expect::{Status, Verdict};
use tumble_scene::format::{Expectation, Scene};

use super::reference::Reference;
use super::{Case, end_of};
use crate::simulate::{Ending, Run};

/// A line of the table. What was not measured, or has no meaning for a run that failed, is `None`.
#[derive(Clone, Debug)]
pub struct Row {
    /// What ran.
    pub case: Case,
    /// Number of steps taken.
    pub steps: u64,
    /// Expectations that were met.
    pub met: usize,
    /// Expectations that are claimed for the model.
    pub claimed: usize,
    /// All expectations of the scene.
    pub expectations: usize,
    /// Largest part of its tolerance that an expectation used; above 1 it was not met [1].
    pub worst_ratio: Option<f64>,
    /// Largest distance of a dynamic body from where the reference has it [m].
    pub reference_error: Option<f64>,
    /// Energy gained or lost, relative to the energy in play [1].
    pub energy_drift: Option<f64>,
    /// Deepest overlap [m].
    pub deepest_overlap: Option<f64>,
    /// Largest residual of the contact solver, in its own measure.
    pub residual: Option<f64>,
    /// Largest drift of a body that should rest, over the last tenth of the run [m/min].
    pub creep: Option<f64>,
    /// Time on the clock per step, recording included [µs].
    pub microseconds_per_step: f64,
    /// Why the run did not come to its end.
    pub failure: Option<String>,
}

impl Row {
    /// Measures a run.
    pub fn of<D: SceneDim>(
        case: &Case,
        run: &Run<D>,
        verdict: &Verdict,
        resting: &[usize],
        reference: Option<&Reference<D>>,
    ) -> Self {
        let recording = &run.recording;
        let steps = recording.samples.last().map_or(0, |sample| sample.step);
        let failure = match &run.ending {
            Ending::Failed(error) => Some(format!("the run failed: {error}")),
            Ending::Complete | Ending::Interrupted => None,
        };
        let complete = failure.is_none();
        let audit = recording.audit.iter();
        Self {
            case: *case,
            steps,
            met: verdict.count(Status::Met),
            claimed: verdict.count(Status::Met) + verdict.count(Status::Failed),
            expectations: verdict.outcomes.len(),
            worst_ratio: verdict.outcomes.iter().filter_map(|outcome| outcome.ratio()).reduce(worse),
            reference_error: reference.filter(|_| complete).and_then(|reference| reference.distance_to(recording)),
            energy_drift: energy_drift(recording).filter(|_| complete),
            deepest_overlap: audit.clone().map(|row| row.deepest_overlap).reduce(worse).filter(|_| complete),
            residual: audit.filter_map(|row| row.residual).reduce(worse),
            creep: creep(recording, resting).filter(|_| complete),
            microseconds_per_step: 1e6 * run.wall_time.as_secs_f64() / steps.max(1) as f64,
            failure,
        }
    }

    /// The model, with the step if that differs between rows.
    pub fn label(&self, with_step: bool) -> String {
        self.case.label(with_step)
    }
}

/// The larger of two; what is not a number is the worst.
pub fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::INFINITY } else { one.max(other) }
}

/// Bodies that the scene expects to be at rest in the last tenth of the run, under any model.
pub fn resting_bodies<D: SceneDim>(scene: &Scene<D>, recording: &Recording<D>) -> Vec<usize> {
    let is_dynamic = |body: &usize| recording.bodies[*body].kind == BodyKind::Dynamic;
    let mut bodies = Vec::new();
    for expectation in &scene.expect {
        match expectation {
            Expectation::AtRest(e) if e.from <= 0.9 * scene.duration => match &e.of {
                None => bodies.extend(0..recording.bodies.len()),
                Some(name) => {
                    bodies.extend(scene.names_meant_by(name).iter().filter_map(|name| recording.body(name)));
                }
            },
            _ => {}
        }
    }
    bodies.retain(is_dynamic);
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}

/// Largest drift of these bodies over the last tenth of the run [m/min].
fn creep<D: SceneDim>(recording: &Recording<D>, bodies: &[usize]) -> Option<f64> {
    let end = recording.samples.last()?;
    let start = recording.samples.iter().find(|sample| sample.time >= 0.9 * end_of(recording) - 0.6 * recording.dt)?;
    let minutes = (end.time - start.time) / 60.0;
    let drift = |body: &usize| {
        let place = |sample: &Sample<D>| sample.state(*body).map(|state| state.position);
        Some((place(end)? - place(start)?).length())
    };
    let drift = bodies.iter().filter_map(drift).reduce(worse)?;
    (minutes > 0.0).then(|| drift / minutes)
}
