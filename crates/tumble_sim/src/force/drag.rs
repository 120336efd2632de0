//! Drag of a fluid at rest.
//!
//! ```text
//! linear:     f = −c v,        τ = −c_r ω
//! quadratic:  f = −b |v| v,    τ = −b_r |ω| ω
//! ```

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear};

use crate::body::{AngularVelocity, Force, LinearVelocity, Torque};
use crate::rest::Awake;

/// Drag that grows with speed.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearDrag {
    /// c, against translation [N·s/m].
    pub translation: f64,
    /// c_r, against rotation [N·m·s].
    pub rotation: f64,
}

/// Drag that grows with the square of speed.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct QuadraticDrag {
    /// b, against translation [N·s²/m²].
    pub translation: f64,
    /// b_r, against rotation [N·m·s²].
    pub rotation: f64,
}

/// f −= c v and τ −= c_r ω.
pub fn apply_linear_drag<D: Dim>(
    mut bodies: Query<
        (
            &mut Force<D::Vector>,
            &mut Torque<D::Angular>,
            &LinearVelocity<D::Vector>,
            &AngularVelocity<D::Angular>,
            &LinearDrag,
        ),
        Awake,
    >,
) {
    for (mut force, mut torque, velocity, spin, drag) in &mut bodies {
        force.bypass_change_detection().0 -= velocity.0 * drag.translation;
        torque.bypass_change_detection().0 -= spin.0 * drag.rotation;
    }
}

/// f −= b |v| v and τ −= b_r |ω| ω.
pub fn apply_quadratic_drag<D: Dim>(
    mut bodies: Query<
        (
            &mut Force<D::Vector>,
            &mut Torque<D::Angular>,
            &LinearVelocity<D::Vector>,
            &AngularVelocity<D::Angular>,
            &QuadraticDrag,
        ),
        Awake,
    >,
) {
    for (mut force, mut torque, velocity, spin, drag) in &mut bodies {
        force.bypass_change_detection().0 -= velocity.0 * (drag.translation * velocity.0.length());
        torque.bypass_change_detection().0 -= spin.0 * (drag.rotation * spin.0.length());
    }
}
