//! The separating axes of two polyhedra: faces first, then those pairs of edges that can still be better.
//!
//! The separation along a unit vector n is `min n·b − max n·a`. The ball of radius r_b around b's centre c_b lies inside b, so for
//! a face of a in the plane n·p = o
//!
//! ```text
//! separation ≤ h − r_b,     h = n · c_b − o   (height of b's centre above the face)
//! ```
//!
//! and a face whose bound is below the best separation found needs no look at b's vertices. The same holds for an edge of a: the
//! normals of its axes lie on the arc between the normals of its two faces, where n · (c_b − p) is at most what the heights h₁ and
//! h₂ above the two faces tell. Few edges that face the other shape are left, and of those, pairs count whose arcs cross on the
//! Gauss map (Gregorius 2013): only then do the two edges make a face of the Minkowski difference.

use glam::DVec3;
use smallvec::SmallVec;
use tumble_shape::ConvexHull;

use super::axis::{Axis, AxisOf, FlushFaces, Found, Limits, Search};
use super::place::Place;

/// Squared sine below which two edges count as parallel: they make no axis that faces do not make better [1].
const PARALLEL: f64 = 1e-16;

/// Squared sine below which the direction square to two edges is noisy, and its separation is measured over all vertices [1].
const NOISY: f64 = 1e-8;

type Heights = SmallVec<[f64; 32]>;

/// Searches the axes of polyhedra a and b, b's frame standing in a's.
pub(super) fn search(a: &ConvexHull, b: &ConvexHull, b_in_a: &Place, limits: &Limits) -> Search {
    let a_in_b = b_in_a.inverse();
    let mut flush = FlushFaces::NONE;
    // Heights of the one's centre above the other's faces.
    let above_a: Heights = heights(a, b_in_a.point(b.centre()));
    let above_b: Heights = heights(b, a_in_b.point(a.centre()));

    let (face, separation) = best_face(a, b, b_in_a, &above_a, f64::NEG_INFINITY, limits, &mut flush, |normal| normal);
    let face_a = Axis { of: AxisOf::FaceA(face), normal: a.faces()[face].normal, separation };
    if separation > limits.margin {
        return Search::Apart(face_a.normal);
    }
    let (face, separation) =
        best_face(b, a, &a_in_b, &above_b, separation, limits, &mut flush, |normal| b_in_a.vector(normal));
    let face_b = Axis { of: AxisOf::FaceB(face), normal: -b_in_a.vector(b.faces()[face].normal), separation };
    if separation > limits.margin {
        return Search::Apart(face_b.normal);
    }
    let least = face_a.separation.max(face_b.separation);
    let edges = search_edges([a, b], b_in_a, [&above_a, &above_b], least, limits.margin);
    if let Some(axis) = edges.filter(|axis| axis.separation > limits.margin) {
        return Search::Apart(axis.normal);
    }
    Search::Near(Found { face_a, face_b, edges, flush })
}

/// The face of a hull along which another one is farthest, and the separation there [m]; at least the one that looks best is looked at,
/// and others when they may be better than `least`.
fn best_face(
    hull: &ConvexHull,
    other: &ConvexHull,
    other_in_own: &Place,
    above: &Heights,
    least: f64,
    limits: &Limits,
    flush: &mut FlushFaces,
    in_a: impl Fn(DVec3) -> DVec3,
) -> (usize, f64) {
    let inner = other.inner_radius();
    // The face that the other shape is highest above comes first, and mostly stays the best.
    let first = highest(above);
    let mut best = (first, face_separation(hull, first, other, other_in_own));
    flush.note(in_a(hull.faces()[first].normal), best.1, limits);
    if best.1 > limits.margin {
        return best;
    }
    for (face, height) in above.iter().enumerate() {
        let bound = height - inner;
        let least = best.1.max(least);
        let wanted = if limits.flush > 0.0 { least.min(-limits.flush) } else { least };
        if face == first {
            continue;
        }
        if bound <= wanted {
            flush.note_deep(bound, limits);
            continue;
        }
        let separation = face_separation(hull, face, other, other_in_own);
        flush.note(in_a(hull.faces()[face].normal), separation, limits);
        if separation > best.1 {
            best = (face, separation);
        }
    }
    best
}

/// The separation along the normal of a face [m].
#[inline]
pub(super) fn face_separation(hull: &ConvexHull, face: usize, other: &ConvexHull, other_in_own: &Place) -> f64 {
    let face = &hull.faces()[face];
    lowest(other.vertices(), other_in_own.unturned(face.normal)) + face.normal.dot(other_in_own.origin) - face.offset
}

/// The best pair of edges with a separation above `least` [m].
fn search_edges(
    hulls: [&ConvexHull; 2],
    b_in_a: &Place,
    above: [&Heights; 2],
    least: f64,
    margin: f64,
) -> Option<Axis> {
    let [a, b] = hulls;
    let near_a = facing(a, above[0], least + b.inner_radius());
    if near_a.is_empty() {
        return None;
    }
    let near_b = facing(b, above[1], least + a.inner_radius());
    let mut best: Option<Axis> = None;
    let mut least = least;
    let edges_b: SmallVec<[EdgeInA; 16]> =
        near_b.iter().map(|&edge| EdgeInA::new(b, edge as usize, Some(b_in_a))).collect();
    for &i in &near_a {
        let one = EdgeInA::new(a, i as usize, None);
        for (other, &j) in edges_b.iter().zip(&near_b) {
            let Some((normal, separation)) = separation_of_edges(hulls, b_in_a, &one, other) else { continue };
            if separation > least {
                least = separation;
                best = Some(Axis { of: AxisOf::Edges(i as usize, j as usize), normal, separation });
                if separation > margin {
                    return best;
                }
            }
        }
    }
    best
}

/// The separation along the direction square to two edges, if they make a face of the Minkowski difference.
pub(super) fn separation_of_edges(
    [a, b]: [&ConvexHull; 2],
    b_in_a: &Place,
    one: &EdgeInA,
    other: &EdgeInA,
) -> Option<(DVec3, f64)> {
    if !arcs_cross(one, other) {
        return None;
    }
    let across = one.along.cross(other.along);
    let squared = across.length_squared();
    let lengths = one.along.length_squared() * other.along.length_squared();
    if squared <= PARALLEL * lengths {
        return None;
    }
    let outwards = if across.dot(one.normals[0] + one.normals[1]) < 0.0 { -1.0 } else { 1.0 };
    let normal = across * (outwards / squared.sqrt());
    let noisy = squared <= NOISY * lengths;
    Some((normal, if noisy { along(a, b, b_in_a, normal) } else { normal.dot(other.on - one.on) }))
}

/// The separation along a unit vector from a to b, in a's frame [m].
pub(super) fn along(a: &ConvexHull, b: &ConvexHull, b_in_a: &Place, normal: DVec3) -> f64 {
    lowest(b.vertices(), b_in_a.unturned(normal)) + normal.dot(b_in_a.origin) + lowest(a.vertices(), -normal)
}

/// An edge in the frame of a: one end, the vector to the other, and the normals of its two faces.
pub(super) struct EdgeInA {
    on: DVec3,
    along: DVec3,
    normals: [DVec3; 2],
}

impl EdgeInA {
    pub(super) fn new(hull: &ConvexHull, edge: usize, place: Option<&Place>) -> Self {
        let edge = &hull.edges()[edge];
        let [from, to] = edge.vertices.map(|vertex| hull.vertices()[vertex as usize]);
        let normals = edge.faces.map(|face| hull.faces()[face as usize].normal);
        match place {
            None => Self { on: from, along: to - from, normals },
            Some(place) => Self {
                on: place.point(from),
                along: place.vector(to - from),
                normals: normals.map(|normal| place.vector(normal)),
            },
        }
    }
}

/// Whether the arc of one edge and the mirrored arc of the other cross on the Gauss map.
///
/// An edge with the faces left and right has the direction n_l × n_r, so the four triple products are products with it.
#[inline]
fn arcs_cross(one: &EdgeInA, other: &EdgeInA) -> bool {
    let (left, right) = (other.normals[0].dot(one.along), other.normals[1].dot(one.along));
    if left * right >= 0.0 {
        return false;
    }
    let (own_left, own_right) = (one.normals[0].dot(other.along), one.normals[1].dot(other.along));
    own_left * own_right < 0.0 && left * own_right < 0.0
}

/// Heights of a point above the faces of a hull, in its frame [m].
fn heights(hull: &ConvexHull, point: DVec3) -> Heights {
    hull.faces().iter().map(|face| face.normal.dot(point) - face.offset).collect()
}

fn highest(heights: &Heights) -> usize {
    let mut best = 0;
    for (face, &height) in heights.iter().enumerate() {
        if height > heights[best] {
            best = face;
        }
    }
    best
}

/// Smallest direction · v over vertices [m].
#[inline]
pub(super) fn lowest(vertices: &[DVec3], direction: DVec3) -> f64 {
    vertices
        .iter()
        .map(|vertex| direction.dot(*vertex))
        .fold(f64::INFINITY, |least, height| if height < least { height } else { least })
}

/// The edges for which some normal n of their arc may have n · (c − p) > `least`, c the centre of the other shape [m].
///
/// With the heights h₁ and h₂ of c above the two faces and the cosine k between their normals, the largest n · (c − p) is the distance
/// of c from the edge's line, √((h₁² + h₂² − 2 k h₁ h₂)/(1 − k²)), if its foot is on the arc, and else the larger height.
fn facing(hull: &ConvexHull, heights: &Heights, least: f64) -> SmallVec<[u32; 32]> {
    let mut found = SmallVec::new();
    for (i, edge) in hull.edges().iter().enumerate() {
        let [h1, h2] = edge.faces.map(|face| heights[face as usize]);
        // Most edges look away. A foot on the arc is at most half the arc from the nearer normal: distance ≤ height / √((1 + k)/2).
        let (k, higher) = (edge.cosine, h1.max(h2));
        if least > 0.0 && (higher <= 0.0 || 2.0 * higher * higher < least * least * (1.0 + k)) {
            continue;
        }
        let near = higher > least || {
            let on_arc = h1 >= k * h2 && h2 >= k * h1;
            on_arc && (least < 0.0 || h1 * h1 + h2 * h2 - 2.0 * k * h1 * h2 >= least * least * (1.0 - k * k))
        };
        if near {
            found.push(i as u32);
        }
    }
    found
}
