//! Bodies of space for tests, with gravity along −z.

use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use glam::{DVec3, dvec3};
use tumble_math::{Spatial, SpatialRotation};
use tumble_shape::{HalfSpace, SpatialShape};
use tumble_sim::{
    Amount, AngularVelocity, BodyKind, ContactModel, LinearVelocity, Orientation, Part, Position, Settings, Simulation,
};
use tumble_solver::Surface;

/// Gravity [m/s²].
pub const G: f64 = 9.81;

/// The models that keep contacts rigid.
pub const RIGID: [ContactModel; 3] = [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp];

/// Settings of a model with a step [s].
pub fn settings(contact: ContactModel, dt: f64) -> Settings<Spatial> {
    Settings { dt, contact, gravity: dvec3(0.0, 0.0, -G), ..Settings::weightless() }
}

/// A surface with one coefficient of friction that does not bounce.
pub fn rough(friction: f64) -> Surface {
    Surface { static_friction: friction, kinetic_friction: friction, restitution: 0.0 }
}

/// A world with a floor at height 0.
pub fn on_a_floor(settings: Settings<Spatial>, surface: Surface) -> Simulation<Spatial> {
    let mut simulation = Simulation::with_settings(settings);
    simulation.materials_mut().set("default", surface);
    let floor = simulation.spawn((Name::new("floor"), Position(DVec3::ZERO), BodyKind::Static));
    let half_space = HalfSpace::try_new(DVec3::Z, 0.0).unwrap();
    simulation.attach(floor, Part::new(SpatialShape::from(half_space), Amount::Density(0.0)));
    simulation
}

/// How a body begins.
pub struct Start {
    /// Origin of its shape [m].
    pub at: DVec3,
    /// Its rotation.
    pub turned: SpatialRotation,
    /// Velocity of its centre of mass [m/s].
    pub velocity: DVec3,
    /// Its rate of turn [rad/s].
    pub spin: DVec3,
}

impl Start {
    /// At rest at a place.
    pub fn at(at: DVec3) -> Self {
        Self { at, turned: SpatialRotation::IDENTITY, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }
}

/// Puts a body of one shape into a simulation.
pub fn spawn(
    simulation: &mut Simulation<Spatial>,
    name: &str,
    shape: impl Into<SpatialShape>,
    mass: f64,
    start: &Start,
) -> Entity {
    let entity = simulation.spawn((
        Name::new(name.to_owned()),
        Position(start.at),
        Orientation(start.turned),
        LinearVelocity(start.velocity),
        AngularVelocity(start.spin),
    ));
    simulation.attach(entity, Part::new(shape.into(), Amount::Mass(mass)));
    entity
}

/// Fails unless two vectors differ by no more than a tolerance.
#[track_caller]
pub fn near(measured: DVec3, expected: DVec3, tolerance: f64) {
    assert!((measured - expected).length() <= tolerance, "{measured} is not {expected} ± {tolerance:e}");
}
