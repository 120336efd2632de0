//! Coulomb friction on blocks: section D of the validation cases, under every model that keeps contacts rigid.

use crate::support::{
    G, assert_near, assert_vector_near, block, body, contact_force, direction, every, floor, incline, rigid, rough,
    simulation, under,
};
use glam::{DVec2, dvec2};
use tumble_math::{Planar, trig};
use tumble_sim::{
    AppliedForce, Axes, BodyKind, ContactModel, Course, Integrator, LinearVelocity, Settings, Simulation, Spring,
};
use tumble_solver::Surface;

/// The same with each integrator.
fn both_integrators(settings: Settings) -> [Settings; 2] {
    [
        Settings { integrator: Integrator::SymplecticEuler, ..settings },
        Settings { integrator: Integrator::Ballistic, ..settings },
    ]
}

/// Settings under each model that keeps contacts rigid, with each integrator.
fn rigid_with_both_integrators(dt: f64) -> impl Iterator<Item = Settings> {
    rigid(every(dt)).flat_map(both_integrators)
}

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
    for settings in rigid_with_both_integrators(0.01) {
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
    for settings in rigid(every(0.01)) {
        for (friction, repose) in [(0.3, 16.699244234), (0.6, 30.9637565321)] {
            for (degrees, holds) in [(repose - 0.01, true), (repose + 0.01, false)] {
                let mut simulation = block_on_incline(settings, rough(friction, friction), degrees, 0.5, 0.125);
                simulation.run_for(5.0).unwrap();
                let (way, _) = down_slope(&simulation, degrees);
                // Above: a = g (sin θ − μ cos θ) = g sin 0.01° / cos(repose) ≥ 1.7e-3 m/s², 2 cm in 5 s.
                assert_eq!(way < 1e-9, holds, "μ = {friction}, {degrees}°: {way} m");
            }
        }
    }
}

#[test]
fn d1_block_above_the_angle_of_repose_slides_with_the_kinetic_coefficient() {
    for settings in rigid_with_both_integrators(0.01) {
        let mut simulation = block_on_incline(settings, rough(0.3, 0.3), 30.0, 0.5, 0.125);
        simulation.run_for(2.0).unwrap();
        let (way, speed) = down_slope(&simulation, 30.0);
        let a = 2.35628723666;
        // Friction of the filter is exact at each step: round-off, and the eleven digits of a.
        assert_near(speed, 2.0 * a, 1e-9);
        let ahead = if settings.integrator == Integrator::SymplecticEuler { 0.5 * 0.01 * 2.0 * a } else { 0.0 };
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
    for settings in rigid(every(0.01)) {
        for tenth in 1..=10 {
            let friction = 0.1 * f64::from(tenth);
            let repose = trig::atan(friction).to_degrees();
            for (degrees, holds) in [(repose - 1.0, true), (repose + 1.0, false)] {
                // A third as high as wide: it does not tip below μ = 3.
                let mut simulation = block_on_incline(settings, rough(friction, friction), degrees, 0.6, 0.2);
                simulation.run_for(2.0).unwrap();
                let (way, _) = down_slope(&simulation, degrees);
                // a ≥ g sin 1° cos(repose)⁻¹… at least 0.17 m/s²: 0.34 m in 2 s.
                assert_eq!(way < 1e-9, holds, "μ = {friction}, {degrees}°: {way} m");
                assert!(holds || way > 0.3);
            }
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
    let h = 0.01;
    for settings in rigid_with_both_integrators(h) {
        let mut simulation = quiz(settings);
        let mut broke_away = None;
        while simulation.time() < 9.995 {
            simulation.step().unwrap();
            let friction = -contact_force(&mut simulation, "floor", "block").x;
            let time = simulation.time();
            // Symplectic Euler reads the push at the end of the step. Ballistic reads it at the start and adds half of its change in
            // velocities, which resting forces do not see.
            let read_at = match (settings.integrator, settings.contact) {
                (Integrator::SymplecticEuler, _) => time,
                (Integrator::Ballistic, ContactModel::RestingLcp) => time - h,
                (Integrator::Ballistic, _) => time - 0.5 * h,
            };
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
    for settings in rigid(every(1e-3)) {
        let mut simulation = quiz(settings);
        simulation.run_for(10.0).unwrap();
        let block = body(&simulation, "block");
        // First order: a tenth of what the step of 0.01 s is allowed; the break-away falls anywhere within its step.
        assert_near(block.velocity().x, 16.534166, 0.015);
        assert_near(block.position().x, 28.2083266667, 0.05);
    }
}

#[test]
fn d4_sliding_block_stops_where_it_should() {
    for settings in rigid(every(0.01)) {
        let mut simulation = simulation(settings, rough(0.3, 0.3));
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
}

#[test]
fn d4_stopping_distance_under_the_ballistic_integrator_and_penalty() {
    // Exact under the constant friction but for the last step, in which the mean of v and 0 is taken: below v h/2 of the last step.
    let last_step = 0.5 * 0.3 * G * 0.01 * 0.01;
    let ballistic = rigid(Settings { integrator: Integrator::Ballistic, ..every(0.01) });
    // Below the slip speed of 0.01 m/s regularised friction creeps to a stop.
    let penalty = (under(ContactModel::Penalty, every(1e-3)), 3.0 * 1e-3);
    for (settings, within) in ballistic.map(|settings| (settings, last_step)).chain([penalty]) {
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
    for settings in rigid_with_both_integrators(1e-3) {
        let within = if settings.integrator == Integrator::SymplecticEuler { 2e-3 } else { 1e-3 };
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
    for settings in rigid(every(1e-3)) {
        let mut simulation = thrown_uphill(settings, rough(0.35, 0.35));
        simulation.run_for(0.551).unwrap();
        let (start, _) = down_slope(&simulation, 25.0);
        simulation.run_for(1.0).unwrap();
        let (end, speed) = down_slope(&simulation, 25.0);
        // One second of 1.03407736089 m/s² from rest, which began within a step.
        assert_near(speed, 1.03407736089, 1.03407736089 * 2e-3);
        assert_near(end - start, 0.5 * 1.03407736089, 2e-3);
    }
}

/// Where and when a block that a spring holds on a moving belt begins to slip, and to stick again, in 5 s [s], [m].
fn slips_and_sticks(settings: Settings) -> [Vec<(f64, f64)>; 2] {
    let mut simulation = simulation(settings, rough(0.5, 0.3));
    let belt = block(20.0, 0.5, 1.0).at(0.0, -0.25).moving(0.1, 0.0).kind(BodyKind::Kinematic);
    belt.spawn(&mut simulation, "belt");
    let block = block(0.5, 0.125, 1.0).at(0.0, 0.0625).moving(0.1, 0.0).spawn(&mut simulation, "block");
    simulation.spawn(Spring {
        a: tumble_sim::Anchor::World(dvec2(-50.0, 0.0625)),
        b: tumble_sim::Anchor::Body(block, DVec2::ZERO),
        stiffness: 100.0,
        damping: 0.0,
        rest_length: 50.0,
    });
    let (mut changes, mut slipping) = ([Vec::new(), Vec::new()], false);
    while simulation.time() < 5.0 {
        simulation.step().unwrap();
        let block = body(&simulation, "block");
        let slip = (block.velocity().x - 0.1).abs() > 1e-6;
        if slip != slipping {
            changes[usize::from(!slip)].push((simulation.time(), block.position().x));
        }
        slipping = slip;
    }
    changes
}

#[test]
fn d10_stick_slip_on_a_belt() {
    for settings in rigid(every(1e-3)) {
        let [slips, sticks] = slips_and_sticks(settings);
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
}
