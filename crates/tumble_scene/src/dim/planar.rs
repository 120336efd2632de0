//! Scenes of the plane.

use std::path::Path;

use glam::DVec2;
use tumble_math::{Bounds, Planar, PlanarRotation, Pose, Rotation, SpatialRotation};
use tumble_shape::{MassProperties, PlanarShape};

use super::{AngularClaim, PartError, PartFields, SceneDim};
use crate::engine::SceneEngine;
use crate::exact::{before_normalization, degrees};
use crate::expect::Measured;
use crate::format::{
    BodyEntry, DiscPart, HalfPlanePart, JointKind, Keyframe, Part, PolygonPart, RodPart, ScalarExpectation,
};
use crate::shapes::planar_shape;

impl SceneDim for Planar {
    fn scene_engine() -> &'static SceneEngine<Self> {
        static PLANAR: SceneEngine<Planar> = SceneEngine::new();
        &PLANAR
    }

    fn shapes(part: &Part) -> Result<Vec<PlanarShape>, PartError> {
        Ok(planar_shape(part)?.into_iter().collect())
    }

    fn read_file(_: &mut Part, _: Option<&Path>) -> Result<(), PartError> {
        Ok(())
    }

    fn are_pieces(_: &PlanarShape, _: &PlanarShape) -> bool {
        false
    }

    fn part(shapes: &[&PlanarShape], fields: PartFields) -> Option<Part> {
        let (density, mass) = fields.density_and_mass();
        let PartFields { material, sensor, groups, collides_with, .. } = fields;
        Some(match shapes.first()? {
            PlanarShape::Rod(rod) => {
                let (from, to, radius) = (rod.from(), rod.to(), rod.radius());
                Part::Rod(RodPart { from, to, radius, density, mass, material, sensor, groups, collides_with })
            }
            PlanarShape::Disc(disc) => {
                let (at, radius) = (disc.centre(), disc.radius());
                Part::Disc(DiscPart { at, radius, density, mass, material, sensor, groups, collides_with })
            }
            PlanarShape::ConvexPolygon(polygon) => {
                let points = polygon.points().to_vec();
                Part::Polygon(PolygonPart { points, density, mass, material, sensor, groups, collides_with })
            }
            PlanarShape::HalfPlane(plane) => {
                let (normal, offset) = (before_normalization(plane.normal()), plane.offset());
                Part::HalfPlane(HalfPlanePart { normal, offset, material, sensor, groups, collides_with })
            }
        })
    }

    fn bounds(shape: &PlanarShape) -> Option<Bounds<DVec2>> {
        shape.bounds(&Pose::<Self>::default())
    }

    fn inertia(entry: &f64) -> f64 {
        *entry
    }

    fn inertia_mistake(entry: &f64) -> Option<(String, String)> {
        (*entry <= 0.0).then(|| ("must be positive".to_owned(), format!("{entry} is not above 0")))
    }

    fn inertia_entry(inertia: f64) -> f64 {
        inertia
    }

    fn mass_mistake(of: &MassProperties<Self>) -> Option<String> {
        let is_sound = of.mass > 0.0 && of.inertia > 0.0 && of.mass.is_finite() && of.inertia.is_finite();
        (!is_sound).then(|| format!("mass {} kg, inertia {} kg·m²", of.mass, of.inertia))
    }

    fn design_rotation(body: &BodyEntry) -> PlanarRotation {
        PlanarRotation::from_degrees(body.angle_degrees)
    }

    fn rotation_mistake(_: &BodyEntry) -> Option<(&'static str, &'static str)> {
        None
    }

    fn write_rotation(body: &mut BodyEntry, rotation: PlanarRotation) {
        body.angle_degrees = degrees(rotation.angle());
    }

    fn random_turn(most_degrees: f64, mut draw: impl FnMut() -> f64) -> f64 {
        most_degrees * draw()
    }

    fn displace(body: &mut BodyEntry, offset: DVec2, degrees: f64) {
        body.at += offset;
        body.angle_degrees += degrees;
        for keyframe in &mut body.keyframes {
            keyframe.at += offset;
            keyframe.angle_degrees += degrees;
        }
    }

    fn keyframe_rotation(frame: &Keyframe) -> Option<PlanarRotation> {
        Some(PlanarRotation::from_degrees(frame.angle_degrees))
    }

    fn write_keyframe_rotation(frame: &mut Keyframe, rotation: PlanarRotation) {
        frame.angle_degrees = degrees(rotation.angle());
    }

    fn joint(kind: &JointKind, [a, b]: [DVec2; 2]) -> tumble_sim::JointKind {
        match *kind {
            JointKind::Revolute => tumble_sim::JointKind::Revolute,
            JointKind::Distance { length } => {
                tumble_sim::JointKind::Distance { length: length.unwrap_or_else(|| a.distance(b)) }
            }
            JointKind::Fixed => tumble_sim::JointKind::Fixed,
            JointKind::Prismatic { axis } => tumble_sim::JointKind::Prismatic { axis },
        }
    }

    fn joint_entry(kind: &tumble_sim::JointKind) -> JointKind {
        match *kind {
            tumble_sim::JointKind::Revolute => JointKind::Revolute,
            tumble_sim::JointKind::Distance { length } => JointKind::Distance { length: Some(length) },
            tumble_sim::JointKind::Fixed => JointKind::Fixed,
            tumble_sim::JointKind::Prismatic { axis } => JointKind::Prismatic { axis },
        }
    }

    fn angular_claim(claim: &ScalarExpectation) -> AngularClaim<'_> {
        AngularClaim::Scalar(claim)
    }

    fn measured(angular: f64) -> Measured {
        Measured::Number(angular)
    }

    fn shown_torque(torque: f64) -> f64 {
        torque
    }

    fn in_space(_: &PlanarRotation) -> Option<SpatialRotation> {
        None
    }

    fn orientation_between(from: &f64, to: &f64, share: f64) -> f64 {
        from + share * (to - from)
    }

    fn joint_gap(kind: &JointKind, between: DVec2, rotation_of_a: &PlanarRotation) -> f64 {
        match *kind {
            JointKind::Revolute | JointKind::Fixed => between.length(),
            JointKind::Distance { length } => length.map_or(0.0, |length| (between.length() - length).abs()),
            JointKind::Prismatic { axis } => rotation_of_a.rotate(axis).normalize_or_zero().perp_dot(between).abs(),
        }
    }

    fn joint_axis(kind: &JointKind) -> Option<DVec2> {
        if let JointKind::Prismatic { axis } = kind { Some(*axis) } else { None }
    }
}
