//! Two corners: the normal joins them.

use glam::DVec2;

use super::core::Core;
use crate::manifold::{ContactKind, ContactPoint, FeatureId, PlanarManifold};

/// Distance below which two corners are at one place, relative to how far both are from the origin of the pair [1].
///
/// A few units of rounding: the direction between closer corners is noise.
const ONE_PLACE: f64 = 1e-15;

/// The contact of the two closest corners; along `fallback` when they are at one place.
pub(super) fn closest(a: &Core, b: &Core, fallback: DVec2, origin: DVec2, margin: f64) -> PlanarManifold {
    let mut closest = (f64::INFINITY, (0, 0));
    for i in 0..a.vertex_count() {
        let vertex_a = a.vertex(i);
        for j in 0..b.vertex_count() {
            let squared = vertex_a.distance_squared(b.vertex(j));
            if squared < closest.0 {
                closest = (squared, (i, j));
            }
        }
    }
    let (squared, corners) = closest;
    let (vertex_a, vertex_b) = (a.vertex(corners.0), b.vertex(corners.1));
    let distance = squared.sqrt();
    let apart = distance > ONE_PLACE * (vertex_a.length() + vertex_b.length());
    let normal = if apart { (vertex_b - vertex_a) * (1.0 / distance) } else { fallback };
    along(a, b, corners, normal, origin, margin)
}

/// The contact of two corners along a given normal.
pub(super) fn along(
    a: &Core,
    b: &Core,
    corners: (usize, usize),
    normal: DVec2,
    origin: DVec2,
    margin: f64,
) -> PlanarManifold {
    let (vertex_a, vertex_b) = (a.vertex(corners.0), b.vertex(corners.1));
    let separation = normal.dot(vertex_b - vertex_a) - a.radius - b.radius;
    if separation > margin || separation.is_nan() {
        return PlanarManifold::EMPTY;
    }
    let mut manifold = PlanarManifold::along(normal);
    manifold.insert(ContactPoint {
        point: (vertex_a + normal * a.radius + vertex_b - normal * b.radius) * 0.5 + origin,
        separation,
        feature: FeatureId::vertices(corners.0, corners.1),
        kind: match (a.radius > 0.0, b.radius > 0.0) {
            (true, true) => ContactKind::RoundRound,
            (false, false) => ContactKind::VertexVertex,
            _ => ContactKind::RoundVertex,
        },
    });
    manifold
}
