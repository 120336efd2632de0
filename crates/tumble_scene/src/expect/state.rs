//! What is expected of the state of bodies: where they are, how they move, whether they rest, and every bit of it.

use tumble_record::{BodyKind, BodyState};

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run, expected};
use crate::format::{AtRestExpectation, Expectation, When};

/// The quantity that an expectation of a state speaks about.
fn quantity(expectation: &Expectation, state: &BodyState) -> Option<Measured> {
    Some(match expectation {
        Expectation::Position(_) => Measured::Vector(state.position),
        Expectation::X(_) => Measured::Number(state.position.x),
        Expectation::Y(_) => Measured::Number(state.position.y),
        Expectation::Angle(_) => Measured::Number(state.angle.to_degrees()),
        Expectation::Velocity(_) => Measured::Vector(state.velocity),
        Expectation::VelocityX(_) => Measured::Number(state.velocity.x),
        Expectation::VelocityY(_) => Measured::Number(state.velocity.y),
        Expectation::Speed(_) => Measured::Number(state.velocity.length()),
        Expectation::AngularVelocity(_) => Measured::Number(state.angular_velocity),
        _ => return None,
    })
}

/// The body that an expectation of a state speaks about.
fn body_of(expectation: &Expectation) -> Option<&str> {
    match expectation {
        Expectation::Position(e) | Expectation::Velocity(e) => Some(&e.of),
        Expectation::X(e)
        | Expectation::Y(e)
        | Expectation::VelocityX(e)
        | Expectation::VelocityY(e)
        | Expectation::Speed(e)
        | Expectation::AngularVelocity(e) => Some(&e.of),
        Expectation::Angle(e) => Some(&e.of),
        _ => None,
    }
}

impl Run<'_> {
    /// Position, angle and velocity, and parts of them.
    pub(super) fn state(&self, expectation: &Expectation) -> Result<Finding, NotMeasured> {
        let (Some(name), Some(expected)) = (body_of(expectation), expected(expectation)) else {
            unreachable!("only states are measured here")
        };
        let when = expectation.when();
        let finding = |body, state: &BodyState, time| {
            let measured = quantity(expectation, state).expect("only states are measured here");
            Finding { measured, expected: expected.clone(), time: Some(time), body: Some(body) }
        };
        let mut found = Vec::new();
        for body in self.bodies(name)? {
            match when {
                When::At(time) => {
                    let at = self.timeline.state_at(body, time)?;
                    found.push(finding(body, &at.state, at.time));
                }
                When::Throughout { .. } => {
                    let findings = self
                        .timeline
                        .samples(when)
                        .map(|sample| Ok(finding(body, self.timeline.state(sample, body)?, sample.time)));
                    found.extend(worst(findings.collect::<Result<Vec<_>, _>>()?));
                }
            }
        }
        self.timeline.conclude(worst(found), when)
    }

    /// Rest of one body, or of every dynamic body while it is in the world.
    pub(super) fn at_rest(&self, e: &AtRestExpectation) -> Result<Finding, NotMeasured> {
        let when = When::Throughout { from: e.from, until: f64::INFINITY };
        let expected =
            Expected::Rest { speed_below: e.speed_below, turn_below: e.turn_below, drift_below: e.drift_below };
        let recording = self.timeline.recording;
        let bodies = match &e.of {
            Some(name) => self.bodies(name)?,
            None => {
                (0..recording.bodies.len()).filter(|&body| recording.bodies[body].kind == BodyKind::Dynamic).collect()
            }
        };
        if bodies.is_empty() {
            return Err(NotMeasured::NoDynamicBody);
        }
        let mut found = Vec::new();
        for body in bodies {
            let mut start = None;
            let mut findings = Vec::new();
            for sample in self.timeline.samples(when) {
                let state = match (self.timeline.state(sample, body), &e.of) {
                    (Ok(state), _) => state,
                    (Err(_), None) => continue,
                    (Err(absent), Some(_)) => return Err(absent),
                };
                let start = *start.get_or_insert(state.position);
                let measured = Measured::Rest {
                    speed: state.velocity.length(),
                    turn: state.angular_velocity.abs(),
                    drift: (state.position - start).length(),
                };
                findings.push(Finding {
                    measured,
                    expected: expected.clone(),
                    time: Some(sample.time),
                    body: Some(body),
                });
            }
            found.extend(worst(findings));
        }
        self.timeline.conclude(worst(found), when)
    }

    /// Every bit of the final state.
    pub(super) fn fingerprint(&self, digits: &str) -> Result<Finding, NotMeasured> {
        let last = self.timeline.end()?;
        Ok(Finding {
            measured: Measured::Fingerprint(self.timeline.recording.fingerprint(last)),
            expected: Expected::Fingerprint(digits.to_owned()),
            time: Some(last.time),
            body: None,
        })
    }
}
