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

mod kind;
mod problem;
mod systems;
mod table;

use bevy_ecs::prelude::*;

use crate::body::InDim;
use crate::force::Anchor;
use crate::structure::mark_changed;

pub use kind::{JointKind, JointMotion, SpatialJointKind};
pub use problem::JointProblem;
pub use systems::{apply_joint_springs, correct_curvature};
pub use table::{JointEntry, JointTable};

pub(crate) use systems::{joint_tolerance, stop_joints};
pub(crate) use table::prepare_joints;

/// A joint, an entity of its own. A name beside it is what outputs call it.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_discard = mark_changed)]
pub struct Joint<V: InDim> {
    /// Where it holds the first body.
    pub a: Anchor<V>,
    /// Where it holds the second body.
    pub b: Anchor<V>,
    /// What it lets the two do: a [`JointKind`] in the plane, a [`SpatialJointKind`] in space.
    pub kind: V::JointKind,
}
