//! Box3D over the spatial scenes of tumble_bench: its default build and settings, except that nothing sleeps.

use std::convert::Infallible;
use std::process::ExitCode;

use box3d_sys as ffi;
use clap::Parser;
use glam::{DQuat, DVec3};
use tumble_bench::options::{PeerArguments, print_lines};
use tumble_bench::plan::icosahedron;
use tumble_bench::run::{Run, run};
use tumble_bench::{AnyPlan, BodyState, Engine, Kind, Plan, SpatialShape};
use tumble_math::{Pose, Spatial, SpatialRotation};

/// Box3D's own number of substeps.
const SUBSTEPS: u32 = 4;

/// A world of Box3D.
struct World {
    id: ffi::b3WorldId,
    bodies: Vec<ffi::b3BodyId>,
    dt: f32,
    substeps: i32,
}

fn vector(vector: DVec3) -> ffi::b3Vec3 {
    let vector = vector.as_vec3();
    ffi::b3Vec3 { x: vector.x, y: vector.y, z: vector.z }
}

fn position(place: DVec3) -> ffi::b3Pos {
    let place = place.as_vec3();
    ffi::b3Pos { x: place.x, y: place.y, z: place.z }
}

impl World {
    fn new(plan: &Plan<Spatial>, threads: u32, substeps: u32) -> Self {
        // SAFETY: plain calls of the C interface; every id comes from the world made here, which exists until it is dropped.
        unsafe {
            let mut world = ffi::b3DefaultWorldDef();
            world.gravity = vector(plan.gravity);
            world.enableSleep = false;
            world.workerCount = threads;
            let id = ffi::b3CreateWorld(&world);
            let bodies = plan.bodies.iter().map(|body| {
                let mut definition = ffi::b3DefaultBodyDef();
                definition.type_ = match body.kind {
                    Kind::Static => ffi::b3BodyType_b3_staticBody,
                    Kind::Kinematic => ffi::b3BodyType_b3_kinematicBody,
                    Kind::Dynamic => ffi::b3BodyType_b3_dynamicBody,
                };
                let turn = body.pose.rotation.quaternion();
                definition.position = position(body.pose.position);
                definition.rotation = ffi::b3Quat { v: vector(DVec3::new(turn.x, turn.y, turn.z)), s: turn.w as f32 };
                definition.linearVelocity = vector(body.velocity);
                definition.angularVelocity = vector(body.angular_velocity);
                definition.enableSleep = false;
                let entry = ffi::b3CreateBody(id, &definition);
                let mut material = ffi::b3DefaultShapeDef();
                material.density = plan.density as f32;
                material.baseMaterial.friction = plan.friction as f32;
                material.baseMaterial.restitution = plan.restitution as f32;
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
/// The body must exist. Boxes must not be turned against it: no scene has such.
unsafe fn add_shape(body: ffi::b3BodyId, material: &ffi::b3ShapeDef, shape: &SpatialShape, pose: &Pose<Spatial>) {
    // SAFETY: the definitions are complete, and Box3D copies what they point to.
    unsafe {
        match *shape {
            SpatialShape::Box { half_extents } => {
                let half = half_extents.as_vec3();
                let hull = ffi::b3MakeOffsetBoxHull(half.x, half.y, half.z, vector(pose.position));
                ffi::b3CreateHullShape(body, material, &hull.base);
            }
            SpatialShape::Sphere { radius } => {
                let sphere = ffi::b3Sphere { center: vector(pose.position), radius: radius as f32 };
                ffi::b3CreateSphereShape(body, material, &sphere);
            }
            SpatialShape::Capsule { half_length, radius } => {
                let end = |along: f64| vector(pose.transform_point(DVec3::Y * along));
                let (center1, center2) = (end(-half_length), end(half_length));
                let capsule = ffi::b3Capsule { center1, center2, radius: radius as f32 };
                ffi::b3CreateCapsuleShape(body, material, &capsule);
            }
            SpatialShape::Icosahedron { radius } => {
                let corners = icosahedron(radius).map(|corner| vector(pose.transform_point(corner)));
                let count = corners.len() as i32;
                let hull = ffi::b3CreateHull(corners.as_ptr(), count, count);
                assert!(!hull.is_null(), "the corners of an icosahedron are a hull");
                ffi::b3CreateHullShape(body, material, hull);
            }
        }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: the world exists, and nobody uses it after this.
        unsafe { ffi::b3DestroyWorld(self.id) };
    }
}

impl Engine<Spatial> for World {
    type Error = Infallible;

    fn step(&mut self) -> Result<(), Infallible> {
        // SAFETY: the world exists.
        unsafe { ffi::b3World_Step(self.id, self.dt, self.substeps) };
        Ok(())
    }

    fn states(&self) -> Vec<BodyState<Spatial>> {
        let long = |short: ffi::b3Vec3| DVec3::new(short.x.into(), short.y.into(), short.z.into());
        let state = |body: &ffi::b3BodyId| {
            // SAFETY: the body exists.
            let (position, turn, velocity, spin) = unsafe {
                let (position, turn) = (ffi::b3Body_GetPosition(*body), ffi::b3Body_GetRotation(*body));
                (position, turn, ffi::b3Body_GetLinearVelocity(*body), ffi::b3Body_GetAngularVelocity(*body))
            };
            let quaternion = DQuat::from_vec4(long(turn.v).extend(turn.s.into()));
            let position = DVec3::new(position.x.into(), position.y.into(), position.z.into());
            let rotation = SpatialRotation::try_from_quaternion(quaternion).unwrap_or_default();
            BodyState { pose: Pose { position, rotation }, velocity: long(velocity), angular_velocity: long(spin) }
        };
        self.bodies.iter().map(state).collect()
    }
}

fn held_bytes() -> usize {
    // SAFETY: reads a counter.
    usize::try_from(unsafe { ffi::b3GetByteCount() }).unwrap_or(0)
}

fn main() -> ExitCode {
    let PeerArguments { scenes, options, substeps } = PeerArguments::parse();
    // SAFETY: reads a constant.
    let version = unsafe { ffi::b3GetVersion() };
    let mut version = format!("{}.{}.{}", version.major, version.minor, version.revision);
    if let Some(substeps) = substeps {
        version += &format!("-{substeps}-substeps");
    }
    let substeps = substeps.unwrap_or(SUBSTEPS);
    let how = Run { engine: "box3d", version: &version, threads: options.threads, steps: options.steps, held_bytes };
    let done = print_lines(&scenes, &options, |plan| match plan {
        AnyPlan::Spatial(plan) => {
            let built = run(&plan, &how, |plan| Ok(World::new(plan, options.threads, substeps)));
            Ok(built.unwrap_or_else(|never: Infallible| match never {}))
        }
        AnyPlan::Planar(plan) => Err(format!("{} is a scene of the plane", plan.name)),
    });
    if let Err(error) = done {
        eprintln!("peer_box3d: {error}");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}
