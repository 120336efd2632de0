//! Rapier over the planar scenes of tumble_bench: its default settings, except that nothing sleeps.

use std::process::ExitCode;

use clap::Parser;
use glam::DVec2;
use rapier2d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector};
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use tumble_bench::memory::held_bytes;
use tumble_bench::options::{PeerArguments, print_lines};
use tumble_bench::run::{Run, run};
use tumble_bench::{AnyPlan, BodyState, Engine, Kind, Part, Plan, PlanarShape};
use tumble_math::{Planar, PlanarRotation, Pose};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// A world of Rapier.
struct World {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

fn vector(vector: DVec2) -> Vector {
    let vector = vector.as_vec2();
    Vector::new(vector.x, vector.y)
}

impl World {
    fn new(plan: &Plan<Planar>, threads: u32, iterations: Option<u32>) -> Result<Self, String> {
        let mut world = PhysicsWorld { gravity: vector(plan.gravity), ..PhysicsWorld::default() };
        world.integration_parameters.dt = plan.dt as f32;
        if let Some(iterations) = iterations {
            world.integration_parameters.num_solver_iterations = iterations as usize;
        }
        world.physics_pipeline.configure_thread_pool(threads as usize).map_err(|error| error.to_string())?;
        let mut bodies = Vec::with_capacity(plan.bodies.len());
        for body in &plan.bodies {
            let builder = match body.kind {
                Kind::Static => RigidBodyBuilder::fixed(),
                Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based(),
                Kind::Dynamic => RigidBodyBuilder::dynamic(),
            };
            let builder = builder
                .translation(vector(body.pose.position))
                .rotation(body.pose.rotation.angle() as f32)
                .linvel(vector(body.velocity))
                .angvel(body.angular_velocity as f32)
                .can_sleep(false);
            let handle = world.insert_body(builder);
            for part in &body.parts {
                let collider = collider(part)
                    .density(plan.density as f32)
                    .friction(plan.friction as f32)
                    .restitution(plan.restitution as f32);
                world.insert_collider(collider, Some(handle));
            }
            bodies.push(handle);
        }
        Ok(Self { world, bodies })
    }
}

fn collider(part: &Part<Planar>) -> ColliderBuilder {
    let builder = match part.shape {
        PlanarShape::Box { half_extents } => ColliderBuilder::cuboid(half_extents.x as f32, half_extents.y as f32),
        PlanarShape::Disc { radius } => ColliderBuilder::ball(radius as f32),
        PlanarShape::Capsule { half_length, radius } => ColliderBuilder::capsule_x(half_length as f32, radius as f32),
    };
    builder.translation(vector(part.pose.position)).rotation(part.pose.rotation.angle() as f32)
}

impl Engine<Planar> for World {
    type Error = String;

    fn step(&mut self) -> Result<(), String> {
        self.world.step();
        Ok(())
    }

    fn states(&self) -> Vec<BodyState<Planar>> {
        let state = |handle: &RigidBodyHandle| {
            let body = &self.world.bodies[*handle];
            let long = |vector: Vector| DVec2::new(vector.x.into(), vector.y.into());
            let rotation = PlanarRotation::from_angle(body.rotation().angle().into());
            let pose = Pose { position: long(body.translation()), rotation };
            BodyState { pose, velocity: long(body.linvel()), angular_velocity: body.angvel().into() }
        };
        self.bodies.iter().map(state).collect()
    }
}

fn main() -> ExitCode {
    let PeerArguments { scenes, options, substeps } = PeerArguments::parse();
    let version = substeps.map_or_else(|| "0.36".to_owned(), |substeps| format!("0.36-{substeps}-iterations"));
    let how = Run {
        engine: "rapier2d",
        version: &version,
        threads: options.threads,
        steps: options.steps,
        held_bytes: || held_bytes(ALLOCATOR),
    };
    let done = print_lines(&scenes, &options, |plan| match plan {
        AnyPlan::Planar(plan) => run(&plan, &how, |plan| World::new(plan, options.threads, substeps)),
        AnyPlan::Spatial(plan) => Err(format!("{} is a scene of space", plan.name)),
    });
    if let Err(error) = done {
        eprintln!("rapier2d: {error}");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}
