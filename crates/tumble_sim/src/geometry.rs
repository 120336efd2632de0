//! What the simulation asks of shapes: one trait over the dimension, so that everything above it is written once.

use std::fmt::Debug;

use glam::DVec2;
use tumble_collision::{ContactPoint, OrientedBox, PlanarManifold, PlanarQuery, Volume, collide as collide_planar};
use tumble_math::{Planar, PlanarRotation, Pose, Rotation};
use tumble_shape::{MassDim, MassProperties, PlanarShape};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointEnds, JointError, JointRow, distance, fixed, prismatic, revolute};

use crate::body::InDim;
use crate::engine::Engine;
use crate::joint::{JointEntry, JointKind};
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
pub trait Geometry: MassDim<Vector: InDim<Dim = Self>> {
    /// A shape.
    type Shape: Clone + Debug + PartialEq + Send + Sync + 'static;
    /// A box that turns with a shape.
    type OrientedBox: Copy + Debug + Send + Sync + 'static;
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

    /// A close box around the shape of a body, grown by a margin [m]; `None` for one without bounds.
    fn oriented_box(shape: &Self::Shape, pose: &Pose<Self>, margin: f64) -> Option<Self::OrientedBox>;

    /// Whether two boxes share a point.
    fn boxes_overlap(one: &Self::OrientedBox, other: &Self::OrientedBox) -> bool;

    /// Largest distance of a point of the shape from the origin of its frame [m]; `None` for one without bounds.
    fn extent(shape: &Self::Shape) -> Option<f64>;

    /// The two ends of a rod, in the frame of the shape [m]; `None` for other shapes.
    fn rod_ends(shape: &Self::Shape) -> Option<[Self::Vector; 2]>;

    /// Radius by which the corners of a shape are rounded [m].
    fn rounding(shape: &Self::Shape) -> f64;

    /// Contact points of two shapes.
    fn collide(a: Posed<'_, Self>, b: Posed<'_, Self>, query: &ContactQuery<'_, Self>) -> Self::Manifold;

    /// The points of a manifold.
    fn points(manifold: &Self::Manifold) -> &[ContactPoint<Self::Vector>];

    /// The normal of a manifold, from a to b.
    fn normal(manifold: &Self::Manifold) -> Self::Vector;

    /// By how much b is turned against a.
    fn turn_between(a: &Self::Rotation, b: &Self::Rotation) -> Self::Angular;

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

impl Geometry for Planar {
    type Shape = PlanarShape;
    type OrientedBox = OrientedBox;
    type Manifold = PlanarManifold;
    type PerPoint<T: Copy + Debug + Default + Send + Sync + 'static> = [T; 2];

    fn mass_properties(shape: &PlanarShape, amount: Amount) -> Option<MassProperties<Self>> {
        match amount {
            Amount::Density(density) => shape.mass_properties(density),
            Amount::Mass(mass) => shape.mass_properties_of_mass(mass),
        }
    }

    fn translated(shape: &PlanarShape, by: DVec2) -> PlanarShape {
        shape.translated(by)
    }

    fn volume(shape: &PlanarShape, pose: &Pose<Self>) -> Volume<DVec2> {
        Volume::of_planar(shape, pose)
    }

    fn oriented_box(shape: &PlanarShape, pose: &Pose<Self>, margin: f64) -> Option<OrientedBox> {
        OrientedBox::around(shape, pose, margin)
    }

    #[inline]
    fn boxes_overlap(one: &OrientedBox, other: &OrientedBox) -> bool {
        one.overlaps(other)
    }

    fn extent(shape: &PlanarShape) -> Option<f64> {
        shape.extent_about(DVec2::ZERO)
    }

    fn rod_ends(shape: &PlanarShape) -> Option<[DVec2; 2]> {
        match shape {
            PlanarShape::Rod(rod) => Some(*rod.ends()),
            _ => None,
        }
    }

    fn rounding(shape: &PlanarShape) -> f64 {
        match shape {
            PlanarShape::Rod(rod) => rod.radius(),
            PlanarShape::Disc(disc) => disc.radius(),
            _ => 0.0,
        }
    }

    fn collide(a: Posed<'_, Self>, b: Posed<'_, Self>, query: &ContactQuery<'_, Self>) -> PlanarManifold {
        let query = PlanarQuery {
            margin: query.margin,
            flush_tolerance: query.flush_tolerance,
            previous: Some(query.previous).filter(|previous| !previous.is_empty()),
        };
        collide_planar(a.shape, a.pose, b.shape, b.pose, &query)
    }

    fn points(manifold: &PlanarManifold) -> &[ContactPoint<DVec2>] {
        manifold.points()
    }

    fn normal(manifold: &PlanarManifold) -> DVec2 {
        manifold.normal
    }

    fn turn_between(a: &PlanarRotation, b: &PlanarRotation) -> f64 {
        b.angle() - a.angle()
    }

    fn push_joint_rows(
        joint: &JointEntry<Self>,
        ends: &JointEnds<Self>,
        rotations: [&PlanarRotation; 2],
        bodies: &[SolverBody<Self>],
        rows: &mut Vec<JointRow<Self>>,
    ) -> Result<(), JointError> {
        let [a, b] = rotations;
        let turned = || Self::turn_between(a, b) - joint.turned;
        match joint.kind {
            JointKind::Revolute => revolute::push_rows(ends, bodies, rows),
            JointKind::Distance { length } => distance::push_rows(ends, length, bodies, rows)?,
            JointKind::Fixed => fixed::push_rows(ends, turned(), bodies, rows),
            JointKind::Prismatic { axis } => prismatic::push_rows(ends, a.rotate(axis), turned(), bodies, rows)?,
        }
        Ok(())
    }

    fn engine() -> &'static Engine<Self> {
        static PLANAR: Engine<Planar> = Engine::new();
        &PLANAR
    }
}
