//! Springs and applied forces.

use tumble_math::Linear;

use super::Findings;
use super::bodies::BodyNames;
use crate::format::{AnchorEntry, Dialect, Scene};
use crate::path::ScenePath;

pub(super) fn check<D: Dialect>(scene: &Scene<D>, bodies: &BodyNames, found: &mut Findings) {
    springs(scene, bodies, found);
    forces(scene, bodies, found);
}

fn springs<D: Dialect>(scene: &Scene<D>, bodies: &BodyNames, found: &mut Findings) {
    for (index, spring) in scene.springs.iter().enumerate() {
        let path = ScenePath::root().field("springs").index(index);
        for (field, anchor) in [("from", &spring.from), ("to", &spring.to)] {
            if let AnchorEntry::Body { name, .. } = anchor {
                bodies.check(&path.field(field).field("name"), name, found);
            }
        }
        match (&spring.from, &spring.to) {
            (AnchorEntry::World { .. }, AnchorEntry::World { .. }) => {
                found.error(&path.field("to"), "a spring must hold a body", "both ends hold the world");
            }
            (AnchorEntry::Body { name: a, .. }, AnchorEntry::Body { name: b, .. }) if a == b => {
                found.error(
                    &path.field("to").field("name"),
                    format!("a spring ties \"{a}\" to itself"),
                    "the same body as at the other end",
                );
            }
            _ => {}
        }
        found.not_negative(&path.field("stiffness"), "the stiffness of a spring", spring.stiffness);
        found.not_negative(&path.field("damping"), "the damping of a spring", spring.damping);
        if let Some(length) = spring.rest_length {
            found.not_negative(&path.field("rest_length"), "the rest length of a spring", length);
        }
    }
}

fn forces<D: Dialect>(scene: &Scene<D>, bodies: &BodyNames, found: &mut Findings) {
    for (index, force) in scene.forces.iter().enumerate() {
        let path = ScenePath::root().field("forces").index(index);
        bodies.check(&path.field("on"), &force.on, found);
        if force.force == D::Vector::ZERO && force.torque == D::Angular::ZERO {
            found.warning(&path, "this force does nothing", "neither `force` nor `torque` is given");
        }
        found.not_negative(&path.field("from"), "the beginning of a force", force.from);
        if let Some(until) = force.until.filter(|until| *until <= force.from) {
            let label = format!("{until} s does not come after {} s", force.from);
            found.error(&path.field("until"), "a force must end after it begins", label);
        }
        for (index, pair) in force.factor.windows(2).enumerate() {
            let ((before, _), (after, _)) = (pair[0], pair[1]);
            if after <= before {
                let label = format!("{after} s does not come after {before} s");
                found.error(&path.field("factor").index(index + 1), "times of a factor must rise", label);
            }
        }
    }
}
