//! Claims about touch and parting.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::format::ContactModel;

/// Something that happens between two bodies; the name of a repeated body stands for any of its copies.
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

fn default_occurrence() -> u32 {
    1
}
