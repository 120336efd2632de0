//! A fine run, and how far another is from it.

use tumble_math::Linear;
use tumble_record::{BodyKind, BodyState, Recording, Sample};
use tumble_scene::{Loaded, SceneDim};
use tumble_sim::StepError;

use super::figures::worse;
use super::{Case, REFERENCE_STEPS, finished};
use crate::args::Overrides;
use crate::failure::Failure;
use crate::simulate::{Ending, Prepared, Progress};
use crate::source::Source;

/// A run with small steps.
pub struct Reference<D: SceneDim> {
    recording: Recording<D>,
}

impl<D: SceneDim> Reference<D> {
    /// Builds the scene with small steps; it is sampled as often as the finest of the other runs.
    pub fn prepare(case: &Case, source: &Source, loaded: &Loaded<D>) -> Result<Prepared<D>, Failure> {
        let overrides = Overrides { contact: Some(case.contact), dt: Some(case.dt), duration: None };
        Prepared::sampled(source, loaded.clone(), &overrides, Some(REFERENCE_STEPS), |_| Vec::new())
    }

    /// Takes the reference run, which may fail like any other.
    pub fn run(mut prepared: Prepared<D>) -> Result<Result<Self, StepError>, Failure> {
        let run = finished(prepared.run(Progress::Shown))?;
        Ok(match run.ending {
            Ending::Failed(error) => Err(error),
            Ending::Complete | Ending::Interrupted => Ok(Self { recording: run.recording }),
        })
    }

    /// Largest distance of a dynamic body of another run of the same scene from where it is here [m].
    pub fn distance_to(&self, other: &Recording<D>) -> Option<f64> {
        let dynamic = (0..other.bodies.len()).filter(|&body| other.bodies[body].kind == BodyKind::Dynamic);
        let dynamic: Vec<usize> = dynamic.collect();
        let distances = other.samples.iter().flat_map(|sample| {
            dynamic.iter().filter_map(|&body| {
                let there = sample.state(body)?.position;
                Some((self.position(body, sample.time)? - there).length())
            })
        });
        distances.reduce(worse)
    }

    /// Where a body is at a time: that of a sample, or by the cubic through places and velocities of the samples around it [m].
    fn position(&self, body: usize, time: f64) -> Option<D::Vector> {
        let samples = &self.recording.samples;
        // The same time may be a different product of a number of steps and a step.
        let tolerance = 1e-6 * self.recording.dt;
        let next = samples.partition_point(|sample| sample.time < time - tolerance);
        let after = samples.get(next)?;
        let end = after.state(body)?;
        if (after.time - time).abs() <= tolerance || next == 0 {
            return Some(end.position);
        }
        let before = &samples[next - 1];
        Some(hermite(before, before.state(body)?, after, end, time))
    }
}

/// The cubic with the places and velocities of two samples, at a time between them [m].
fn hermite<D: SceneDim>(
    before: &Sample<D>,
    start: &BodyState<D>,
    after: &Sample<D>,
    end: &BodyState<D>,
    time: f64,
) -> D::Vector {
    let span = after.time - before.time;
    let s = (time - before.time) / span;
    let (from, to) = (start.position, end.position);
    let (slope_from, slope_to) = (start.velocity * span, end.velocity * span);
    let rest = 1.0 - s;
    from * (rest * rest * (1.0 + 2.0 * s)) + to * (s * s * (3.0 - 2.0 * s)) + slope_from * (s * rest * rest)
        - slope_to * (s * s * rest)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use tumble_math::Planar;

    use super::*;

    #[test]
    fn between_samples_a_throw_is_followed_exactly() {
        // A parabola is a cubic.
        let at = |time: f64| BodyState {
            position: DVec2::new(2.0 * time, 3.0 * time - 5.0 * time * time),
            velocity: DVec2::new(2.0, 3.0 - 10.0 * time),
            ..BodyState::default()
        };
        let sample = |time: f64| Sample::<Planar> { time, ..Sample::default() };
        for time in [0.2, 0.35, 0.6] {
            let found = hermite(&sample(0.2), &at(0.2), &sample(0.6), &at(0.6), time);
            // Rounding of numbers near 1.
            assert!((found - at(time).position).length() < 1e-14, "{found}");
        }
    }
}
