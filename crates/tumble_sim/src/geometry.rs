//! What the simulation asks of shapes: one trait over the dimension, so that everything above it is written once.

mod planar;
mod spatial;

use std::fmt::Debug;

use tumble_collision::{ContactPoint, TurningBox, Volume};
use tumble_math::Pose;
use tumble_shape::{MassDim, MassProperties};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointEnds, JointError, JointRow};
use tumble_solver::soft_step::SoftDim;

use crate::body::InDim;
use crate::engine::Engine;
use crate::joint::JointEntry;
use crate::part::Amount;

/// A shape and where its body is.
#[derive(Clone, Copy, Debug)]
pub struct Posed<'a, D: Geometry> {
    /// The shape, in the body frame.
    pub shape: &'a D::Shape,
    /// The body's pose.
    pub pose: &'a Pose<D>,
}

/// What is asked about a pair of shapes.
#[derive(Clone, Copy, Debug)]
pub struct ContactQuery<'a, D: Geometry> {
    /// Largest separation at which a point is made [m].
    pub margin: f64,
    /// Overlap that counts as lying flush [m].
    pub flush_tolerance: f64,
    /// The pair's manifold of the step before; without points for a new pair.
    pub previous: &'a D::Manifold,
}

/// Shapes and contacts of a dimension.
pub trait Geometry: MassDim<Vector: InDim<Dim = Self>> + SoftDim {
    /// A shape.
    type Shape: Clone + Debug + PartialEq + Send + Sync + 'static;
    /// A box that turns with a shape.
    type OrientedBox: TurningBox<Vector = Self::Vector> + Debug + Send + Sync + 'static;
    /// The contact points of two shapes.
    type Manifold: Clone + Debug + Default + Send + Sync + 'static;
    /// Something for each point of a manifold.
    type PerPoint<T: Copy + Debug + Default + Send + Sync + 'static>: AsRef<[T]>
        + AsMut<[T]>
        + Copy
        + Debug
        + Default
        + Send
        + Sync
        + 'static;

    /// Mass, centre and inertia of a shape; `None` for one without bounds.
    fn mass_properties(shape: &Self::Shape, amount: Amount) -> Option<MassProperties<Self>>;

    /// The shape moved by a vector.
    fn translated(shape: &Self::Shape, by: Self::Vector) -> Self::Shape;

    /// Where the shape of a body is.
    fn volume(shape: &Self::Shape, pose: &Pose<Self>) -> Volume<Self::Vector>;

    /// A close box around the shape of a body, grown by a margin [m]; `None` for one without bounds, and where it would be no closer than the
    /// volume.
    fn oriented_box(shape: &Self::Shape, pose: &Pose<Self>, margin: f64) -> Option<Self::OrientedBox>;

    /// Largest distance of a point of the shape from the origin of its frame [m]; `None` for one without bounds.
    fn extent(shape: &Self::Shape) -> Option<f64>;

    /// The two ends of a rod, in the frame of the shape [m]; `None` for other shapes.
    fn rod_ends(shape: &Self::Shape) -> Option<[Self::Vector; 2]>;

    /// Radius by which the corners of a shape are rounded [m].
    fn rounding(shape: &Self::Shape) -> f64;

    /// A point of the axis about which a shape is round, and a unit vector along it, in the frame of the shape; `None` for shapes that are
    /// round about no axis or about all.
    fn round_axis(shape: &Self::Shape) -> Option<[Self::Vector; 2]>;

    /// Unit vector along the edge of a number in a contact's feature, in the frame of the shape; `None` where the number means no
    /// straight edge.
    fn edge_direction(shape: &Self::Shape, number: usize) -> Option<Self::Vector>;

    /// Contact points of two shapes.
    fn collide(a: Posed<'_, Self>, b: Posed<'_, Self>, query: &ContactQuery<'_, Self>) -> Self::Manifold;

    /// The points of a manifold.
    fn points(manifold: &Self::Manifold) -> &[ContactPoint<Self::Vector>];

    /// The normal of a manifold, from a to b.
    fn normal(manifold: &Self::Manifold) -> Self::Vector;

    /// Moves the points to other places, along another normal: `place` tells the point and its separation by number.
    fn carry(manifold: &mut Self::Manifold, normal: Self::Vector, place: impl FnMut(usize) -> (Self::Vector, f64));

    /// Appends the rows of a joint whose bodies have these rotations.
    ///
    /// # Errors
    ///
    /// Where the joint has no direction to act in.
    fn push_joint_rows(
        joint: &JointEntry<Self>,
        ends: &JointEnds<Self>,
        rotations: [&Self::Rotation; 2],
        bodies: &[SolverBody<Self>],
        rows: &mut Vec<JointRow<Self>>,
    ) -> Result<(), JointError>;

    /// What makes and runs a simulation of this dimension: see [`Engine`].
    fn engine() -> &'static Engine<Self>;
}
