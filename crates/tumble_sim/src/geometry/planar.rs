//! Shapes and contacts of the plane.

use glam::DVec2;
use tumble_collision::{ContactPoint, OrientedBox, PlanarManifold, PlanarQuery, Volume, collide};
use tumble_math::{Planar, PlanarRotation, Pose, Rotation};
use tumble_shape::{MassProperties, PlanarShape};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointEnds, JointError, JointRow, distance, fixed, prismatic, revolute};

use super::{ContactQuery, Geometry, Posed};
use crate::engine::Engine;
use crate::joint::{JointEntry, JointKind};
use crate::part::Amount;

impl Geometry for Planar {
    type Shape = PlanarShape;
    type OrientedBox = OrientedBox;
    type Manifold = PlanarManifold;
    type PerPoint<T: Copy + std::fmt::Debug + Default + Send + Sync + 'static> = [T; 2];

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

    fn round_axis(_: &PlanarShape) -> Option<[DVec2; 2]> {
        None
    }

    fn edge_direction(_: &PlanarShape, _: usize) -> Option<DVec2> {
        None
    }

    fn collide(a: Posed<'_, Self>, b: Posed<'_, Self>, query: &ContactQuery<'_, Self>) -> PlanarManifold {
        let query = PlanarQuery {
            margin: query.margin,
            flush_tolerance: query.flush_tolerance,
            previous: Some(query.previous).filter(|previous| !previous.is_empty()),
        };
        collide(a.shape, a.pose, b.shape, b.pose, &query)
    }

    fn points(manifold: &PlanarManifold) -> &[ContactPoint<DVec2>] {
        manifold.points()
    }

    fn normal(manifold: &PlanarManifold) -> DVec2 {
        manifold.normal
    }

    fn carry(manifold: &mut PlanarManifold, normal: DVec2, place: impl FnMut(usize) -> (DVec2, f64)) {
        manifold.carry(normal, place);
    }

    fn push_joint_rows(
        joint: &JointEntry<Self>,
        ends: &JointEnds<Self>,
        rotations: [&PlanarRotation; 2],
        bodies: &[SolverBody<Self>],
        rows: &mut Vec<JointRow<Self>>,
    ) -> Result<(), JointError> {
        let [a, b] = rotations;
        let turned = || b.angle() - a.angle() - joint.held.angle();
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
