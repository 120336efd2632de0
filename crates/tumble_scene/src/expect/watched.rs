//! Which steps the expectations of a scene look at, so that the others need not be kept.

use std::ops::RangeInclusive;

use crate::format::{ContactModel, Dialect, Expectation, Scene, When};

/// Spans of steps whose samples decide about the expectations that are claimed for a contact model, in no order.
///
/// With these sampled the verdict is that of a recording with every step. Energy, momentum, overlap and events need no samples.
pub fn watched_steps<D: Dialect>(scene: &Scene<D>, model: ContactModel) -> Vec<RangeInclusive<u64>> {
    let claimed = scene.expect.iter().filter(|expectation| expectation.is_claimed_under(model));
    claimed
        .filter(|expectation| needs_samples(expectation))
        .map(|expectation| span(expectation.when(), scene.dt))
        .collect()
}

fn needs_samples<D: Dialect>(expectation: &Expectation<D>) -> bool {
    match expectation {
        Expectation::Position(_)
        | Expectation::X(_)
        | Expectation::Y(_)
        | Expectation::Z(_)
        | Expectation::Angle(_)
        | Expectation::Orientation(_)
        | Expectation::Tilt(_)
        | Expectation::Velocity(_)
        | Expectation::VelocityX(_)
        | Expectation::VelocityY(_)
        | Expectation::VelocityZ(_)
        | Expectation::Speed(_)
        | Expectation::AngularVelocity(_)
        | Expectation::AngularVelocityX(_)
        | Expectation::AngularVelocityY(_)
        | Expectation::AngularVelocityZ(_)
        | Expectation::TurnRate(_)
        | Expectation::AtRest(_)
        | Expectation::ContactForceSum(_)
        | Expectation::FrictionForce(_)
        | Expectation::JointForce(_) => true,
        // The last step, which a fingerprint is of, is always sampled.
        Expectation::EnergyNeverRises(_)
        | Expectation::EnergyKept(_)
        | Expectation::MomentumKept(_)
        | Expectation::AngularMomentumKept(_)
        | Expectation::Depth(_)
        | Expectation::Order(_)
        | Expectation::Happens(_)
        | Expectation::Never(_)
        | Expectation::Fingerprint(_) => false,
    }
}

/// The steps of a moment, and one more to each side, whichever way a time is rounded; never only the start, where no force has acted.
fn span(when: When, dt: f64) -> RangeInclusive<u64> {
    let (from, until) = match when {
        When::At(time) => (time, time),
        When::Throughout { from, until } => (from, until),
    };
    ((from / dt).floor() as u64).saturating_sub(1)..=((until / dt).ceil() as u64).saturating_add(1)
}
