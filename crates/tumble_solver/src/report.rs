//! What a solver says about its work.

use serde::{Deserialize, Serialize};

/// How a solver ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ending {
    /// The tolerance was met.
    #[default]
    Converged,
    /// The cap on the work came first.
    NotConverged,
}

/// Work and remaining error of a solver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Sweeps over all rows, or single impulses, depending on the method.
    pub iterations: u32,
    /// Error that is left, as a speed [m/s].
    pub residual: f64,
    /// Whether that is within the tolerance.
    pub ending: Ending,
}
