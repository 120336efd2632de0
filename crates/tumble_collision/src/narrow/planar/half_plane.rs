//! Half-plane and core: the lowest corners touch.

use tumble_math::{Planar, Pose};
use tumble_shape::{HalfPlane, PlanarShape};

use super::core::{Core, Owner};
use crate::manifold::{ContactKind, ContactPoint, FeatureId, PlanarManifold};
use crate::narrow::PlanarQuery;

/// Contact points of a half-plane (shape a or b, as `plane_is` says) and another shape.
///
/// Of many corners near the surface two are enough, and the two that carry best are the outermost among those that are as low as
/// the lowest, to the flush tolerance. If the lowest is alone, the next one up is its neighbour and may land next.
pub(super) fn collide(
    plane: &HalfPlane,
    pose_plane: &Pose<Planar>,
    plane_is: Owner,
    shape: &PlanarShape,
    pose_shape: &Pose<Planar>,
    query: &PlanarQuery,
) -> PlanarManifold {
    let origin = pose_shape.position;
    let core = Core::new(shape, pose_shape, origin);
    let normal = plane.posed(&Pose { position: pose_plane.position - origin, rotation: pose_plane.rotation });
    let (normal, offset) = (normal.normal(), normal.offset());
    let tangent = normal.perp();

    let (lowest, height) = core.lowest(normal);
    let separation = height - offset - core.radius;
    if separation > query.margin || separation.is_nan() {
        return PlanarManifold::EMPTY;
    }
    let [mut left, mut right] = [lowest; 2];
    let mut second = None;
    let along = |i: usize| tangent.dot(core.vertex(i));
    for i in (0..core.vertex_count()).filter(|&i| i != lowest) {
        let height_i = normal.dot(core.vertex(i));
        if height_i <= height + query.flush_tolerance {
            left = if along(i) < along(left) { i } else { left };
            right = if along(i) > along(right) { i } else { right };
        }
        if second.is_none_or(|(_, least)| height_i < least) {
            second = Some((i, height_i));
        }
    }
    let pair = if left == right { (lowest, second.map(|(i, _)| i)) } else { (left, Some(right)) };

    let mut manifold = PlanarManifold::along(if plane_is == Owner::A { normal } else { -normal });
    for i in [Some(pair.0), pair.1].into_iter().flatten() {
        let vertex = core.vertex(i);
        let separation = normal.dot(vertex) - offset - core.radius;
        if separation <= query.margin {
            manifold.insert(ContactPoint {
                point: vertex - normal * (core.radius + 0.5 * separation) + origin,
                separation,
                feature: if plane_is == Owner::A { FeatureId::vertex_of_b(i) } else { FeatureId::vertex_of_a(i) },
                kind: if core.radius > 0.0 { ContactKind::RoundFace } else { ContactKind::VertexFace },
            });
        }
    }
    manifold
}
