//! Springs and applied forces.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A spring with damping between two points: F = −stiffness (length − rest_length) − damping · rate of length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringEntry {
    /// One end.
    pub from: AnchorEntry,
    /// The other end.
    pub to: AnchorEntry,
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
#[serde(deny_unknown_fields)]
pub enum AnchorEntry {
    /// A fixed point of the world.
    World {
        /// Where, world frame [m].
        #[schemars(with = "(f64, f64)")]
        point: DVec2,
    },
    /// A point that moves with a body.
    Body {
        /// Name of the body.
        name: String,
        /// Where, design frame [m]. Default the centre of mass.
        #[serde(default)]
        #[schemars(with = "Option<(f64, f64)>")]
        point: Option<DVec2>,
    },
}

/// A force and a torque on a body, while `from` ≤ time < `until`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceEntry {
    /// Name of the body.
    pub on: String,
    /// Where the force acts, design frame [m]. Default the centre of mass.
    #[serde(default)]
    #[schemars(with = "Option<(f64, f64)>")]
    pub point: Option<DVec2>,
    /// Force [N]. Default (0, 0).
    #[serde(default)]
    #[schemars(with = "(f64, f64)")]
    pub force: DVec2,
    /// Torque, besides that of the force, counter-clockwise [N·m]. Default 0.
    #[serde(default)]
    pub torque: f64,
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
