//! Shapes and contacts of space.

use std::fmt::Debug;

use glam::{DMat3, DVec3};
use tumble_collision::{
    ContactPoint, SpatialManifold, SpatialOrientedBox, SpatialQuery, Volume, collide_spatial as collide,
};
use tumble_math::{Dim, Matrix, Pose, Rotation, Spatial, SpatialRotation};
use tumble_shape::{ConvexHull, MassProperties, SpatialShape};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointEnds, JointError, JointRow, distance, revolute, spatial};

use super::{ContactQuery, Geometry, Posed};
use crate::engine::Engine;
use crate::joint::{JointEntry, SpatialJointKind};
use crate::part::Amount;

/// Appends the rows of a joint that holds directions, given by a frame in world axes as a and as b carry it.
type PushFrameRows = fn(&JointEnds<Spatial>, [&DMat3; 2], &[SolverBody<Spatial>], &mut Vec<JointRow<Spatial>>);

impl Geometry for Spatial {
    type Shape = SpatialShape;
    type OrientedBox = SpatialOrientedBox;
    type Manifold = SpatialManifold;
    type PerPoint<T: Copy + Debug + Default + Send + Sync + 'static> = [T; 4];

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
        // A ball is the same from all sides: a second look would say nothing new.
        if matches!(shape, SpatialShape::Sphere(_)) { None } else { SpatialOrientedBox::around(shape, pose, margin) }
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

    fn round_axis(shape: &SpatialShape) -> Option<[DVec3; 2]> {
        match shape {
            SpatialShape::Cylinder(cylinder) => Some([cylinder.ends()[0], cylinder.direction()]),
            SpatialShape::Cone(cone) => Some([cone.base(), cone.direction()]),
            _ => None,
        }
    }

    fn edge_direction(shape: &SpatialShape, number: usize) -> Option<DVec3> {
        let of_hull = |hull: &ConvexHull| {
            let [from, to] = hull.edges().get(number)?.vertices.map(|vertex| hull.vertices()[vertex as usize]);
            Some(to - from)
        };
        let along = match shape {
            SpatialShape::Cuboid(cuboid) => of_hull(cuboid.hull())?,
            SpatialShape::ConvexHull(hull) => of_hull(hull)?,
            SpatialShape::SpatialRod(rod) => rod.ends()[1] - rod.ends()[0],
            SpatialShape::Capsule(capsule) => capsule.ends()[1] - capsule.ends()[0],
            _ => return None,
        };
        along.try_normalize()
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

    fn carry(manifold: &mut SpatialManifold, normal: DVec3, place: impl FnMut(usize) -> (DVec3, f64)) {
        manifold.carry(normal, place);
    }

    fn push_joint_rows(
        joint: &JointEntry<Self>,
        ends: &JointEnds<Self>,
        [a, b]: [&SpatialRotation; 2],
        bodies: &[SolverBody<Self>],
        rows: &mut Vec<JointRow<Self>>,
    ) -> Result<(), JointError> {
        // A frame along the axis, as each of the bodies has carried it along since the joint was made.
        let carried = |axis: DVec3| {
            let frame = Self::contact_frame(axis.normalize());
            let of_b = DMat3::from_columns(|i| joint.held.unrotate(frame.col(i)));
            [a.to_matrix() * frame, b.to_matrix() * of_b]
        };
        let mut hold = |push: PushFrameRows, axis: DVec3| {
            let [of_a, of_b] = carried(axis);
            push(ends, [&of_a, &of_b], bodies, rows);
        };
        match joint.kind {
            SpatialJointKind::Revolute { axis } => hold(spatial::revolute::push_rows, axis),
            SpatialJointKind::Fixed => hold(spatial::fixed::push_rows, DVec3::X),
            SpatialJointKind::Prismatic { axis } => hold(spatial::prismatic::push_rows, axis),
            SpatialJointKind::Spherical => revolute::push_rows(ends, bodies, rows),
            SpatialJointKind::Distance { length } => distance::push_rows(ends, length, bodies, rows)?,
        }
        Ok(())
    }

    fn engine() -> &'static Engine<Self> {
        static SPATIAL: Engine<Spatial> = Engine::new();
        &SPATIAL
    }
}
