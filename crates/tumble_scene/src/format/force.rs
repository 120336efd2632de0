//! Springs and applied forces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use super::Dialect;

/// A spring with damping between two points: F = −stiffness (length − rest_length) − damping · rate of length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct SpringEntry<D: Dialect = Planar> {
    /// One end.
    pub from: AnchorEntry<D>,
    /// The other end.
    pub to: AnchorEntry<D>,
    /// Force per stretch [N/m].
    pub stiffness: f64,
    /// Force per rate of stretch [N·s/m]. Default 0.
    #[serde(default)]
    pub damping: f64,
    /// Length without force [m]. Default the distance of the two points at the start.
    #[serde(default)]
    pub rest_length: Option<f64>,
}

/// Where a spring or a joint holds on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub enum AnchorEntry<D: Dialect = Planar> {
    /// A fixed point of the world.
    World {
        /// Where, world frame [m].
        #[schemars(with = "D::VectorText")]
        point: D::Vector,
    },
    /// A point that moves with a body.
    Body {
        /// Name of the body.
        name: String,
        /// Where, design frame [m]. Default the centre of mass.
        #[serde(default)]
        #[schemars(with = "Option<D::VectorText>")]
        point: Option<D::Vector>,
    },
}

/// A force and a torque on a body, while `from` ≤ time < `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct ForceEntry<D: Dialect = Planar> {
    /// Name of the body.
    pub on: String,
    /// Where the force acts, design frame [m]. Default the centre of mass.
    #[serde(default)]
    #[schemars(with = "Option<D::VectorText>")]
    pub point: Option<D::Vector>,
    /// Force [N]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::VectorText")]
    pub force: D::Vector,
    /// Torque, besides that of the force, counter-clockwise in the plane, world axes in space [N·m]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::AngularText")]
    pub torque: D::Angular,
    /// Axes in which the force is written. Default World.
    #[serde(default)]
    pub axes: Axes,
    /// When it begins [s]. Default 0.
    #[serde(default)]
    pub from: f64,
    /// When it ends [s]. Default never.
    #[serde(default)]
    pub until: Option<f64>,
    /// Factor on force and torque over time, as pairs (time [s], factor [1]) in rising order of time; linear in between, held outside.
    /// Default 1 throughout. `[(0.0, 0.0), (10.0, 1.0)]` is a push that grows for ten seconds.
    #[serde(default)]
    pub factor: Vec<(f64, f64)>,
}

/// Axes in which a force is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Axes {
    /// The world's: the direction stays.
    #[default]
    World,
    /// The design frame's: the direction turns with the body.
    Body,
}
