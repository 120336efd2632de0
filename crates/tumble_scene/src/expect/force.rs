//! What is expected of contact forces: the impulses of a step divided by dt.

use tumble_math::Linear;
use tumble_record::{BodyKind, ContactRecord, Sample};

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::dim::SceneDim;
use crate::expand::copies;
use crate::format::{BodyEntry, ForceExpectation, FrictionExpectation, TargetForce, When};

/// What a force is compared with; a weight depends on the body.
pub(super) fn expected<D: SceneDim>(e: &ForceExpectation<D>) -> Option<Expected> {
    match e.is {
        TargetForce::Weight => None,
        TargetForce::Newtons(magnitude) => Some(Expected::near(magnitude, e.within)),
        TargetForce::Vector(is) => Some(Expected::near_vector(is, e.within)),
    }
}

/// On which bodies, by which bodies, and when.
struct Forces<'e> {
    on: &'e str,
    by: Option<&'e str>,
    when: When,
}

/// A force on one body [N], and when if it is of one step [s].
struct ForceAt<V> {
    force: V,
    time: Option<f64>,
}

impl<D: SceneDim> Run<'_, D> {
    /// Vector sum of the contact forces on a body [N].
    pub(super) fn contact_force_sum(&self, e: &ForceExpectation<D>, when: When) -> Result<Finding, NotMeasured> {
        let forces = Forces { on: &e.on, by: e.by.as_deref(), when };
        self.forces(&forces, ContactRecord::impulse_on_b, |body, force| {
            let (measured, expected) = match (e.is, expected(e)) {
                (TargetForce::Newtons(_), Some(expected)) => (Measured::Number(force.length()), expected),
                (_, Some(expected)) => (Measured::of_vector(force), expected),
                (_, None) => (Measured::of_vector(force), Expected::near_vector(self.support(body, &e.on)?, e.within)),
            };
            Ok((measured, expected))
        })
    }

    /// Magnitude of the vector sum of the friction forces on a body [N].
    pub(super) fn friction_force(&self, e: &FrictionExpectation, when: When) -> Result<Finding, NotMeasured> {
        let forces = Forces { on: &e.on, by: e.by.as_deref(), when };
        self.forces(&forces, ContactRecord::friction_on_b, |_, force| {
            Ok((Measured::Number(force.length()), Expected::near(e.is, e.within)))
        })
    }

    /// Sums what each contact does to b over the contacts of each body, and compares the worst of the bodies.
    fn forces(
        &self,
        forces: &Forces,
        impulse_on_b: impl Fn(&ContactRecord<D>) -> D::Vector,
        compare: impl Fn(usize, D::Vector) -> Result<(Measured, Expected), NotMeasured>,
    ) -> Result<Finding, NotMeasured> {
        let by = forces.by.map(|name| self.bodies(name)).transpose()?;
        let acts = |other: usize| by.as_ref().is_none_or(|bodies| bodies.binary_search(&other).is_ok());
        let mut found = Vec::new();
        for body in self.bodies(forces.on)? {
            let force_in = |sample: &Sample<D>| -> Result<D::Vector, NotMeasured> {
                self.timeline.state(sample, body)?;
                let mut impulse = D::Vector::ZERO;
                for contact in &sample.contacts {
                    if contact.b == body && acts(contact.a) {
                        impulse += impulse_on_b(contact);
                    } else if contact.a == body && acts(contact.b) {
                        impulse -= impulse_on_b(contact);
                    }
                }
                Ok(impulse * (1.0 / self.timeline.recording.dt))
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
        force_in: impl Fn(&Sample<D>) -> Result<D::Vector, NotMeasured>,
    ) -> Result<ForceAt<D::Vector>, NotMeasured> {
        if let When::At(time) = when {
            let sample = self.timeline.sample_after_a_step_near(time)?;
            return Ok(ForceAt { force: force_in(sample)?, time: Some(sample.time) });
        }
        self.timeline.reach_end_of(when)?;
        let (mut sum, mut count) = (D::Vector::ZERO, 0.0);
        for sample in self.timeline.samples(when).filter(|sample| sample.step > 0) {
            sum += force_in(sample)?;
            count += 1.0;
        }
        if count == 0.0 {
            Err(NotMeasured::EmptyWindow)
        } else {
            Ok(ForceAt { force: sum * (1.0 / count), time: None })
        }
    }

    /// The force that carries a body, which the scene calls `name`: the opposite of gravity on it [N].
    fn support(&self, body: usize, name: &str) -> Result<D::Vector, NotMeasured> {
        let record = &self.timeline.recording.bodies[body];
        if record.kind != BodyKind::Dynamic {
            return Err(NotMeasured::NoWeight { body: record.name.clone() });
        }
        let entry = self.entry_of(name).ok_or_else(|| NotMeasured::UnknownBody { name: name.to_owned() })?;
        Ok(-self.scene.gravity * entry.gravity_scale * record.mass)
    }

    /// What the scene says about a body, or about a family of copies.
    fn entry_of(&self, name: &str) -> Option<&BodyEntry<D>> {
        let mut entries = self.scene.bodies.iter();
        let by_own_name = self.scene.bodies.iter().find(|entry| entry.name == name);
        by_own_name.or_else(|| entries.find(|entry| copies(entry).any(|copy| copy.name == name)))
    }
}
