//! Components and integrating systems are shared by plane and space: free bodies in space through the same systems.

use bevy_ecs::prelude::*;
use glam::{DVec3, dvec3};
use tumble_math::{Inertia, Rotation, Spatial, SpatialRotation, SymmetricTensor};
use tumble_sim::contact::PositionCorrections;
use tumble_sim::fault::Fault;
use tumble_sim::force::{apply_gravity, apply_linear_drag};
use tumble_sim::integrate::{clear_forces, compute_accelerations, integrate_velocities, update_positions};
use tumble_sim::*;

/// A world with the phases that need no shapes.
fn world(gravity: DVec3, dt: f64) -> (World, bevy_ecs::schedule::Schedule) {
    let mut world = World::new();
    world.insert_resource(Settings::<Spatial> { gravity, dt, ..Settings::weightless() });
    world.insert_resource(Clock::new(dt));
    world.init_resource::<Fault>();
    world.init_resource::<PositionCorrections<Spatial>>();
    let mut schedule = bevy_ecs::schedule::Schedule::default();
    schedule.add_systems(
        (
            clear_forces::<Spatial>,
            apply_gravity::<Spatial>,
            apply_linear_drag::<Spatial>,
            compute_accelerations::<Spatial>,
            integrate_velocities::<Spatial>,
            update_positions::<Spatial>,
        )
            .chain(),
    );
    (world, schedule)
}

/// Mass components of a free body.
fn mass(mass: f64, inertia: DVec3) -> impl Bundle {
    let inertia = SymmetricTensor::from_diagonal(inertia);
    (
        Mass(mass),
        InverseMass(DVec3::splat(1.0 / mass)),
        BodyInertia(inertia),
        InverseInertia(inertia.try_inverse().unwrap()),
    )
}

#[test]
fn b1_free_fall_in_space_follows_the_recurrence() {
    let (mut world, mut schedule) = world(dvec3(0.0, 0.0, -9.81), 0.01);
    let body = world.spawn((Position(dvec3(1.0, 2.0, 10.0)), mass(2.0, DVec3::ONE))).id();
    for _ in 0..100 {
        schedule.run(&mut world);
    }
    let position = world.get::<Position<DVec3>>(body).unwrap().0;
    // Round-off of 100 additions.
    assert!((position - dvec3(1.0, 2.0, 5.04595)).length() < 1e-12, "{position}");
}

#[test]
fn torque_free_body_keeps_its_angular_momentum() {
    let (mut world, mut schedule) = world(DVec3::ZERO, 0.01);
    let start = dvec3(0.01, 5.0, 0.01);
    let body = world.spawn((Position(DVec3::ZERO), AngularVelocity(start), mass(1.0, dvec3(1.0, 2.0, 3.0)))).id();
    for _ in 0..10_000 {
        schedule.run(&mut world);
    }
    let inertia = world.get::<BodyInertia<SymmetricTensor>>(body).unwrap().0;
    let rotation: SpatialRotation = world.get::<Orientation<SpatialRotation>>(body).unwrap().0;
    let spin = world.get::<AngularVelocity<DVec3>>(body).unwrap().0;
    let momentum = rotation.rotate(inertia.apply(rotation.unrotate(spin)));
    // Each of the 10 000 steps rounds once or twice.
    assert!((momentum - inertia.apply(start)).length() < 1e-10, "{momentum}");
}

#[test]
fn drag_slows_a_body_in_space() {
    let (mut world, mut schedule) = world(DVec3::ZERO, 1e-3);
    let drag = LinearDrag { translation: 0.5, rotation: 0.0 };
    let velocity = LinearVelocity(dvec3(3.0, -1.0, 2.0));
    let body = world.spawn((Position(DVec3::ZERO), velocity, drag, mass(2.0, DVec3::ONE))).id();
    for _ in 0..3000 {
        schedule.run(&mut world);
    }
    let slowed = world.get::<LinearVelocity<DVec3>>(body).unwrap().0;
    let expected = velocity.0 * tumble_math::trig::exp(-0.5 / 2.0 * 3.0);
    // First order: relative error c Δt t / (2 m) · c/m = 1e-4 at this step.
    assert!((slowed - expected).length() < 1e-4 * expected.length(), "{slowed} is not {expected}");
}
