//! Mass of a body, and the inverse-mass filter through which forces and impulses move it (R7).

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Vector};

use super::BodyKind;
use crate::structure::mark_changed;

/// Mass [kg]; 0 for bodies that forces do not move.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Mass(pub f64);

/// Inertia about the centre of mass, in body axes [kg·m²].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyInertia<I: Send + Sync + 'static>(pub I);

/// 1 / m per world axis, 0 on axes that forces cannot move [1/kg].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct InverseMass<V: Vector>(pub V);

/// Inverse inertia in body axes, 0 where torques cannot turn [1/(kg·m²)].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct InverseInertia<I: Send + Sync + 'static>(pub I);

/// Mass given outright instead of by the parts, whose inertia is rescaled with it [kg].
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct MassOverride(pub f64);

/// Centre of mass given outright instead of by the parts, in the frame of the parts [m].
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct CentreOverride<V: Vector>(pub V);

/// Inertia given outright instead of by the parts, about the centre of mass, in body axes [kg·m²].
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct InertiaOverride<I: Send + Sync + 'static>(pub I);

/// A dynamic body that nothing moves or turns while this is present.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct Pinned;

/// World axes along which a body cannot move, and whether it cannot turn.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct LockedAxes<V: Vector> {
    /// Component 1 where locked, 0 where free.
    pub translation: V,
    /// Whether rotation is locked.
    pub rotation: Lock,
}

/// Whether something is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lock {
    /// It moves.
    #[default]
    Free,
    /// It does not.
    Locked,
}

/// The inverse-mass filter: what forces and impulses are multiplied with.
pub(super) fn inverse_mass<D: Dim>(
    kind: BodyKind,
    mass: f64,
    inertia: &D::Inertia,
    pinned: Option<&Pinned>,
    locked: Option<&LockedAxes<D::Vector>>,
) -> (D::Vector, D::Inertia) {
    if kind != BodyKind::Dynamic || pinned.is_some() {
        return (D::Vector::ZERO, D::Inertia::ZERO);
    }
    let mut inverse_mass = D::Vector::splat(1.0 / mass);
    let mut inverse_inertia = inertia.try_inverse().unwrap_or(D::Inertia::ZERO);
    if let Some(locked) = locked {
        for axis in 0..D::Vector::AXES {
            if locked.translation[axis] != 0.0 {
                inverse_mass[axis] = 0.0;
            }
        }
        if locked.rotation == Lock::Locked {
            inverse_inertia = D::Inertia::ZERO;
        }
    }
    (inverse_mass, inverse_inertia)
}
