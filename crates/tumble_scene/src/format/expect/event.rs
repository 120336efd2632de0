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

expectation! {
    /// Events whose first occurrences come strictly one after the other.
    #[derive(Default)]
    OrderExpectation {
        /// The events, first to last; at least two.
        events: Vec<Event>,
    }
}

expectation! {
    /// An event that happens at a time.
    HappensExpectation {
        /// The event.
        event: Event,
        /// Which occurrence is meant, counted from 1 [1]. Default 1.
        #[serde(default = "default_occurrence")]
        occurrence: u32,
        /// When [s].
        at: f64,
        /// Largest difference [s].
        within: f64,
    }
}

expectation! {
    /// An event that does not happen in the whole run.
    NeverExpectation {
        /// The event.
        event: Event,
    }
}

fn default_occurrence() -> u32 {
    1
}
