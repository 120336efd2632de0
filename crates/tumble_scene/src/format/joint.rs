//! Joints.

use std::fmt::Debug;

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use super::{AnchorEntry, Dialect};

/// Something that holds two bodies, or a body and the world, together. The two do not collide with each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct JointEntry<D: Dialect = Planar> {
    /// Unique name, by which expectations, plots and `joints.csv` call it.
    pub name: String,
    /// What it lets the two do.
    pub kind: D::JointKind,
    /// Where it holds the first body, or the world.
    pub a: AnchorEntry<D>,
    /// Where it holds the second body, or the world. Forces of the joint are those on this side.
    pub b: AnchorEntry<D>,
    /// Whether the joint may be open by more than the slop at the start; the first steps then close it, without giving speed. Default
    /// false: that is a mistake.
    #[serde(default)]
    pub allow_gap: bool,
}

/// What a joint of the plane lets two bodies do.
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

/// What a joint of space lets two bodies do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum SpatialJointKind {
    /// Turn in every way about the common anchor: a ball in its socket.
    Spherical,
    /// Turn about an axis through the common anchor: a hinge.
    Revolute {
        /// Direction of the axis, turning with the first body: in its design frame, or world axes if that is the world; of any length.
        #[schemars(with = "(f64, f64, f64)")]
        axis: DVec3,
    },
    /// Anything that leaves the anchors this far apart: a massless rod with a ball at each end.
    Distance {
        /// Length [m]. Default the distance of the anchors at the start.
        #[serde(default)]
        length: Option<f64>,
    },
    /// Nothing: the bodies keep their orientation against each other, and the anchors stay together.
    Fixed,
    /// Slide along an axis through the anchors; the bodies keep their orientation against each other.
    Prismatic {
        /// Direction of sliding, turning with the first body: in its design frame, or world axes if that is the world; of any length.
        #[schemars(with = "(f64, f64, f64)")]
        axis: DVec3,
    },
}

/// What the joints of the plane and of space have in common.
pub trait JointKindEntry:
    Copy + Debug + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// The length as written, of a joint that keeps the anchors apart.
    fn length(&self) -> Option<Option<f64>>;
}

impl JointKindEntry for JointKind {
    fn length(&self) -> Option<Option<f64>> {
        if let Self::Distance { length } = self { Some(*length) } else { None }
    }
}

impl JointKindEntry for SpatialJointKind {
    fn length(&self) -> Option<Option<f64>> {
        if let Self::Distance { length } = self { Some(*length) } else { None }
    }
}
