//! Which systems a world needs: a system is registered only when something uses it, so that a body in free flight costs next to nothing.

use std::collections::BTreeSet;

use bevy_ecs::prelude::*;
use tumble_math::Linear;

use crate::Settings;
use crate::body::{Keyframes, PreviousVelocity};
use crate::contact::Colliders;
use crate::force::{AppliedForce, GravityScale, LinearDrag, QuadraticDrag, Spring};
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::ledger::Ledger;
use crate::settings::{ContactModel, PenaltyLaw};

/// Something that needs systems of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Need {
    Gravity,
    ScaledGravity,
    LinearDrag,
    QuadraticDrag,
    Springs,
    AppliedForces,
    Keyframes,
    Ballistic,
    Detection,
    Penalty,
    LectureFloor,
    Velocity,
    ImpactTimes,
    Resting,
    SoftStep,
    Sleep,
    Joints,
    JointSprings,
    Ledger,
}

/// What the world needs now.
pub(crate) fn needs<D: Geometry>(world: &mut World) -> BTreeSet<Need> {
    let settings = *world.resource::<Settings<D>>();
    let mut needs = BTreeSet::new();
    let mut need = |when: bool, what: Need| {
        if when {
            needs.insert(what);
        }
    };
    need(settings.gravity != D::Vector::ZERO, Need::Gravity);
    need(settings.gravity != D::Vector::ZERO && any::<GravityScale>(world), Need::ScaledGravity);
    need(any::<LinearDrag>(world), Need::LinearDrag);
    need(any::<QuadraticDrag>(world), Need::QuadraticDrag);
    need(any::<Spring<D::Vector>>(world), Need::Springs);
    need(any::<AppliedForce<D>>(world), Need::AppliedForces);
    need(any::<Keyframes<D::Vector, D::Rotation>>(world), Need::Keyframes);
    need(any::<PreviousVelocity<D::Vector, D::Angular>>(world), Need::Ballistic);
    need(world.contains_resource::<Ledger>(), Need::Ledger);
    let contacts = world.resource::<Colliders<D>>().as_slice().len() > 1;
    let joints = !world.resource::<JointTable<D>>().entries().is_empty();
    need(contacts, Need::Detection);
    match (settings.contact, settings.penalty.law) {
        (ContactModel::Impulse | ContactModel::VelocityLcp | ContactModel::RestingLcp, _) => {
            need((contacts || joints) && settings.contact == ContactModel::RestingLcp, Need::Resting);
            need(contacts || joints, Need::Velocity);
            need(contacts && settings.time_of_impact, Need::ImpactTimes);
            need(joints, Need::Joints);
        }
        (ContactModel::SoftStep, _) => {
            need(true, Need::SoftStep);
            need(settings.sleep.is_some(), Need::Sleep);
            need(joints, Need::Joints);
        }
        (ContactModel::Penalty, law) => {
            need(joints, Need::JointSprings);
            match law {
                PenaltyLaw::SpringDamper(_) => need(contacts, Need::Penalty),
                PenaltyLaw::Lecture { .. } => need(contacts, Need::LectureFloor),
            }
        }
    }
    needs
}

/// Whether any entity has a component.
fn any<C: Component>(world: &mut World) -> bool {
    world.query_filtered::<(), With<C>>().iter(world).next().is_some()
}
