//! The scene format: plain types that mirror a RON file field by field.
//!
//! Everything a scene can say is declared here and nowhere else; the descriptions below become the descriptions of
//! `tumble schema`. Lengths are in metres, masses in kilograms, times in seconds, angles in degrees where the field's name
//! says so and in radians nowhere.
//!
//! **Dimension.** A scene is of the plane unless it says `dimension: Spatial` at the top. Everything is the same for both but what
//! [`Dialect`] lists: vectors have three components in space, rates of turn and torques are vectors, shapes are [`SpatialPart`]s, and
//! bodies are placed by `orientation` instead of `angle_degrees`. Gravity pulls against y unless a scene says otherwise, so that a planar
//! scene is one of space at z = 0.
//!
//! **Design frame.** The parts of a body are written in a frame of their own, its design frame; `at` and `angle_degrees` or
//! `orientation` place that frame in the world. Every point of a body that a scene mentions (`centre`, the end of a spring, where a force acts) is a
//! point of the design frame. The *position* of a body in results and expectations is its centre of mass, wherever the
//! parts put it, and `velocity` is the velocity of that centre.

mod body;
mod coefficient;
mod contact;
mod dimension;
mod expect;
mod force;
mod joint;
mod material;
mod part;
mod planar_part;
mod scene;
mod spatial_part;
mod turn;

pub use body::{Axis, BodyEntry, BodyKind, Drag, Groups, Jitter, Keyframe, Repeat, RepeatGrid, RepeatLine};
pub use coefficient::Coefficient;
pub use contact::{
    ContactModel, ImpulseEntry, ModelEntries, PenaltyEntry, PenaltyLaw, RestitutionLaw, SleepEntry, SoftStepEntry,
    VelocityLcpEntry, VelocitySolver,
};
pub use dimension::{Absent, AsCounts, Dialect, Dimension, Entry};
pub use expect::{
    AngleExpectation, AtRestExpectation, Claim, DepthExpectation, EnergyNeverRisesExpectation, Event, Expectation,
    FingerprintExpectation, ForceExpectation, FrictionExpectation, HappensExpectation, JointForceExpectation,
    JointForcePart, KeptExpectation, NeverExpectation, OrderExpectation, OrientationExpectation, ScalarExpectation,
    TargetForce, TiltExpectation, VectorExpectation, When,
};
pub use force::{AnchorEntry, Axes, ForceEntry, SpringEntry};
pub use joint::{JointEntry, JointKind, JointKindEntry, SpatialJointKind};
pub use material::{FrictionEntry, MaterialEntry, MaterialTable, PairEntry, Surface, Take};
pub use part::{PartEntry, Shared};
pub use planar_part::{BoxPart, DiscPart, HalfPlanePart, Part, PolygonPart, RodPart};
pub use scene::{Integrator, Scene};
pub use spatial_part::{
    CapsulePart, ConePart, CylinderPart, HalfSpacePart, HeightFieldPart, HullFilePart, HullPart, MeshFilePart,
    MeshPart, SpatialBoxPart, SpatialPart, SpatialRodPart, SpherePart,
};
pub use turn::{InertiaEntry, OrientationEntry, TensorEntry, Turn};
