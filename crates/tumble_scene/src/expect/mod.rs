//! Whether a run kept what its scene promised.
//!
//! [`evaluate`] compares each [`Expectation`] of a scene with a [`Recording`] and gives a [`Verdict`]: what was measured, what was
//! expected, and when. The rules:
//!
//! - **At a time**: the step nearest to the time decides; its own time is reported. Where that step was not sampled, the state
//!   (position, orientation, velocity, rate of turn) is interpolated linearly between the samples around it, and a force is that of the nearest
//!   sample. At the start no step has acted yet, so the force of the first step stands for it.
//! - **Throughout a window**, ends included: the worst sample decides, and its time is reported. A window without samples has failed.
//!   Forces are averaged over the window as vectors, and a magnitude is that of the average.
//! - **Never reached has failed**: a time past the end of the recording, or a claim about the whole run of a run that stopped early.
//! - **Not a number has failed**, whichever way it is compared.
//! - `within`, `slack`: the tolerance itself is allowed. `above`, `below`: the bound itself is not, save that a depth may be equal to it,
//!   so that 0 means no overlap at all.
//! - A repeated body's name means all of its copies, and each of them must hold. For `by` and for events it means any of them.
//! - **Touch** of two bodies is the first of their parts to touch, **part** the last to leave; where one part takes over from another
//!   within a step, the bodies stay in touch. Bodies that touch from the start begin to do so in the first step. Of two events in
//!   the same step neither is before the other.

mod event;
mod force;
mod joint;
mod judge;
mod print;
mod state;
mod timeline;
mod verdict;
mod watched;
mod world;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use tumble_math::{Linear, Vector};
use tumble_record::{BodyState, Recording, TurnAxis};

use crate::dim::{AngularClaim, SceneDim};
use crate::format::{ContactModel, Expectation, ScalarExpectation, Scene};
use timeline::Timeline;

pub use verdict::{Expected, Measured, Near, NotMeasured, Outcome, Status, Verdict, WorldVector};
pub use watched::watched_steps;

/// Compares every expectation of a scene with what was recorded under a contact model.
pub fn evaluate<D: SceneDim>(scene: &Scene<D>, model: ContactModel, recording: &Recording<D>) -> Verdict {
    (D::scene_engine().evaluate)(scene, model, recording)
}

pub(crate) fn verdict_of<D: SceneDim>(scene: &Scene<D>, model: ContactModel, recording: &Recording<D>) -> Verdict {
    let run = Run::new(scene, recording);
    let outcomes = scene.expect.iter().enumerate().map(|(index, expectation)| {
        let (because, _) = expectation.because_and_under();
        let mut outcome = Outcome {
            index,
            name: print::title(expectation),
            unit: print::unit(expectation),
            status: Status::NotClaimed,
            measured: None,
            expected: expected(expectation),
            time: None,
            body: None,
            obstacle: None,
            because: because.to_owned(),
        };
        if expectation.is_claimed_under(model) {
            match run.measure(expectation) {
                Ok(finding) => outcome.take(finding),
                Err(obstacle) => {
                    outcome.status = Status::Failed;
                    outcome.obstacle = Some(obstacle);
                }
            }
        }
        outcome
    });
    Verdict { outcomes: outcomes.collect() }
}

/// What an expectation expects, as far as that does not depend on the run.
fn expected<D: SceneDim>(expectation: &Expectation<D>) -> Option<Expected> {
    Some(match expectation {
        Expectation::Position(e) | Expectation::Velocity(e) => e.into(),
        Expectation::X(e)
        | Expectation::Y(e)
        | Expectation::Z(e)
        | Expectation::VelocityX(e)
        | Expectation::VelocityY(e)
        | Expectation::VelocityZ(e)
        | Expectation::Speed(e)
        | Expectation::AngularVelocityX(e)
        | Expectation::AngularVelocityY(e)
        | Expectation::AngularVelocityZ(e)
        | Expectation::TurnRate(e) => e.into(),
        Expectation::AngularVelocity(e) => match D::angular_claim(e) {
            AngularClaim::Scalar(e) => e.into(),
            AngularClaim::Vector(e) => e.into(),
        },
        Expectation::Angle(e) => e.into(),
        Expectation::Orientation(e) => Expected::near(0.0, e.within_degrees),
        Expectation::Tilt(e) => e.into(),
        Expectation::AtRest(e) => e.into(),
        Expectation::EnergyNeverRises(e) => Expected::AtMost(e.slack),
        Expectation::EnergyKept(_) | Expectation::MomentumKept(_) | Expectation::AngularMomentumKept(_) => return None,
        Expectation::Depth(e) => e.into(),
        Expectation::ContactForceSum(e) => return force::expected(e),
        Expectation::FrictionForce(e) => Expected::near(e.is, e.within),
        Expectation::JointForce(e) => e.into(),
        Expectation::Order(_) => Expected::Order,
        Expectation::Happens(e) => Expected::near(e.at, e.within),
        Expectation::Never(_) => Expected::Never,
        Expectation::Fingerprint(e) => Expected::Fingerprint(e.is.clone()),
    })
}

/// A component of a vector, which is not a number where the dimension has none.
fn component<V: Vector>(vector: V, axis: usize) -> f64 {
    if axis < V::AXES { vector[axis] } else { f64::NAN }
}

/// Rate of turn about a world axis, which is not a number in the plane [rad/s].
fn turn_about<D: SceneDim>(state: &BodyState<D>, axis: TurnAxis) -> f64 {
    D::about(state.angular_velocity, axis).unwrap_or(f64::NAN)
}

/// A scene and what was recorded of it.
struct Run<'r, D: SceneDim> {
    scene: &'r Scene<D>,
    timeline: Timeline<'r, D>,
    /// Index of each recorded body by its name.
    index_of: BTreeMap<&'r str, usize>,
}

/// What was measured for one expectation, and what is right.
#[derive(Clone, Debug)]
struct Finding {
    measured: Measured,
    expected: Expected,
    /// When it was measured [s].
    time: Option<f64>,
    /// Index of the body it was measured on.
    body: Option<usize>,
}

/// A finding with the body's name instead of its index.
struct NamedFinding {
    finding: Finding,
    body: Option<String>,
}

impl Outcome {
    /// Judges what was found.
    fn take(&mut self, NamedFinding { finding, body }: NamedFinding) {
        self.status = if finding.judgement().holds { Status::Met } else { Status::Failed };
        self.measured = Some(finding.measured);
        self.expected = Some(finding.expected);
        self.time = finding.time;
        self.body = body;
    }
}

impl<'r, D: SceneDim> Run<'r, D> {
    fn new(scene: &'r Scene<D>, recording: &'r Recording<D>) -> Self {
        let mut index_of = BTreeMap::new();
        for (index, name) in recording.body_names().enumerate() {
            index_of.entry(name).or_insert(index);
        }
        Self { scene, timeline: Timeline::new(recording, scene.duration), index_of }
    }

    fn measure(&self, expectation: &Expectation<D>) -> Result<NamedFinding, NotMeasured> {
        let when = expectation.when();
        let number = |e: &ScalarExpectation, quantity: fn(&BodyState<D>) -> f64| {
            self.state(&e.of, when, e.into(), |state| Measured::Number(quantity(state)))
        };
        let finding = match expectation {
            Expectation::Position(e) => self.state(&e.of, when, e.into(), |state| Measured::of_vector(state.position)),
            Expectation::X(e) => number(e, |state| state.position[0]),
            Expectation::Y(e) => number(e, |state| state.position[1]),
            Expectation::Z(e) => number(e, |state| component(state.position, 2)),
            Expectation::Angle(e) => {
                let degrees = |state: &BodyState<D>| D::angle(&state.orientation).unwrap_or(f64::NAN).to_degrees();
                self.state(&e.of, when, e.into(), |state| Measured::Number(degrees(state)))
            }
            Expectation::Orientation(e) => self.orientation(e, when),
            Expectation::Tilt(e) => self.tilt(e, when),
            Expectation::Velocity(e) => self.state(&e.of, when, e.into(), |state| Measured::of_vector(state.velocity)),
            Expectation::VelocityX(e) => number(e, |state| state.velocity[0]),
            Expectation::VelocityY(e) => number(e, |state| state.velocity[1]),
            Expectation::VelocityZ(e) => number(e, |state| component(state.velocity, 2)),
            Expectation::Speed(e) => number(e, |state| state.velocity.length()),
            Expectation::AngularVelocityX(e) => number(e, |state| turn_about(state, TurnAxis::X)),
            Expectation::AngularVelocityY(e) => number(e, |state| turn_about(state, TurnAxis::Y)),
            Expectation::AngularVelocityZ(e) => number(e, |state| turn_about(state, TurnAxis::Z)),
            Expectation::TurnRate(e) => number(e, |state| state.angular_velocity.length()),
            Expectation::AngularVelocity(e) => {
                let (of, claimed) = match D::angular_claim(e) {
                    AngularClaim::Scalar(e) => (&e.of, e.into()),
                    AngularClaim::Vector(e) => (&e.of, e.into()),
                };
                self.state(of, when, claimed, |state| D::measured(state.angular_velocity))
            }
            Expectation::AtRest(e) => self.at_rest(e),
            Expectation::EnergyNeverRises(e) => self.energy_never_rises(e.slack),
            Expectation::EnergyKept(e) => self.energy_kept(e.within),
            Expectation::MomentumKept(e) => self.momentum_kept(e.within),
            Expectation::AngularMomentumKept(e) => self.angular_momentum_kept(e.within),
            Expectation::Depth(e) => self.depth(e, when),
            Expectation::ContactForceSum(e) => self.contact_force_sum(e, when),
            Expectation::FrictionForce(e) => self.friction_force(e, when),
            Expectation::JointForce(e) => self.joint_force(e, when),
            Expectation::Order(e) => self.order(&e.events),
            Expectation::Happens(e) => self.happens(e),
            Expectation::Never(e) => self.never(&e.event),
            Expectation::Fingerprint(e) => self.fingerprint(&e.is),
        }?;
        let body = finding.body.map(|index| self.timeline.recording.bodies[index].name.clone());
        Ok(NamedFinding { finding, body })
    }

    /// Indices of the bodies that a name means, ascending; at least one.
    fn bodies(&self, name: &str) -> Result<Vec<usize>, NotMeasured> {
        let names = self.scene.names_meant_by(name).into_iter();
        let indices = names.map(|name| match self.index_of.get(name.as_str()) {
            Some(index) => Ok(*index),
            None => Err(NotMeasured::UnknownBody { name }),
        });
        let mut bodies = indices.collect::<Result<Vec<usize>, NotMeasured>>()?;
        if bodies.is_empty() {
            return Err(NotMeasured::UnknownBody { name: name.to_owned() });
        }
        bodies.sort_unstable();
        Ok(bodies)
    }
}
