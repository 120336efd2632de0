//! Claims about contact forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use crate::format::{ContactModel, Dialect};

expectation! {
    /// Sum of the contact forces on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
    #[serde(bound = "D: Dialect")]
    #[schemars(bound = "D: Dialect")]
    ForceExpectation<D> {
        /// Name of the body; that of a repeated body claims it for every copy.
        on: String,
        /// Only forces by this body, or by any copy of a repeated one. Default by all.
        #[serde(default)]
        by: Option<String>,
        /// When [s].
        #[serde(default)]
        at: Option<f64>,
        /// Beginning of the window [s]. Default the start, if `until` is given.
        #[serde(default)]
        from: Option<f64>,
        /// End of the window [s]. Default the end, if `from` is given.
        #[serde(default)]
        until: Option<f64>,
        /// The force.
        is: TargetForce<D>,
        /// Largest difference [N].
        within: f64,
    }
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

expectation! {
    /// Force or torque of a joint on the body that it holds as its second (`b`), mean of a step. Say when by one of `at`, `always: true`, or
    /// `from` and/or `until`.
    #[derive(Default)]
    JointForceExpectation {
        /// Name of the joint.
        of: String,
        /// Which number of the force. Default Magnitude.
        #[serde(default)]
        part: JointForcePart,
        [when]
        /// The value [N], for a torque [N·m]; needs `within`.
        #[serde(default)]
        is: Option<f64>,
        /// Largest distance from the value, in the same unit.
        #[serde(default)]
        within: Option<f64>,
        /// Lower bound, in the same unit. Default none.
        #[serde(default)]
        above: Option<f64>,
        /// Upper bound, in the same unit. Default none.
        #[serde(default)]
        below: Option<f64>,
    }
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

expectation! {
    /// Magnitude of the friction force on a body, at a time or on average over a window. The force of a step is its impulse divided by dt.
    #[derive(Default)]
    FrictionExpectation {
        /// Name of the body; that of a repeated body claims it for every copy.
        on: String,
        /// Only forces by this body, or by any copy of a repeated one. Default by all.
        #[serde(default)]
        by: Option<String>,
        /// When [s].
        #[serde(default)]
        at: Option<f64>,
        /// Beginning of the window [s]. Default the start, if `until` is given.
        #[serde(default)]
        from: Option<f64>,
        /// End of the window [s]. Default the end, if `from` is given.
        #[serde(default)]
        until: Option<f64>,
        /// Magnitude [N].
        is: f64,
        /// Largest difference [N].
        within: f64,
    }
}
