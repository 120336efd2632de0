//! What a body is: components over the value type, so that plane and space share them and users need no type annotations.
//!
//! ```
//! # use tumble_sim::{AngularVelocity, Position, Simulation, Settings};
//! # use glam::dvec2;
//! # let mut simulation = Simulation::new(Settings::default());
//! simulation.spawn((Position(dvec2(0.0, 5.0)), AngularVelocity(0.5)));
//! ```
//!
//! [`Position`] brings the others with it. Mass comes from the body's [parts](crate::Part), or is given outright by [`MassOverride`].

mod kinematic;
mod mass;
mod state;
mod table;
mod view;

pub use kinematic::{Keyframe, Keyframes, follow_keyframes};
pub use mass::{
    BodyInertia, CentreOverride, InertiaOverride, InverseInertia, InverseMass, Lock, LockedAxes, Mass, MassOverride,
    Pinned,
};
pub use state::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyId, BodyKind, Force, InDim, LinearVelocity, Orientation,
    Position, PreviousVelocity, Torque,
};
pub use table::{BodyEntry, BodyIndex, BodyTable};
pub(crate) use table::{PartFrame, prepare_bodies};
pub use view::BodyView;
