//! Painlevé's rod: section F of the validation cases, under every model.
//!
//! A rod of half-length 1 m and 1 kg leans to the right and its lower end slides to the left: friction turns it into the floor.

use crate::support;
use crate::support::{
    assert_near, assert_vector_near, body, contact_force, direction, every, floor, rigid, rod, rough,
};
use crate::support::{simulation, under};
use glam::{DVec2, dvec2};
use tumble_math::trig;
use tumble_sim::{ContactModel, Settings, Simulation};

/// The rod at an angle, its lower end sliding at a velocity while it turns, after one step.
fn painleve(settings: Settings, friction: f64, angle: f64, slides: f64, spin: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    floor(&mut simulation);
    let centre = direction(angle);
    let velocity = dvec2(slides, 0.0) + centre.perp() * spin;
    rod(2.0, 1.0)
        .at(centre.x, centre.y)
        .turned(angle)
        .moving(velocity.x, velocity.y)
        .spinning(spin)
        .spawn(&mut simulation, "rod");
    simulation
}

/// The rod of F2 and F3: tan θ = 2, its end sliding at −2 m/s.
fn at_least_friction(settings: Settings, friction: f64, spin: f64) -> Simulation {
    painleve(settings, friction, trig::atan2(2.0, 1.0), -2.0, spin)
}

/// Velocity of the lower end [m/s].
fn end_velocity(simulation: &Simulation) -> DVec2 {
    let rod = body(simulation, "rod");
    rod.velocity() - direction(rod.angle()).perp() * rod.angular_velocity()
}

#[test]
fn f1_resting_forces_exist_below_four_thirds_of_friction_and_not_above() {
    for (friction, solvable) in [(4.0 / 3.0 * 0.999, true), (4.0 / 3.0 * 1.001, false)] {
        let mut simulation = at_least_friction(under(ContactModel::RestingLcp, every(1e-3)), friction, 1.0);
        simulation.step().unwrap();
        assert_eq!(simulation.notices().steps_without_solution().is_none(), solvable, "{friction}");
    }
}

#[test]
fn f2_f4_rod_without_resting_forces_is_resolved_by_an_impulse() {
    for settings in rigid(every(1e-3)) {
        let mut simulation = at_least_friction(settings, 1.6, 1.0);
        simulation.step().unwrap();
        // The acceleration-level model says that it has no answer; the others never ask for forces.
        let no_solution = simulation.notices().steps_without_solution().map(|counted| counted.first_step);
        assert_eq!(no_solution, (settings.contact == ContactModel::RestingLcp).then_some(1));
        // One shot, the end approaching with g Δt: printed with seven digits.
        let impulse = contact_force(&mut simulation, "floor", "rod") * settings.dt;
        assert_vector_near(impulse, dvec2(0.802943, 0.6083385), 1e-6);
        // The end stops within the step, up to what it turns in it: ω² Δt.
        assert!(end_velocity(&simulation).length() < 1e-2, "{}", end_velocity(&simulation));
    }
}

#[test]
fn f4_impulse_tends_to_the_one_without_collision_as_the_step_shrinks() {
    for contact in [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp] {
        let errors = [1e-3, 5e-4, 2.5e-4].map(|h| {
            let mut simulation = at_least_friction(under(contact, every(h)), 1.6, 1.0);
            simulation.step().unwrap();
            (contact_force(&mut simulation, "floor", "rod") * h - dvec2(0.8, 0.6)).length()
        });
        // First order: the approach is g Δt.
        assert_near(errors[0] / errors[1], 2.0, 1e-6);
        assert_near(errors[1] / errors[2], 2.0, 1e-6);
    }
}

#[test]
fn f3_where_two_outcomes_are_possible_the_smaller_force_is_taken_and_reported() {
    let mut simulation = at_least_friction(under(ContactModel::RestingLcp, every(1e-3)), 1.6, 4.0);
    simulation.step().unwrap();
    assert_eq!(simulation.notices().ambiguous_steps().map(|counted| counted.first_step), Some(1));
    assert_eq!(simulation.notices().steps_without_solution(), None);
    assert_vector_near(contact_force(&mut simulation, "floor", "rod"), DVec2::ZERO, 0.0);
}

#[test]
fn f3_known_limit_velocity_level_models_do_not_see_the_end_lift_off() {
    // Whether the end lifts off depends on ω², which is in accelerations and not in velocities: they jam the rod as in F2.
    for contact in [ContactModel::Impulse, ContactModel::VelocityLcp] {
        let mut simulation = at_least_friction(under(contact, every(1e-3)), 1.6, 4.0);
        simulation.step().unwrap();
        let impulse = contact_force(&mut simulation, "floor", "rod") * 1e-3;
        assert_vector_near(impulse, dvec2(0.802943, 0.6083385), 1e-6);
    }
}

#[test]
fn f5_inconsistent_rod_of_enormous_friction_is_stopped_in_one_step() {
    for settings in rigid(every(1e-3)) {
        // The mirror image of the other cases, with I = 1 instead of 1/3.
        let angle = 0.75 * std::f64::consts::PI;
        let mut simulation = simulation(settings, rough(1000.0, 1000.0));
        floor(&mut simulation);
        let centre = direction(angle);
        rod(2.0, 1.0).inertia(1.0).at(centre.x, centre.y).turned(angle).moving(1.0, 0.0).spawn(&mut simulation, "rod");
        simulation.step().unwrap();
        assert!(end_velocity(&simulation).length() < 1e-2, "{}", end_velocity(&simulation));
    }
}

#[test]
fn f2_penalty_springs_jam_the_rod_in_their_own_time() {
    let mut simulation = at_least_friction(under(ContactModel::Penalty, every(1e-4)), 1.6, 1.0);
    let (mut given, mut largest) = (DVec2::ZERO, 0.0_f64);
    while end_velocity(&simulation).x < -0.01 {
        simulation.step().unwrap();
        let force = contact_force(&mut simulation, "floor", "rod");
        given += force * 1e-4;
        largest = largest.max(force.y);
    }
    // The end presses itself into its spring and stops after 8 ms; the impulse is that without collision, (0.8, 0.6), but for the 0.08 N·s
    // of gravity meanwhile.
    assert_near(simulation.time(), 8.2e-3, 5e-4);
    assert_vector_near(given, dvec2(0.8, 0.6), 0.08);
    assert!(largest > 10.0 * support::G, "{largest} N");
}
