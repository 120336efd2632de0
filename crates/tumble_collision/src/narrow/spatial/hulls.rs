//! Polyhedron and polyhedron.

use glam::DVec3;
use tumble_shape::{ConvexHull, Cuboid};

use super::Pair;
use super::axis::{Axis, AxisOf, Limits, Search};
use super::cut::{self, Cut};
use super::draft::{Draft, Feature, Owner, feature_id};
use super::memory::AxisMemory;
use super::{boxes, closest, face, search, segment};
use crate::manifold::{ContactKind, ContactPoint, SpatialManifold};

/// Contact points of two polyhedra, with the boxes they are, if both are.
pub(super) fn collide(
    pair: &Pair,
    a: &ConvexHull,
    b: &ConvexHull,
    cuboids: Option<(&Cuboid, &Cuboid)>,
) -> SpatialManifold {
    let limits = Limits { margin: pair.query.margin, preference: pair.preference(), flush: pair.flush() };
    if let Some(normal) = pair.remembered_gap() {
        let gap = match cuboids {
            Some((a, b)) => boxes::along(a, b, &pair.b_in_a, normal),
            None => search::along(a, b, &pair.b_in_a, normal),
        };
        if gap > limits.margin {
            return pair.apart(normal);
        }
    }
    if let Some(memory) = pair.query.previous.map(SpatialManifold::memory)
        && let Some(axis) = memory.still_best(pair, a, b, &limits)
    {
        if axis.separation > limits.margin {
            return pair.apart(axis.normal);
        }
        return contact(pair, a, b, &axis, memory);
    }
    let search = match cuboids {
        Some((a, b)) => boxes::search(a, b, &pair.b_in_a, &limits),
        None => search::search(a, b, &pair.b_in_a, &limits),
    };
    match search {
        Search::Apart(normal) => pair.apart(normal),
        Search::Near(found) => {
            let axis = found.choice(&limits);
            if found.flush.across(&axis) {
                return pair.apart(axis.normal);
            }
            contact(pair, a, b, &axis, &AxisMemory::new(pair, &found, &axis))
        }
    }
}

/// What touches along an axis.
fn contact(pair: &Pair, a: &ConvexHull, b: &ConvexHull, best: &Axis, memory: &AxisMemory) -> SpatialManifold {
    let tolerance = pair.preference() + pair.rounding();
    let closest = || closest::manifold(pair, a, b.vertices(), Some(b), 0.0, best.normal);
    let mut manifold = SpatialManifold::EMPTY;
    if let AxisOf::Edges(i, j) = best.of {
        let (on_a, on_b) = crossing(pair, a, i, b, j);
        // Apart, and yet the edges pass each other beyond their ends: closest elsewhere.
        if best.separation > 0.0
            && on_a.distance(on_b) > best.separation + tolerance
            && let Some(closest) = closest()
        {
            manifold = closest;
            return manifold;
        }
        manifold.normal = pair.a_in_world.vector(best.normal);
        if best.separation <= pair.query.margin {
            manifold.insert(ContactPoint {
                point: pair.a_in_world.point((on_a + on_b) * 0.5),
                separation: best.separation,
                feature: feature_id(Feature::Edge(i as u32), Feature::Edge(j as u32)),
                kind: ContactKind::EdgeEdge,
            });
        }
        manifold.remember(memory);
    } else if !on_face(pair, a, b, best, memory, &mut manifold) {
        manifold = closest().unwrap_or_else(|| single(pair, a, b, best));
    }
    manifold
}

/// Puts what lies on the face of an axis into an empty manifold; `false` if the shapes are apart and come closer elsewhere.
fn on_face(
    pair: &Pair,
    a: &ConvexHull,
    b: &ConvexHull,
    axis: &Axis,
    memory: &AxisMemory,
    manifold: &mut SpatialManifold,
) -> bool {
    let (owner, number, reference, incident) = match axis.of {
        AxisOf::FaceB(face) => (Owner::B, face, b, a),
        AxisOf::FaceA(face) | AxisOf::Edges(face, _) => (Owner::A, face, a, b),
    };
    let a_in_b;
    let place = if owner == Owner::A {
        &pair.b_in_a
    } else {
        a_in_b = pair.b_in_a.inverse();
        &a_in_b
    };
    let above = &reference.faces()[number];
    let deep_enough = |cut: &Cut| face::lowest(cut) <= axis.separation + pair.preference() + pair.rounding();
    let mut cut = Cut::new();
    if let Some((facing, sources)) = memory.cut()
        && let Some(facing) = incident.faces().get(facing)
        && cut::again(reference, above, incident, facing, place, sources, &mut cut).is_some()
        && deep_enough(&cut)
    {
        face::put(pair, owner, above, &cut, 0.0, manifold);
        manifold.remember(memory);
        return true;
    }
    let down = place.unturned(above.normal);
    let cut_by = |facing: usize| cut::polygon(reference, above, incident, &incident.faces()[facing], place);
    let mut facing = face::facing(incident, down);
    cut = cut_by(facing);
    if !deep_enough(&cut) {
        // The face that faces most squarely does not have the nearest vertex; one around that vertex has.
        facing = face::facing_at_lowest(incident, down).0;
        cut = cut_by(facing);
        if axis.separation > 0.0 && !deep_enough(&cut) || cut.is_empty() {
            return false;
        }
    }
    let all = cut.len().min(4);
    face::choose(pair, above, &mut cut, 0.0);
    let memory = if cut.len() == all { memory.with_cut(facing, &cut) } else { memory.without_cut() };
    face::put(pair, owner, above, &cut, 0.0, manifold);
    manifold.remember(&memory);
    true
}

/// Overlapping, yet nothing faces the reference face: its deepest vertex alone.
fn single(pair: &Pair, a: &ConvexHull, b: &ConvexHull, axis: &Axis) -> SpatialManifold {
    let down = pair.b_in_a.unturned(axis.normal);
    let (_, vertex_b) = face::facing_at_lowest(b, down);
    let (_, vertex_a) = face::facing_at_lowest(a, -axis.normal);
    let (on_a, on_b) = (a.vertices()[vertex_a as usize], pair.b_in_a.point(b.vertices()[vertex_b as usize]));
    let mut draft = Draft::new(&pair.a_in_world, axis.normal, pair.query.margin);
    let feature = feature_id(Feature::Vertex(vertex_a), Feature::Vertex(vertex_b));
    draft.push((on_a + on_b) * 0.5, axis.separation, feature, ContactKind::VertexVertex);
    draft.finish()
}

/// Closest points of two edges, in the frame of a [m].
fn crossing(pair: &Pair, a: &ConvexHull, i: usize, b: &ConvexHull, j: usize) -> (DVec3, DVec3) {
    let p = a.edges()[i].vertices.map(|vertex| a.vertices()[vertex as usize]);
    let q = b.edges()[j].vertices.map(|vertex| pair.b_in_a.point(b.vertices()[vertex as usize]));
    let (s, t) = segment::closest(p, q);
    (p[0].lerp(p[1], s), q[0].lerp(q[1], t))
}
