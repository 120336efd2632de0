//! Claims about the whole world: energy, momentum, overlap.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::format::ContactModel;

expectation! {
    /// Total energy never rises above its lowest value so far by more than the slack.
    #[derive(Default)]
    EnergyNeverRisesExpectation {
        /// Largest rise [J].
        slack: f64,
    }
}

expectation! {
    /// A quantity that stays what it was at the start.
    #[derive(Default)]
    KeptExpectation {
        /// Largest difference from the start, in the unit of the expectation.
        within: f64,
    }
}

expectation! {
    /// Deepest overlap no deeper than a bound, throughout the run unless a time is given.
    #[derive(Default)]
    DepthExpectation {
        /// Deepest overlap that is allowed [m]; 0 allows touching and no overlap at all.
        below: f64,
        /// When [s]. Default throughout.
        #[serde(default)]
        at: Option<f64>,
        /// Whether it holds throughout the run; the default anyway.
        #[serde(default)]
        always: bool,
        /// When it begins to hold [s]. Default the start.
        #[serde(default)]
        from: Option<f64>,
        /// When it ceases to hold [s]. Default the end.
        #[serde(default)]
        until: Option<f64>,
    }
}
