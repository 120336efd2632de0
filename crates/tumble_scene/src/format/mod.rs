//! The scene format: plain types that mirror a RON file field by field.
//!
//! Everything a scene can say is declared here and nowhere else; the descriptions below become the descriptions of
//! `tumble schema`. Lengths are in metres, masses in kilograms, times in seconds, angles in degrees where the field's name
//! says so and in radians nowhere.
//!
//! **Design frame.** The parts of a body are written in a frame of their own, its design frame; `at` and `angle_degrees` place
//! that frame in the world. Every point of a body that a scene mentions (`centre`, the end of a spring, where a force acts) is a
//! point of the design frame. The *position* of a body in results and expectations is its centre of mass, wherever the
//! parts put it, and `velocity` is the velocity of that centre.

mod body;
mod coefficient;
mod contact;
mod expect;
mod force;
mod joint;
mod material;
mod part;
mod scene;

pub use body::{Axis, BodyEntry, BodyKind, Drag, Groups, Jitter, Keyframe, Repeat, RepeatGrid, RepeatLine};
pub use coefficient::Coefficient;
pub use contact::{
    ContactModel, ImpulseEntry, ModelEntries, PenaltyEntry, PenaltyLaw, RestitutionLaw, VelocityLcpEntry,
    VelocitySolver,
};
pub use expect::{
    AngleExpectation, AtRestExpectation, DepthExpectation, EnergyNeverRisesExpectation, Event, Expectation,
    FingerprintExpectation, ForceExpectation, FrictionExpectation, HappensExpectation, JointForceExpectation,
    JointForcePart, KeptExpectation, NeverExpectation, OrderExpectation, ScalarExpectation, TargetForce,
    VectorExpectation, When,
};
pub use force::{AnchorEntry, Axes, ForceEntry, SpringEntry};
pub use joint::{JointEntry, JointKind};
pub use material::{FrictionEntry, MaterialEntry, MaterialTable, PairEntry, Surface, Take};
pub use part::{BoxPart, DiscPart, HalfPlanePart, Part, PolygonPart, RodPart};
pub use scene::{Integrator, Scene};
