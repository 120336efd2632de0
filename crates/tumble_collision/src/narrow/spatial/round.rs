//! Polyhedron and a point or segment with a radius.

use glam::DVec3;
use tumble_shape::ConvexHull;

use super::Pair;
use super::axis::{Axis, AxisOf, FlushFaces, Limits};
use super::cut::{self, Cut};
use super::draft::{Draft, Feature, Owner, feature_id, kind_of};
use super::{closest, face, segment};
use crate::manifold::SpatialManifold;

/// Contact points of hull a and the core of b (one or two vertices) grown by a radius [m].
pub(super) fn collide(pair: &Pair, hull: &ConvexHull, core: &[DVec3], radius: f64) -> SpatialManifold {
    let limits = Limits { margin: pair.query.margin + radius, preference: pair.preference(), flush: pair.flush() };
    let ends = [core[0], core[core.len() - 1]].map(|vertex| pair.b_in_a.point(vertex));
    let (best, flush) = best_axis(hull, ends, &limits);
    if best.separation > limits.margin {
        return pair.apart(best.normal);
    }
    let sharp = radius == 0.0;
    if sharp && flush.across(&best) {
        return pair.apart(best.normal);
    }

    let tolerance = limits.preference + pair.rounding();
    let fits = |distance: f64| best.separation <= 0.0 || distance <= best.separation + tolerance;
    match best.of {
        AxisOf::FaceA(number) | AxisOf::FaceB(number) => {
            let above = &hull.faces()[number];
            let mut cut =
                if core.len() == 2 { cut::segment(hull, above, ends) } else { cut::point(hull, above, ends[0]) };
            if !cut.is_empty() && fits(face::lowest(&cut)) {
                face::choose(pair, above, &mut cut, radius);
                return face::manifold(pair, Owner::A, above, &cut, radius);
            }
        }
        AxisOf::Edges(edge, _) => {
            let own = hull.edges()[edge].vertices.map(|vertex| hull.vertices()[vertex as usize]);
            let (s, t) = segment::closest(own, ends);
            let (on_a, on_b) = (own[0].lerp(own[1], s), ends[0].lerp(ends[1], t));
            if fits(on_a.distance(on_b)) {
                let mut draft = Draft::new(&pair.a_in_world, best.normal, pair.query.margin);
                let (of_a, of_b) = (Feature::Edge(edge as u32), Feature::Edge(0));
                let radii = [0.0, radius];
                let separation = best.separation - radius;
                let middle = on_b - best.normal * (radius + 0.5 * separation);
                draft.push(middle, separation, feature_id(of_a, of_b), kind_of(of_a, of_b, radii));
                return draft.finish();
            }
        }
    }
    closest::manifold(pair, hull, core, None, radius, best.normal)
        .unwrap_or_else(|| deepest(pair, hull, ends, radius, &best))
}

/// Overlapping cores, nothing of the segment above the face: its lower end.
fn deepest(pair: &Pair, hull: &ConvexHull, ends: [DVec3; 2], radius: f64, axis: &Axis) -> SpatialManifold {
    let lower = usize::from(axis.normal.dot(ends[1]) < axis.normal.dot(ends[0]));
    let number = match axis.of {
        AxisOf::FaceA(number) | AxisOf::FaceB(number) => number,
        AxisOf::Edges(edge, _) => hull.edges()[edge].faces[0] as usize,
    };
    let above = &hull.faces()[number];
    let height = above.normal.dot(ends[lower]) - above.offset;
    let source = cut::Source::Incident(lower as u32);
    let cut = Cut::from_slice(&[cut::CutPoint { place: ends[lower], height, source }]);
    face::manifold(pair, Owner::A, above, &cut, radius)
}

/// The separating axis of a hull and a segment (or a point, both ends alike), all in the hull's frame.
fn best_axis(hull: &ConvexHull, ends: [DVec3; 2], limits: &Limits) -> (Axis, FlushFaces) {
    let mut flush = FlushFaces::NONE;
    let mut best = Axis { of: AxisOf::FaceA(0), normal: DVec3::ZERO, separation: f64::NEG_INFINITY };
    for (i, face) in hull.faces().iter().enumerate() {
        let separation = face.normal.dot(ends[0]).min(face.normal.dot(ends[1])) - face.offset;
        flush.note(face.normal, separation, limits);
        if separation > best.separation {
            best = Axis { of: AxisOf::FaceA(i), normal: face.normal, separation };
        }
    }
    let along = ends[1] - ends[0];
    if along == DVec3::ZERO || best.separation > limits.margin {
        return (best, flush);
    }
    let mut least = best.separation + limits.preference;
    for (i, edge) in hull.edges().iter().enumerate() {
        let [left, right] = edge.faces.map(|face| hull.faces()[face as usize].normal);
        // The segment's normals are a great circle: does the edge's arc cross it?
        if left.dot(along) * right.dot(along) >= 0.0 {
            continue;
        }
        let [from, to] = edge.vertices.map(|vertex| hull.vertices()[vertex as usize]);
        let across = (to - from).cross(along);
        let outwards = if across.dot(left + right) < 0.0 { -1.0 } else { 1.0 };
        let Some(normal) = (across * outwards).try_normalize() else { continue };
        let separation = normal.dot(ends[0]).min(normal.dot(ends[1])) - normal.dot(from).max(normal.dot(to));
        if separation > least {
            least = separation;
            best = Axis { of: AxisOf::Edges(i, 0), normal, separation };
        }
    }
    (best, flush)
}
