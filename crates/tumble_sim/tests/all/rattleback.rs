//! A stone that turns round by itself when it is spun one way and not the other: G10 of the validation cases.
//!
//! It is a capsule that lies on a round hill, so that its contact is a point of smooth surfaces: along the stone the hill curves, across it both do.
//! Its principal axes are turned against the capsule by 5°, and its centre of mass is 1 cm above the contact.

use crate::space_support::{RIGID, Start, rough, settings, spawn};
use bevy_ecs::name::Name;
use glam::{DVec3, dvec3};
use tumble_math::{SymmetricTensor, trig};
use tumble_shape::{Capsule, SpatialShape, Sphere};
use tumble_sim::{Amount, BodyKind, CentreOverride, ContactModel, InertiaOverride, Part, Position, Simulation};

/// Radius of the hill [m].
const HILL: f64 = 0.5;
/// Radius of the capsule [m].
const STONE: f64 = 0.05;
/// Height of the centre of mass over the contact [m]; below `HILL · STONE/(HILL + STONE)`, so the stone rocks upright.
const HEIGHT: f64 = 0.01;

/// Rates of turn about the vertical [rad/s] after 1 s, 1.5 s and 2 s of a stone of 1 kg that begins level with `spin` [rad/s] and a little rocking.
fn turning(contact: ContactModel, dt: f64, spin: f64) -> [f64; 3] {
    let mut simulation = Simulation::with_settings(settings(contact, dt));
    simulation.materials_mut().set("default", rough(1.0));
    let hill = simulation.spawn((Name::new("hill"), Position(DVec3::Z * -HILL), BodyKind::Static));
    let ball = SpatialShape::from(Sphere::try_new(DVec3::ZERO, HILL).unwrap());
    simulation.attach(hill, Part::new(ball, Amount::Density(0.0)));
    let spin = dvec3(0.02, 0.02, spin);
    let start = Start { spin, velocity: spin.cross(DVec3::Z * HEIGHT), ..Start::at(DVec3::Z * STONE) };
    let capsule = Capsule::try_new(DVec3::X * -0.5, DVec3::X * 0.5, STONE).unwrap();
    let stone = spawn(&mut simulation, "stone", capsule, 1.0, &start);
    let (sine, cosine) = trig::sin_cos(5_f64.to_radians());
    let (along, across, upright) = (2e-4, 1.6e-3, 1.7e-3);
    let diagonal = [cosine * cosine, sine * sine].map(|share| along * share + across * (1.0 - share));
    let inertia = SymmetricTensor {
        diagonal: dvec3(diagonal[0], diagonal[1], upright),
        off_diagonal: DVec3::Z * ((along - across) * sine * cosine),
    };
    let centre = CentreOverride(DVec3::Z * (HEIGHT - STONE));
    simulation.world_mut().entity_mut(stone).insert((centre, InertiaOverride(inertia)));
    [1.0, 0.5, 0.5].map(|seconds| {
        simulation.run_for(seconds).unwrap();
        simulation.body("stone").unwrap().angular_velocity().z
    })
}

// Expected values: Newton's and Euler's equations of a body that rolls without slip on the hill, by Runge and Kutta's fourth-order method with steps of
// 1 ms, which keeps the energy to 1e-7; friction 0.49 is needed.

#[test]
fn g10_a_rattleback_spun_against_its_twist_turns_round() {
    for contact in RIGID {
        let expected = [-4.8599, -2.7715, 1.5294];
        let [coarse, fine] = [5e-4, 2.5e-4].map(|dt| turning(contact, dt, -5.0));
        for (found, expected) in fine.into_iter().zip(expected) {
            // First order in the step: 0.075 rad/s while it turns fastest.
            assert!((found - expected).abs() < 0.1, "{contact:?}: {found} rad/s, not {expected}");
        }
        let ratio = (coarse[1] - expected[1]) / (fine[1] - expected[1]);
        assert!((ratio - 2.0).abs() < 0.2, "{contact:?}: half the step makes the error {ratio} times smaller");
    }
}

#[test]
fn g10_a_rattleback_spun_with_its_twist_goes_on() {
    for contact in RIGID {
        // Nothing grows as yet: 4.99749 rad/s at the end, to 1e-3.
        let [_, _, end] = turning(contact, 5e-4, 5.0);
        assert!((end - 4.9975).abs() < 1e-3, "{contact:?}: {end} rad/s");
    }
}
