//! The integrating phases: a = M⁻¹ f, v += a Δt, x += v Δt (R6, R7).

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Rotation};

use crate::Clock;
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyInertia, Force, InDim, InverseInertia,
    InverseMass, LinearVelocity, Orientation, Position, PreviousVelocity, Torque,
};
use crate::contact::PositionCorrections;
use crate::fault::{Fault, Quantity};
use crate::geometry::Geometry;
use crate::ledger::Books;
use crate::rest::Awake;
use crate::schedule::StepSystems;

type VectorOf<D> = <D as Dim>::Vector;
type AngularOf<D> = <D as Dim>::Angular;

/// Forgets the forces of the last step.
pub fn clear_forces<D: Dim>(mut bodies: Query<(&mut Force<VectorOf<D>>, &mut Torque<AngularOf<D>>), Awake>) {
    for (mut force, mut torque) in &mut bodies {
        force.bypass_change_detection().0 = VectorOf::<D>::ZERO;
        torque.bypass_change_detection().0 = AngularOf::<D>::ZERO;
    }
}

/// a = M⁻¹ f through the inverse-mass filter: pinned bodies and locked axes have inverse mass 0 (R6, R7).
pub fn compute_accelerations<D: Dim<Vector: InDim>>(
    mut bodies: Query<
        (
            &BodyIndex,
            &Force<VectorOf<D>>,
            &Torque<AngularOf<D>>,
            &InverseMass<VectorOf<D>>,
            &InverseInertia<D::Inertia>,
            &Orientation<D::Rotation>,
            &mut Acceleration<VectorOf<D>>,
            &mut AngularAcceleration<AngularOf<D>>,
        ),
        Awake,
    >,
    mut fault: ResMut<Fault>,
) {
    for (index, force, torque, inverse_mass, inverse_inertia, orientation, mut linear, mut angular) in &mut bodies {
        let a = force.0.scale_by(inverse_mass.0);
        let alpha = inverse_inertia.0.in_world(&orientation.0).apply(torque.0);
        fault.check(
            a.is_finite() && alpha.is_finite(),
            index.0,
            Quantity::Acceleration,
            StepSystems::ComputeAccelerations,
        );
        linear.bypass_change_detection().0 = a;
        angular.bypass_change_detection().0 = alpha;
    }
}

/// v += a Δt.
pub fn integrate_velocities<D: Dim>(
    clock: Res<Clock>,
    mut bodies: Query<
        (
            &BodyIndex,
            &Acceleration<VectorOf<D>>,
            &AngularAcceleration<AngularOf<D>>,
            &mut LinearVelocity<VectorOf<D>>,
            &mut AngularVelocity<AngularOf<D>>,
        ),
        Awake,
    >,
    mut fault: ResMut<Fault>,
) {
    for (index, a, alpha, mut velocity, mut angular_velocity) in &mut bodies {
        let v = velocity.0 + a.0 * clock.part();
        let w = angular_velocity.0 + alpha.0 * clock.part();
        fault.check(v.is_finite() && w.is_finite(), index.0, Quantity::Velocity, StepSystems::FilterVelocities);
        velocity.bypass_change_detection().0 = v;
        angular_velocity.bypass_change_detection().0 = w;
    }
}

/// Remembers the velocities before the step, for the ballistic integrator.
///
/// The step before could only use the acceleration at its beginning. Now that the one at its end is known, half of their difference
/// makes up for it, so that velocities follow the trapezoidal rule (velocity Verlet; Swope et al. 1982):
///
/// ```text
/// v_n += ½ (a_n − a_{n−1}) Δt
/// L_n += ½ (τ_n − τ_{n−1}) Δt
/// ```
///
/// Torques are compared rather than angular accelerations, since I turns with the body.
pub fn remember_velocities<D: Dim>(
    clock: Res<Clock>,
    mut bodies: Query<
        (
            &Acceleration<VectorOf<D>>,
            &AngularAcceleration<AngularOf<D>>,
            &Torque<AngularOf<D>>,
            &InverseInertia<D::Inertia>,
            &Orientation<D::Rotation>,
            &mut LinearVelocity<VectorOf<D>>,
            &mut AngularVelocity<AngularOf<D>>,
            &mut PreviousVelocity<VectorOf<D>, AngularOf<D>>,
        ),
        Awake,
    >,
) {
    let half_step = 0.5 * clock.part_before();
    for (a, alpha, torque, inverse, orientation, mut velocity, mut angular_velocity, mut previous) in &mut bodies {
        if let Some((a_before, torque_before)) = previous.drive.replace((a.0, torque.0)) {
            let alpha_before = inverse.0.in_world(&orientation.0).apply(torque_before);
            velocity.bypass_change_detection().0 += (a.0 - a_before) * half_step;
            angular_velocity.bypass_change_detection().0 += (alpha.0 - alpha_before) * half_step;
        }
        (previous.linear, previous.angular) = (velocity.0, angular_velocity.0);
    }
}

/// x += v Δt, plus the displacements of the position filter; rotation by the implicit midpoint rule with L constant.
///
/// Ballistic bodies (those with a [`PreviousVelocity`]) move with the mean of the velocities before and after the step.
pub fn update_positions<D: Geometry>(
    clock: Res<Clock>,
    corrections: Option<Res<PositionCorrections<D>>>,
    mut books: Option<ResMut<Books<D>>>,
    mut bodies: Query<
        (
            &BodyIndex,
            &mut Position<VectorOf<D>>,
            &mut Orientation<D::Rotation>,
            &LinearVelocity<VectorOf<D>>,
            &mut AngularVelocity<AngularOf<D>>,
            &BodyInertia<D::Inertia>,
            &InverseInertia<D::Inertia>,
            Option<&PreviousVelocity<VectorOf<D>, AngularOf<D>>>,
        ),
        Awake,
    >,
    mut fault: ResMut<Fault>,
) {
    let corrections = corrections.as_deref();
    for (index, mut position, mut orientation, velocity, mut angular_velocity, inertia, inverse, previous) in
        &mut bodies
    {
        let (mut v, mut w) = (velocity.0, angular_velocity.0);
        if let Some(previous) = previous {
            v = (previous.linear + v) * 0.5;
            w = (previous.angular + w) * 0.5;
        }
        let mut x = position.0 + v * clock.part();
        // Locked bodies and spheres turn steadily.
        let steady = inertia.0.is_spherical() || inverse.0 == D::Inertia::ZERO;
        let (mut rotation, mut turned) = if steady {
            (orientation.0.turned(w * clock.part()), angular_velocity.0)
        } else {
            D::turn_freely(orientation.0, &inertia.0, &inverse.0, w, clock.part())
        };
        if previous.is_some() && !steady {
            let momentum = inertia.0.in_world(&orientation.0).apply(angular_velocity.0);
            turned = inverse.0.in_world(&rotation).apply(momentum);
        }
        if let Some((shift, turn)) = corrections.and_then(|corrections| corrections.of(index.0)) {
            x += shift;
            rotation = rotation.turned(turn);
        }
        fault.check(x.is_finite() && rotation.is_finite(), index.0, Quantity::Position, StepSystems::UpdatePositions);
        if let Some(books) = &mut books
            && !D::Rotation::INERTIA_IS_CONSTANT
            && inverse.0 != D::Inertia::ZERO
        {
            let twice_energy = |rotation: &D::Rotation, w: D::Angular| w.dot(inertia.0.in_world(rotation).apply(w));
            let before = twice_energy(&orientation.0, angular_velocity.0);
            books.count_turn(0.5 * (twice_energy(&rotation, turned) - before));
        }
        position.bypass_change_detection().0 = x;
        orientation.bypass_change_detection().0 = rotation;
        angular_velocity.bypass_change_detection().0 = turned;
    }
}
