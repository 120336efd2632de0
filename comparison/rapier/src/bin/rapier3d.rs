//! Rapier over the spatial scenes of tumble_bench: its default settings, except that nothing sleeps.

use std::process::ExitCode;

use clap::Parser;
use glam::{DQuat, DVec3};
use rapier3d::glamx::{Quat, Vec3};
use rapier3d::prelude::{ColliderBuilder, PhysicsWorld, Pose as RapierPose, RigidBodyBuilder, RigidBodyHandle};
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use tumble_bench::memory::held_bytes;
use tumble_bench::options::{PeerArguments, print_lines};
use tumble_bench::plan::icosahedron;
use tumble_bench::run::{Run, run};
use tumble_bench::{AnyPlan, BodyState, Engine, Kind, Part, Plan, SpatialShape};
use tumble_math::{Pose, Spatial, SpatialRotation};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// A world of Rapier.
struct World {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

fn vector(vector: DVec3) -> Vec3 {
    Vec3::from_array(vector.as_vec3().to_array())
}

fn pose(pose: &Pose<Spatial>) -> RapierPose {
    RapierPose::from_parts(vector(pose.position), Quat::from_array(pose.rotation.quaternion().as_quat().to_array()))
}

impl World {
    fn new(plan: &Plan<Spatial>, threads: u32, iterations: Option<u32>) -> Result<Self, String> {
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
                .pose(pose(&body.pose))
                .linvel(vector(body.velocity))
                .angvel(vector(body.angular_velocity))
                .can_sleep(false);
            let handle = world.insert_body(builder);
            for part in &body.parts {
                let collider = collider(part)?
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

fn collider(part: &Part<Spatial>) -> Result<ColliderBuilder, String> {
    let builder = match part.shape {
        SpatialShape::Box { half_extents } => {
            let half = half_extents.as_vec3();
            ColliderBuilder::cuboid(half.x, half.y, half.z)
        }
        SpatialShape::Sphere { radius } => ColliderBuilder::ball(radius as f32),
        SpatialShape::Capsule { half_length, radius } => ColliderBuilder::capsule_y(half_length as f32, radius as f32),
        SpatialShape::Icosahedron { radius } => {
            let corners = icosahedron(radius).map(vector);
            ColliderBuilder::convex_hull(&corners).ok_or("the corners of an icosahedron are no hull")?
        }
    };
    Ok(builder.position(pose(&part.pose)))
}

impl Engine<Spatial> for World {
    type Error = String;

    fn step(&mut self) -> Result<(), String> {
        self.world.step();
        Ok(())
    }

    fn states(&self) -> Vec<BodyState<Spatial>> {
        let state = |handle: &RigidBodyHandle| {
            let body = &self.world.bodies[*handle];
            let long = |vector: Vec3| DVec3::from_array(vector.to_array().map(f64::from));
            let quaternion = DQuat::from_array(body.rotation().to_array().map(f64::from));
            let rotation = SpatialRotation::try_from_quaternion(quaternion).unwrap_or_default();
            let pose = Pose { position: long(body.translation()), rotation };
            BodyState { pose, velocity: long(body.linvel()), angular_velocity: long(body.angvel()) }
        };
        self.bodies.iter().map(state).collect()
    }
}

fn main() -> ExitCode {
    let PeerArguments { scenes, options, substeps } = PeerArguments::parse();
    let version = substeps.map_or_else(|| "0.36".to_owned(), |substeps| format!("0.36-{substeps}-iterations"));
    let how = Run {
        engine: "rapier3d",
        version: &version,
        threads: options.threads,
        steps: options.steps,
        held_bytes: || held_bytes(ALLOCATOR),
    };
    let done = print_lines(&scenes, &options, |plan| match plan {
        AnyPlan::Spatial(plan) => run(&plan, &how, |plan| World::new(plan, options.threads, substeps)),
        AnyPlan::Planar(plan) => Err(format!("{} is a scene of the plane", plan.name)),
    });
    if let Err(error) = done {
        eprintln!("rapier3d: {error}");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}
