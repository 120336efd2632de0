//! A step in which no contact begins or ends asks the allocator for nothing.

use std::alloc::System;

use glam::dvec2;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use tumble_shape::{ConvexPolygon, HalfPlane};
use tumble_sim::{Amount, BodyKind, ContactModel, Part, Position, Settings, Simulation};
use tumble_solver::Surface;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

#[test]
fn a_steady_step_allocates_nothing() {
    let settings = Settings { dt: 1.0 / 60.0, contact: ContactModel::SoftStep, ..Settings::default() };
    let mut simulation = Simulation::new(settings);
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.6, restitution: 0.0 };
    simulation.materials_mut().set("default", surface);
    let ground = simulation.spawn((BodyKind::Static, Position(dvec2(0.0, 0.0))));
    simulation.attach(ground, Part::new(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0).unwrap(), Amount::Mass(0.0)));
    for k in 0..100 {
        let (column, row) = (f64::from(k / 4), f64::from(k % 4));
        let body = simulation.spawn((BodyKind::Dynamic, Position(dvec2(2.0 * column, row + 0.5))));
        let square = ConvexPolygon::rectangle(dvec2(0.0, 0.0), dvec2(0.5, 0.5), 0.0).unwrap();
        simulation.attach(body, Part::new(square, Amount::Density(1.0)));
    }
    simulation.run_for(5.0).unwrap();
    let region = Region::new(ALLOCATOR);
    for _ in 0..100 {
        simulation.step().unwrap();
    }
    let change = region.change();
    assert_eq!((change.allocations, change.reallocations, change.deallocations), (0, 0, 0));
}
