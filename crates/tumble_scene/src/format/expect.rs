//! Expectations: what a run of the scene must show.
//!
//! Each says when, what and how closely, and `because` of what; `under` names the contact models for which it is claimed
//! (default: all).

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ContactModel;

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
    /// Events that happen one before the other.
    Order(OrderExpectation),
    /// An event that happens at a time.
    Happens(HappensExpectation),
    /// An event that does not happen.
    Never(NeverExpectation),
    /// Every bit of the final state.
    Fingerprint(FingerprintExpectation),
}

/// A vector near a value. Say when by one of `at`, `always: true`, or `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VectorExpectation {
    /// Name of the body.
    pub of: String,
    /// When [s].
    #[serde(default)]
    pub at: Option<f64>,
    /// Whether it holds throughout the run. Default false.
    #[serde(default)]
    pub always: bool,
    /// When it begins to hold [s]. Default the start, if `until` is given.
    #[serde(default)]
    pub from: Option<f64>,
    /// When it ceases to hold [s]. Default the end, if `from` is given.
    #[serde(default)]
    pub until: Option<f64>,
    /// The value, in the unit of the expectation.
    #[schemars(with = "(f64, f64)")]
    pub is: DVec2,
    /// Largest distance from the value, in the same unit.
    pub within: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// A number near a value, or between bounds. Say when by one of `at`, `always: true`, or `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScalarExpectation {
    /// Name of the body.
    pub of: String,
    /// When [s].
    #[serde(default)]
    pub at: Option<f64>,
    /// Whether it holds throughout the run. Default false.
    #[serde(default)]
    pub always: bool,
    /// When it begins to hold [s]. Default the start, if `until` is given.
    #[serde(default)]
    pub from: Option<f64>,
    /// When it ceases to hold [s]. Default the end, if `from` is given.
    #[serde(default)]
    pub until: Option<f64>,
    /// The value, in the unit of the expectation; needs `within`.
    #[serde(default)]
    pub is: Option<f64>,
    /// Largest distance from the value, in the same unit.
    #[serde(default)]
    pub within: Option<f64>,
    /// Lower bound, in the same unit. Default none.
    #[serde(default)]
    pub above: Option<f64>,
    /// Upper bound, in the same unit. Default none.
    #[serde(default)]
    pub below: Option<f64>,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// An angle near a value, or between bounds. Say when by one of `at`, `always: true`, or `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AngleExpectation {
    /// Name of the body.
    pub of: String,
    /// When [s].
    #[serde(default)]
    pub at: Option<f64>,
    /// Whether it holds throughout the run. Default false.
    #[serde(default)]
    pub always: bool,
    /// When it begins to hold [s]. Default the start, if `until` is given.
    #[serde(default)]
    pub from: Option<f64>,
    /// When it ceases to hold [s]. Default the end, if `from` is given.
    #[serde(default)]
    pub until: Option<f64>,
    /// The angle [degrees]; needs `within_degrees`.
    #[serde(default)]
    pub is_degrees: Option<f64>,
    /// Largest difference from the angle [degrees].
    #[serde(default)]
    pub within_degrees: Option<f64>,
    /// Lower bound [degrees]. Default none.
    #[serde(default)]
    pub above_degrees: Option<f64>,
    /// Upper bound [degrees]. Default none.
    #[serde(default)]
    pub below_degrees: Option<f64>,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// A body, or every dynamic body, at rest from a time on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtRestExpectation {
    /// Name of the body. Default every dynamic body.
    #[serde(default)]
    pub of: Option<String>,
    /// From when on [s].
    pub from: f64,
    /// Largest speed from then on [m/s]. Default 0.001.
    #[serde(default = "default_rest_speed")]
    pub speed_below: f64,
    /// Largest rate of turn from then on [rad/s]. Default 0.001.
    #[serde(default = "default_rest_speed")]
    pub turn_below: f64,
    /// Largest distance from where the body was at that time [m]. Default no bound.
    #[serde(default)]
    pub drift_below: Option<f64>,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// Total energy never rises above its lowest value so far by more than the slack.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnergyNeverRisesExpectation {
    /// Largest rise [J].
    pub slack: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// A quantity that stays what it was at the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KeptExpectation {
    /// Largest difference from the start, in the unit of the expectation.
    pub within: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// Deepest overlap below a bound, throughout the run unless a time is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DepthExpectation {
    /// Upper bound [m].
    pub below: f64,
    /// When [s]. Default throughout.
    #[serde(default)]
    pub at: Option<f64>,
    /// Whether it holds throughout the run; the default anyway.
    #[serde(default)]
    pub always: bool,
    /// When it begins to hold [s]. Default the start.
    #[serde(default)]
    pub from: Option<f64>,
    /// When it ceases to hold [s]. Default the end.
    #[serde(default)]
    pub until: Option<f64>,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// Sum of the contact forces on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceExpectation {
    /// Name of the body.
    pub on: String,
    /// Only forces by this body. Default by all.
    #[serde(default)]
    pub by: Option<String>,
    /// When [s].
    #[serde(default)]
    pub at: Option<f64>,
    /// Beginning of the window [s]. Default the start, if `until` is given.
    #[serde(default)]
    pub from: Option<f64>,
    /// End of the window [s]. Default the end, if `from` is given.
    #[serde(default)]
    pub until: Option<f64>,
    /// The force.
    pub is: TargetForce,
    /// Largest difference [N].
    pub within: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// What a sum of forces is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum TargetForce {
    /// The force that carries the body: the opposite of gravity on it.
    Weight,
    /// A magnitude [N].
    Newtons(f64),
    /// Both components, world axes [N].
    Vector(f64, f64),
}

/// Magnitude of the friction force on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionExpectation {
    /// Name of the body.
    pub on: String,
    /// Only forces by this body. Default by all.
    #[serde(default)]
    pub by: Option<String>,
    /// When [s].
    #[serde(default)]
    pub at: Option<f64>,
    /// Beginning of the window [s]. Default the start, if `until` is given.
    #[serde(default)]
    pub from: Option<f64>,
    /// End of the window [s]. Default the end, if `from` is given.
    #[serde(default)]
    pub until: Option<f64>,
    /// Magnitude [N].
    pub is: f64,
    /// Largest difference [N].
    pub within: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// Something that happens between two bodies.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Event {
    /// The two bodies begin to touch.
    Touch(String, String),
    /// The two bodies cease to touch.
    Part(String, String),
}

impl Event {
    /// Names of the two bodies, as written.
    pub fn bodies(&self) -> [&str; 2] {
        match self {
            Self::Touch(a, b) | Self::Part(a, b) => [a, b],
        }
    }
}

/// Events whose first occurrences come strictly one after the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrderExpectation {
    /// The events, first to last; at least two.
    pub events: Vec<Event>,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// An event that happens at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HappensExpectation {
    /// The event.
    pub event: Event,
    /// Which occurrence is meant, counted from 1 [1]. Default 1.
    #[serde(default = "default_occurrence")]
    pub occurrence: u32,
    /// When [s].
    pub at: f64,
    /// Largest difference [s].
    pub within: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// An event that does not happen in the whole run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NeverExpectation {
    /// The event.
    pub event: Event,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// Every bit of the final state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FingerprintExpectation {
    /// The fingerprint: 32 hexadecimal digits.
    pub is: String,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

fn default_rest_speed() -> f64 {
    1e-3
}

fn default_occurrence() -> u32 {
    1
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
            Self::Order(e) => (&e.because, &e.under),
            Self::Happens(e) => (&e.because, &e.under),
            Self::Never(e) => (&e.because, &e.under),
            Self::Fingerprint(e) => (&e.because, &e.under),
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
