//! Shapes of the plane as thin solids around z = 0.

use glam::{DVec2, DVec3};
use tumble_math::trig;

use super::{Detail, Look, Mesh};
use crate::dim::Geometry;

/// Corners of a full circle.
const CORNERS: usize = 48;

impl Mesh {
    /// The shape, as thick as the detail says.
    pub fn of_planar(shape: &Geometry, detail: &Detail) -> Self {
        match shape {
            Geometry::Rod { from, to, radius } => {
                let wide = if *radius > 0.0 { *radius } else { detail.thin };
                let along = (*to - *from).normalize_or(DVec2::X);
                let start = trig::atan2(along.y, along.x) - std::f64::consts::FRAC_PI_2;
                let mut outline = arc(*to, wide, start, CORNERS / 2);
                outline.extend(arc(*from, wide, start + std::f64::consts::PI, CORNERS / 2));
                prism(&outline, detail.half_thickness)
            }
            Geometry::Disc { centre, radius } => {
                let (from, length) = (centre.extend(-detail.half_thickness), 2.0 * detail.half_thickness);
                let mut mesh = Self::default();
                mesh.add_cylinder(from, DVec3::Z, length, *radius);
                mesh
            }
            Geometry::Polygon { points } => prism(points, detail.half_thickness),
            Geometry::HalfPlane { point, normal } => {
                let along = DVec2::new(normal.y, -normal.x);
                let middle = *point + along * along.dot(detail.middle.truncate() - *point);
                let (side, deep) = (along * detail.ground, *normal * -detail.ground);
                let corners = [middle + side, middle - side, middle - side + deep, middle + side + deep];
                // A shelf, wide enough to throw shadows on.
                Self { look: Look::Ground, ..prism(&corners, 12.0 * detail.half_thickness) }
            }
        }
    }
}

/// Corners of an arc, counter-clockwise, both ends included.
fn arc(centre: DVec2, radius: f64, start: f64, corners: usize) -> Vec<DVec2> {
    let corner = |i: usize| {
        let (sin, cos) = trig::sin_cos(start + std::f64::consts::TAU * i as f64 / CORNERS as f64);
        centre + DVec2::new(cos, sin) * radius
    };
    (0..=corners).map(corner).collect()
}

/// A polygon, counter-clockwise, pulled out to both sides.
fn prism(outline: &[DVec2], half_thickness: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |point: &DVec2, z: f64| point.extend(z);
    let front: Vec<DVec3> = outline.iter().map(|point| at(point, half_thickness)).collect();
    let back: Vec<DVec3> = outline.iter().rev().map(|point| at(point, -half_thickness)).collect();
    mesh.add_polygon(&front, DVec3::Z);
    mesh.add_polygon(&back, DVec3::NEG_Z);
    for (index, from) in outline.iter().enumerate() {
        let to = &outline[(index + 1) % outline.len()];
        let side = *to - *from;
        if let Some(normal) = DVec2::new(side.y, -side.x).try_normalize() {
            let corners =
                [at(from, -half_thickness), at(to, -half_thickness), at(to, half_thickness), at(from, half_thickness)];
            mesh.add_polygon(&corners, normal.extend(0.0));
        }
    }
    mesh
}
