//! The complementarity models through the whole step: resting LCP (acceleration level) and velocity LCP.

mod support;

use glam::{DVec2, dvec2};
use support::{
    G, assert_near, assert_vector_near, ball, block, body, contact_force, direction, every, floor, incline,
    kinetic_energy, rod, rough, simulation, weightless,
};
use tumble_math::{Planar, trig};
use tumble_shape::Rod;
use tumble_sim::{Amount, AppliedForce, Axes, ContactModel, Course, Part, Settings, Simulation, VelocityLcpSettings};
use tumble_solver::Surface;
use tumble_solver::velocity_lcp::Restitution;

const MODELS: [ContactModel; 2] = [ContactModel::RestingLcp, ContactModel::VelocityLcp];

fn under(contact: ContactModel, settings: Settings) -> Settings {
    Settings { contact, ..settings }
}

#[test]
fn d1_sticking_means_no_drift() {
    for contact in MODELS {
        let mut simulation = simulation(under(contact, every(0.01)), rough(0.6, 0.3));
        let angle = 30_f64.to_radians();
        incline(&mut simulation, angle);
        let start = direction(angle).perp() * 0.125;
        block(0.5, 0.25, 1.0).at(start.x, start.y).turned(angle).spawn(&mut simulation, "block");
        simulation.run_for(60.0).unwrap();
        // The case: below 1e-12 m per simulated minute with the pivoting solvers.
        let creep = (body(&simulation, "block").position() - start).length();
        assert!(creep < 1e-12, "{contact:?}: {creep} m");
        assert_vector_near(contact_force(&mut simulation, "floor", "block"), dvec2(0.0, G), 1e-9);
    }
}

#[test]
fn d1_angle_of_repose_is_sharp() {
    for contact in MODELS {
        for (friction, repose) in [(0.3, 16.699244234), (0.6, 30.9637565321)] {
            for (degrees, holds) in [(repose - 0.01, true), (repose + 0.01, false)] {
                let mut simulation = simulation(under(contact, every(0.01)), rough(friction, friction));
                let angle = f64::to_radians(degrees);
                incline(&mut simulation, angle);
                let start = direction(angle).perp() * 0.0625;
                block(0.5, 0.125, 1.0).at(start.x, start.y).turned(angle).spawn(&mut simulation, "block");
                simulation.run_for(5.0).unwrap();
                // Above: g sin 0.01° / cos(repose) ≥ 1.7e-3 m/s², 2 cm in 5 s.
                let way = (body(&simulation, "block").position() - start).length();
                assert_eq!(way < 1e-9, holds, "{contact:?}, μ = {friction}, {degrees}°: {way} m");
            }
        }
    }
}

#[test]
fn d3_quiz_friction_is_a_ramp_a_drop_and_a_plateau() {
    for contact in MODELS {
        let h = 0.01;
        let mut simulation = simulation(under(contact, every(h)), rough(0.6, 0.4));
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
        let mut broke_away = None;
        while simulation.time() < 9.995 {
            simulation.step().unwrap();
            let friction = -contact_force(&mut simulation, "floor", "block").x;
            let (time, speed) = (simulation.time(), body(&simulation, "block").velocity().x);
            match broke_away {
                None if simulation.clock().step == 1 => {}
                None if speed < 1e-9 => assert_near(friction, 2.0 * time, 1e-9),
                None => broke_away = Some(time),
                Some(_) => assert_near(friction, 7.848, 1e-9),
            }
        }
        assert_near(broke_away.unwrap(), 5.886, 2.0 * h);
        assert_near(body(&simulation, "block").velocity().x, 16.534166, 0.15);
    }
}

#[test]
fn e4_stack_of_boxes_carries_what_is_above() {
    for contact in MODELS {
        let mut simulation = simulation(under(contact, every(0.01)), rough(0.5, 0.4));
        floor(&mut simulation);
        for k in 0..5 {
            block(1.0, 1.0, 2.0).at(0.0, 0.5 + f64::from(k)).spawn(&mut simulation, &format!("box-{k}"));
        }
        simulation.run_for(1.0).unwrap();
        for k in 0..5 {
            let below = if k == 0 { "floor".to_owned() } else { format!("box-{}", k - 1) };
            let force = contact_force(&mut simulation, &below, &format!("box-{k}"));
            // Newton's second law; pivoting leaves round-off of 2 kg, 10 m/s² over Δt.
            assert_vector_near(force, dvec2(0.0, f64::from(5 - k) * 2.0 * G), 1e-9);
        }
    }
}

/// A table on three legs in the plane, 10 kg, its legs equally far apart: one more than statics can tell apart.
fn table(contact: ContactModel) -> Simulation {
    let mut simulation = simulation(under(contact, every(0.01)), rough(0.5, 0.4));
    floor(&mut simulation);
    let leg = |x: f64| {
        Part::new(Rod::try_new(dvec2(x, -0.5), dvec2(x, 0.5), 0.0).expect("a leg has a length"), Amount::Mass(2.0))
    };
    let table = block(2.0, 0.1, 4.0).at(0.0, 0.5).spawn(&mut simulation, "table");
    for x in [-1.0, 0.0, 1.0] {
        simulation.attach(table, leg(x));
    }
    simulation
}

#[test]
fn e1_indeterminate_table_stands_and_its_forces_sum_right() {
    for contact in MODELS {
        let run = || {
            let mut simulation = table(contact);
            simulation.run_for(2.0).unwrap();
            let force = contact_force(&mut simulation, "floor", "table");
            (force, simulation)
        };
        let (force, simulation) = run();
        assert_vector_near(force, dvec2(0.0, 10.0 * G), 1e-9);
        assert!(kinetic_energy(&simulation) < 1e-24);
        // The same answer every time.
        let (again, _) = run();
        assert_eq!(force, again);
    }
}

/// A rod of 2 m and 1 kg that stands on its lower end at an angle.
fn rod_on_its_end(settings: Settings, surface: Surface, angle: f64, velocity: DVec2, spin: f64) -> Simulation {
    let mut simulation = simulation(settings, surface);
    floor(&mut simulation);
    let centre = direction(angle);
    let rod = rod(2.0, 1.0).at(centre.x, centre.y).turned(angle).moving(velocity.x, velocity.y).spinning(spin);
    rod.spawn(&mut simulation, "rod");
    simulation
}

#[test]
fn c12_poissons_law_takes_energy_where_newtons_creates_it() {
    for (restitution, gained, normal) in [(Restitution::Newton, 0.109375, 1.0), (Restitution::Poisson, -0.05, 0.7)] {
        let settings = Settings {
            velocity_lcp: VelocityLcpSettings { restitution, ..VelocityLcpSettings::default() },
            ..under(ContactModel::VelocityLcp, weightless(1e-9))
        };
        let surface = Surface { static_friction: 1.0, kinetic_friction: 1.0, restitution: 1.0 };
        let mut simulation = rod_on_its_end(settings, surface, 45_f64.to_radians(), dvec2(0.5, -1.0), 0.0);
        simulation.step().unwrap();
        let rod = body(&simulation, "rod");
        let end = rod.velocity() + dvec2(-1.0, -1.0).perp() * rod.angular_velocity() * 0.5_f64.sqrt();
        // Exact but for the turn in a step of 1e-9 s.
        assert_vector_near(end, dvec2(0.0, normal), 1e-8);
        assert_near(kinetic_energy(&simulation) - 0.625, gained, 1e-8);
    }
}

#[test]
fn c13_rocking_block_loses_what_housner_says() {
    for (ratio, kept) in [(2.0, 0.7), (4.0, 0.911764705882), (8.0, 0.976923076923)] {
        let (width, height) = (0.5, 0.5 * ratio);
        let surface = Surface { static_friction: 10.0, kinetic_friction: 10.0, restitution: 0.0 };
        let mut simulation = simulation(under(ContactModel::VelocityLcp, weightless(1e-9)), surface);
        floor(&mut simulation);
        // It turns about its left corner and lands flat.
        let spin = -1.0;
        let velocity = dvec2(0.5 * width, 0.5 * height).perp() * spin;
        block(width, height, 1.0)
            .at(0.0, 0.5 * height)
            .moving(velocity.x, velocity.y)
            .spinning(spin)
            .spawn(&mut simulation, "block");
        simulation.step().unwrap();
        assert_near(body(&simulation, "block").angular_velocity() / spin, kept, 1e-9);
    }
}

#[test]
fn c14_two_discs_hit_a_third_from_both_sides_at_once() {
    let surface = Surface { restitution: 1.0, ..Surface::default() };
    let mut simulation = simulation(under(ContactModel::VelocityLcp, weightless(1e-3)), surface);
    ball(0.5, 1.0).at(-1.0, 0.0).moving(1.0, 0.0).spawn(&mut simulation, "left");
    ball(0.5, 1.0).at(0.0, 0.0).spawn(&mut simulation, "middle");
    ball(0.5, 1.0).at(1.0, 0.0).moving(-1.0, 0.0).spawn(&mut simulation, "right");
    simulation.step().unwrap();
    let speed = |name| body(&simulation, name).velocity().x;
    // Symmetry: to the bit.
    assert_eq!((speed("left"), speed("middle"), speed("right")), (-1.0, 0.0, 1.0));
}

#[test]
fn c9_flat_rod_comes_back_flat() {
    let surface = Surface { restitution: 0.5, ..Surface::default() };
    let mut simulation = simulation(under(ContactModel::VelocityLcp, weightless(1e-3)), surface);
    floor(&mut simulation);
    rod(2.0, 1.0).at(0.0, 0.0).moving(0.0, -1.0).spawn(&mut simulation, "rod");
    simulation.step().unwrap();
    assert_vector_near(body(&simulation, "rod").velocity(), dvec2(0.0, 0.5), 1e-14);
    assert_near(body(&simulation, "rod").angular_velocity(), 0.0, 1e-14);
}

#[test]
fn c15_elastic_box_comes_back_to_its_height() {
    let surface = Surface { restitution: 1.0, ..Surface::default() };
    let mut simulation = simulation(under(ContactModel::VelocityLcp, every(0.005)), surface);
    floor(&mut simulation);
    block(1.0, 0.5, 1.0).at(0.0, 1.25).spawn(&mut simulation, "box");
    let mut highest: f64 = 0.0;
    for step in 0..2_000 {
        simulation.step().unwrap();
        if step > 1_600 {
            highest = highest.max(body(&simulation, "box").position().y);
        }
    }
    // After ten bounces on two corners: the drop height. Between two steps near the top lie ½ g (Δt/2)² = 3e-5 m. (Later round-off has turned
    // the box so far that its corners hit one after the other.)
    assert_near(highest, 1.25, 1e-4);
    // Round-off that every bounce makes larger.
    assert_near(body(&simulation, "box").angle(), 0.0, 1e-6);
}

/// A rod of half-length 1 m whose lower end slides at −2 m/s at the angle where least friction jams it (F2, F3).
fn painleve(spin: f64) -> Simulation {
    let angle = trig::atan2(2.0, 1.0);
    let arm = -direction(angle);
    let velocity = dvec2(-2.0, 0.0) - arm.perp() * spin;
    let mut simulation =
        rod_on_its_end(under(ContactModel::RestingLcp, every(1e-3)), rough(1.6, 1.6), angle, velocity, spin);
    simulation.step().unwrap();
    simulation
}

#[test]
fn f2_painleves_rod_is_resolved_by_an_impulse_and_reported() {
    let simulation = painleve(1.0);
    assert_eq!(simulation.notices().steps_without_solution().map(|counted| counted.first_step), Some(1));
    let rod = body(&simulation, "rod");
    let end = rod.velocity() - direction(rod.angle()).perp() * rod.angular_velocity();
    // F4: the end stops within the step, up to what it turns in it: ω² Δt.
    assert!(end.length() < 1e-2, "{end}");
}

#[test]
fn f3_where_two_outcomes_are_possible_the_smaller_force_is_taken_and_reported() {
    let mut simulation = painleve(4.0);
    assert_eq!(simulation.notices().ambiguous_steps().map(|counted| counted.first_step), Some(1));
    assert_eq!(simulation.notices().steps_without_solution(), None);
    assert_vector_near(contact_force(&mut simulation, "floor", "rod"), DVec2::ZERO, 0.0);
}
