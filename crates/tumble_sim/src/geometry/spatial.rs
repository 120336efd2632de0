//! Shapes and contacts of space.

use std::fmt::Debug;

use glam::DVec3;
use tumble_collision::{
    ContactPoint, SpatialManifold, SpatialOrientedBox, SpatialQuery, Volume, collide_spatial as collide,
};
use tumble_math::{Pose, Spatial, SpatialRotation};
use tumble_shape::{MassProperties, SpatialShape};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointEnds, JointError, JointRow, distance, revolute};

use super::{ContactQuery, Geometry, Posed};
use crate::engine::Engine;
use crate::joint::{JointEntry, JointKind};
use crate::part::Amount;

impl Geometry for Spatial {
    type Shape = SpatialShape;
    type OrientedBox = SpatialOrientedBox;
    type Manifold = SpatialManifold;
    type PerPoint<T: Copy + Debug + Default + Send + Sync + 'static> = [T; 4];

    const JOINTS_HOLD_DIRECTIONS: bool = false;

    fn mass_properties(shape: &SpatialShape, amount: Amount) -> Option<MassProperties<Self>> {
        match amount {
            Amount::Density(density) => shape.mass_properties(density),
            Amount::Mass(mass) => shape.mass_properties_of_mass(mass),
        }
    }

    fn translated(shape: &SpatialShape, by: DVec3) -> SpatialShape {
        shape.translated(by)
    }

    fn volume(shape: &SpatialShape, pose: &Pose<Self>) -> Volume<DVec3> {
        Volume::of_spatial(shape, pose)
    }

    fn oriented_box(shape: &SpatialShape, pose: &Pose<Self>, margin: f64) -> Option<SpatialOrientedBox> {
        SpatialOrientedBox::around(shape, pose, margin)
    }

    #[inline]
    fn boxes_overlap(one: &SpatialOrientedBox, other: &SpatialOrientedBox) -> bool {
        one.overlaps(other)
    }

    fn extent(shape: &SpatialShape) -> Option<f64> {
        shape.extent_about(DVec3::ZERO)
    }

    fn rod_ends(shape: &SpatialShape) -> Option<[DVec3; 2]> {
        match shape {
            SpatialShape::SpatialRod(rod) => Some(*rod.ends()),
            _ => None,
        }
    }

    fn rounding(shape: &SpatialShape) -> f64 {
        shape.radius()
    }

    fn collide(a: Posed<'_, Self>, b: Posed<'_, Self>, query: &ContactQuery<'_, Self>) -> SpatialManifold {
        // A manifold without points remembers along which direction the shapes were apart.
        let query = SpatialQuery {
            margin: query.margin,
            flush_tolerance: query.flush_tolerance,
            previous: Some(query.previous),
        };
        collide(a.shape, a.pose, b.shape, b.pose, &query)
    }

    fn points(manifold: &SpatialManifold) -> &[ContactPoint<DVec3>] {
        manifold.points()
    }

    fn normal(manifold: &SpatialManifold) -> DVec3 {
        manifold.normal
    }

    fn turn_between(a: &SpatialRotation, b: &SpatialRotation) -> DVec3 {
        a.turn_to(b).rotation_vector()
    }

    /// A revolute joint is a ball joint here: it holds a point and leaves all turning free.
    fn push_joint_rows(
        joint: &JointEntry<Self>,
        ends: &JointEnds<Self>,
        _: [&SpatialRotation; 2],
        bodies: &[SolverBody<Self>],
        rows: &mut Vec<JointRow<Self>>,
    ) -> Result<(), JointError> {
        match joint.kind {
            JointKind::Revolute => revolute::push_rows(ends, bodies, rows),
            JointKind::Distance { length } => distance::push_rows(ends, length, bodies, rows)?,
            JointKind::Fixed | JointKind::Prismatic { .. } => unreachable!("refused with the table of joints"),
        }
        Ok(())
    }

    fn engine() -> &'static Engine<Self> {
        static SPATIAL: Engine<Spatial> = Engine::new();
        &SPATIAL
    }
}
