//! Box2D over the planar scenes of tumble_bench: its default build and settings, except that nothing sleeps.

use std::convert::Infallible;
use std::process::ExitCode;

use boxdd_sys::ffi;
use clap::Parser;
use glam::DVec2;
use tumble_bench::options::{PeerArguments, print_lines};
use tumble_bench::run::{Run, run};
use tumble_bench::{AnyPlan, BodyState, Engine, Kind, Plan, PlanarShape};
use tumble_math::{Planar, PlanarRotation, Pose, trig};

/// Box2D's own number of substeps.
const SUBSTEPS: u32 = 4;

/// A world of Box2D.
struct World {
    id: ffi::b2WorldId,
    bodies: Vec<ffi::b2BodyId>,
    dt: f32,
    substeps: i32,
}

fn vector(vector: DVec2) -> ffi::b2Vec2 {
    let vector = vector.as_vec2();
    ffi::b2Vec2 { x: vector.x, y: vector.y }
}

fn rotation(rotation: &PlanarRotation) -> ffi::b2Rot {
    ffi::b2Rot { c: rotation.cos() as f32, s: rotation.sin() as f32 }
}

impl World {
    fn new(plan: &Plan<Planar>, threads: u32, substeps: u32) -> Self {
        // SAFETY: plain calls of the C interface; every id comes from the world made here, which exists until it is dropped.
        unsafe {
            let mut world = ffi::b2DefaultWorldDef();
            world.gravity = vector(plan.gravity);
            world.enableSleep = false;
            world.workerCount = threads as i32;
            let id = ffi::b2CreateWorld(&world);
            let bodies = plan.bodies.iter().map(|body| {
                let mut definition = ffi::b2DefaultBodyDef();
                definition.type_ = match body.kind {
                    Kind::Static => ffi::b2BodyType_b2_staticBody,
                    Kind::Kinematic => ffi::b2BodyType_b2_kinematicBody,
                    Kind::Dynamic => ffi::b2BodyType_b2_dynamicBody,
                };
                definition.position = vector(body.pose.position);
                definition.rotation = rotation(&body.pose.rotation);
                definition.linearVelocity = vector(body.velocity);
                definition.angularVelocity = body.angular_velocity as f32;
                definition.enableSleep = false;
                let entry = ffi::b2CreateBody(id, &definition);
                let mut material = ffi::b2DefaultShapeDef();
                material.density = plan.density as f32;
                material.material.friction = plan.friction as f32;
                material.material.restitution = plan.restitution as f32;
                for part in &body.parts {
                    add_shape(entry, &material, &part.shape, &part.pose);
                }
                entry
            });
            let bodies = bodies.collect();
            Self { id, bodies, dt: plan.dt as f32, substeps: substeps as i32 }
        }
    }
}

/// # Safety
///
/// The body must exist.
unsafe fn add_shape(body: ffi::b2BodyId, material: &ffi::b2ShapeDef, shape: &PlanarShape, pose: &Pose<Planar>) {
    // SAFETY: the definitions are complete, and Box2D copies what they point to.
    unsafe {
        match *shape {
            PlanarShape::Box { half_extents } => {
                let (width, height) = (half_extents.x as f32, half_extents.y as f32);
                let polygon = ffi::b2MakeOffsetBox(width, height, vector(pose.position), rotation(&pose.rotation));
                ffi::b2CreatePolygonShape(body, material, &polygon);
            }
            PlanarShape::Disc { radius } => {
                let circle = ffi::b2Circle { center: vector(pose.position), radius: radius as f32 };
                ffi::b2CreateCircleShape(body, material, &circle);
            }
            PlanarShape::Capsule { half_length, radius } => {
                let end = |along: f64| vector(pose.transform_point(DVec2::X * along));
                let (center1, center2) = (end(-half_length), end(half_length));
                let capsule = ffi::b2Capsule { center1, center2, radius: radius as f32 };
                ffi::b2CreateCapsuleShape(body, material, &capsule);
            }
        }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: the world exists, and nobody uses it after this.
        unsafe { ffi::b2DestroyWorld(self.id) };
    }
}

impl Engine<Planar> for World {
    type Error = Infallible;

    fn step(&mut self) -> Result<(), Infallible> {
        // SAFETY: the world exists.
        unsafe { ffi::b2World_Step(self.id, self.dt, self.substeps) };
        Ok(())
    }

    fn states(&self) -> Vec<BodyState<Planar>> {
        let state = |body: &ffi::b2BodyId| {
            // SAFETY: the body exists.
            let (position, rotation, velocity, angular_velocity) = unsafe {
                let (position, rotation) = (ffi::b2Body_GetPosition(*body), ffi::b2Body_GetRotation(*body));
                (position, rotation, ffi::b2Body_GetLinearVelocity(*body), ffi::b2Body_GetAngularVelocity(*body))
            };
            let angle = trig::atan2(rotation.s.into(), rotation.c.into());
            let position = DVec2::new(position.x.into(), position.y.into());
            BodyState {
                pose: Pose { position, rotation: PlanarRotation::from_angle(angle) },
                velocity: DVec2::new(velocity.x.into(), velocity.y.into()),
                angular_velocity: angular_velocity.into(),
            }
        };
        self.bodies.iter().map(state).collect()
    }
}

fn held_bytes() -> usize {
    // SAFETY: reads a counter.
    usize::try_from(unsafe { ffi::b2GetByteCount() }).unwrap_or(0)
}

fn main() -> ExitCode {
    let PeerArguments { scenes, options, substeps } = PeerArguments::parse();
    // SAFETY: reads a constant.
    let version = unsafe { ffi::b2GetVersion() };
    let mut version = format!("{}.{}.{}", version.major, version.minor, version.revision);
    if let Some(substeps) = substeps {
        version += &format!("-{substeps}-substeps");
    }
    let substeps = substeps.unwrap_or(SUBSTEPS);
    let how = Run { engine: "box2d", version: &version, threads: options.threads, steps: options.steps, held_bytes };
    let done = print_lines(&scenes, &options, |plan| match plan {
        AnyPlan::Planar(plan) => {
            let built = run(&plan, &how, |plan| Ok(World::new(plan, options.threads, substeps)));
            Ok(built.unwrap_or_else(|never: Infallible| match never {}))
        }
        AnyPlan::Spatial(plan) => Err(format!("{} is a scene of space", plan.name)),
    });
    if let Err(error) = done {
        eprintln!("peer_box2d: {error}");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}
