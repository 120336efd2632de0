//! What is expected of contact forces: the impulses of a step divided by dt.

use glam::DVec2;
use tumble_record::{BodyKind, ContactRecord, Sample};

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::expand::copies;
use crate::format::{BodyEntry, ForceExpectation, FrictionExpectation, TargetForce, When};

/// What a force is compared with; a weight depends on the body.
pub(super) fn expected(e: &ForceExpectation) -> Option<Expected> {
    match e.is {
        TargetForce::Weight => None,
        TargetForce::Newtons(magnitude) => Some(Expected::near(magnitude, e.within)),
        TargetForce::Vector(x, y) => Some(Expected::Vector { is: DVec2::new(x, y), within: e.within }),
    }
}

/// On which bodies, by which bodies, and when.
struct Forces<'e> {
    on: &'e str,
    by: Option<&'e str>,
    when: When,
}

/// A force on one body [N], and when if it is of one step [s].
struct ForceAt {
    force: DVec2,
    time: Option<f64>,
}

impl Run<'_> {
    /// Vector sum of the contact forces on a body [N].
    pub(super) fn contact_force_sum(&self, e: &ForceExpectation, when: When) -> Result<Finding, NotMeasured> {
        let forces = Forces { on: &e.on, by: e.by.as_deref(), when };
        self.forces(&forces, ContactRecord::impulse_on_b, |body, force| {
            let (measured, expected) = match (e.is, expected(e)) {
                (TargetForce::Newtons(_), Some(expected)) => (Measured::Number(force.length()), expected),
                (_, Some(expected)) => (Measured::Vector(force), expected),
                (_, None) => {
                    (Measured::Vector(force), Expected::Vector { is: self.support(body, &e.on)?, within: e.within })
                }
            };
            Ok((measured, expected))
        })
    }

    /// Magnitude of the vector sum of the friction forces on a body [N].
    pub(super) fn friction_force(&self, e: &FrictionExpectation, when: When) -> Result<Finding, NotMeasured> {
        let forces = Forces { on: &e.on, by: e.by.as_deref(), when };
        let friction = |contact: &ContactRecord| contact.tangent() * contact.tangent_impulse;
        self.forces(&forces, friction, |_, force| {
            Ok((Measured::Number(force.length()), Expected::near(e.is, e.within)))
        })
    }

    /// Sums what each contact does to b over the contacts of each body, and compares the worst of the bodies.
    fn forces(
        &self,
        forces: &Forces,
        impulse_on_b: impl Fn(&ContactRecord) -> DVec2,
        compare: impl Fn(usize, DVec2) -> Result<(Measured, Expected), NotMeasured>,
    ) -> Result<Finding, NotMeasured> {
        let by = forces.by.map(|name| self.bodies(name)).transpose()?;
        let acts = |other: usize| by.as_ref().is_none_or(|bodies| bodies.binary_search(&other).is_ok());
        let mut found = Vec::new();
        for body in self.bodies(forces.on)? {
            let force_in = |sample: &Sample| -> Result<DVec2, NotMeasured> {
                self.timeline.state(sample, body)?;
                let impulse: DVec2 = sample
                    .contacts
                    .iter()
                    .map(|contact| match contact {
                        contact if contact.b == body && acts(contact.a) => impulse_on_b(contact),
                        contact if contact.a == body && acts(contact.b) => -impulse_on_b(contact),
                        _ => DVec2::ZERO,
                    })
                    .sum();
                Ok(impulse / self.timeline.recording.dt)
            };
            let ForceAt { force, time } = self.force_when(forces.when, force_in)?;
            let (measured, expected) = compare(body, force)?;
            found.push(Finding { measured, expected, time, body: Some(body) });
        }
        worst(found).ok_or(NotMeasured::EmptyWindow)
    }

    /// The force near a time, or its average over a window.
    fn force_when(
        &self,
        when: When,
        force_in: impl Fn(&Sample) -> Result<DVec2, NotMeasured>,
    ) -> Result<ForceAt, NotMeasured> {
        if let When::At(time) = when {
            let sample = self.timeline.sample_after_a_step_near(time)?;
            return Ok(ForceAt { force: force_in(sample)?, time: Some(sample.time) });
        }
        self.timeline.reach_end_of(when)?;
        let (mut sum, mut count) = (DVec2::ZERO, 0.0);
        for sample in self.timeline.samples(when).filter(|sample| sample.step > 0) {
            sum += force_in(sample)?;
            count += 1.0;
        }
        if count == 0.0 { Err(NotMeasured::EmptyWindow) } else { Ok(ForceAt { force: sum / count, time: None }) }
    }

    /// The force that carries a body, which the scene calls `name`: the opposite of gravity on it [N].
    fn support(&self, body: usize, name: &str) -> Result<DVec2, NotMeasured> {
        let record = &self.timeline.recording.bodies[body];
        if record.kind != BodyKind::Dynamic {
            return Err(NotMeasured::NoWeight { body: record.name.clone() });
        }
        let entry = self.entry_of(name).ok_or_else(|| NotMeasured::UnknownBody { name: name.to_owned() })?;
        Ok(-self.scene.gravity * entry.gravity_scale * record.mass)
    }

    /// What the scene says about a body, or about a family of copies.
    fn entry_of(&self, name: &str) -> Option<&BodyEntry> {
        let mut entries = self.scene.bodies.iter();
        let by_own_name = self.scene.bodies.iter().find(|entry| entry.name == name);
        by_own_name.or_else(|| entries.find(|entry| copies(entry).any(|copy| copy.name == name)))
    }
}
