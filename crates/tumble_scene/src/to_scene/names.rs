//! The bodies and joints that an expectation is about.

use crate::format::{Event, Expectation};

/// Names of bodies, as written.
pub(super) fn bodies_named(expectation: &Expectation) -> Vec<&str> {
    match expectation {
        Expectation::Position(e) | Expectation::Velocity(e) => vec![&e.of],
        Expectation::X(e)
        | Expectation::Y(e)
        | Expectation::VelocityX(e)
        | Expectation::VelocityY(e)
        | Expectation::Speed(e)
        | Expectation::AngularVelocity(e) => vec![&e.of],
        Expectation::Angle(e) => vec![&e.of],
        Expectation::AtRest(e) => e.of.as_deref().into_iter().collect(),
        Expectation::ContactForceSum(e) => [Some(&*e.on), e.by.as_deref()].into_iter().flatten().collect(),
        Expectation::FrictionForce(e) => [Some(&*e.on), e.by.as_deref()].into_iter().flatten().collect(),
        Expectation::Order(e) => e.events.iter().flat_map(Event::bodies).collect(),
        Expectation::Happens(e) => e.event.bodies().into(),
        Expectation::Never(e) => e.event.bodies().into(),
        Expectation::EnergyNeverRises(_)
        | Expectation::EnergyKept(_)
        | Expectation::MomentumKept(_)
        | Expectation::AngularMomentumKept(_)
        | Expectation::Depth(_)
        | Expectation::JointForce(_)
        | Expectation::Fingerprint(_) => Vec::new(),
    }
}

/// Name of the joint, if it is about one.
pub(super) fn joint_named(expectation: &Expectation) -> Option<&str> {
    match expectation {
        Expectation::JointForce(e) => Some(&e.of),
        _ => None,
    }
}
