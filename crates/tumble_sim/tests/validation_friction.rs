//! Coulomb friction: section D of the validation cases in the plane.

mod support;

use glam::{DVec2, dvec2};
use support::{
    G, assert_near, assert_vector_near, ball, block, body, direction, every, floor, incline, rough, simulation,
};
use support::{contact_force, momentum, weightless};
use tumble_math::{Planar, trig};
use tumble_sim::{
    AppliedForce, Axes, BodyKind, ContactModel, Course, Integrator, LinearVelocity, Settings, Simulation, Spring,
};
use tumble_solver::Surface;

/// A block half as high as wide on an incline, at rest [1 kg].
fn block_on_incline(settings: Settings, surface: Surface, degrees: f64, width: f64, height: f64) -> Simulation {
    let angle = degrees.to_radians();
    let mut simulation = simulation(settings, surface);
    incline(&mut simulation, angle);
    let start = direction(angle).perp() * 0.5 * height;
    block(width, height, 1.0).at(start.x, start.y).turned(angle).spawn(&mut simulation, "block");
    simulation
}

/// How far down the slope the block has come, and how fast it is going.
fn down_slope(simulation: &Simulation, degrees: f64) -> (f64, f64) {
    let along = direction(degrees.to_radians());
    let block = body(simulation, "block");
    (-block.position().dot(along), -block.velocity().dot(along))
}

#[test]
fn d1_block_below_the_angle_of_repose_does_not_creep() {
    for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
        let settings = Settings { integrator, ..every(0.01) };
        let mut simulation = block_on_incline(settings, rough(0.6, 0.3), 30.0, 0.5, 0.25);
        simulation.run_for(10.0).unwrap();
        let (way, speed) = down_slope(&simulation, 30.0);
        // The case allows 1e-6 m in 10 s; round-off is all there is.
        assert_near(way, 0.0, 1e-12);
        assert_near(speed, 0.0, 1e-12);
        let force = contact_force(&mut simulation, "floor", "block");
        assert_vector_near(force, dvec2(0.0, G), 1e-9);
    }
}

#[test]
fn d1_angle_of_repose_is_sharp() {
    for (friction, repose) in [(0.3, 16.699244234), (0.6, 30.9637565321)] {
        for (degrees, holds) in [(repose - 0.01, true), (repose + 0.01, false)] {
            let mut simulation = block_on_incline(every(0.01), rough(friction, friction), degrees, 0.5, 0.125);
            simulation.run_for(5.0).unwrap();
            let (way, _) = down_slope(&simulation, degrees);
            // Above: a = g (sin θ − μ cos θ) = g sin 0.01° / cos(repose) ≥ 1.7e-3 m/s², 2 cm in 5 s.
            assert_eq!(way < 1e-9, holds, "μ = {friction}, {degrees}°: {way} m");
        }
    }
}

#[test]
fn d1_block_above_the_angle_of_repose_slides_with_the_kinetic_coefficient() {
    for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
        let settings = Settings { integrator, ..every(0.01) };
        let mut simulation = block_on_incline(settings, rough(0.3, 0.3), 30.0, 0.5, 0.125);
        simulation.run_for(2.0).unwrap();
        let (way, speed) = down_slope(&simulation, 30.0);
        let a = 2.35628723666;
        // Friction of the filter is exact at each step: round-off, and the eleven digits of a.
        assert_near(speed, 2.0 * a, 1e-9);
        let ahead = if integrator == Integrator::SymplecticEuler { 0.5 * 0.01 * 2.0 * a } else { 0.0 };
        // Ballistic takes its first step from rest with the mean of the filtered velocities: exact as well.
        assert_near(way, 2.0 * a + ahead, 1e-9);
    }
}

#[test]
fn d1_known_limit_penalty_creeps_below_the_angle_of_repose() {
    let settings = Settings { contact: ContactModel::Penalty, ..every(1e-3) };
    let mut simulation = block_on_incline(settings, rough(0.6, 0.6), 30.0, 0.5, 0.125);
    simulation.run_for(5.0).unwrap();
    let (_, speed) = down_slope(&simulation, 30.0);
    // Regularised friction balances tan 30° = μ_s s(2 − s) at s = 1 − √(1 − tan 30°/0.6) of the slip speed 0.01 m/s: 8.06 mm/s. The
    // load sits on one corner more than on the other, both in the same ratio.
    let expected = 0.01 * (1.0 - (1.0 - trig::tan(30.0_f64.to_radians()) / 0.6).sqrt());
    assert_near(speed, expected, 1e-6);
}

#[test]
fn d2_block_holds_or_slides_for_every_coefficient() {
    for tenth in 1..=10 {
        let friction = 0.1 * f64::from(tenth);
        let repose = trig::atan(friction).to_degrees();
        for (degrees, holds) in [(repose - 1.0, true), (repose + 1.0, false)] {
            // A third as high as wide: it does not tip below μ = 3.
            let mut simulation = block_on_incline(every(0.01), rough(friction, friction), degrees, 0.6, 0.2);
            simulation.run_for(2.0).unwrap();
            let (way, _) = down_slope(&simulation, degrees);
            // a ≥ g sin 1° cos(repose)⁻¹… at least 0.17 m/s²: 0.34 m in 2 s.
            assert_eq!(way < 1e-9, holds, "μ = {friction}, {degrees}°: {way} m");
            assert!(holds || way > 0.3);
        }
    }
}

/// The lecture's quiz: 2 kg, μ_s = 0.6, μ_k = 0.4, pushed by F = 2t at the height of its centre.
fn quiz(settings: Settings) -> Simulation {
    let mut simulation = simulation(settings, rough(0.6, 0.4));
    floor(&mut simulation);
    let block = block(1.0, 0.25, 2.0).at(0.0, 0.125).spawn(&mut simulation, "block");
    simulation.spawn(AppliedForce::<Planar> {
        body: block,
        point: DVec2::ZERO,
        force: dvec2(2.0, 0.0),
        torque: 0.0,
        axes: Axes::World,
        course: Course::lines([(0.0, 0.0), (100.0, 100.0)]),
    });
    simulation
}

#[test]
fn d3_quiz_friction_is_a_ramp_a_drop_and_a_plateau() {
    for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
        let h = 0.01;
        let mut simulation = quiz(Settings { integrator, ..every(h) });
        let mut broke_away = None;
        while simulation.time() < 9.995 {
            simulation.step().unwrap();
            let friction = -contact_force(&mut simulation, "floor", "block").x;
            let time = simulation.time();
            // Symplectic Euler reads the push at the end of the step. Ballistic adds half of its change to the reading at the start.
            let read_at = if integrator == Integrator::SymplecticEuler { time } else { time - 0.5 * h };
            match broke_away {
                None if simulation.clock().step == 1 => {}
                // The velocity has the 1e-12 of the filter's tolerance, times m/Δt.
                None if body(&simulation, "block").velocity().x < 1e-9 => assert_near(friction, 2.0 * read_at, 1e-9),
                None => broke_away = Some(time),
                Some(_) => assert_near(friction, 7.848, 1e-9),
            }
        }
        assert_near(broke_away.unwrap(), 5.886, 2.0 * h);
        // Break-away within 2h, at a net force of 4 N on 2 kg: 2 m/s² · 2h; and h of a push of 20 N at the end.
        assert_near(body(&simulation, "block").velocity().x, 16.534166, 0.15);
        assert_near(body(&simulation, "block").position().x, 28.2083266667, 0.5);
    }
}

#[test]
fn d3_quiz_converges_to_the_closed_form() {
    let errors = [1e-2, 1e-3].map(|h| {
        let mut simulation = quiz(every(h));
        simulation.run_for(10.0).unwrap();
        let block = body(&simulation, "block");
        [(block.velocity().x - 16.534166).abs(), (block.position().x - 28.2083266667).abs()]
    });
    // First order: a tenth of the step, about a tenth of the error; the break-away falls anywhere within its step.
    assert!(errors[1][0] < 0.015 && errors[1][1] < 0.05);
}

#[test]
fn d4_sliding_block_stops_where_it_should() {
    let mut simulation = simulation(every(0.01), rough(0.3, 0.3));
    floor(&mut simulation);
    block(1.0, 0.25, 1.0).at(0.0, 0.125).moving(3.0, 0.0).spawn(&mut simulation, "block");
    for step in 1..=200 {
        simulation.step().unwrap();
        let speed = body(&simulation, "block").velocity().x;
        if step <= 101 {
            assert_near(speed, 3.0 - 0.3 * G * 0.01 * f64::from(step), 1e-11);
        } else {
            assert_near(speed, 0.0, 1e-12);
        }
    }
    // The recurrence's own value; seven digits are given, Σ over 101 steps of h (v0 − μ g h n).
    let expected = 0.01 * (3.0 * 101.0 - 0.3 * G * 0.01 * 101.0 * 102.0 / 2.0);
    assert_near(expected, 1.5140607, 5e-8);
    assert_near(body(&simulation, "block").position().x, expected, 1e-11);
}

#[test]
fn d4_stopping_distance_under_the_ballistic_integrator_and_penalty() {
    for (settings, within) in [
        // Exact under the constant friction but for the last step, in which the mean of v and 0 is taken: below v h/2 of the last step.
        (Settings { integrator: Integrator::Ballistic, ..every(0.01) }, 0.5 * 0.3 * G * 0.01 * 0.01),
        // Below the slip speed of 0.01 m/s regularised friction creeps to a stop.
        (Settings { contact: ContactModel::Penalty, ..every(1e-3) }, 3.0 * 1e-3),
    ] {
        let mut simulation = simulation(settings, rough(0.3, 0.3));
        floor(&mut simulation);
        block(1.0, 0.25, 1.0).at(0.0, 0.125).moving(3.0, 0.0).spawn(&mut simulation, "block");
        simulation.run_for(2.0).unwrap();
        assert_near(body(&simulation, "block").position().x, 1.52905198777, within);
    }
}

/// A block thrown uphill at 4 m/s on 25°.
fn thrown_uphill(settings: Settings, surface: Surface) -> Simulation {
    let mut simulation = block_on_incline(settings, surface, 25.0, 0.5, 0.125);
    let block = simulation.entity("block").unwrap();
    simulation.world_mut().entity_mut(block).insert(LinearVelocity(4.0 * direction(25.0_f64.to_radians())));
    simulation
}

#[test]
fn d5_block_thrown_uphill_stops_and_stays_with_two_coefficients() {
    for (integrator, within) in [(Integrator::SymplecticEuler, 2e-3), (Integrator::Ballistic, 1e-3)] {
        let settings = Settings { integrator, ..every(1e-3) };
        let mut simulation = thrown_uphill(settings, rough(0.55, 0.35));
        simulation.run_for(0.5).unwrap();
        // 0.5 s of 7.25769293447 m/s²; round-off, and twelve digits.
        assert_near(-down_slope(&simulation, 25.0).1, 4.0 - 0.5 * 7.25769293447, 1e-10);
        simulation.run_for(5.0).unwrap();
        let (way, speed) = down_slope(&simulation, 25.0);
        assert_near(-way, 1.10227865414, within);
        assert_near(speed, 0.0, 1e-12);
    }
}

#[test]
fn d5_block_thrown_uphill_slides_back_with_one_coefficient() {
    let mut simulation = thrown_uphill(every(1e-3), rough(0.35, 0.35));
    simulation.run_for(0.551).unwrap();
    let (start, _) = down_slope(&simulation, 25.0);
    simulation.run_for(1.0).unwrap();
    let (end, speed) = down_slope(&simulation, 25.0);
    // One second of 1.03407736089 m/s² from rest, which began within a step.
    assert_near(speed, 1.03407736089, 1.03407736089 * 2e-3);
    assert_near(end - start, 0.5 * 1.03407736089, 2e-3);
}

/// c = I/(m R²) of sphere, disc, shell and hoop.
const ROLLING: [f64; 4] = [0.4, 0.5, 2.0 / 3.0, 1.0];

#[test]
fn d6_slip_becomes_roll() {
    for c in ROLLING {
        let mut simulation = simulation(every(1e-3), rough(0.2, 0.2));
        floor(&mut simulation);
        ball(0.25, 2.0).inertia(c * 2.0 * 0.0625).at(0.0, 0.25).moving(5.0, 0.0).spawn(&mut simulation, "ball");
        let time = 5.0 / (0.2 * G * (1.0 + 1.0 / c));
        let way = 5.0 * time - 0.1 * G * time * time;
        let speed = 5.0 / (1.0 + c);
        let mut rolls_from = None;
        while simulation.time() < 2.0 {
            simulation.step().unwrap();
            let ball = body(&simulation, "ball");
            let slip = ball.velocity().x + 0.25 * ball.angular_velocity();
            if slip.abs() < 1e-9 && rolls_from.is_none() {
                rolls_from = Some((simulation.time(), ball.position().x));
            }
        }
        let (found_time, found_way) = rolls_from.unwrap();
        // Rolling begins within a step; ways are g h t/2-like off: 1e-3 relative, as the case says.
        assert_near(found_time, time, 1e-3 + 1e-9);
        assert_near(found_way, way + speed * (found_time - time), 1e-3 * way);
        // The rolling speed follows from angular momentum about the contact alone: round-off.
        assert_near(body(&simulation, "ball").velocity().x, speed, 1e-10);
    }
}

#[test]
fn d7_wheel_rolls_or_slips_down_the_slope() {
    let angle = 30.0_f64.to_radians();
    for c in ROLLING {
        let critical = trig::tan(angle) / (1.0 + 1.0 / c);
        for friction in [critical * 1.001, critical * 0.999, 0.5 * critical] {
            let mut simulation = simulation(every(1e-3), rough(friction, friction));
            incline(&mut simulation, angle);
            let start = 0.25 * direction(angle).perp();
            ball(0.25, 2.0).inertia(c * 2.0 * 0.0625).at(start.x, start.y).spawn(&mut simulation, "ball");
            simulation.run_for(1.0).unwrap();
            let ball = body(&simulation, "ball");
            let speed = -ball.velocity().dot(direction(angle));
            let (expected, spin) = if friction > critical {
                let a = G * trig::sin(angle) / (1.0 + c);
                (a, a / 0.25)
            } else {
                (G * (trig::sin(angle) - friction * trig::cos(angle)), friction * G * trig::cos(angle) / (c * 0.25))
            };
            // Constant accelerations: round-off of 1000 steps of the filter.
            assert_near(speed, expected, 1e-9);
            assert_near(ball.angular_velocity(), spin, 1e-8);
        }
    }
}

#[test]
fn d10_stick_slip_on_a_belt() {
    let h = 1e-3;
    let mut simulation = simulation(every(h), rough(0.5, 0.3));
    let belt = block(20.0, 0.5, 1.0).at(0.0, -0.25).moving(0.1, 0.0).kind(BodyKind::Kinematic);
    belt.spawn(&mut simulation, "belt");
    let block = block(0.5, 0.125, 1.0).at(0.0, 0.0625).moving(0.1, 0.0).spawn(&mut simulation, "block");
    let wall = dvec2(-50.0, 0.0625);
    simulation.spawn(Spring {
        a: tumble_sim::Anchor::World(wall),
        b: tumble_sim::Anchor::Body(block, DVec2::ZERO),
        stiffness: 100.0,
        damping: 0.0,
        rest_length: 50.0,
    });
    let (mut slips, mut sticks, mut slipping) = (Vec::new(), Vec::new(), false);
    while simulation.time() < 5.0 {
        simulation.step().unwrap();
        let block = body(&simulation, "block");
        let slip = (block.velocity().x - 0.1).abs() > 1e-6;
        if slip != slipping {
            if slip { &mut slips } else { &mut sticks }.push((simulation.time(), block.position().x));
        }
        slipping = slip;
    }
    for (slip, stick) in slips.iter().zip(&sticks) {
        // One per cent at h = 1e-3, and a belt's travel within a step.
        assert_near(slip.1, 0.04905, 0.01 * 0.04905);
        assert_near(stick.1, 0.00981, 0.01 * 0.04905);
        assert_near(stick.0 - slip.0, 0.40843221712, 0.01 * 0.4084);
    }
    for pair in slips.windows(2) {
        assert_near(pair[1].0 - pair[0].0, 0.80083221712, 0.01 * 0.8008);
    }
    assert!(slips.len() >= 5);
}

#[test]
fn d12_box_slides_or_tips_whichever_comes_first() {
    // Width over height 0.5: tips at 26.565° unless it slides before.
    for (friction, first) in [(0.4, "slides"), (0.6, "tips")] {
        let limit = trig::atan(if first == "slides" { friction } else { 0.5 }).to_degrees();
        for (degrees, happens) in [(limit - 0.05, false), (limit + 0.05, true)] {
            let mut simulation = block_on_incline(every(0.01), rough(friction, friction), degrees, 0.5, 1.0);
            simulation.run_for(5.0).unwrap();
            let turned = (body(&simulation, "block").angle() - degrees.to_radians()).abs();
            let (way, _) = down_slope(&simulation, degrees);
            assert_eq!(turned > 1e-6, happens && first == "tips", "μ {friction}, {degrees}°: turned by {turned}");
            assert_eq!(way > 1e-6, happens, "μ {friction}, {degrees}°: moved by {way}");
        }
    }
}

#[test]
fn d13_work_of_friction_is_force_times_slip() {
    let h = 0.01;
    let mut simulation = simulation(every(h), rough(0.4, 0.4));
    floor(&mut simulation);
    block(1.0, 0.25, 3.0).at(0.0, 0.125).moving(4.0, 0.0).spawn(&mut simulation, "block");
    let mut work = 0.0;
    for _ in 0..90 {
        let before = body(&simulation, "block").velocity().x;
        simulation.step().unwrap();
        let force = contact_force(&mut simulation, "floor", "block");
        assert_near(force.x, -0.4 * force.y, 1e-9);
        // The work of an impulse is its product with the mean of the velocities before and after.
        work += force.x * h * 0.5 * (before + body(&simulation, "block").velocity().x);
    }
    let lost = 24.0 - body(&simulation, "block").kinetic_energy();
    // Round-off of 90 steps of 24 J.
    assert_near(work, -lost, 1e-11);
}

/// Two discs in flight that graze each other after a gap along the line of their centres.
fn grazing(dt: f64, gap: f64) -> Simulation {
    let surface = Surface { static_friction: 0.5, kinetic_friction: 0.3, restitution: 0.4 };
    let mut simulation = simulation(weightless(dt), surface);
    let centre = dvec2(0.6, 0.8) * (1.0 + gap);
    ball(0.5, 1.0).moving(3.0, 0.5).spinning(5.0).spawn(&mut simulation, "one");
    ball(0.5, 2.0).at(centre.x, centre.y).moving(-1.0, 0.0).spinning(-2.0).spawn(&mut simulation, "other");
    simulation
}

/// Momentum and angular momentum of the two discs at the start.
const BEFORE_GRAZING: (DVec2, f64) = (dvec2(1.0, 0.5), 1.6 + 0.125 * 5.0 - 0.25 * 2.0);

#[test]
fn d13_friction_between_two_free_bodies_keeps_momentum_and_angular_momentum() {
    let mut simulation = grazing(1e-6, 0.0);
    simulation.step().unwrap();
    assert!((body(&simulation, "one").velocity() - dvec2(3.0, 0.5)).length() > 0.1, "they met");
    // Round-off.
    assert_vector_near(momentum(&simulation), BEFORE_GRAZING.0, 1e-12);
    assert_near(support::angular_momentum(&simulation), BEFORE_GRAZING.1, 1e-12);
}

#[test]
fn d13_known_limit_setting_down_within_a_step_moves_angular_momentum_to_first_order() {
    let errors = [1e-3, 5e-4, 2.5e-4].map(|h| {
        // The discs approach at 2.8 m/s along the normal: half a step of overshoot for every h.
        let mut simulation = grazing(h, 2.8 * 2.5 * h);
        for _ in 0..5 {
            simulation.step().unwrap();
        }
        assert_vector_near(momentum(&simulation), BEFORE_GRAZING.0, 1e-12);
        let start = BEFORE_GRAZING.1 + 1.6 * 2.8 * 2.5 * h;
        (support::angular_momentum(&simulation) - start).abs()
    });
    // Bodies are pushed back onto each other's surface along the normal while they also pass each other: Δx × m v.
    assert_near(errors[0] / errors[1], 2.0, 0.2);
    assert_near(errors[1] / errors[2], 2.0, 0.2);
    // Reduced mass 2/3 kg, half a step of 2.8 m/s, slip of 3.2 m/s.
    assert!(errors[0] < 2.0 / 3.0 * 0.5 * 2.8e-3 * 3.5);
}
