//! Rest and its forces: cases of section E that impulses claim.

mod support;

use glam::dvec2;
use support::{G, assert_near, assert_vector_near, block, body, direction, every, floor, rod, rough, simulation};
use support::{contact_force, wall};
use tumble_math::trig;
use tumble_sim::{ContactModel, Settings, Simulation};
use tumble_solver::Surface;

#[test]
fn e4_each_interface_of_a_stack_carries_what_is_above_it() {
    for (contact, dt, within) in [
        // Impulses of a step over Δt: the filter's tolerance 1e-12 m/s times five masses over Δt, and a few sweeps' worth of it.
        (ContactModel::Impulse, 0.01, 1e-7),
        // Springs and dampers come to rest within tenfold per second: 1.5e-8 N are left after 10 s.
        (ContactModel::Penalty, 0.001, 1e-6),
    ] {
        let mut simulation = simulation(Settings { contact, ..every(dt) }, rough(0.5, 0.4));
        floor(&mut simulation);
        for k in 0..5 {
            block(1.0, 0.5, 2.0).at(0.0, 0.25 + 0.5 * f64::from(k)).spawn(&mut simulation, &format!("box-{k}"));
        }
        simulation.run_for(10.0).unwrap();
        for k in 0..5 {
            let below = if k == 0 { "floor".to_owned() } else { format!("box-{}", k - 1) };
            let force = contact_force(&mut simulation, &below, &format!("box-{k}"));
            assert_vector_near(force, dvec2(0.0, f64::from(5 - k) * 2.0 * G), within);
        }
    }
}

#[test]
fn e4_known_limit_penalty_stack_sinks_and_falls_in_on_itself_at_a_large_step() {
    // The default stiffness fits Δt: at 0.001 s the top of five half-metre boxes sinks by 7 cm. At 0.01 s springs are a hundred times
    // softer, 7 m in all: the boxes sink into each other until nothing pushes them apart.
    for (dt, height) in [(0.001, 2.1785), (0.01, 0.2774)] {
        let mut simulation = simulation(Settings { contact: ContactModel::Penalty, ..every(dt) }, rough(0.5, 0.4));
        floor(&mut simulation);
        for k in 0..5 {
            block(1.0, 0.5, 2.0).at(0.0, 0.25 + 0.5 * f64::from(k)).spawn(&mut simulation, &format!("box-{k}"));
        }
        simulation.run_for(10.0).unwrap();
        // The figures measured, to their last digit.
        assert_near(body(&simulation, "box-4").position().y, height, 1e-4);
    }
}

/// A ladder of length 2 and 10 kg against a smooth wall.
fn ladder(settings: Settings, friction: f64, degrees: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    let smooth = simulation.materials_mut().set("smooth", Surface::default());
    let standard = simulation.materials_mut().find("default").unwrap();
    simulation.materials_mut().set_pair(smooth, standard, Surface::default());
    floor(&mut simulation);
    let smooth_wall = wall(&mut simulation, "wall", dvec2(1.0, 0.0));
    let part = simulation.world().get::<tumble_sim::Parts>(smooth_wall).unwrap();
    let part = bevy_ecs::relationship::RelationshipTarget::iter(part).next().unwrap();
    let changed =
        simulation.world().get::<tumble_sim::Part<tumble_math::Planar>>(part).unwrap().clone().material(smooth);
    simulation.world_mut().entity_mut(part).insert(changed);
    let up = direction(std::f64::consts::PI - degrees.to_radians());
    let angle = std::f64::consts::PI - degrees.to_radians();
    rod(2.0, 10.0).at(-up.x, up.y).turned(angle).spawn(&mut simulation, "ladder");
    simulation
}

#[test]
fn e5_ladder_leans_on_a_smooth_wall() {
    let mut simulation = ladder(every(0.01), 0.4, 60.0);
    simulation.run_for(5.0).unwrap();
    // The filter's tolerance of 1e-12 m/s times m/Δt, and round-off.
    assert_vector_near(contact_force(&mut simulation, "wall", "ladder"), dvec2(28.3190307038, 0.0), 1e-8);
    assert_vector_near(contact_force(&mut simulation, "floor", "ladder"), dvec2(-28.3190307038, 98.1), 1e-8);
    assert_near(body(&simulation, "ladder").velocity().length(), 0.0, 1e-10);
}

#[test]
fn e5_ladder_holds_from_half_the_cotangent_on() {
    for (friction, holds) in [(0.288675134595 * 1.001, true), (0.288675134595 * 0.999, false)] {
        let mut simulation = ladder(every(0.01), friction, 60.0);
        let start = body(&simulation, "ladder").position();
        simulation.run_for(5.0).unwrap();
        let moved = (body(&simulation, "ladder").position() - start).length();
        // Below, a thousandth of the friction is missing: 0.03 N on 10 kg grow to centimetres, and faster, in 5 s.
        assert_eq!(moved < 1e-6, holds, "μ = {friction}: moved {moved}");
    }
}

#[test]
fn e6_frictionless_ladder_leaves_the_wall_at_two_thirds_of_its_height() {
    let mut simulation = ladder(every(1e-3), 0.0, 70.0);
    let mut last = None;
    while simulation.time() < 0.65 {
        simulation.step().unwrap();
        // Leaving is smooth: the force has fallen to 1 N within 5 ms of its end.
        if contact_force(&mut simulation, "wall", "ladder").x > 1e-3 {
            let ladder = body(&simulation, "ladder");
            last = Some((simulation.time(), std::f64::consts::PI - ladder.angle(), ladder.angular_velocity()));
        }
    }
    let (time, angle, spin) = last.unwrap();
    // 5e-3 relative at h = 1e-3, as the case says.
    assert_near(time, 0.597527805947, 5e-3 * 0.6);
    assert_near(angle, 38.7895564164_f64.to_radians(), 5e-3 * 0.677);
    assert_near(spin, 2.14690295658, 5e-3 * 2.147);
    assert_near(trig::sin(angle), 2.0 / 3.0 * trig::sin(70.0_f64.to_radians()), 5e-3);
}
