//! A face and what lies on it.

use glam::DVec3;
use tumble_shape::{ConvexHull, spatial::Face};

use super::Pair;
use super::cut::{Cut, Source};
use super::draft::{Feature, Owner, feature_id, vertex_id};
use super::reduce;
use crate::manifold::{ContactKind, ContactPoint, SpatialManifold};

/// Smallest height of the points of a cut; infinite without any [m].
pub(super) fn lowest(cut: &Cut) -> f64 {
    cut.iter().map(|point| point.height).fold(f64::INFINITY, f64::min)
}

/// Leaves those points of a cut that are within the margin, and at most four; `round` is the radius of the other shape [m].
pub(super) fn choose(pair: &Pair, face: &Face, cut: &mut Cut, round: f64) {
    cut.retain(|point| point.height - round <= pair.query.margin);
    reduce::to_four(cut, face.normal, pair.preference());
}

/// The manifold of chosen points above a face of one of the shapes; `round` is the radius of the other one [m].
pub(super) fn manifold(pair: &Pair, owner: Owner, face: &Face, cut: &Cut, round: f64) -> SpatialManifold {
    let mut manifold = SpatialManifold::EMPTY;
    put(pair, owner, face, cut, round, &mut manifold);
    manifold
}

/// Puts chosen points above a face into an empty manifold, where it stands: it is large enough for copies of it to count.
#[inline]
pub(super) fn put(pair: &Pair, owner: Owner, face: &Face, cut: &Cut, round: f64, manifold: &mut SpatialManifold) {
    let (frame, normal) = match owner {
        Owner::A => (&pair.a_in_world, face.normal),
        Owner::B => (&pair.b_in_world, -face.normal),
    };
    manifold.normal = frame.vector(normal);
    for point in cut {
        let (feature, kind) = match point.source {
            Source::Incident(vertex) => (vertex_id(owner.other(), vertex), ContactKind::VertexFace),
            Source::Reference(vertex) => (vertex_id(owner, vertex), ContactKind::VertexFace),
            Source::Crossing { incident, reference } => {
                let edges = (Feature::Edge(incident), Feature::Edge(reference));
                let (of_a, of_b) = if owner == Owner::A { (edges.1, edges.0) } else { edges };
                (feature_id(of_a, of_b), ContactKind::EdgeEdge)
            }
        };
        let separation = point.height - round;
        let middle = point.place - face.normal * (round + 0.5 * separation);
        let kind = if round > 0.0 { ContactKind::RoundFace } else { kind };
        if separation <= pair.query.margin {
            manifold.insert(ContactPoint { point: frame.point(middle), separation, feature, kind });
        }
    }
}

/// The number of the face of a hull that faces a direction (in its own frame) most squarely.
pub(super) fn facing(hull: &ConvexHull, direction: DVec3) -> usize {
    let mut best = (f64::INFINITY, 0);
    for (i, face) in hull.faces().iter().enumerate() {
        let slope = face.normal.dot(direction);
        if slope < best.0 {
            best = (slope, i);
        }
    }
    best.1
}

/// The vertex that is lowest along a direction (in the hull's own frame), and of the faces around it the one that faces most squarely.
pub(super) fn facing_at_lowest(hull: &ConvexHull, direction: DVec3) -> (usize, u32) {
    let height = |vertex: u32| direction.dot(hull.vertices()[vertex as usize]);
    let vertices = 0..hull.vertices().len() as u32;
    let lowest = vertices.fold(0, |lowest, vertex| if height(vertex) < height(lowest) { vertex } else { lowest });
    let mut best = (f64::INFINITY, 0);
    for (i, face) in hull.faces().iter().enumerate() {
        let slope = face.normal.dot(direction);
        if slope < best.0 && hull.sides(face).iter().any(|side| side.vertex == lowest) {
            best = (slope, i);
        }
    }
    (best.1, lowest)
}
