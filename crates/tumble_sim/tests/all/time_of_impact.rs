//! Steps that are cut at impacts: sections C1, C2 and C4 of the validation cases with exact times, and what must not change.

use crate::support;
use crate::support::{
    G, assert_near, assert_vector_near, ball, block, body, bouncing, every, floor, kinetic_energy, rod,
};
use crate::support::{simulation, weightless};
use bevy_ecs::message::{MessageCursor, Messages};
use glam::{DVec2, dvec2};
use tumble_sim::{ContactModel, Settings, Simulation, Touch, TouchPhase};
use tumble_solver::Surface;

const EVENT_DRIVEN: [ContactModel; 3] = [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp];

fn cut(contact: ContactModel, dt: f64) -> Settings {
    Settings { contact, time_of_impact: true, ..every(dt) }
}

/// Runs, and lists the times at which touches began [s].
fn touch_times(simulation: &mut Simulation, seconds: f64) -> Vec<f64> {
    let mut cursor = MessageCursor::<Touch>::default();
    let mut times = Vec::new();
    while simulation.time() < seconds {
        simulation.step().unwrap();
        let touches = simulation.world().resource::<Messages<Touch>>();
        times.extend(cursor.read(touches).filter(|touch| touch.phase == TouchPhase::Began).map(|touch| touch.time));
    }
    times
}

#[test]
fn c1_impacts_happen_at_their_times_whatever_the_step() {
    let first = (2.0_f64 / G).sqrt();
    for (contact, dt) in EVENT_DRIVEN.into_iter().flat_map(|contact| [(contact, 0.01), (contact, 0.001)]) {
        let mut simulation = simulation(cut(contact, dt), bouncing(0.8));
        floor(&mut simulation);
        ball(0.1, 1.0).at(0.0, 1.1).spawn(&mut simulation, "ball");
        let times = touch_times(&mut simulation, 5.0);
        // t_n = t₁ (1 + 2 Σ εᵏ): exact up to the round-off of heights near 1 m, divided by speeds that fall by 0.8 each time.
        let (mut expected, mut flight) = (first, 2.0 * first);
        for time in times.iter().take(30) {
            assert_near(*time, expected, 1e-9);
            flight *= 0.8;
            expected += flight;
        }
        // Zeno's time, t₁ (1 + ε)/(1 − ε) = 4.06371276887 s, ends in rest.
        assert!(times.len() > 60, "{} impacts", times.len());
        assert_near(*times.last().unwrap(), 4.06371276887, 1e-9);
        assert_eq!(body(&simulation, "ball").velocity(), DVec2::ZERO, "{contact:?}");
        // It rests on the surface, up to the round-off of places near 1 m.
        assert_near(body(&simulation, "ball").position().y, 0.1, 1e-14);
        assert!(simulation.notices().steps_with_too_many_impacts().is_none());
    }
}

#[test]
fn c1_heights_follow_the_parabolas_between_impacts() {
    let mut simulation = simulation(cut(ContactModel::Impulse, 0.01), bouncing(0.8));
    floor(&mut simulation);
    ball(0.1, 1.0).at(0.0, 1.1).spawn(&mut simulation, "ball");
    let first = (2.0_f64 / G).sqrt();
    while simulation.time() < 3.5 {
        simulation.step().unwrap();
        let time = simulation.time();
        let (mut start, mut speed) = (first, 0.8 * G * first);
        while start + 2.0 * speed / G < time {
            start += 2.0 * speed / G;
            speed *= 0.8;
        }
        if time > first {
            let since = time - start;
            let height = speed * since - 0.5 * G * since * since;
            assert_near(body(&simulation, "ball").position().y - 0.1, height, 1e-9);
        }
    }
}

#[test]
fn c2_siconos_ball_arrives_and_rests_at_its_times() {
    for contact in EVENT_DRIVEN {
        let mut simulation = simulation(cut(contact, 0.005), bouncing(0.9));
        floor(&mut simulation);
        ball(0.1, 1.0).at(0.0, 1.0).spawn(&mut simulation, "ball");
        let times = touch_times(&mut simulation, 10.0);
        assert_near(times[0], 0.428352936878, 1e-9);
        assert_near(*times.last().unwrap(), 8.13870580068, 1e-9);
        assert_eq!(body(&simulation, "ball").velocity(), DVec2::ZERO);
    }
}

#[test]
fn without_cuts_symplectic_euler_is_half_a_step_early() {
    // x_n = x₀ − ½ g n (n + 1) h² is the fall of time t_n + ½ h: the floor is met half a step early, to first order.
    for h in [1e-2, 1e-3, 1e-4] {
        let mut simulation = simulation(every(h), bouncing(0.5));
        let start = 1.0;
        ball(0.1, 1.0).at(0.0, 1.1).spawn(&mut simulation, "ball");
        let mut before = start;
        let crossing = loop {
            simulation.step().unwrap();
            let height = body(&simulation, "ball").position().y - 0.1;
            if height <= 0.0 {
                // The step's straight way crosses the floor here.
                break simulation.time() - h * height / (height - before);
            }
            before = height;
        };
        let early = (2.0 * start / G).sqrt() - crossing;
        // The straight way within a step is off by up to g h²/8, at 4.4 m/s: h²/4; the rest is of second order too.
        assert_near(early, 0.5 * h, h * h);
    }
}

#[test]
fn an_elastic_ball_keeps_its_energy_for_a_minute() {
    for contact in EVENT_DRIVEN {
        let mut simulation = simulation(cut(contact, 0.01), bouncing(1.0));
        floor(&mut simulation);
        ball(0.1, 1.0).at(0.0, 1.1).spawn(&mut simulation, "ball");
        simulation.run_for(60.0).unwrap();
        let ball = body(&simulation, "ball");
        let energy = 0.5 * ball.velocity().length_squared() + G * (ball.position().y - 0.1);
        // 66 bounces with an energy of 9.81 J: round-off.
        assert_near(energy, G, 1e-11);
    }
}

#[test]
fn a_box_dropped_flat_lands_on_both_corners_at_once() {
    for contact in EVENT_DRIVEN {
        let mut simulation = simulation(cut(contact, 0.01), bouncing(0.5));
        floor(&mut simulation);
        block(1.0, 1.0, 2.0).at(0.0, 1.5).spawn(&mut simulation, "box");
        let times = touch_times(&mut simulation, 0.45);
        assert!(times.is_empty());
        let times = touch_times(&mut simulation, 0.46);
        assert_near(times[0], (2.0_f64 / G).sqrt(), 1e-12);
        if contact == ContactModel::VelocityLcp {
            // Both at once: straight up again.
            assert_near(body(&simulation, "box").angular_velocity(), 0.0, 1e-12);
        }
    }
}

#[test]
fn a_plastic_rod_lands_end_after_end_and_rests() {
    for contact in EVENT_DRIVEN {
        let mut simulation =
            simulation(cut(contact, 0.01), Surface { static_friction: 0.5, kinetic_friction: 0.5, restitution: 0.0 });
        floor(&mut simulation);
        rod(2.0, 1.0).at(0.0, 1.0).turned(0.3).spawn(&mut simulation, "rod");
        simulation.run_for(3.0).unwrap();
        let rod = body(&simulation, "rod");
        // An end that a turning rod lifts goes on touching up to a hundredth of the slop.
        assert_near(rod.position().y, 0.0, 5e-5);
        assert_near(rod.angle(), 0.0, 5e-5);
        assert_vector_near(rod.velocity(), DVec2::ZERO, 1e-9);
    }
}

#[test]
fn c4_cradle_of_separate_balls_passes_the_speed_on_at_its_times() {
    let mut simulation = simulation(Settings { time_of_impact: true, ..weightless(0.05) }, bouncing(1.0));
    let gap = 0.01;
    for k in 0..5 {
        let speed = if k == 0 { 1.0 } else { 0.0 };
        ball(0.1, 1.0)
            .at((0.2 + gap) * f64::from(k), 0.0)
            .moving(speed, 0.0)
            .spawn(&mut simulation, &format!("ball-{k}"));
    }
    let times = touch_times(&mut simulation, 0.2);
    assert_eq!(times.len(), 4);
    for (k, time) in times.iter().enumerate() {
        assert_near(*time, gap * (k + 1) as f64, 1e-13);
    }
    assert_vector_near(body(&simulation, "ball-4").velocity(), dvec2(1.0, 0.0), 1e-12);
    // It has run on since it was struck.
    assert_near(body(&simulation, "ball-4").position().x, 4.0 * (0.2 + gap) + 0.2 - 4.0 * gap, 1e-12);
}

#[test]
fn a_fast_ball_between_walls_bounces_many_times_in_a_step() {
    // 100 m/s across 1 m: five bounces in each step of 0.05 s.
    let mut simulation =
        simulation(Settings { time_of_impact: true, speculative_limit: Some(10.0), ..weightless(0.05) }, bouncing(1.0));
    support::wall(&mut simulation, "left", DVec2::X);
    let right = simulation.spawn((
        bevy_ecs::name::Name::new("right"),
        tumble_sim::Position(dvec2(1.2, 0.0)),
        tumble_sim::BodyKind::Static,
    ));
    let face = tumble_shape::HalfPlane::try_new(DVec2::NEG_X, 0.0).unwrap();
    simulation.attach(right, tumble_sim::Part::new(face, tumble_sim::Amount::Density(0.0)));
    ball(0.1, 1.0).at(0.1, 0.0).moving(100.0, 0.0).spawn(&mut simulation, "ball");
    let times = touch_times(&mut simulation, 1.0);
    // One touch every 0.01 s, from 0.01 s on, after the one that it starts with.
    assert_eq!(times.iter().filter(|time| **time > 0.0).count(), 100);
    for (n, time) in times.iter().filter(|time| **time > 0.0).enumerate() {
        assert_near(*time, 0.01 * (n + 1) as f64, 1e-12);
    }
    assert_near(kinetic_energy(&simulation), 5000.0, 1e-9);
}

#[test]
fn the_ledger_closes_in_steps_that_are_cut() {
    for contact in EVENT_DRIVEN {
        let mut simulation =
            simulation(cut(contact, 0.01), Surface { static_friction: 0.4, kinetic_friction: 0.3, restitution: 0.6 });
        simulation.keep_ledger();
        floor(&mut simulation);
        block(1.0, 0.5, 2.0).at(0.0, 1.5).turned(0.4).moving(2.0, 0.0).spawn(&mut simulation, "box");
        let mut worst = 0.0_f64;
        for _ in 0..300 {
            simulation.step().unwrap();
            worst = worst.max(simulation.world().resource::<tumble_sim::Ledger>().error.abs());
        }
        // Round-off of energies of some 30 J, over the parts of a step.
        assert!(worst < 1e-10, "{contact:?}: {worst:e}");
    }
}
