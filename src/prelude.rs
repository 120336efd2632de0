//! The names that most programs need: `use tumble::prelude::*;`.

pub use bevy_ecs::name::Name;
pub use bevy_ecs::prelude::{Component, Entity, Query, Res, ResMut, Resource, With, Without};
pub use glam::{DVec2, DVec3, dvec2, dvec3};

pub use tumble_math::{Planar, PlanarRotation, Rotation, Spatial, SpatialRotation};
pub use tumble_record::{
    Channel, Completeness, Fingerprint, OutputFolder, Record, Recording, Summary, plot::Plot, write_run,
};
pub use tumble_scene::expect::{Status, Verdict};
pub use tumble_scene::format::{Expectation, ScalarExpectation, Scene, VectorExpectation};
pub use tumble_scene::shipped::Shipped;
pub use tumble_scene::{Check, FromScene, ToScene};
pub use tumble_shape::{
    Capsule, ConvexHull, ConvexPolygon, Cuboid, Disc, HalfPlane, HalfSpace, PlanarShape, Rod, SpatialRod, SpatialShape,
    Sphere,
};
pub use tumble_sim::{
    Amount, Anchor, AngularVelocity, AppliedForce, Axes, BodyId, BodyKind, CentreOverride, Clock, ContactModel, Course,
    Force, GravityScale, Groups, InertiaOverride, Integrator, Joint, JointKind, JointMotion, Keyframe, Keyframes,
    Ledger, LinearDrag, LinearVelocity, Lock, LockedAxes, Mass, MassOverride, Orientation, Part, PenaltyLaw,
    PenaltySettings, Pinned, Position, QuadraticDrag, Response, Settings, Simulation, SpatialJointKind, Spring,
    SpringDamperSettings, StepSystems, Torque, VelocityLcpSettings,
};
pub use tumble_solver::Surface;
