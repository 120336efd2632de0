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
/// A polyhedron touches with the corners of one face: of those around its lowest corner, the one that lies flattest. A cylinder or cone
/// touches with places on its rims, and the tip.
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
        // Both are ground.
        Solid::Facet(_) => return SpatialManifold::EMPTY,
        Solid::Rims(ends, radii) => (places_on_rims(ends, radii, normal, pair.preference(), at), 0.0),
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

/// Four places on the lower rim, a quarter of a turn apart, and the lowest of the other rim (or the tip), in the order of a polygon.
///
/// ```text
///        1                    seen along the axis: place 0 is the lowest of the rim. Of a rim that lies
///      .' '.                  flat, to the preference, every place is as low: there the four stay where
///   2 (  ·  ) 0  ↓ downhill   they are on the body, so that they do not wander with rounding.
///      '._.'
///        3
/// ```
fn places_on_rims(
    ends: [DVec3; 2],
    radii: [f64; 2],
    normal: DVec3,
    flat: f64,
    at: impl Fn(DVec3, u32) -> CutPoint,
) -> Cut {
    let axis = (ends[1] - ends[0]).try_normalize().unwrap_or(DVec3::Z);
    let downhill = axis * normal.dot(axis) - normal;
    let steepness = downhill.length();
    let fixed = axis.any_orthonormal_vector();
    let lies_flat = steepness * radii[0] <= flat;
    let out = if lies_flat { fixed } else { downhill * (1.0 / steepness) };
    let across = axis.cross(out);
    let places = |end: usize| {
        let arms = [out, across, -out, -across];
        std::array::from_fn::<_, 4, _>(|k| at(ends[end] + arms[k] * radii[end], (4 * end + k) as u32))
    };
    let low = |end: usize| places(end).iter().map(|place| place.height).fold(f64::INFINITY, f64::min);
    let lower = usize::from(low(1) < low(0));
    if radii[lower] == 0.0 {
        return Cut::from_slice(&[places(lower)[0], places(1 - lower)[0]]);
    }
    let [lowest, one, opposite, other] = places(lower);
    // Standing flat, the other rim lies above this one and would only stand in for a place of it.
    if lies_flat {
        return Cut::from_slice(&[lowest, one, opposite, other]);
    }
    Cut::from_slice(&[lowest, one, opposite, other, places(1 - lower)[0]])
}
