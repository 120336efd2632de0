//! Claims about the state of bodies.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use crate::format::{ContactModel, Dialect, OrientationEntry};

/// A vector near a value. Say when by one of `at`, `always: true`, or `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct VectorExpectation<D: Dialect = Planar> {
    /// Name of the body; that of a repeated body claims it for every copy.
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
    #[schemars(with = "D::VectorText")]
    pub is: D::Vector,
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
    /// Name of the body; that of a repeated body claims it for every copy.
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
    /// Name of the body; that of a repeated body claims it for every copy.
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

/// A body of space turned in a certain way. Say when by one of `at`, `always: true`, or `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrientationExpectation {
    /// Name of the body; that of a repeated body claims it for every copy.
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
    /// How the design frame is turned. Default not at all.
    #[serde(default)]
    pub is: Option<OrientationEntry>,
    /// Largest angle of the turn that is missing [degrees].
    pub within_degrees: f64,
    /// Why this must be so. Default empty.
    #[serde(default)]
    pub because: String,
    /// Contact models for which it is claimed. Default all.
    #[serde(default)]
    pub under: Vec<ContactModel>,
}

/// The angle between an axis of a body of space and a direction, from 0 to 180 degrees. Say when by one of `at`, `always: true`, or `from`
/// and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltExpectation {
    /// Name of the body; that of a repeated body claims it for every copy.
    pub of: String,
    /// The axis of the body, design frame, of any length but zero [1]. Default (0, 1, 0).
    #[serde(default)]
    #[schemars(with = "Option<(f64, f64, f64)>")]
    pub axis: Option<DVec3>,
    /// The direction, world axes, of any length but zero [1]. Default where the axis pointed in the first sample.
    #[serde(default)]
    #[schemars(with = "Option<(f64, f64, f64)>")]
    pub against: Option<DVec3>,
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
    /// Name of the body; that of a repeated body claims it for every copy. Default every dynamic body.
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
