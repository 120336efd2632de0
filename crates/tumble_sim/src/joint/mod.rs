//! Joints: entities that hold two bodies, or a body and the world, together. The two do not collide with each other.
//!
//! ```text
//! phase 3  J(x) v = 0                     with the contacts, as the contact model does it
//! phase 4  C(x + Δt v) = C(x)             the curvature of the motion, taken into the velocities (SHAKE)
//!          C(x + Δt v + Δx) = 0           what is wrong all the same, by displacements alone: no kinetic energy
//! phase 6  J(x) v = 0                     for ballistic bodies, whose velocities belong to the end of the step (RATTLE), and after impacts
//! ```
//!
//! Under symplectic Euler velocities run half a step ahead of positions, and the two parts of phases 3 and 4 together are the SHAKE method
//! (Ryckaert, Ciccotti and Berendsen 1977): second order in the positions at whole steps, and symplectic, so that energy does not drift. The penalty model has springs and dampers
//! instead.

mod problem;
mod systems;
mod table;

use bevy_ecs::prelude::*;
use tumble_math::Vector;

use crate::force::Anchor;
use crate::structure::mark_changed;

pub use problem::JointProblem;
pub use systems::{apply_joint_springs, correct_curvature};
pub use table::{JointEntry, JointTable};

pub(crate) use systems::{joint_tolerance, stop_joints};
pub(crate) use table::prepare_joints;

/// A joint, an entity of its own. A name beside it is what outputs call it.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_discard = mark_changed)]
pub struct Joint<V: Vector> {
    /// Where it holds the first body.
    pub a: Anchor<V>,
    /// Where it holds the second body.
    pub b: Anchor<V>,
    /// What it lets the two do.
    pub kind: JointKind<V>,
}

/// What a joint lets two bodies do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind<V> {
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
        axis: V,
    },
}

impl<V> JointKind<V> {
    /// Its word in scenes and outputs.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Distance { .. } => "distance",
            Self::Fixed => "fixed",
            Self::Prismatic { .. } => "prismatic",
        }
    }
}
