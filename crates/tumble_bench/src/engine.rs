//! tumble as an engine that runs plans.

use bevy_ecs::prelude::Entity;
use tumble_bench::{Body, BodyState, Engine, Kind, Plan, PlanDim, PlanarShape, SpatialShape};
use tumble_math::{Planar, Pose, Spatial, SpatialRotation};
use tumble_shape::{Capsule, ConvexHull, ConvexPolygon, Cuboid, Disc, Rod, ShapeError, SpatialShapeError, Sphere};
use tumble_sim::{
    Amount, AngularVelocity, BodyId, BodyKind, ContactModel, Geometry, InertiaOverride, LinearVelocity, Orientation,
    Part, Position, Settings, Simulation, StepError, TeamError,
};
use tumble_solver::Surface;

use crate::profile::Profile;

/// Why tumble cannot run a plan.
#[derive(Debug, thiserror::Error)]
pub enum TumbleError {
    /// A shape of the plane is degenerate.
    #[error(transparent)]
    Planar(#[from] ShapeError),
    /// A shape of space is degenerate.
    #[error(transparent)]
    Spatial(#[from] SpatialShapeError),
    /// Threads could not be started.
    #[error(transparent)]
    Threads(#[from] TeamError),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// What a simulation asks of the shapes of a plan.
pub trait TumbleDim: PlanDim + Geometry {
    /// The part that a shape is.
    fn part(part: &tumble_bench::Part<Self>, density: f64) -> Result<Part<Self>, TumbleError>;

    /// Inertia of a body where its parts do not know it.
    fn inertia(body: &Body<Self>, density: f64) -> Option<Self::Inertia>;
}

impl TumbleDim for Planar {
    fn part(part: &tumble_bench::Part<Self>, density: f64) -> Result<Part<Self>, TumbleError> {
        let Pose { position, rotation } = part.pose;
        Ok(match part.shape {
            PlanarShape::Box { half_extents } => {
                let polygon = ConvexPolygon::rectangle(position, half_extents, rotation.angle())?;
                Part::new(polygon, Amount::Density(density))
            }
            PlanarShape::Disc { radius } => Part::new(Disc::try_new(position, radius)?, Amount::Density(density)),
            PlanarShape::Capsule { half_length, radius } => {
                let half = part.pose.transform_vector(glam::DVec2::X * half_length);
                let rod = Rod::try_new(position - half, position + half, radius)?;
                Part::new(rod, Amount::Mass(density * part.shape.area()))
            }
        })
    }

    fn inertia(body: &Body<Self>, density: f64) -> Option<f64> {
        // Rods have their mass on a line, capsules in their area.
        let has_capsules = body.parts.iter().any(|part| matches!(part.shape, PlanarShape::Capsule { .. }));
        has_capsules.then(|| density * body.polar_moment())
    }
}

impl TumbleDim for Spatial {
    fn part(part: &tumble_bench::Part<Self>, density: f64) -> Result<Part<Self>, TumbleError> {
        let Pose { position, rotation } = part.pose;
        let amount = Amount::Density(density);
        Ok(match part.shape {
            SpatialShape::Box { half_extents } => {
                // A cuboid at the origin in its own axes is the common case, and cheaper for every contact.
                let cuboid = if rotation == SpatialRotation::IDENTITY && position == glam::DVec3::ZERO {
                    Cuboid::with_half_extents(half_extents)?
                } else {
                    Cuboid::try_new(position, half_extents, rotation)?
                };
                Part::new(cuboid, amount)
            }
            SpatialShape::Sphere { radius } => Part::new(Sphere::try_new(position, radius)?, amount),
            SpatialShape::Capsule { half_length, radius } => {
                let half = part.pose.transform_vector(glam::DVec3::Y * half_length);
                Part::new(Capsule::try_new(position - half, position + half, radius)?, amount)
            }
            SpatialShape::Icosahedron { radius } => {
                let corners = tumble_bench::plan::icosahedron(radius).map(|corner| part.pose.transform_point(corner));
                Part::new(ConvexHull::try_new(&corners)?, amount)
            }
        })
    }

    fn inertia(_: &Body<Self>, _: f64) -> Option<Self::Inertia> {
        None
    }
}

/// A simulation with the bodies of a plan.
pub struct Tumble<D: Geometry> {
    simulation: Simulation<D>,
    bodies: Vec<Entity>,
}

impl<D: TumbleDim> Tumble<D> {
    /// Builds the bodies of a plan, ready for the first step, and lets a profile watch it.
    pub fn new(
        plan: &Plan<D>,
        contact: ContactModel,
        threads: u32,
        profile: Option<&Profile>,
    ) -> Result<Self, TumbleError> {
        let settings = Settings { dt: plan.dt, gravity: plan.gravity, contact, ..Settings::weightless() };
        let mut simulation = Simulation::with_settings(settings);
        simulation.set_threads(threads as usize)?;
        let Plan { friction, restitution, .. } = *plan;
        let surface = Surface { static_friction: friction, kinetic_friction: friction, restitution };
        simulation.materials_mut().set("default", surface);
        let mut bodies = Vec::with_capacity(plan.bodies.len());
        for (id, body) in plan.bodies.iter().enumerate() {
            let kind = match body.kind {
                Kind::Static => BodyKind::Static,
                Kind::Kinematic => BodyKind::Kinematic,
                Kind::Dynamic => BodyKind::Dynamic,
            };
            let place = (Position(body.pose.position), Orientation(body.pose.rotation));
            let motion = (LinearVelocity(body.velocity), AngularVelocity(body.angular_velocity));
            let entity = simulation.spawn((BodyId(id as u64), kind, place, motion));
            if let Some(inertia) = D::inertia(body, plan.density).filter(|_| kind == BodyKind::Dynamic) {
                simulation.world_mut().entity_mut(entity).insert(InertiaOverride(inertia));
            }
            for part in &body.parts {
                simulation.attach(entity, D::part(part, plan.density)?);
            }
            bodies.push(entity);
        }
        if let Some(profile) = profile {
            profile.watch(&mut simulation);
        }
        simulation.prepare()?;
        Ok(Self { simulation, bodies })
    }
}

impl<D: TumbleDim> Engine<D> for Tumble<D> {
    type Error = TumbleError;

    fn step(&mut self) -> Result<(), TumbleError> {
        Ok(self.simulation.step()?)
    }

    fn states(&self) -> Vec<BodyState<D>> {
        let world = self.simulation.world();
        let state = |body: &Entity| {
            let body = world.entity(*body);
            let velocity = body.get::<LinearVelocity<D::Vector>>().map_or_else(Default::default, |velocity| velocity.0);
            BodyState {
                pose: Pose {
                    position: body.get::<Position<D::Vector>>().map_or_else(Default::default, |position| position.0),
                    rotation: body.get::<Orientation<D::Rotation>>().map_or_else(Default::default, |turn| turn.0),
                },
                velocity,
                angular_velocity: body
                    .get::<AngularVelocity<D::Angular>>()
                    .map_or_else(Default::default, |turn| turn.0),
            }
        };
        self.bodies.iter().map(state).collect()
    }
}
