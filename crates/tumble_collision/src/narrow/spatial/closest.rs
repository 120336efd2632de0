//! Shapes that are closest at edges or corners, where no face or pair of edges faces the other: the normal joins the closest points.

use glam::DVec3;
use tumble_shape::ConvexHull;

use super::Pair;
use super::core::Core;
use super::draft::{Draft, Feature, feature_id, kind_of};
use super::gjk::{self, Closest};
use super::segment;
use crate::manifold::SpatialManifold;

/// Distance below which two points are at one place, relative to the size of the pair [1].
const ONE_PLACE: f64 = 1e-14;

/// Sine of the largest slope against the normal of an edge that lies beside a segment [1].
const LEVEL: f64 = 1e-2;

/// Manifold of hull a and another core (b's vertices with a radius), given a direction from a to b for a first guess.
///
/// `None` when the two overlap or touch to rounding.
pub(super) fn manifold(
    pair: &Pair,
    hull: &ConvexHull,
    b: &[DVec3],
    of_b: Option<&ConvexHull>,
    radius: f64,
    guess: DVec3,
) -> Option<SpatialManifold> {
    let core_b = Core::placed(b, &pair.b_in_a);
    let found = gjk::closest(&Core::own(hull.vertices()), &core_b, guess)?;
    let between = found.on_b - found.on_a;
    let distance = between.length();
    if distance <= ONE_PLACE * pair.size {
        return None;
    }
    let normal = between * (1.0 / distance);
    let mut draft = Draft::new(&pair.a_in_world, normal, pair.query.margin);
    let radii = [0.0, radius];
    if let ([from, to], None) = (b, of_b) {
        let ends = [*from, *to].map(|end| pair.b_in_a.point(end));
        if let Some(edge) = level_edge_beside(hull, &found, ends, normal) {
            let vertices = hull.edges()[edge].vertices;
            let own = vertices.map(|vertex| hull.vertices()[vertex as usize]);
            if let Some(stretch) = segment::beside(own, ends) {
                let edge = edge as u32;
                for (s, t) in stretch {
                    let of_a = at_end(s).map_or(Feature::Edge(edge), |end| Feature::Vertex(vertices[end]));
                    let of_b = at_end(t).map_or(Feature::Edge(0), |end| Feature::Vertex(end as u32));
                    let (on_a, on_b) = (own[0].lerp(own[1], s), ends[0].lerp(ends[1], t));
                    draft.between(on_a, on_b, radii, feature_id(of_a, of_b), kind_of(of_a, of_b, radii));
                }
                return Some(draft.finish());
            }
        }
    }
    let of_a = feature(&found, 0, Some(hull));
    let of_b = feature(&found, 1, of_b);
    draft.between(found.on_a, found.on_b, radii, feature_id(of_a, of_b), kind_of(of_a, of_b, radii));
    Some(draft.finish())
}

/// Which end a share is, if it is one.
pub(super) fn at_end(share: f64) -> Option<usize> {
    if share == 0.0 {
        Some(0)
    } else if share == 1.0 {
        Some(1)
    } else {
        None
    }
}

/// The vertex or edge that the closest point of one shape lies on; of a face, its first vertex stands for the point on the other side.
fn feature(found: &Closest, of: usize, hull: Option<&ConvexHull>) -> Feature {
    let mut ids = [found.simplex.points()[0].ids[of]; 2];
    for point in found.simplex.points() {
        if point.ids[of] != ids[0] {
            ids[1] = point.ids[of];
        }
    }
    if ids[0] == ids[1] {
        return Feature::Vertex(ids[0]);
    }
    ids.sort_unstable();
    // A segment is its own edge 0; two corners of a face need not share an edge.
    let edge = hull.map_or(Some(0), |hull| hull.edges().iter().position(|edge| edge.vertices == ids));
    Feature::Edge(edge.unwrap_or(0) as u32)
}

/// An edge of the hull at the closest point that runs square to the normal and along the segment.
fn level_edge_beside(hull: &ConvexHull, found: &Closest, ends: [DVec3; 2], normal: DVec3) -> Option<usize> {
    let along = (ends[1] - ends[0]).try_normalize()?;
    let ids = found.simplex.points().iter().map(|point| point.ids[0]);
    let touches = |edge: &tumble_shape::spatial::Edge| ids.clone().any(|id| edge.vertices.contains(&id));
    let mut best = (1.0 - 0.5 * LEVEL * LEVEL, None);
    for (i, edge) in hull.edges().iter().enumerate().filter(|(_, edge)| touches(edge)) {
        let [from, to] = edge.vertices.map(|vertex| hull.vertices()[vertex as usize]);
        let direction = (to - from).try_normalize()?;
        let cosine = direction.dot(along).abs();
        if direction.dot(normal).abs() <= LEVEL && cosine > best.0 {
            best = (cosine, Some(i));
        }
    }
    best.1
}
