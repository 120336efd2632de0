//! A triangle of ground and another shape.

use tumble_shape::Facet;

use super::Pair;
use super::core::Solid;
use super::draft::Owner;
use super::{cut, face, hulls, rims, round};
use crate::manifold::SpatialManifold;

/// Contact points of facet a and a shape.
///
/// The prism below the triangle collides as a polyhedron. Along a normal that the facet does not allow, the shape touches an inner
/// edge of the mesh, or the prism's sides: then only what lies above the triangle counts, with the normal of the triangle.
pub(super) fn collide(pair: &Pair, facet: &Facet, other: &Solid) -> SpatialManifold {
    let prism = facet.prism();
    let manifold = match *other {
        Solid::Hull(hull, _) => hulls::collide(pair, prism, hull, None),
        Solid::Segment(ends, radius) => round::collide(pair, prism, ends, radius),
        Solid::Point(centre, radius) => round::collide(pair, prism, &[centre], radius),
        Solid::Rims(ends, radii) => rims::collide(pair, &Solid::Facet(facet), ends, radii),
        Solid::Facet(_) => return SpatialManifold::EMPTY,
    };
    if manifold.is_empty() || facet.allows(pair.a_in_world.unturned(manifold.normal)) {
        return manifold;
    }
    let top = &prism.faces()[0];
    // What is through the prism is on the other side of the ground.
    let thickness = top.offset - top.normal.dot(prism.vertices()[3]);
    let place = &pair.b_in_a;
    let (mut cut, radius) = match *other {
        Solid::Hull(hull, _) => {
            let down = place.unturned(top.normal);
            let cut_by = |facing: usize| cut::polygon(prism, top, hull, &hull.faces()[facing], place);
            let squarest = cut_by(face::facing(hull, down));
            // The squarest face need not have the lowest corner.
            let lowest = cut_by(face::facing_at_lowest(hull, down).0);
            (if face::lowest(&lowest) < face::lowest(&squarest) - pair.rounding() { lowest } else { squarest }, 0.0)
        }
        Solid::Segment(ends, radius) => (cut::segment(prism, top, ends.map(|end| place.point(end))), radius),
        Solid::Point(centre, radius) => (cut::point(prism, top, place.point(centre)), radius),
        Solid::Rims(ends, radii) => return rims::on_top(pair, prism, ends, radii, -thickness),
        Solid::Facet(_) => return SpatialManifold::EMPTY,
    };
    cut.retain(|point| point.height - radius >= -thickness);
    face::choose(pair, top, &mut cut, radius);
    face::manifold(pair, Owner::A, top, &cut, radius)
}
