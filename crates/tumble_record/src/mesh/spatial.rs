//! Shapes of space.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{Detail, Fields, Look, Mesh, Ring, arc};
use crate::dim::SpatialGeometry;

/// Rings from the equator of a ball to its pole.
const RINGS: usize = 8;

impl Mesh {
    /// The shape; a half-space as a square of its surface.
    pub fn of_spatial(shape: &SpatialGeometry, detail: &Detail) -> Self {
        let mut mesh = Self::default();
        match shape {
            SpatialGeometry::Sphere { centre, radius } => {
                let rings: Vec<Ring> = arc(0.0, *radius, -FRAC_PI_2, FRAC_PI_2, 2 * RINGS).collect();
                mesh.add_revolution(*centre, DVec3::Y, &rings, Fields::Board);
            }
            SpatialGeometry::Rod { from, to, radius } => {
                let wide = if *radius > 0.0 { *radius } else { detail.thin };
                let (axis, length) = direction(*from, *to);
                let ends = arc(0.0, wide, -FRAC_PI_2, 0.0, RINGS).chain(arc(length, wide, 0.0, FRAC_PI_2, RINGS));
                mesh.add_revolution(*from, axis, &ends.collect::<Vec<Ring>>(), Fields::Stripes);
            }
            SpatialGeometry::Polyhedron { points, faces } => {
                for face in faces {
                    let corners: Vec<DVec3> =
                        face.iter().filter_map(|&corner| points.get(corner as usize)).copied().collect();
                    mesh.add_polygon(&corners, normal_of(&corners));
                }
            }
            SpatialGeometry::Cylinder { from, to, radius } => {
                let (axis, length) = direction(*from, *to);
                mesh.add_cylinder(*from, axis, length, *radius);
            }
            SpatialGeometry::Cone { base, tip, radius } => {
                let (axis, length) = direction(*base, *tip);
                let slant = (length * length + radius * radius).sqrt();
                let out = (radius / slant, length / slant);
                let ring = |along, radius, normal| Ring { along, radius, normal };
                let bottom = [ring(0.0, 0.0, (-1.0, 0.0)), ring(0.0, *radius, (-1.0, 0.0))];
                for rings in [bottom, [ring(0.0, *radius, out), ring(length, 0.0, out)]] {
                    mesh.add_revolution(*base, axis, &rings, Fields::Stripes);
                }
            }
            SpatialGeometry::HalfSpace { point, normal } => {
                let middle = detail.middle - *normal * normal.dot(detail.middle - *point);
                let side = normal.any_orthonormal_vector() * detail.ground;
                let other = normal.cross(side);
                let corners =
                    [middle - side - other, middle + side - other, middle + side + other, middle - side + other];
                mesh.add_polygon(&corners, *normal);
                mesh.look = Look::Ground;
            }
            SpatialGeometry::Triangle { points } => mesh.add_polygon(points, normal_of(points)),
        }
        mesh
    }
}

/// Unit vector from one point to another, and their distance [m].
fn direction(from: DVec3, to: DVec3) -> (DVec3, f64) {
    ((to - from).normalize_or(DVec3::Y), from.distance(to))
}

/// Unit normal of a polygon (Newell), counter-clockwise seen from its tip.
fn normal_of(corners: &[DVec3]) -> DVec3 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).fold(DVec3::ZERO, |sum, (a, b)| sum + a.cross(*b)).normalize_or(DVec3::Y)
}
