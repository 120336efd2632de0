//! What differs between recordings of the plane and of space.

mod planar;
mod spatial;

use std::fmt::Debug;

use glam::{DQuat, DVec3};
use serde::Serialize;
use serde::de::DeserializeOwned;
use tumble_sim::Geometry as Shapes;

use crate::mesh::{Detail, Mesh};
use crate::recording::{BodyState, ContactRecord};

pub use planar::Geometry;
pub use spatial::SpatialGeometry;

/// A value that a recording holds: plain numbers, which serde writes in a fixed order.
pub trait Plain: Copy + Debug + Default + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static {}

impl<T> Plain for T where T: Copy + Debug + Default + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static {}

/// What differs between recordings of the plane and of space. Everything else is written once, over this trait.
pub trait RecordDim: Shapes<Vector: Plain, Angular: Plain, Inertia: Plain> {
    /// Body axes to world axes: the angle, accumulated over turns [rad], or a unit quaternion x, y, z, w.
    type Orientation: Plain;
    /// Friction of a contact on b: a number along the tangent (n_y, −n_x), or a vector in world axes.
    type Tangent: Plain;
    /// Outline of a shape in the body frame.
    type Outline: Clone + Debug + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static;
    /// Pose and velocity as a row of numbers.
    type Numbers: AsRef<[f64]>;

    /// Inertia of what no torque turns.
    const INFINITE_INERTIA: Self::Inertia;
    /// Names of the columns that hold this dimension's values.
    const COLUMNS: Columns;
    /// Whether the dimension has a quantity that is not of both.
    const HOME: Home;

    /// Rotation as a recording holds it.
    fn orientation(rotation: &Self::Rotation) -> Self::Orientation;

    /// Rotation of what a recording holds.
    fn rotation(orientation: &Self::Orientation) -> Self::Rotation;

    /// Outline of a shape.
    fn outline(shape: &Self::Shape) -> Self::Outline;

    /// Part along the surface of an impulse on b [N·s].
    fn tangent_impulse(normal: Self::Vector, impulse_on_b: Self::Vector) -> Self::Tangent;

    /// The same as a vector in world axes [N·s].
    fn tangent_vector(normal: Self::Vector, tangent_impulse: Self::Tangent) -> Self::Vector;

    /// Friction on a body as one number, from its contacts, each with 1 where the body is b and −1 where it is a [N·s].
    fn friction<'a>(contacts: impl Iterator<Item = (&'a ContactRecord<Self>, f64)>) -> f64;

    /// Position, orientation, velocity, rate of turn: the order of the columns of `trajectory.csv` and of the fingerprint.
    fn numbers(state: &BodyState<Self>) -> Self::Numbers;

    /// The vector in space; z = 0 in the plane.
    fn embed(vector: Self::Vector) -> DVec3;

    /// The orientation in space; about z in the plane.
    fn quaternion(orientation: &Self::Orientation) -> DQuat;

    /// Surface of a shape, for pictures.
    fn mesh(outline: &Self::Outline, detail: &Detail) -> Mesh;

    /// The angle of an orientation; only in the plane [rad].
    fn angle(orientation: &Self::Orientation) -> Option<f64>;

    /// Part of an angular quantity about an axis; none where the dimension does not have the axis.
    fn about(angular: Self::Angular, axis: TurnAxis) -> Option<f64>;
}

/// Where a quantity is at home.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home {
    /// In the plane and in space.
    Both,
    /// Only in the plane.
    Plane,
    /// Only in space.
    Space,
}

impl Home {
    /// Word for it in messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::Both => "the plane and space",
            Self::Plane => "the plane",
            Self::Space => "space",
        }
    }
}

/// An axis to turn about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnAxis {
    /// The only one of the plane, towards the reader.
    Plane,
    /// World x.
    X,
    /// World y.
    Y,
    /// World z.
    Z,
}

/// Names of the columns of values that differ between the dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Columns {
    /// A point [m].
    pub point: &'static [&'static str],
    /// An orientation.
    pub orientation: &'static [&'static str],
    /// A velocity [m/s].
    pub velocity: &'static [&'static str],
    /// A rate of turn [rad/s].
    pub angular_velocity: &'static [&'static str],
    /// A unit normal [1].
    pub normal: &'static [&'static str],
    /// An impulse along the surface [N·s].
    pub tangent_impulse: &'static [&'static str],
    /// A momentum [kg·m/s].
    pub momentum: &'static [&'static str],
    /// An angular momentum [kg·m²/s].
    pub angular_momentum: &'static [&'static str],
    /// A force [N].
    pub force: &'static [&'static str],
    /// A torque [N·m].
    pub torque: &'static [&'static str],
}
