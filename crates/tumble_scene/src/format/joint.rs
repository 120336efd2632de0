//! Joints.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::AnchorEntry;

/// Something that holds two bodies, or a body and the world, together. The two do not collide with each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointEntry {
    /// Unique name, by which expectations, plots and `joints.csv` call it.
    pub name: String,
    /// What it lets the two do.
    pub kind: JointKind,
    /// Where it holds the first body, or the world.
    pub a: AnchorEntry,
    /// Where it holds the second body, or the world. Forces of the joint are those on this side.
    pub b: AnchorEntry,
    /// Whether the joint may be open by more than the slop at the start; the first steps then close it, without giving speed. Default
    /// false: that is a mistake.
    #[serde(default)]
    pub allow_gap: bool,
}

/// What a joint lets two bodies do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum JointKind {
    /// Turn about the common anchor.
    Revolute,
    /// Anything that leaves the anchors this far apart: a massless rod with a pin at each end.
    Distance {
        /// Length [m]. Default the distance of the anchors at the start.
        #[serde(default)]
        length: Option<f64>,
    },
    /// Nothing: the bodies keep the angle between them, and the anchors stay together.
    Fixed,
    /// Slide along an axis through the anchors; the bodies keep the angle between them.
    Prismatic {
        /// Direction of sliding, turning with the first body: in its design frame, or world axes if that is the world; of any length.
        #[schemars(with = "(f64, f64)")]
        axis: DVec2,
    },
}
