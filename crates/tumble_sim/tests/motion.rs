//! Free motion and single contacts against closed forms.

use bevy_ecs::name::Name;
use glam::{DVec2, dvec2};
use tumble_math::PlanarRotation;
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, PlanarShape};
use tumble_sim::*;
use tumble_solver::Surface;

fn floor(simulation: &mut Simulation) {
    let floor = simulation.spawn((Name::new("floor"), Position(DVec2::ZERO), BodyKind::Static));
    let shape = PlanarShape::HalfPlane(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0).unwrap());
    simulation.attach(floor, Part::new(shape, Amount::Density(0.0)));
}

fn ball(simulation: &mut Simulation, height: f64) {
    let ball = simulation.spawn((Name::new("ball"), Position(dvec2(0.0, height + 0.1))));
    let shape = PlanarShape::Disc(Disc::try_new(DVec2::ZERO, 0.1).unwrap());
    simulation.attach(ball, Part::new(shape, Amount::Mass(1.0)));
}

#[test]
fn b1_free_fall_follows_the_recurrence_of_symplectic_euler() {
    let mut simulation = Simulation::new(Settings::default());
    simulation.spawn((Name::new("ball"), Position(dvec2(0.0, 10.0)), MassOverride(2.0), InertiaOverride(1.0)));
    simulation.run_for(1.0).unwrap();
    let ball = simulation.body("ball").unwrap();
    // Round-off of 100 additions.
    assert!((ball.position().y - 5.04595).abs() < 1e-12);
    assert!((ball.velocity().y + 9.81).abs() < 1e-12);
}

#[test]
fn elastic_ball_neither_gains_nor_loses_height() {
    for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
        let mut simulation = Simulation::new(Settings { integrator, ..Settings::default() });
        simulation.materials_mut().set("default", Surface { restitution: 1.0, ..Surface::default() });
        floor(&mut simulation);
        ball(&mut simulation, 1.0);
        let mut apex: f64 = 0.0;
        for step in 0..6000 {
            simulation.step().unwrap();
            if step > 5900 {
                apex = apex.max(simulation.body("ball").unwrap().position().y - 0.1);
            }
        }
        println!("{integrator:?} apex after a minute {apex}");
        // Apexes fall between samples: by at most g Δt²/8.
        assert!((apex - 1.0).abs() < 9.81 * 1e-4 / 8.0 + 1e-9, "{integrator:?}: {apex}");
    }
}

#[test]
fn box_on_incline_rests_or_slides() {
    for (degrees, surface, expected) in [(30.0_f64, 0.6, 0.0), (31.5, 0.6, 0.0)] {
        let angle = degrees.to_radians();
        let mut simulation = Simulation::new(Settings::default());
        simulation
            .materials_mut()
            .set("default", Surface { restitution: 0.0, static_friction: surface, kinetic_friction: 0.3 });
        let floor = simulation.spawn((Name::new("floor"), Position(DVec2::ZERO), BodyKind::Static));
        let rotation = PlanarRotation::from_angle(angle);
        let shape = PlanarShape::HalfPlane(HalfPlane::try_new(dvec2(-rotation.sin(), rotation.cos()), 0.0).unwrap());
        simulation.attach(floor, Part::new(shape, Amount::Density(0.0)));
        let normal = dvec2(-rotation.sin(), rotation.cos());
        let block = simulation.spawn((Name::new("block"), Position(normal * 0.25), Orientation(rotation)));
        let shape = PlanarShape::from(ConvexPolygon::rectangle(DVec2::ZERO, dvec2(0.5, 0.25), 0.0).unwrap());
        simulation.attach(block, Part::new(shape, Amount::Density(1.0)));
        simulation.run_for(10.0).unwrap();
        let block = simulation.body("block").unwrap();
        println!(
            "{degrees} {expected} pos {:?} v {:?} {:?}",
            block.position() - normal * 0.25,
            block.velocity(),
            simulation.notices()
        );
    }
}
