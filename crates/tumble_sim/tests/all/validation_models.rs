//! What the complementarity models do better than one-by-one impulses: no creep, and simultaneous impacts.

use crate::support::{
    G, assert_near, assert_vector_near, block, body, complementarity, contact_force, direction, every, floor, incline,
    kinetic_energy, rod, rough, simulation, under, weightless,
};
use glam::{DVec2, dvec2};
use tumble_sim::{ContactModel, Settings, Simulation, VelocityLcpSettings};
use tumble_solver::Surface;
use tumble_solver::velocity_lcp::Restitution;

#[test]
fn d1_sticking_means_no_drift() {
    for settings in complementarity(every(0.01)) {
        let mut simulation = simulation(settings, rough(0.6, 0.3));
        let angle = 30_f64.to_radians();
        incline(&mut simulation, angle);
        let start = direction(angle).perp() * 0.125;
        block(0.5, 0.25, 1.0).at(start.x, start.y).turned(angle).spawn(&mut simulation, "block");
        simulation.run_for(60.0).unwrap();
        // The case: below 1e-12 m per simulated minute with the pivoting solvers.
        let creep = (body(&simulation, "block").position() - start).length();
        assert!(creep < 1e-12, "{creep} m");
        assert_vector_near(contact_force(&mut simulation, "floor", "block"), dvec2(0.0, G), 1e-9);
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
