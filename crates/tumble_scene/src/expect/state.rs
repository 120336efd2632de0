//! What is expected of the state of bodies: where they are, how they move, whether they rest, and every bit of it.

use glam::DVec3;
use tumble_math::{Linear, Rotation, SpatialRotation, trig};
use tumble_record::{BodyKind, BodyState};

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::dim::SceneDim;
use crate::format::{AtRestExpectation, OrientationEntry, OrientationExpectation, TiltExpectation, When};

impl<D: SceneDim> Run<'_, D> {
    /// A quantity of a body's state.
    pub(super) fn state(
        &self,
        name: &str,
        when: When,
        expected: Expected,
        quantity: impl Fn(&BodyState<D>) -> Measured,
    ) -> Result<Finding, NotMeasured> {
        let finding = |body, state: &BodyState<D>, time| Finding {
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

    /// The turn that is missing from the orientation that is claimed [degrees].
    pub(super) fn orientation(&self, e: &OrientationExpectation, when: When) -> Result<Finding, NotMeasured> {
        let claimed =
            e.is.as_ref().map_or(Some(SpatialRotation::IDENTITY), OrientationEntry::rotation).unwrap_or_default();
        self.state(&e.of, when, Expected::near(0.0, e.within_degrees), |state| {
            let missing =
                D::in_space(&state.pose().rotation).map(|rotation| rotation.turn_to(&claimed).rotation_vector());
            Measured::Number(missing.map_or(f64::NAN, |turn| Linear::length(turn).to_degrees()))
        })
    }

    /// The angle between an axis of a body and a direction [degrees].
    pub(super) fn tilt(&self, e: &TiltExpectation, when: When) -> Result<Finding, NotMeasured> {
        let axis = e.axis.unwrap_or(DVec3::Y);
        let pointing = |state: &BodyState<D>| D::in_space(&state.pose().rotation).map(|rotation| rotation.rotate(axis));
        let mut found = Vec::new();
        for body in self.bodies(&e.of)? {
            let start = || self.timeline.recording.samples.iter().find_map(|sample| pointing(sample.state(body)?));
            let against = e.against.or_else(start).unwrap_or(DVec3::NAN);
            let name = &self.timeline.recording.bodies[body].name;
            found.push(self.state(name, when, e.into(), |state| {
                Measured::Number(pointing(state).map_or(f64::NAN, |axis| angle_between(axis, against).to_degrees()))
            })?);
        }
        worst(found).ok_or(NotMeasured::EmptyWindow)
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
                    turn: state.angular_velocity.length(),
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

/// The angle between two directions, as exact near 0 and π as in between [rad].
fn angle_between(one: DVec3, other: DVec3) -> f64 {
    trig::atan2(Linear::length(one.cross(other)), one.dot(other))
}
