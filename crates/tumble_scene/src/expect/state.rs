//! What is expected of the state of bodies: where they are, how they move, whether they rest, and every bit of it.

use tumble_record::{BodyKind, BodyState};

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::format::{AtRestExpectation, When};

impl Run<'_> {
    /// A quantity of a body's state.
    pub(super) fn state(
        &self,
        name: &str,
        when: When,
        expected: Expected,
        quantity: impl Fn(&BodyState) -> Measured,
    ) -> Result<Finding, NotMeasured> {
        let finding = |body, state: &BodyState, time| Finding {
            measured: quantity(state),
            expected: expected.clone(),
            time: Some(time),
            body: Some(body),
        };
        let mut found = Vec::new();
        for body in self.bodies(name)? {
            match when {
                When::At(time) => {
                    let at = self.timeline.state_at(body, time)?;
                    found.push(finding(body, &at.state, at.time));
                }
                When::Throughout { .. } => {
                    let samples = self.timeline.samples(when);
                    let findings =
                        samples.map(|sample| Ok(finding(body, self.timeline.state(sample, body)?, sample.time)));
                    found.extend(worst(findings.collect::<Result<Vec<_>, _>>()?));
                }
            }
        }
        self.timeline.conclude(worst(found), when)
    }

    /// Rest of one body, or of every dynamic body while it is in the world.
    pub(super) fn at_rest(&self, e: &AtRestExpectation) -> Result<Finding, NotMeasured> {
        let when = When::Throughout { from: e.from, until: f64::INFINITY };
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
                findings.push(Finding { measured, expected: e.into(), time: Some(sample.time), body: Some(body) });
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
