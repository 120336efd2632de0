//! Whether a run kept what its scene promised.
//!
//! [`evaluate`] compares each [`Expectation`] of a scene with a [`Recording`] and gives a [`Verdict`]: what was measured, what was
//! expected, and when. The rules:
//!
//! - **At a time**: the step nearest to the time decides; its own time is reported. Where that step was not sampled, the state
//!   (position, angle, velocity, rate of turn) is interpolated linearly between the samples around it, and a force is that of the nearest
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

use tumble_record::{BodyState, Recording};

use crate::format::{ContactModel, Expectation, ScalarExpectation, Scene};
use timeline::Timeline;

pub use verdict::{Expected, Measured, Near, NotMeasured, Outcome, Status, Verdict};
pub use watched::watched_steps;

/// Compares every expectation of a scene with what was recorded under a contact model.
pub fn evaluate(scene: &Scene, model: ContactModel, recording: &Recording) -> Verdict {
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
fn expected(expectation: &Expectation) -> Option<Expected> {
    Some(match expectation {
        Expectation::Position(e) | Expectation::Velocity(e) => e.into(),
        Expectation::X(e)
        | Expectation::Y(e)
        | Expectation::VelocityX(e)
        | Expectation::VelocityY(e)
        | Expectation::Speed(e)
        | Expectation::AngularVelocity(e) => e.into(),
        Expectation::Angle(e) => e.into(),
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

/// A scene and what was recorded of it.
struct Run<'r> {
    scene: &'r Scene,
    timeline: Timeline<'r>,
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

impl<'r> Run<'r> {
    fn new(scene: &'r Scene, recording: &'r Recording) -> Self {
        let mut index_of = BTreeMap::new();
        for (index, name) in recording.body_names().enumerate() {
            index_of.entry(name).or_insert(index);
        }
        Self { scene, timeline: Timeline::new(recording, scene.duration), index_of }
    }

    fn measure(&self, expectation: &Expectation) -> Result<NamedFinding, NotMeasured> {
        let when = expectation.when();
        let number = |e: &ScalarExpectation, quantity: fn(&BodyState) -> f64| {
            self.state(&e.of, when, e.into(), |state| Measured::Number(quantity(state)))
        };
        let finding = match expectation {
            Expectation::Position(e) => self.state(&e.of, when, e.into(), |state| Measured::Vector(state.position)),
            Expectation::X(e) => number(e, |state| state.position.x),
            Expectation::Y(e) => number(e, |state| state.position.y),
            Expectation::Angle(e) => {
                self.state(&e.of, when, e.into(), |state| Measured::Number(state.angle().to_degrees()))
            }
            Expectation::Velocity(e) => self.state(&e.of, when, e.into(), |state| Measured::Vector(state.velocity)),
            Expectation::VelocityX(e) => number(e, |state| state.velocity.x),
            Expectation::VelocityY(e) => number(e, |state| state.velocity.y),
            Expectation::Speed(e) => number(e, |state| state.velocity.length()),
            Expectation::AngularVelocity(e) => number(e, |state| state.angular_velocity),
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
