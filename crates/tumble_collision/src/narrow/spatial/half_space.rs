//! Half-space and another shape: what is lowest touches.

use glam::DVec3;
use tumble_shape::{ConvexHull, HalfSpace};

use super::Pair;
use super::core::Solid;
use super::cut::{Cut, CutPoint, Source};
use super::draft::{Draft, Owner, vertex_id};
use super::{face, reduce};
use crate::manifold::{ContactKind, SpatialManifold};

/// Contact points of half-space a and a shape.
///
/// A polyhedron touches with the corners of one face: of those around its lowest corner, the one that lies flattest.
pub(super) fn collide(pair: &Pair, plane: &HalfSpace, solid: &Solid) -> SpatialManifold {
    // All in the frame of b.
    let normal = pair.b_in_a.unturned(plane.normal());
    let offset = plane.offset() - plane.normal().dot(pair.b_in_a.origin);
    let at = |place: DVec3, vertex: u32| CutPoint {
        place,
        height: normal.dot(place) - offset,
        source: Source::Incident(vertex),
    };
    let (mut cut, radius) = match *solid {
        Solid::Hull(hull, _) => (lowest_face(hull, normal, at), 0.0),
        Solid::Segment(ends, radius) => (Cut::from_slice(&[at(ends[0], 0), at(ends[1], 1)]), radius),
        Solid::Point(centre, radius) => (Cut::from_slice(&[at(centre, 0)]), radius),
    };
    cut.retain(|point| point.height - radius <= pair.query.margin);
    reduce::to_four(&mut cut, normal, pair.preference());
    let mut draft = Draft::new(&pair.b_in_world, normal, pair.query.margin);
    for point in &cut {
        let Source::Incident(vertex) = point.source else { continue };
        let separation = point.height - radius;
        let kind = if radius > 0.0 { ContactKind::RoundFace } else { ContactKind::VertexFace };
        draft.push(point.place - normal * (radius + 0.5 * separation), separation, vertex_id(Owner::B, vertex), kind);
    }
    draft.finish()
}

fn lowest_face(hull: &ConvexHull, normal: DVec3, at: impl Fn(DVec3, u32) -> CutPoint) -> Cut {
    let (facing, _) = face::facing_at_lowest(hull, normal);
    hull.sides(&hull.faces()[facing])
        .iter()
        .map(|side| at(hull.vertices()[side.vertex as usize], side.vertex))
        .collect()
}
