//! Claims about the whole world: energy, momentum, overlap.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::format::ContactModel;

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

/// Deepest overlap no deeper than a bound, throughout the run unless a time is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DepthExpectation {
    /// Deepest overlap that is allowed [m]; 0 allows touching and no overlap at all.
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
