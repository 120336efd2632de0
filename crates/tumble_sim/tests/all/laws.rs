//! Laws that hold for every scene: momentum, energy, mirrors, repetition.

use crate::support::{OneShape, angular_momentum, ball, block, body, kinetic_energy, momentum, rod};
use crate::support::{simulation, weightless};
use glam::{DVec2, dvec2};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tumble_shape::Rod;
use tumble_sim::{Amount, ContactModel, Part, Settings, Simulation};
use tumble_solver::Surface;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(7), ..ProptestConfig::default() }
}

/// A body of a random scene.
#[derive(Clone, Copy, Debug)]
struct Thrown {
    shape: u8,
    size: f64,
    mass: f64,
    offset: DVec2,
    angle: f64,
    velocity: DVec2,
    spin: f64,
}

fn thrown() -> impl Strategy<Value = Thrown> {
    (0..3_u8, 0.3..0.6, 0.5..5.0, (-0.1..0.1, -0.1..0.1), -1.5..1.5, (-3.0..3.0, -3.0..3.0), -4.0..4.0).prop_map(
        |(shape, size, mass, offset, angle, velocity, spin)| Thrown {
            shape,
            size,
            mass,
            offset: dvec2(offset.0, offset.1),
            angle,
            velocity: dvec2(velocity.0, velocity.1),
            spin,
        },
    )
}

fn shape(thrown: &Thrown) -> OneShape {
    match thrown.shape {
        0 => ball(0.5 * thrown.size, thrown.mass),
        1 => rod(thrown.size, thrown.mass),
        _ => block(thrown.size, 0.6 * thrown.size, thrown.mass),
    }
}

/// Nine bodies about the corners of a grid, thrown at its middle; mirrored at the y axis if `side` is −1.
fn scene(bodies: &[Thrown], surface: Surface, settings: Settings, side: f64) -> Simulation {
    let mut simulation = simulation(settings, surface);
    for (i, thrown) in bodies.iter().enumerate() {
        let cell = dvec2((i % 3) as f64 - 1.0, (i / 3) as f64 - 1.0);
        let (at, velocity) = (cell + thrown.offset, thrown.velocity - 2.0 * cell);
        shape(thrown)
            .at(side * at.x, at.y)
            .turned(side * thrown.angle)
            .moving(side * velocity.x, velocity.y)
            .spinning(side * thrown.spin)
            .spawn(&mut simulation, &format!("body-{i}"));
    }
    simulation.prepare().unwrap();
    simulation
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn collisions_of_free_bodies_keep_momentum(
        bodies in prop::collection::vec(thrown(), 9), restitution in 0.0..1.0_f64, friction in 0.0..1.0_f64,
    ) {
        let surface = Surface { static_friction: friction, kinetic_friction: 0.8 * friction, restitution };
        for contact in [ContactModel::Impulse, ContactModel::Penalty] {
            let mut simulation = scene(&bodies, surface, Settings { contact, ..weightless(0.005) }, 1.0);
            let before = (momentum(&simulation), angular_momentum(&simulation));
            simulation.run_for(0.5).unwrap();
            // Round-off: 100 steps of 9 bodies with up to 20 kg m/s.
            prop_assert!((momentum(&simulation) - before.0).length() < 1e-11, "{contact:?}");
            if contact == ContactModel::Penalty {
                // Forces act at one point on both bodies. Impulses do too, but bodies are also set down on each other's surfaces.
                prop_assert!((angular_momentum(&simulation) - before.1).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn frictionless_impacts_never_add_energy(
        bodies in prop::collection::vec(thrown(), 9), restitution in 0.0..=1.0_f64,
    ) {
        let surface = Surface { restitution, ..Surface::default() };
        let mut simulation = scene(&bodies, surface, weightless(0.005), 1.0);
        let mut before = kinetic_energy(&simulation);
        for _ in 0..100 {
            simulation.step().unwrap();
            let after = kinetic_energy(&simulation);
            // Round-off of some hundred joules.
            prop_assert!(after <= before + 1e-11, "{before} -> {after}");
            before = after;
        }
    }

    #[test]
    fn mirrored_scene_has_a_mirrored_result(
        bodies in prop::collection::vec(thrown(), 9), restitution in 0.0..1.0_f64, friction in 0.0..0.5_f64,
    ) {
        let surface = Surface { static_friction: friction, kinetic_friction: friction, restitution };
        let [mut one, mut other] = [1.0, -1.0].map(|side| scene(&bodies, surface, weightless(0.005), side));
        one.run_for(0.25).unwrap();
        other.run_for(0.25).unwrap();
        for i in 0..bodies.len() {
            let name = format!("body-{i}");
            let (a, b) = (body(&one, &name), body(&other, &name));
            // Round-off, grown by a few impacts, each by less than a hundredfold.
            prop_assert!((a.position() - b.position() * dvec2(-1.0, 1.0)).length() < 1e-9);
            prop_assert!((a.angle() + b.angle()).abs() < 1e-8);
        }
    }

    #[test]
    fn same_scene_has_the_same_bits(bodies in prop::collection::vec(thrown(), 9)) {
        let surface = Surface { static_friction: 0.4, kinetic_friction: 0.3, restitution: 0.5 };
        for contact in [ContactModel::Impulse, ContactModel::Penalty] {
            let settings = Settings { contact, ..weightless(0.01) };
            let [mut one, mut other] = [(); 2].map(|()| scene(&bodies, surface, settings, 1.0));
            one.run_for(0.5).unwrap();
            other.run_for(0.5).unwrap();
            for i in 0..bodies.len() {
                let name = format!("body-{i}");
                let bits = |simulation| {
                    let body = body(simulation, &name);
                    [body.position().x, body.position().y, body.angle(), body.velocity().x, body.angular_velocity()]
                        .map(f64::to_bits)
                };
                prop_assert_eq!(bits(&one), bits(&other));
            }
        }
    }
}

/// A cross of two thin rods of length 1.
fn cross(simulation: &mut Simulation, name: &str, x: f64, speed: f64, spin: f64) {
    let arm = rod(1.0, 1.0).at(x, 0.0).moving(speed, 0.0).spinning(spin);
    let body = arm.spawn(simulation, name);
    let upright = Rod::try_new(dvec2(0.0, -0.5), dvec2(0.0, 0.5), 0.0).unwrap();
    simulation.attach(body, Part::new(upright, Amount::Mass(1.0)));
}

/// The ends of both rods of a cross.
fn rods(simulation: &Simulation, name: &str) -> [[DVec2; 2]; 2] {
    let body = body(simulation, name);
    [dvec2(0.5, 0.0), dvec2(0.0, 0.5)].map(|end| [body.point(-end), body.point(end)])
}

/// How far the shallowest end of two crossing segments would have to move to part them; 0 where they do not cross [m].
fn crossing_depth([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from) / (to - from).length();
    let (of_c, of_d) = (side(a, b, c), side(a, b, d));
    let (of_a, of_b) = (side(c, d, a), side(c, d, b));
    if of_c * of_d >= 0.0 || of_a * of_b >= 0.0 {
        return 0.0;
    }
    [of_a, of_b, of_c, of_d].map(f64::abs).into_iter().fold(f64::MAX, f64::min)
}

#[test]
fn crosses_of_thin_rods_hit_each_other_and_never_pass_through() {
    for (speed, spin) in [(1.0, 10.0), (10.0, 5.0), (25.0, 0.0), (25.0, 20.0)] {
        for (one, other) in [(1.0, 1.0), (1.0, -1.0)] {
            let surface = Surface { static_friction: 0.3, kinetic_friction: 0.3, restitution: 0.5 };
            let mut simulation = simulation(weightless(1.0 / 60.0), surface);
            cross(&mut simulation, "left", -2.0, speed, one * spin);
            cross(&mut simulation, "right", 2.1, -speed, other * spin);
            let (mut met, mut turn) = (false, spin / 60.0);
            for _ in 0..240 {
                simulation.step().unwrap();
                let (left, right) = (body(&simulation, "left"), body(&simulation, "right"));
                met |= (left.velocity().x - speed).abs() > 1e-9;
                // Motion within a step is foreseen along straight lines and a fixed normal. Turning by ω Δt meanwhile dips a tip by
                // up to ½ r (ω Δt)² for each cross, and by the way that the two pass each other times ω Δt.
                turn = turn.max(left.angular_velocity().abs().max(right.angular_velocity().abs()) / 60.0);
                let allowed = 2.0 * 0.005 + 0.5 * turn * turn + 2.0 * speed / 60.0 * turn;
                for one in rods(&simulation, "left") {
                    for other in rods(&simulation, "right") {
                        let depth = crossing_depth(one, other);
                        let time = simulation.time();
                        assert!(
                            depth < allowed,
                            "{speed} m/s, {spin} rad/s, {time} s: {depth} m deep, allowed {allowed}"
                        );
                    }
                }
            }
            assert!(met, "{speed} m/s, {spin} rad/s: they missed");
            assert!(momentum(&simulation).length() < 1e-11, "round-off of the impulses of 240 steps");
        }
    }
}
