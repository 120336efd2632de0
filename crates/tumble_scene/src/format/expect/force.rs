//! Claims about contact forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use crate::format::{ContactModel, Dialect};

/// Sum of the contact forces on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct ForceExpectation<D: Dialect = Planar> {
    /// Name of the body; that of a repeated body claims it for every copy.
    pub on: String,
    /// Only forces by this body, or by any copy of a repeated one. Default by all.
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
    pub is: TargetForce<D>,
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
#[serde(bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub enum TargetForce<D: Dialect = Planar> {
    /// The force that carries the body: the opposite of gravity on it.
    Weight,
    /// A magnitude [N].
    Newtons(f64),
    /// All components, world axes [N].
    Vector(#[schemars(with = "D::VectorText")] D::Vector),
}

/// Force or torque of a joint on the body that it holds as its second (`b`), mean of a step. Say when by one of `at`, `always: true`, or
/// `from` and/or `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointForceExpectation {
    /// Name of the joint.
    pub of: String,
    /// Which number of the force. Default Magnitude.
    #[serde(default)]
    pub part: JointForcePart,
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
    /// The value [N], for a torque [N·m]; needs `within`.
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

/// A number of the force of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum JointForcePart {
    /// Length of the force vector.
    #[default]
    Magnitude,
    /// Along x, world axes.
    X,
    /// Along y, world axes.
    Y,
    /// Along z, world axes, in space.
    Z,
    /// The torque about the anchor, counter-clockwise; in space its magnitude.
    Torque,
}

/// Magnitude of the friction force on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionExpectation {
    /// Name of the body; that of a repeated body claims it for every copy.
    pub on: String,
    /// Only forces by this body, or by any copy of a repeated one. Default by all.
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
