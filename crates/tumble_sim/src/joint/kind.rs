//! What joints let two bodies do, in the plane and in space.

use std::fmt::Debug;

use glam::{DVec2, DVec3};

/// What a joint of some dimension lets two bodies do.
pub trait JointMotion<V>: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Its word in scenes and outputs.
    fn word(&self) -> &'static str;

    /// The axis that it leaves free, in the frame of the first body.
    fn axis(&self) -> Option<V>;

    /// Whether it keeps the bodies from turning against each other about some axis, and so has a torque of its own.
    ///
    /// The others are symmetric: the two bodies can change places.
    fn holds_directions(&self) -> bool;

    /// A length or an axis that no joint can have, by its word, with its value or length.
    fn bad_quantity(&self) -> Option<(&'static str, f64)>;
}

/// What a joint of the plane lets two bodies do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Turn about the common anchor; see [`tumble_solver::joint::revolute`].
    Revolute,
    /// Anything that leaves the anchors this far apart; see [`tumble_solver::joint::distance`].
    Distance {
        /// Length [m].
        length: f64,
    },
    /// Nothing; see [`tumble_solver::joint::fixed`]. The angle between the bodies stays as it is when the joint is made.
    Fixed,
    /// Slide along an axis; see [`tumble_solver::joint::prismatic`]. The angle between the bodies stays as it is when the joint is made.
    Prismatic {
        /// Direction of sliding, in the frame of the first body.
        axis: DVec2,
    },
}

/// What a joint of space lets two bodies do.
///
/// Directions are held as the bodies have them when the joint is made. Axes are in the frame of the first body, of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpatialJointKind {
    /// Turn any way about the common anchor (a ball and socket); see [`tumble_solver::joint::revolute`].
    Spherical,
    /// Turn about one axis through the common anchor (a hinge); see [`tumble_solver::joint::spatial::revolute`].
    Revolute {
        /// Direction of the axis, in the frame of the first body.
        axis: DVec3,
    },
    /// Anything that leaves the anchors this far apart; see [`tumble_solver::joint::distance`].
    Distance {
        /// Length [m].
        length: f64,
    },
    /// Nothing (a weld); see [`tumble_solver::joint::spatial::fixed`].
    Fixed,
    /// Slide along an axis (a slider); see [`tumble_solver::joint::spatial::prismatic`].
    Prismatic {
        /// Direction of sliding, in the frame of the first body.
        axis: DVec3,
    },
}

impl JointMotion<DVec2> for JointKind {
    fn word(&self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Distance { .. } => "distance",
            Self::Fixed => "fixed",
            Self::Prismatic { .. } => "prismatic",
        }
    }

    fn axis(&self) -> Option<DVec2> {
        if let Self::Prismatic { axis } = self { Some(*axis) } else { None }
    }

    fn holds_directions(&self) -> bool {
        matches!(self, Self::Fixed | Self::Prismatic { .. })
    }

    fn bad_quantity(&self) -> Option<(&'static str, f64)> {
        match self {
            Self::Revolute | Self::Fixed => None,
            Self::Distance { length } => bad_length(*length),
            Self::Prismatic { axis } => axis.try_normalize().is_none().then(|| ("axis", axis.length())),
        }
    }
}

impl JointMotion<DVec3> for SpatialJointKind {
    fn word(&self) -> &'static str {
        match self {
            Self::Spherical => "spherical",
            Self::Revolute { .. } => "revolute",
            Self::Distance { .. } => "distance",
            Self::Fixed => "fixed",
            Self::Prismatic { .. } => "prismatic",
        }
    }

    fn axis(&self) -> Option<DVec3> {
        match self {
            Self::Revolute { axis } | Self::Prismatic { axis } => Some(*axis),
            _ => None,
        }
    }

    fn holds_directions(&self) -> bool {
        matches!(self, Self::Revolute { .. } | Self::Fixed | Self::Prismatic { .. })
    }

    fn bad_quantity(&self) -> Option<(&'static str, f64)> {
        match self {
            Self::Spherical | Self::Fixed => None,
            Self::Distance { length } => bad_length(*length),
            Self::Revolute { axis } | Self::Prismatic { axis } => {
                axis.try_normalize().is_none().then(|| ("axis", axis.length()))
            }
        }
    }
}

fn bad_length(length: f64) -> Option<(&'static str, f64)> {
    (!(length > 0.0 && length.is_finite())).then_some(("length", length))
}
