//! Rigid bodies as components, and the systems that move them. Nothing below this crate has heard of an entity.
//!
//! [`Simulation`] owns a world and the schedule of a step; [`schedule`] is the page to read first.

pub mod body;
pub mod clock;
pub mod contact;
mod engine;
pub mod error;
pub mod fault;
pub mod force;
pub mod geometry;
pub mod integrate;
pub mod joint;
pub mod ledger;
mod needs;
pub mod notice;
pub mod part;
pub mod rest;
pub mod schedule;
pub mod settings;
mod simulation;
pub mod structure;
mod threads;

pub use body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyEntry, BodyId, BodyIndex, BodyInertia, BodyKind, BodyTable,
    BodyView, CentreOverride, Force, InDim, InertiaOverride, InverseInertia, InverseMass, Keyframe, Keyframes,
    LinearVelocity, Lock, LockedAxes, Mass, MassOverride, Orientation, Pinned, Position, PreviousVelocity, Torque,
};
pub use clock::Clock;
pub use contact::{
    ContactManifold, ContactMemory, ContactPair, ContactReport, IgnoredPairs, Materials, PairKey, PointMemory,
    SoftModel, Touch, TouchPhase,
};
pub use engine::Engine;
pub use error::{BodyError, StepError, UnknownBody};
pub use force::{Anchor, AppliedForce, Axes, Course, GravityScale, LinearDrag, QuadraticDrag, Spring};
pub use geometry::Geometry;
pub use joint::{Joint, JointKind, JointMotion, JointProblem, JointTable, SpatialJointKind};
pub use ledger::Ledger;
pub use notice::Notices;
pub use part::{Amount, Groups, MaterialId, Part, PartOf, Parts, Response};
pub use rest::{Asleep, Rest, SleepSettings};
pub use schedule::{ForceSystems, StepSystems};
pub use settings::{
    ContactModel, ImpulseSettings, Integrator, PenaltyLaw, PenaltySettings, Settings, SpringDamperSettings,
    VelocityLcpSettings,
};
pub use simulation::{Beginning, Simulation};
pub use structure::Structure;
pub use threads::Threads;
pub use tumble_team::TeamError;
