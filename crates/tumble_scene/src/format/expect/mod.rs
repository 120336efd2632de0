//! Expectations: what a run of the scene must show.
//!
//! Each says when, what and how closely, and `because` of what; `under` names the contact models for which it is claimed
//! (default: all).

mod event;
mod force;
mod state;
mod world;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ContactModel;

pub use event::{Event, HappensExpectation, NeverExpectation, OrderExpectation};
pub use force::{ForceExpectation, FrictionExpectation, JointForceExpectation, JointForcePart, TargetForce};
pub use state::{AngleExpectation, AtRestExpectation, FingerprintExpectation, ScalarExpectation, VectorExpectation};
pub use world::{DepthExpectation, EnergyNeverRisesExpectation, KeptExpectation};

/// Something a run must show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Expectation {
    /// Position of a body's centre of mass [m].
    Position(VectorExpectation),
    /// First coordinate of a body's centre of mass [m].
    X(ScalarExpectation),
    /// Second coordinate of a body's centre of mass [m].
    Y(ScalarExpectation),
    /// Angle of a body, counted over turns [degrees].
    Angle(AngleExpectation),
    /// Velocity of a body's centre of mass [m/s].
    Velocity(VectorExpectation),
    /// Velocity of a body's centre of mass along x [m/s].
    VelocityX(ScalarExpectation),
    /// Velocity of a body's centre of mass along y [m/s].
    VelocityY(ScalarExpectation),
    /// Magnitude of the velocity of a body's centre of mass [m/s].
    Speed(ScalarExpectation),
    /// Rate of turn of a body [rad/s].
    AngularVelocity(ScalarExpectation),
    /// A body that has come to rest.
    AtRest(AtRestExpectation),
    /// Total energy never rises above its lowest value so far.
    EnergyNeverRises(EnergyNeverRisesExpectation),
    /// Total energy stays what it was at the start [J].
    EnergyKept(KeptExpectation),
    /// Total momentum stays what it was at the start [kg·m/s].
    MomentumKept(KeptExpectation),
    /// Angular momentum about the origin stays what it was at the start [kg·m²/s].
    AngularMomentumKept(KeptExpectation),
    /// Deepest overlap of any two bodies [m].
    Depth(DepthExpectation),
    /// Vector sum of the contact forces on a body [N].
    ContactForceSum(ForceExpectation),
    /// Magnitude of the vector sum of the friction forces on a body [N].
    FrictionForce(FrictionExpectation),
    /// Force or torque of a joint [N], [N·m].
    JointForce(JointForceExpectation),
    /// Events that happen one before the other.
    Order(OrderExpectation),
    /// An event that happens at a time.
    Happens(HappensExpectation),
    /// An event that does not happen.
    Never(NeverExpectation),
    /// Every bit of the final state.
    Fingerprint(FingerprintExpectation),
}

/// When an expectation must hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At one time [s].
    At(f64),
    /// From a time until another, ends included; infinite for the end of the run [s].
    Throughout {
        /// The first time [s].
        from: f64,
        /// The last time [s].
        until: f64,
    },
}

impl When {
    /// Reads the fields of an expectation; without any of them, the whole run.
    fn of(at: Option<f64>, from: Option<f64>, until: Option<f64>) -> Self {
        match at {
            Some(time) => Self::At(time),
            None => Self::Throughout { from: from.unwrap_or(0.0), until: until.unwrap_or(f64::INFINITY) },
        }
    }
}

impl Expectation {
    /// The variant's name, as it stands in a file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Position(_) => "Position",
            Self::X(_) => "X",
            Self::Y(_) => "Y",
            Self::Angle(_) => "Angle",
            Self::Velocity(_) => "Velocity",
            Self::VelocityX(_) => "VelocityX",
            Self::VelocityY(_) => "VelocityY",
            Self::Speed(_) => "Speed",
            Self::AngularVelocity(_) => "AngularVelocity",
            Self::AtRest(_) => "AtRest",
            Self::EnergyNeverRises(_) => "EnergyNeverRises",
            Self::EnergyKept(_) => "EnergyKept",
            Self::MomentumKept(_) => "MomentumKept",
            Self::AngularMomentumKept(_) => "AngularMomentumKept",
            Self::Depth(_) => "Depth",
            Self::ContactForceSum(_) => "ContactForceSum",
            Self::FrictionForce(_) => "FrictionForce",
            Self::JointForce(_) => "JointForce",
            Self::Order(_) => "Order",
            Self::Happens(_) => "Happens",
            Self::Never(_) => "Never",
            Self::Fingerprint(_) => "Fingerprint",
        }
    }

    /// Why it must be so, as written, and the contact models for which it is claimed (empty: all).
    pub fn because_and_under(&self) -> (&str, &[ContactModel]) {
        match self {
            Self::Position(e) | Self::Velocity(e) => (&e.because, &e.under),
            Self::X(e)
            | Self::Y(e)
            | Self::VelocityX(e)
            | Self::VelocityY(e)
            | Self::Speed(e)
            | Self::AngularVelocity(e) => (&e.because, &e.under),
            Self::Angle(e) => (&e.because, &e.under),
            Self::AtRest(e) => (&e.because, &e.under),
            Self::EnergyNeverRises(e) => (&e.because, &e.under),
            Self::EnergyKept(e) | Self::MomentumKept(e) | Self::AngularMomentumKept(e) => (&e.because, &e.under),
            Self::Depth(e) => (&e.because, &e.under),
            Self::ContactForceSum(e) => (&e.because, &e.under),
            Self::FrictionForce(e) => (&e.because, &e.under),
            Self::JointForce(e) => (&e.because, &e.under),
            Self::Order(e) => (&e.because, &e.under),
            Self::Happens(e) => (&e.because, &e.under),
            Self::Never(e) => (&e.because, &e.under),
            Self::Fingerprint(e) => (&e.because, &e.under),
        }
    }

    /// Claims it for every contact model, whatever the scene says.
    pub fn claim_under_all(&mut self) {
        match self {
            Self::Position(e) | Self::Velocity(e) => e.under.clear(),
            Self::X(e)
            | Self::Y(e)
            | Self::VelocityX(e)
            | Self::VelocityY(e)
            | Self::Speed(e)
            | Self::AngularVelocity(e) => e.under.clear(),
            Self::Angle(e) => e.under.clear(),
            Self::AtRest(e) => e.under.clear(),
            Self::EnergyNeverRises(e) => e.under.clear(),
            Self::EnergyKept(e) | Self::MomentumKept(e) | Self::AngularMomentumKept(e) => e.under.clear(),
            Self::Depth(e) => e.under.clear(),
            Self::ContactForceSum(e) => e.under.clear(),
            Self::FrictionForce(e) => e.under.clear(),
            Self::JointForce(e) => e.under.clear(),
            Self::Order(e) => e.under.clear(),
            Self::Happens(e) => e.under.clear(),
            Self::Never(e) => e.under.clear(),
            Self::Fingerprint(e) => e.under.clear(),
        }
    }

    /// Whether it is claimed for a contact model.
    pub fn is_claimed_under(&self, model: ContactModel) -> bool {
        let (_, under) = self.because_and_under();
        under.is_empty() || under.contains(&model)
    }

    /// When it must hold; the whole run for those that say nothing.
    pub fn when(&self) -> When {
        match self {
            Self::Position(e) | Self::Velocity(e) => When::of(e.at, e.from, e.until),
            Self::X(e)
            | Self::Y(e)
            | Self::VelocityX(e)
            | Self::VelocityY(e)
            | Self::Speed(e)
            | Self::AngularVelocity(e) => When::of(e.at, e.from, e.until),
            Self::Angle(e) => When::of(e.at, e.from, e.until),
            Self::AtRest(e) => When::of(None, Some(e.from), None),
            Self::Depth(e) => When::of(e.at, e.from, e.until),
            Self::ContactForceSum(e) => When::of(e.at, e.from, e.until),
            Self::FrictionForce(e) => When::of(e.at, e.from, e.until),
            Self::JointForce(e) => When::of(e.at, e.from, e.until),
            Self::Happens(e) => When::At(e.at),
            Self::EnergyNeverRises(_)
            | Self::EnergyKept(_)
            | Self::MomentumKept(_)
            | Self::AngularMomentumKept(_)
            | Self::Order(_)
            | Self::Never(_)
            | Self::Fingerprint(_) => When::of(None, None, None),
        }
    }
}
