//! Free motion, forces and integrators: section B of the validation cases.

use crate::support;
use crate::support::{
    G, assert_near, assert_vector_near, ball, block, body, direction, every, floor, incline, simulation,
};
use crate::support::{bouncing, weightless};
use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;
use glam::{DVec2, dvec2};
use tumble_math::{PlanarRotation, trig};
use tumble_sim::{
    Anchor, AngularVelocity, AppliedForce, Axes, BodyKind, ContactModel, Course, Force, InertiaOverride, Integrator,
    LinearDrag, LinearVelocity, Lock, LockedAxes, MassOverride, Orientation, PenaltyLaw, PenaltySettings, Pinned,
    Position, QuadraticDrag, Settings, Simulation, Spring, SpringDamperSettings,
};
use tumble_solver::Surface;

const BOTH: [Integrator; 2] = [Integrator::SymplecticEuler, Integrator::Ballistic];

/// A body without parts.
fn point(simulation: &mut Simulation, name: &str, mass: f64, position: DVec2, velocity: DVec2) -> Entity {
    simulation.spawn((
        Name::new(name.to_owned()),
        Position(position),
        LinearVelocity(velocity),
        MassOverride(mass),
        InertiaOverride(1.0),
    ))
}

#[test]
fn b1_free_fall_follows_the_recurrence_of_the_integrator() {
    // Round-off of 100 additions.
    let round_off = 1e-12;
    for (integrator, height) in [(Integrator::SymplecticEuler, 5.04595), (Integrator::Ballistic, 5.095)] {
        let mut simulation = Simulation::new(Settings { integrator, ..every(0.01) });
        point(&mut simulation, "ball", 2.0, dvec2(0.0, 10.0), DVec2::ZERO);
        simulation.run_for(1.0).unwrap();
        assert_near(body(&simulation, "ball").position().y, height, round_off);
        assert_near(body(&simulation, "ball").velocity().y, -G, round_off);
    }
}

#[test]
fn b2_projectile_flies_its_parabola() {
    let launch = 20.0 * direction(35.0_f64.to_radians());
    let h = 1e-3;
    for integrator in BOTH {
        let mut simulation = Simulation::new(Settings { integrator, ..every(h) });
        point(&mut simulation, "ball", 0.3, DVec2::ZERO, launch);
        let (mut apex, mut before) = (0.0_f64, DVec2::ZERO);
        let landing = loop {
            simulation.step().unwrap();
            let now = body(&simulation, "ball").position();
            apex = apex.max(now.y);
            if now.y < 0.0 {
                let part = before.y / (before.y - now.y);
                break (simulation.time() - h + part * h, before.x + part * (now.x - before.x));
            }
            before = now;
        };
        // Symplectic Euler falls g h t/2 lower, so it lands exactly one step early and its apex is v_y h/2 lower.
        let early = if integrator == Integrator::Ballistic { 0.0 } else { h };
        // The chord between two samples is off by g h²/8 in height; round-off of 2300 additions is smaller.
        let chord = G * h * h / 8.0;
        assert_near(landing.0, 2.33874184037 - early, chord / launch.y + 1e-10);
        assert_near(landing.1, 38.3157031921 - launch.x * early, launch.x * chord / launch.y + 1e-9);
        assert_near(apex, 6.70723605173 - 0.5 * launch.y * early, chord + 0.5 * G * early * early);
    }
}

#[test]
fn b3_linear_drag_slows_the_fall() {
    for integrator in BOTH {
        let mut simulation = Simulation::new(Settings { integrator, ..every(1e-3) });
        let ball = point(&mut simulation, "ball", 2.0, DVec2::ZERO, DVec2::ZERO);
        simulation.world_mut().entity_mut(ball).insert(LinearDrag { translation: 0.5, rotation: 0.1 });
        simulation.world_mut().entity_mut(ball).insert(AngularVelocity(3.0));
        simulation.run_for(3.0).unwrap();
        let ball = body(&simulation, "ball");
        // First order at h = 1e-3: h c/(2m) of the speed and g h t/2 of the way are within 1e-3 of both.
        assert_near(ball.velocity().y, -20.7043364704, 1e-3 * 20.7);
        assert_near(ball.position().y, -34.9026541182, 1e-3 * 34.9);
        // ω = ω₀ exp(−c_r t/I) with I = 1.
        assert_near(ball.angular_velocity(), 3.0 * trig::exp(-0.3), 1e-3 * 3.0);
    }
}

#[test]
fn b3_linear_drag_ends_at_the_terminal_velocity() {
    let mut simulation = Simulation::new(every(0.01));
    let ball = point(&mut simulation, "ball", 2.0, DVec2::ZERO, DVec2::ZERO);
    simulation.world_mut().entity_mut(ball).insert(LinearDrag { translation: 0.5, rotation: 0.0 });
    simulation.run_for(200.0).unwrap();
    // 50 time constants have passed (e⁻⁵⁰); the fixed point of the recurrence is exact.
    assert_near(body(&simulation, "ball").velocity().y, -39.24, 1e-11);
}

#[test]
fn b4_quadratic_drag_slows_the_fall() {
    for integrator in BOTH {
        let mut simulation = Simulation::new(Settings { integrator, ..every(1e-3) });
        let ball = point(&mut simulation, "ball", 2.0, DVec2::ZERO, DVec2::ZERO);
        simulation.world_mut().entity_mut(ball).insert(QuadraticDrag { translation: 0.1, rotation: 0.0 });
        simulation.run_for(3.0).unwrap();
        let ball = body(&simulation, "ball");
        // As for linear drag.
        assert_near(ball.velocity().y, -13.5941298055, 1e-3 * 13.6);
        assert_near(ball.position().y, -28.4555322462, 1e-3 * 28.5);
    }
}

/// A mass of 1 kg on a spring of 100 N/m whose ends are 10 m apart at rest, stretched from there.
fn oscillator(settings: Settings, stretch: f64) -> Simulation {
    let mut simulation = Simulation::new(settings);
    let ball = point(&mut simulation, "ball", 1.0, dvec2(stretch, 0.0), DVec2::ZERO);
    simulation.spawn(Spring {
        a: Anchor::World(dvec2(-10.0, 0.0)),
        b: Anchor::Body(ball, DVec2::ZERO),
        stiffness: 100.0,
        damping: 0.0,
        rest_length: 10.0,
    });
    simulation
}

#[test]
fn b5_spring_under_symplectic_euler_keeps_its_own_energy() {
    let h = 0.01;
    let mut simulation = oscillator(weightless(h), 1.0);
    for _ in 0..1000 {
        simulation.step().unwrap();
        let (x, v) = (body(&simulation, "ball").position().x, body(&simulation, "ball").velocity().x);
        // Round-off of 1000 steps: 3e-13 of 100, times the ten metres that the spring's length adds to every stretch.
        assert_near(v * v + 100.0 * x * x - h * 100.0 * x * v, 100.0, 1e-9);
        let energy = (v * v + 100.0 * x * x) / 100.0;
        assert!((1.0 / 1.05 - 1e-9..=1.0 / 0.95 + 1e-9).contains(&energy), "energy {energy} of its start");
    }
    assert_near(body(&simulation, "ball").position().x, 0.906212653161, 1e-9);
    assert_near(body(&simulation, "ball").velocity().x, 4.70553716885, 1e-9);
}

#[test]
fn b5_spring_is_stable_while_h_omega_is_below_two() {
    for (h, stable) in [(0.199, true), (0.201, false)] {
        let mut simulation = oscillator(weightless(h), 0.1);
        let mut largest = 0.0_f64;
        for _ in 0..200 {
            simulation.step().unwrap();
            largest = largest.max(body(&simulation, "ball").position().x.abs());
        }
        // Stable: the invariant bounds the amplitude by x₀/√(1 − (hω/2)²) = 1.0013; unstable: it grows by e^0.2 a step.
        assert_eq!(largest < 1.002, stable, "h = {h}: amplitude {largest}");
    }
}

/// Errors after one second with steps of h, h/2, h/4; positions and velocities as one vector.
fn errors(build: impl Fn(f64) -> Simulation, h: f64, exact: (DVec2, DVec2)) -> [f64; 3] {
    [1.0, 0.5, 0.25].map(|part| {
        let mut simulation = build(h * part);
        simulation.run_for(1.0).unwrap();
        let ball = body(&simulation, "ball");
        ((ball.position() - exact.0).length_squared() + (ball.velocity() - exact.1).length_squared()).sqrt()
    })
}

#[track_caller]
fn assert_order(errors: [f64; 3], order: i32) {
    let factor = 2.0_f64.powi(order);
    for pair in errors.windows(2) {
        // Ten per cent for the next term of the error.
        assert_near(pair[0] / pair[1], factor, 0.1 * factor);
    }
}

#[test]
fn halving_the_step_of_a_spring_shows_the_order_of_the_integrator() {
    let exact = (dvec2(trig::cos(10.0), 0.0), dvec2(-10.0 * trig::sin(10.0), 0.0));
    for (integrator, order) in [(Integrator::SymplecticEuler, 1), (Integrator::Ballistic, 2)] {
        assert_order(errors(|dt| oscillator(Settings { integrator, ..weightless(dt) }, 1.0), 1e-3, exact), order);
    }
}

#[test]
fn halving_the_step_of_a_fall_with_drag_shows_the_order_of_the_integrator() {
    // Quadratic drag: v = v∞ tanh(g t/v∞), y = v∞²/g ln cosh(g t/v∞).
    let terminal = (2.0 * G / 0.1_f64).sqrt();
    let s = G / terminal;
    let exact = (dvec2(0.0, -terminal * terminal / G * trig::ln(trig::cosh(s))), dvec2(0.0, -terminal * trig::tanh(s)));
    let fall = |integrator| {
        move |dt| {
            let mut simulation = Simulation::new(Settings { integrator, ..every(dt) });
            let ball = point(&mut simulation, "ball", 2.0, DVec2::ZERO, DVec2::ZERO);
            simulation.world_mut().entity_mut(ball).insert(QuadraticDrag { translation: 0.1, rotation: 0.0 });
            simulation
        }
    };
    assert_order(errors(fall(Integrator::SymplecticEuler), 0.01, exact), 1);
    assert_order(errors(fall(Integrator::Ballistic), 0.01, exact), 2);
}

#[test]
fn halving_the_step_under_a_growing_push_shows_the_order_of_the_integrator() {
    // F = 12 t² by a system of one's own: v = 4 t³, x = t⁴.
    let exact = (dvec2(1.0, 0.0), dvec2(4.0, 0.0));
    for (integrator, order) in [(Integrator::SymplecticEuler, 1), (Integrator::Ballistic, 2)] {
        let pushed = |dt| {
            let mut simulation = Simulation::new(Settings { integrator, ..weightless(dt) });
            point(&mut simulation, "ball", 1.0, DVec2::ZERO, DVec2::ZERO);
            simulation.add_force(|clock: Res<tumble_sim::Clock>, mut bodies: Query<&mut Force<DVec2>>| {
                for mut force in &mut bodies {
                    force.0.x += 12.0 * clock.time() * clock.time();
                }
            });
            simulation
        };
        assert_order(errors(pushed, 0.01, exact), order);
    }
}

#[test]
fn applied_force_grows_along_its_lines() {
    // F = 2t on 1 kg for one second: v = 1, x = 1/3. Symplectic Euler reads it at the ends of its steps: v = 1 + h.
    let h = 0.01;
    // Ballistic: at their beginnings, and the velocity lags by half of the last change of acceleration, h², put right
    // with the next force.
    for (integrator, velocity) in [(Integrator::SymplecticEuler, 1.0 + h), (Integrator::Ballistic, 1.0 - h * h)] {
        let mut simulation = Simulation::new(Settings { integrator, ..weightless(h) });
        let ball = point(&mut simulation, "ball", 1.0, DVec2::ZERO, DVec2::ZERO);
        simulation.spawn(AppliedForce::<tumble_math::Planar> {
            body: ball,
            point: dvec2(0.0, 0.5),
            force: dvec2(20.0, 0.0),
            torque: 0.25,
            axes: Axes::Body,
            course: Course::lines([(0.0, 0.0), (10.0, 1.0)]),
        });
        simulation.world_mut().entity_mut(ball).insert(LockedAxes { translation: DVec2::ZERO, rotation: Lock::Locked });
        simulation.run_for(1.0).unwrap();
        // Round-off of 100 additions.
        assert_near(body(&simulation, "ball").velocity().x, velocity, 1e-12);
    }
}

#[test]
fn force_in_a_window_lasts_exactly_as_many_steps() {
    let mut simulation = Simulation::new(weightless(0.125));
    let ball = point(&mut simulation, "ball", 1.0, DVec2::ZERO, DVec2::ZERO);
    simulation.spawn(AppliedForce::<tumble_math::Planar> {
        body: ball,
        point: dvec2(0.0, 1.0),
        force: dvec2(8.0, 0.0),
        torque: 0.0,
        axes: Axes::World,
        course: Course::window(0.5, 1.0),
    });
    simulation.world_mut().entity_mut(ball).insert(LockedAxes { translation: DVec2::ZERO, rotation: Lock::Locked });
    simulation.run_for(2.0).unwrap();
    // Four steps of 0.125 s; eighths are exact.
    assert_eq!(body(&simulation, "ball").velocity().x, 4.0);
}

#[test]
fn forces_of_ones_own_last_one_step_and_add_in_order() {
    let mut simulation = Simulation::new(weightless(0.5));
    point(&mut simulation, "ball", 2.0, DVec2::ZERO, DVec2::ZERO);
    simulation.add_force(|mut bodies: Query<&mut Force<DVec2>>| bodies.iter_mut().for_each(|mut f| f.0.x += 3.0));
    simulation.add_force(|mut bodies: Query<&mut Force<DVec2>>| bodies.iter_mut().for_each(|mut f| f.0 *= 2.0));
    for step in 1..=4 {
        simulation.step().unwrap();
        // (0 + 3)·2 N on 2 kg: 1.5 m/s each half second, exact in binary. In the other order it would be half.
        assert_eq!(body(&simulation, "ball").velocity(), dvec2(1.5 * f64::from(step), 0.0));
    }
}

#[test]
fn spring_between_two_bodies_keeps_momentum_and_their_frequency() {
    // Reduced mass 2·3/5 = 1.2 kg: ω = √(120/1.2) = 10 rad/s.
    let mut simulation = Simulation::new(Settings { integrator: Integrator::Ballistic, ..weightless(1e-3) });
    let a = point(&mut simulation, "a", 2.0, DVec2::ZERO, DVec2::ZERO);
    let b = point(&mut simulation, "b", 3.0, dvec2(1.5, 0.0), DVec2::ZERO);
    let ends = (Anchor::Body(a, DVec2::ZERO), Anchor::Body(b, DVec2::ZERO));
    simulation.spawn(Spring { a: ends.0, b: ends.1, stiffness: 120.0, damping: 0.0, rest_length: 1.0 });
    simulation.run_for(1.0).unwrap();
    let stretch = body(&simulation, "b").position().x - body(&simulation, "a").position().x - 1.0;
    // Phase error of Verlet: (ωh)²/24 · ωt = 4.2e-5 of half a metre.
    assert_near(stretch, 0.5 * trig::cos(10.0), 5e-5);
    assert!(support::momentum(&simulation).length() < 1e-13, "equal and opposite forces, round-off of 1000 steps");
}

#[test]
fn b8_pinned_body_keeps_every_bit_and_is_a_wall_to_others() {
    for contact in [ContactModel::Impulse, ContactModel::Penalty] {
        let settings = Settings { contact, ..every(1e-3) };
        let mut simulation = simulation(settings, bouncing(1.0));
        let start = (dvec2(0.1, 0.7), 0.3);
        let pinned = block(1.0, 0.2, 5.0).at(start.0.x, start.0.y).turned(start.1).spawn(&mut simulation, "pinned");
        simulation.world_mut().entity_mut(pinned).insert((Pinned, LinearDrag { translation: 2.0, rotation: 1.0 }));
        let free = point(&mut simulation, "free", 1.0, dvec2(3.0, 3.0), DVec2::ZERO);
        simulation.spawn(Spring {
            a: Anchor::Body(pinned, dvec2(0.5, 0.1)),
            b: Anchor::Body(free, DVec2::ZERO),
            stiffness: 50.0,
            damping: 0.1,
            rest_length: 1.0,
        });
        ball(0.1, 1.0).at(0.0, 1.5).spawn(&mut simulation, "ball");
        for _ in 0..2000 {
            simulation.step().unwrap();
            let pinned = body(&simulation, "pinned");
            assert_eq!((pinned.position(), pinned.angle()), start);
            assert_eq!((pinned.velocity(), pinned.angular_velocity()), (DVec2::ZERO, 0.0));
        }
        assert!(body(&simulation, "ball").velocity().x < -1.0, "the ball was turned aside by the slanted top");
    }
}

#[test]
fn locked_axes_keep_every_bit() {
    let mut simulation =
        simulation(every(0.01), Surface { restitution: 0.5, static_friction: 0.5, kinetic_friction: 0.5 });
    floor(&mut simulation);
    let locked = block(0.5, 0.5, 1.0).at(0.25, 1.0).turned(0.3).moving(1.0, 0.0).spawn(&mut simulation, "locked");
    let lock = LockedAxes { translation: dvec2(1.0, 0.0), rotation: Lock::Locked };
    simulation.world_mut().entity_mut(locked).insert((lock, LinearVelocity(DVec2::ZERO)));
    simulation.run_for(2.0).unwrap();
    let locked = body(&simulation, "locked");
    assert_eq!((locked.position().x, locked.angle(), locked.velocity().x), (0.25, 0.3, 0.0));
    // It fell onto its lowest corner and rests there: half diagonals of the turned square.
    let height = 0.25 * (trig::cos(0.3) + trig::sin(0.3));
    assert_near(locked.position().y, height, 1e-9);
}

#[test]
fn b9_frictionless_plane_leaves_the_acceleration_along_it() {
    let angle = 30.0_f64.to_radians();
    for mass in [1e-3, 1.0, 1e3] {
        let mut simulation = simulation(every(0.01), Surface::default());
        incline(&mut simulation, angle);
        let (along, normal) = (direction(angle), direction(angle).perp());
        let start = normal * 0.1;
        block(0.4, 0.2, mass).at(start.x, start.y).turned(angle).spawn(&mut simulation, "block");
        simulation.run_for(1.0).unwrap();
        let block = body(&simulation, "block");
        // Round-off of 100 steps.
        assert_vector_near(block.velocity(), -along * 4.905, 1e-12);
        assert_near((block.position() - start).dot(normal), 0.0, 1e-12);
        assert_near((block.position() - start).dot(along), -4.905 * 0.01 * 0.01 * 5050.0, 1e-12);
    }
}

#[test]
fn b10_ungated_penalty_floor_gives_back_the_speed() {
    let law = SpringDamperSettings { stiffness: Some(500.0), damping: Some(0.0), ..SpringDamperSettings::default() };
    let penalty = PenaltySettings { law: PenaltyLaw::SpringDamper(law) };
    // h √(k/m) = 0.0056, well below 0.05.
    let settings = Settings { contact: ContactModel::Penalty, penalty, ..every(2.5e-4) };
    let mut simulation = simulation(settings, Surface::default());
    floor(&mut simulation);
    ball(0.1, 1.0).at(0.0, 0.1).moving(0.0, -1.0).spawn(&mut simulation, "ball");
    let mut deepest: f64 = 0.0;
    for _ in 0..4000 {
        simulation.step().unwrap();
        let ball = body(&simulation, "ball");
        deepest = deepest.max(0.1 - ball.position().y);
        if ball.position().y > 0.1 {
            break;
        }
    }
    // One per cent, as the case says.
    assert_near(deepest, 0.0684558925382, 0.01 * 0.0685);
    assert_near(body(&simulation, "ball").velocity().y, 1.0, 0.01);
}

#[test]
fn b10_damped_penalty_floor_carries_the_weight_at_its_depth() {
    let law = SpringDamperSettings { stiffness: Some(500.0), damping: Some(20.0), ..SpringDamperSettings::default() };
    let penalty = PenaltySettings { law: PenaltyLaw::SpringDamper(law) };
    let settings = Settings { contact: ContactModel::Penalty, penalty, ..every(1e-3) };
    let mut simulation = simulation(settings, Surface::default());
    floor(&mut simulation);
    ball(0.1, 1.0).at(0.0, 0.1).spawn(&mut simulation, "ball");
    simulation.run_for(10.0).unwrap();
    // 10 s are 100 time constants of the damped spring.
    assert_near(0.1 - body(&simulation, "ball").position().y, 0.01962, 1e-12);
    assert_near(support::contact_force(&mut simulation, "floor", "ball").y, G, 1e-9);
}

#[test]
fn b10_gated_lecture_floor_does_not_rebound() {
    let penalty = PenaltySettings { law: PenaltyLaw::Lecture { stiffness: 500.0, viscosity: 0.0 } };
    let settings = Settings { contact: ContactModel::Penalty, penalty, ..weightless(1e-3) };
    let mut simulation = simulation(settings, Surface::default());
    floor(&mut simulation);
    support::rod(1.0, 1.0).at(0.0, 0.0).moving(0.0, -1.0).spawn(&mut simulation, "rod");
    simulation.run_for(1.0).unwrap();
    // The force ends when the rod stops: what is left is less than the last step's push on both ends, h · 2k/m · depth.
    let speed = body(&simulation, "rod").velocity().y;
    let depth = 1.0 / 1000.0_f64.sqrt();
    assert!((0.0..=1e-3 * 1000.0 * depth).contains(&speed), "rebound at {speed} m/s");
}

#[test]
fn rotation_of_a_free_body_keeps_its_rate() {
    let mut simulation = Simulation::new(every(0.01));
    simulation.spawn((
        Name::new("rod"),
        Position(DVec2::ZERO),
        Orientation(PlanarRotation::from_angle(0.25)),
        AngularVelocity(8.0),
        MassOverride(1.0),
        InertiaOverride(1.0),
        BodyKind::Dynamic,
    ));
    simulation.run_for(10.0).unwrap();
    assert_eq!(body(&simulation, "rod").angular_velocity(), 8.0);
    // The angle counts turns; round-off of 1000 additions.
    assert_near(body(&simulation, "rod").angle(), 80.25, 1e-10);
}
