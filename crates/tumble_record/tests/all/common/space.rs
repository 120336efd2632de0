//! Recordings of space: what is thrown on a floor, really simulated.

use bevy_ecs::name::Name;
use glam::{DVec3, dvec3};
use tumble_math::{Spatial, SpatialRotation};
use tumble_record::{Record, Recording};
use tumble_shape::{Capsule, Cone, ConvexHull, Cuboid, Cylinder, HalfSpace, SpatialShape, Sphere};
use tumble_sim::{
    Amount, AngularVelocity, BodyKind, LinearVelocity, Orientation, Part, Position, Settings, Simulation,
};

type Fallible<T> = Result<T, Box<dyn std::error::Error>>;

/// A world with a floor at height 0, y up.
pub fn on_a_floor(dt: f64) -> Fallible<Simulation<Spatial>> {
    let settings = Settings { dt, gravity: dvec3(0.0, -9.81, 0.0), ..Settings::weightless() };
    let mut simulation = Simulation::with_settings(settings);
    let floor = simulation.spawn((Name::new("floor"), Position(DVec3::ZERO), BodyKind::Static));
    simulation.attach(floor, Part::new(HalfSpace::try_new(DVec3::Y, 0.0)?, Amount::Density(0.0)));
    Ok(simulation)
}

/// One of each shape, and a few boxes more, dropped in a ring; a sample every `every` steps.
pub fn assortment(seconds: f64, every: u32) -> Fallible<Recording<Spatial>> {
    let mut simulation = on_a_floor(0.005)?;
    let rock: Vec<DVec3> = (0..24)
        .map(|i| {
            let (turn, height) = (2.4 * f64::from(i), 1.0 - f64::from(i) / 11.5);
            let round = (1.0 - height * height).max(0.0).sqrt();
            dvec3(0.34 * round * libm::cos(turn), 0.24 * height, 0.3 * round * libm::sin(turn))
        })
        .collect();
    let shapes: [(&str, SpatialShape); 8] = [
        ("ball", Sphere::try_new(DVec3::ZERO, 0.28)?.into()),
        ("box", Cuboid::with_half_extents(dvec3(0.32, 0.2, 0.26))?.into()),
        ("capsule", Capsule::try_new(dvec3(-0.3, 0.0, 0.0), dvec3(0.3, 0.0, 0.0), 0.16)?.into()),
        ("rock", ConvexHull::try_new(&rock)?.into()),
        ("cylinder", Cylinder::try_new(dvec3(0.0, -0.22, 0.0), dvec3(0.0, 0.22, 0.0), 0.26)?.into()),
        ("cone", Cone::try_new(dvec3(0.0, -0.15, 0.0), dvec3(0.0, 0.4, 0.0), 0.27)?.into()),
        ("stick", Capsule::try_new(dvec3(-0.4, 0.0, 0.0), dvec3(0.4, 0.0, 0.0), 0.03)?.into()),
        ("plank", Cuboid::with_half_extents(dvec3(0.5, 0.05, 0.18))?.into()),
    ];
    for (index, (name, shape)) in shapes.into_iter().enumerate() {
        let turn = 0.785 * index as f64;
        let body = simulation.spawn((
            Name::new(name),
            Position(dvec3(1.35 * libm::cos(turn), 0.9 + 0.1 * index as f64, 1.35 * libm::sin(turn))),
            Orientation(SpatialRotation::from_rotation_vector(dvec3(0.3 * turn, 0.5, 0.2))),
            LinearVelocity(dvec3(-0.2 * libm::cos(turn), 0.0, -0.2 * libm::sin(turn))),
            AngularVelocity(dvec3(0.5, 1.0, -0.7)),
        ));
        simulation.attach(body, Part::new(shape, Amount::Mass(1.0)));
    }
    for index in 0..3 {
        let height = 0.25 + 0.52 * f64::from(index);
        let body = simulation.spawn((Name::new(format!("brick-{index}")), Position(dvec3(0.0, height, 0.0))));
        let shape = Cuboid::with_half_extents(dvec3(0.25, 0.25, 0.25))?;
        simulation.attach(body, Part::new(shape, Amount::Mass(1.0)));
    }
    simulation.record(every)?;
    simulation.run_for(seconds)?;
    let mut recording = simulation.take_recording().ok_or("it was recorded")?;
    recording.scene = "assortment".to_owned();
    recording.about = "One of each shape of space falls on a floor.".to_owned();
    Ok(recording)
}
