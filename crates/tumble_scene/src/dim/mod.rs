//! What scenes ask of a dimension beyond how they are written: shapes, rotations, joints.

mod planar;
mod spatial;

use std::fmt;
use std::path::Path;

use thiserror::Error;
use tumble_math::{Bounds, Spatial, SpatialRotation};
use tumble_record::RecordDim;
use tumble_shape::{MassProperties, MeshError, ShapeError, SpatialShapeError};
use tumble_sim::{Amount, InDim};

use crate::engine::SceneEngine;
use crate::expect::Measured;
use crate::format::{BodyEntry, Dialect, Groups, Keyframe, ScalarExpectation, VectorExpectation};

/// Why a part has no shape.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PartError {
    /// Of a shape of the plane.
    #[error(transparent)]
    Planar(#[from] ShapeError),
    /// Of a shape of space.
    #[error(transparent)]
    Spatial(#[from] SpatialShapeError),
    /// Of ground made of triangles.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The surface in a file is no shape.
    #[error("the file \"{file}\" gives no shape: {problem}")]
    File {
        /// The file, as the scene names it.
        file: String,
        /// What is wrong with it.
        problem: String,
    },
    /// How it is turned means nothing.
    #[error("its orientation has an axis or a quaternion without direction")]
    Orientation,
    /// Rows of heights have different lengths.
    #[error("row {row} has {count} heights, but the first one has {first}")]
    Rows {
        /// Number of the row, counted from 0.
        row: usize,
        /// Its number of heights.
        count: usize,
        /// That of the first row.
        first: usize,
    },
}

/// What a part says besides its shape, when it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct PartFields {
    /// Density or mass.
    pub amount: Amount,
    /// Material, unless it is that of the body.
    pub material: Option<String>,
    /// Whether touching is only reported.
    pub sensor: bool,
    /// Groups, unless they are those of the body.
    pub groups: Option<Groups>,
    /// Groups it collides with, unless they are those of the body.
    pub collides_with: Option<Groups>,
}

impl PartFields {
    fn density_and_mass(&self) -> (Option<f64>, Option<f64>) {
        match self.amount {
            Amount::Density(density) => (Some(density), None),
            Amount::Mass(mass) => (None, Some(mass)),
        }
    }
}

/// A claim about the rate of turn.
#[derive(Clone, Copy, Debug)]
pub enum AngularClaim<'e> {
    /// In the plane.
    Scalar(&'e ScalarExpectation),
    /// In space.
    Vector(&'e VectorExpectation<Spatial>),
}

/// A dimension that scenes can be of.
pub trait SceneDim: Dialect + RecordDim {
    /// What reads, builds and judges scenes of this dimension: see [`SceneEngine`].
    fn scene_engine() -> &'static SceneEngine<Self>;

    /// Shapes of a part in the design frame: one, several of ground, none of a list.
    fn shapes(part: &Self::Part) -> Result<Vec<Self::Shape>, PartError>;

    /// Puts the contents of its file into a part that names one. The folder is that of the scene; a scene without one reads no files.
    fn read_file(part: &mut Self::Part, folder: Option<&Path>) -> Result<(), PartError>;

    /// Whether two shapes belong together, as pieces of ground do: one part may have them both.
    fn are_pieces(one: &Self::Shape, other: &Self::Shape) -> bool;

    /// The part that has these shapes, which are one, or pieces of ground; `None` for those that scenes cannot write.
    fn part(shapes: &[&Self::Shape], fields: PartFields) -> Option<Self::Part>;

    /// The smallest box around a shape, in its own frame [m]; `None` for one without bounds.
    fn bounds(shape: &Self::Shape) -> Option<Bounds<Self::Vector>>;

    /// Inertia that is given outright [kg·m²].
    fn inertia(entry: &Self::InertiaEntry) -> Self::Inertia;

    /// Why inertia cannot be given like this, in a message that goes on from "the inertia" and a label.
    fn inertia_mistake(entry: &Self::InertiaEntry) -> Option<(String, String)>;

    /// How inertia is written.
    fn inertia_entry(inertia: Self::Inertia) -> Self::InertiaEntry;

    /// Why no body can have this mass and inertia, if none can.
    fn mass_mistake(mass: &MassProperties<Self>) -> Option<String>;

    /// How the design frame of a body is turned; not at all where what is written means nothing.
    fn design_rotation(body: &BodyEntry<Self>) -> Self::Rotation;

    /// What is wrong with how the design frame of a body is turned, with the name of the field.
    fn rotation_mistake(body: &BodyEntry<Self>) -> Option<(&'static str, &'static str)>;

    /// Writes how the design frame of a body is turned.
    fn write_rotation(body: &mut BodyEntry<Self>, rotation: Self::Rotation);

    /// A turn out of random numbers from −1 to 1, of at most these degrees about each axis [degrees].
    fn random_turn(most_degrees: f64, draw: impl FnMut() -> f64) -> Self::Angular;

    /// Moves a body [m] and turns it [degrees], with its keyframes.
    fn displace(body: &mut BodyEntry<Self>, offset: Self::Vector, degrees: Self::Angular);

    /// How the design frame is turned at a keyframe; `None` where what is written means nothing.
    fn keyframe_rotation(frame: &Keyframe<Self>) -> Option<Self::Rotation>;

    /// Writes how the design frame is turned at a keyframe.
    fn write_keyframe_rotation(frame: &mut Keyframe<Self>, rotation: Self::Rotation);

    /// The joint that an entry means, of which the anchors are at these places at the start [m].
    fn joint(kind: &<Self as Dialect>::JointKind, ends: [Self::Vector; 2]) -> <Self::Vector as InDim>::JointKind;

    /// How a joint is written.
    fn joint_entry(kind: &<Self::Vector as InDim>::JointKind) -> <Self as Dialect>::JointKind;

    /// What is claimed about the rate of turn.
    fn angular_claim(claim: &Self::AngularExpectation) -> AngularClaim<'_>;

    /// An angular quantity as it is judged: a number in the plane, a vector in space.
    fn measured(angular: Self::Angular) -> Measured;

    /// A torque as one number: counter-clockwise in the plane, its magnitude in space [N·m].
    fn shown_torque(torque: Self::Angular) -> f64;

    /// The rotation, if it is one of space.
    fn in_space(rotation: &Self::Rotation) -> Option<SpatialRotation>;

    /// The orientation at a share of the way from one to another.
    fn orientation_between(from: &Self::Orientation, to: &Self::Orientation, share: f64) -> Self::Orientation;

    /// By how much the anchors are not where the joint wants them [m]: `between` leads from the first to the second, world axes.
    fn joint_gap(kind: &Self::JointKind, between: Self::Vector, rotation_of_a: &Self::Rotation) -> f64;

    /// The axis of a joint in the frame of its first body, for one that has an axis; of any length.
    fn joint_axis(kind: &Self::JointKind) -> Option<Self::Vector>;
}

/// A vector as people write it: `(1, 2)`.
pub(crate) struct Shown<V>(pub V, pub usize);

impl<V: tumble_math::Vector> fmt::Display for Shown<V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = self.1;
        let components: Vec<String> = (0..V::AXES).map(|axis| format!("{:.digits$}", self.0[axis])).collect();
        write!(formatter, "({})", components.join(", "))
    }
}
