//! Contact models and their settings.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How bodies in contact act on each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
pub enum ContactModel {
    /// Springs and dampers that push overlapping bodies apart.
    Penalty,
    /// Impulses, one contact at a time, worst first, until no contact is colliding.
    #[default]
    Impulse,
    /// Colliding contacts one by one; all resting contact forces together, such that no contact accelerates into another body (Baraff).
    RestingLcp,
    /// Impulses of all contacts together, with exact friction.
    VelocityLcp,
    /// Soft contacts in substeps, for very many contacts: fast rather than exact.
    SoftStep,
}

impl ContactModel {
    /// Every model, in the order of this file.
    pub const ALL: [Self; 5] = [Self::Penalty, Self::Impulse, Self::RestingLcp, Self::VelocityLcp, Self::SoftStep];

    /// The word for the model on the command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Penalty => "penalty",
            Self::Impulse => "impulse",
            Self::RestingLcp => "resting-lcp",
            Self::VelocityLcp => "velocity-lcp",
            Self::SoftStep => "soft-step",
        }
    }

    /// The model of a word on the command line.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.word() == word)
    }
}

impl From<ContactModel> for tumble_sim::ContactModel {
    fn from(model: ContactModel) -> Self {
        match model {
            ContactModel::Penalty => Self::Penalty,
            ContactModel::Impulse => Self::Impulse,
            ContactModel::RestingLcp => Self::RestingLcp,
            ContactModel::VelocityLcp => Self::VelocityLcp,
            ContactModel::SoftStep => Self::SoftStep,
        }
    }
}

impl From<tumble_sim::ContactModel> for ContactModel {
    fn from(model: tumble_sim::ContactModel) -> Self {
        match model {
            tumble_sim::ContactModel::Penalty => Self::Penalty,
            tumble_sim::ContactModel::Impulse => Self::Impulse,
            tumble_sim::ContactModel::RestingLcp => Self::RestingLcp,
            tumble_sim::ContactModel::VelocityLcp => Self::VelocityLcp,
            tumble_sim::ContactModel::SoftStep => Self::SoftStep,
        }
    }
}

/// Settings of every contact model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModelEntries {
    /// Settings of the penalty model.
    #[serde(default)]
    pub penalty: PenaltyEntry,
    /// Settings of the impulse model.
    #[serde(default)]
    pub impulse: ImpulseEntry,
    /// Settings of the velocity complementarity model.
    #[serde(default)]
    pub velocity_lcp: VelocityLcpEntry,
    /// Settings of the soft-step model.
    #[serde(default)]
    pub soft_step: SoftStepEntry,
}

/// Settings of the penalty model; absent ones take the model's defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PenaltyEntry {
    /// How overlap becomes force. Default SpringDamper.
    #[serde(default)]
    pub law: PenaltyLaw,
    /// Normal force per overlap [N/m]. Default such that dt is a tenth of the largest stable one; 1000 for the Lecture law.
    #[serde(default)]
    pub stiffness: Option<f64>,
    /// Normal force per approach speed [N·s/m]. Default what gives the restitution of the pair of materials.
    #[serde(default)]
    pub damping: Option<f64>,
    /// Slip below which friction grows in proportion, instead of being constant [m/s]. Default 0.01 length scales per second.
    #[serde(default)]
    pub slip_speed: Option<f64>,
    /// Tangential force per slip in the Lecture law, which has no Coulomb friction [N·s/m]. Default 1.
    #[serde(default)]
    pub viscosity: Option<f64>,
}

impl PenaltyEntry {
    /// Default stiffness of the Lecture law [N/m].
    pub(crate) const LECTURE_STIFFNESS: f64 = 1000.0;
    /// Default viscosity of the Lecture law [N·s/m].
    pub(crate) const LECTURE_VISCOSITY: f64 = 1.0;
}

/// How overlap becomes force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum PenaltyLaw {
    /// A spring and a damper at every contact point, with regularised Coulomb friction.
    #[default]
    SpringDamper,
    /// The homework's force, only at rod ends on half-planes and only while they go down: −viscosity · slip, −stiffness · height.
    Lecture,
}

/// Settings of the impulse model; absent ones take the model's defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImpulseEntry {
    /// Sweeps over the resting contacts in each step, at most [1]. Default between 10 and 500, fewer for more contacts.
    #[serde(default)]
    pub iterations: Option<u32>,
    /// Approach speed above which a contact is colliding [m/s]. Default a hundredth of what gravity adds in a step, half of it for pairs
    /// without restitution.
    #[serde(default)]
    pub colliding_tolerance: Option<f64>,
    /// Impulses on colliding contacts in each step, at most, per contact [1]. Default between 2 and 200, fewer for more contacts.
    #[serde(default)]
    pub max_impulses: Option<u32>,
}

/// Settings of the velocity complementarity model; absent ones take the model's defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VelocityLcpEntry {
    /// How contacts that hang together are solved. Default: Auto.
    #[serde(default)]
    pub solver: VelocitySolver,
    /// Which law gives back speed. Default: Poisson.
    #[serde(default)]
    pub restitution: RestitutionLaw,
}

/// Settings of the soft-step model; absent ones take the model's defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftStepEntry {
    /// Substeps of a step [1]. Default 4.
    #[serde(default)]
    pub substeps: Option<u32>,
    /// Frequency of the contact springs, twice as much against bodies that cannot move; at most a quarter of the substeps' own [Hz]. Default 30.
    #[serde(default)]
    pub frequency: Option<f64>,
    /// Damping ratio of the contact springs [1]. Default 10.
    #[serde(default)]
    pub damping_ratio: Option<f64>,
    /// Fastest push out of an overlap [m/s]. Default 3 length scales per second.
    #[serde(default)]
    pub push_speed: Option<f64>,
    /// Lets bodies sleep that have come to rest; absent for never. `()` takes the defaults.
    #[serde(default)]
    pub sleep: Option<SleepEntry>,
}

/// When bodies fall asleep; absent fields take the defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SleepEntry {
    /// No point of a body is faster than this [m/s]. Default 0.05 length scales per second.
    #[serde(default)]
    pub speed: Option<f64>,
    /// For so long [s]. Default 0.5.
    #[serde(default)]
    pub after: Option<f64>,
}

/// Solvers of the velocity complementarity model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum VelocitySolver {
    /// Pivoting for few contacts, then Newton's method and sweeps.
    #[default]
    Auto,
    /// Pivoting: to rounding, for any number of contacts.
    Pivoting,
    /// Contact after contact, again and again.
    BlockGaussSeidel,
    /// Newton's method on all contacts.
    Newton,
}

/// Laws of restitution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum RestitutionLaw {
    /// The part of the compression impulse that comes again. Never creates energy.
    #[default]
    Poisson,
    /// The part of the approach speed that comes again. With friction it can create energy.
    Newton,
}
