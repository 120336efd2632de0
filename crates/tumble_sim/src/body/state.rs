//! The state of a body, and what acts on it during a step.

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use tumble_math::{Angular, Dim, Planar, Spatial, Vector};

use super::mass::{BodyInertia, InverseInertia, InverseMass, Mass};
use super::table::BodyIndex;
use crate::joint::{JointKind, JointMotion, SpatialJointKind};
use crate::structure::mark_changed;

/// A vector that knows whether it belongs to the plane or to space.
pub trait InDim: Vector {
    /// Where it belongs.
    type Dim: Dim<Vector = Self>;
    /// What joints there let two bodies do.
    type JointKind: JointMotion<Self>;
}

impl InDim for DVec2 {
    type Dim = Planar;
    type JointKind = JointKind;
}

impl InDim for DVec3 {
    type Dim = Spatial;
    type JointKind = SpatialJointKind;
}

type RotationOf<V> = <<V as InDim>::Dim as Dim>::Rotation;
type AngularOf<V> = <<V as InDim>::Dim as Dim>::Angular;
type InertiaOf<V> = <<V as InDim>::Dim as Dim>::Inertia;

/// Centre of mass in world axes (R2) [m].
///
/// On a new body it places the frame in which the parts are written; the first step moves it to their centre of mass (R4).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
#[require(
    BodyKind,
    Orientation<RotationOf<V>>,
    LinearVelocity<V>,
    AngularVelocity<AngularOf<V>>,
    Force<V>,
    Torque<AngularOf<V>>,
    Acceleration<V>,
    AngularAcceleration<AngularOf<V>>,
    Mass,
    BodyInertia<InertiaOf<V>>,
    InverseMass<V>,
    InverseInertia<InertiaOf<V>>,
    BodyIndex
)]
#[component(on_add = mark_changed, on_remove = mark_changed)]
pub struct Position<V: InDim>(pub V);

/// Rotation from body to world axes; in the plane its angle is accumulated over turns (R2).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Orientation<R: Send + Sync + 'static>(pub R);

/// Velocity of the centre of mass in world axes [m/s].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearVelocity<V: Vector>(pub V);

/// Rate of turn in world axes, counter-clockwise in the plane [rad/s].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct AngularVelocity<W: Angular>(pub W);

/// Sum of the forces of this step, in world axes [N]. Forces last one step.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Force<V: Vector>(pub V);

/// Sum of the torques of this step about the centre of mass, in world axes [N·m].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Torque<W: Angular>(pub W);

/// Acceleration of the centre of mass by the forces of this step; impulses are not in it [m/s²].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Acceleration<V: Vector>(pub V);

/// Angular acceleration by the torques of this step [rad/s²].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct AngularAcceleration<W: Angular>(pub W);

/// What the ballistic integrator, and only it, keeps of the step before.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct PreviousVelocity<V: Vector, W: Angular> {
    /// Velocity of the centre of mass at the start of the step [m/s].
    pub linear: V,
    /// Rate of turn at the start of the step [rad/s].
    pub angular: W,
    /// Acceleration and torque of the step before; `None` in the first [m/s², N·m].
    pub drive: Option<(V, W)>,
}

/// What moves a body.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[component(on_insert = mark_changed)]
pub enum BodyKind {
    /// Forces and impulses.
    #[default]
    Dynamic,
    /// Its velocity alone, whatever it touches.
    Kinematic,
    /// Nothing.
    Static,
}

/// Stable identity of a body. Its order decides every order that can touch arithmetic.
///
/// Of a pair, a is the body with the smaller id. Assigned at spawn, next free number, unless the user gives one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[component(on_insert = mark_changed)]
pub struct BodyId(pub u64);
