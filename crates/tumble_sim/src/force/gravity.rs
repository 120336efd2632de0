//! Uniform gravity: f = s m g.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear};

use crate::Settings;
use crate::body::{Force, Mass};
use crate::rest::Awake;

/// How strongly gravity acts on a body [1]. Absent means 1.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct GravityScale(pub f64);

/// f += m g.
pub fn apply_gravity<D: Dim>(
    settings: Res<Settings<D>>,
    mut bodies: Query<(&mut Force<D::Vector>, &Mass), (Without<GravityScale>, Awake)>,
) {
    for (mut force, mass) in &mut bodies {
        force.bypass_change_detection().0 += settings.gravity * mass.0;
    }
}

/// f += s m g, for bodies with a scale of their own.
pub fn apply_scaled_gravity<D: Dim>(
    settings: Res<Settings<D>>,
    mut bodies: Query<(&mut Force<D::Vector>, &Mass, &GravityScale), Awake>,
) {
    for (mut force, mass, scale) in &mut bodies {
        force.bypass_change_detection().0 += settings.gravity * (mass.0 * scale.0);
    }
}

/// −m s g · x: potential energy of gravity, zero at the origin [J].
pub fn gravity_potential<D: Dim>(gravity: D::Vector, mass: f64, scale: f64, position: D::Vector) -> f64 {
    -mass * scale * gravity.dot(position)
}
