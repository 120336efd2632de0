//! Mass of polyhedra: signed tetrahedra.
//!
//! The surface is cut into triangles; each makes a tetrahedron with an origin o, with a sign. For the tetrahedron o, o + p, o + q,
//! o + r with s = p + q + r,
//!
//! ```text
//! volume               V = p · (q × r) / 6
//! first moment         ∫ x dV = V s / 4
//! second moment        ∫ x xᵀ dV = V (p pᵀ + q qᵀ + r rᵀ + s sᵀ) / 20
//! inertia              I = ρ (tr(C) 1 − C) with C the sum of the second moments
//! ```
//!
//! (Tonon 2004; the off-diagonal entries of I are *minus* the products of inertia.) The first sum takes a vertex as o, the second
//! the centre of mass found by it, so that every term is positive and none cancels.

use glam::DVec3;
use tumble_math::{Spatial, SymmetricTensor};

use super::ConvexHull;
use crate::MassProperties;

/// Mass properties of a polyhedron at a density [kg/m³].
pub(super) fn of(hull: &ConvexHull, density: f64) -> MassProperties<Spatial> {
    let origin = hull.vertices()[0];
    let mut volume = 0.0;
    let mut first = DVec3::ZERO;
    for_each_triangle(hull, |corners| {
        let [p, q, r] = corners.map(|corner| corner - origin);
        let part = p.dot(q.cross(r)) / 6.0;
        volume += part;
        first += (p + q + r) * (0.25 * part);
    });
    let centre = origin + first * (1.0 / volume);

    // Diagonal of C, and its entries (2,3), (1,3), (1,2).
    let (mut diagonal, mut mixed) = (DVec3::ZERO, DVec3::ZERO);
    for_each_triangle(hull, |corners| {
        let [p, q, r] = corners.map(|corner| corner - centre);
        let twentieth = p.dot(q.cross(r)) / 120.0;
        for v in [p, q, r, p + q + r] {
            diagonal += v * v * twentieth;
            mixed += DVec3::new(v.y * v.z, v.x * v.z, v.x * v.y) * twentieth;
        }
    });
    let d = diagonal;
    let inertia = SymmetricTensor {
        diagonal: DVec3::new(d.y + d.z, d.z + d.x, d.x + d.y) * density,
        off_diagonal: -mixed * density,
    };
    MassProperties { mass: density * volume, centre, inertia }
}

/// Visits the triangles of the surface, counter-clockwise; faces are cut into fans.
fn for_each_triangle(hull: &ConvexHull, mut visit: impl FnMut([DVec3; 3])) {
    for face in hull.faces() {
        let sides = hull.sides(face);
        let place = |i: usize| hull.vertices()[sides[i].vertex as usize];
        for i in 1..sides.len() - 1 {
            visit([place(0), place(i), place(i + 1)]);
        }
    }
}
