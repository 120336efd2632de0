//! Points and segments with radii, among themselves.

use glam::DVec3;

use super::Pair;
use super::closest::at_end;
use super::draft::{Draft, Feature, feature_id, kind_of};
use super::segment;
use crate::manifold::SpatialManifold;

/// Distance below which two points are at one place, relative to the size of the pair [1].
const ONE_PLACE: f64 = 1e-15;

/// Share of the shorter segment by which one may be beyond the other and still be remembered on its side [1].
const REACH_OF_MEMORY: f64 = 0.25;

/// Contact points of two cores of one or two vertices each.
pub(super) fn collide(pair: &Pair, a: &[DVec3], b: &[DVec3], radii: [f64; 2]) -> SpatialManifold {
    let p = [a[0], a[a.len() - 1]];
    let q = [b[0], b[b.len() - 1]].map(|vertex| pair.b_in_a.point(vertex));
    let (s, t) = segment::closest(p, q);
    let (on_a, on_b) = (p[0].lerp(p[1], s), q[0].lerp(q[1], t));
    let feature = |core: &[DVec3], share: f64| match at_end(share) {
        _ if core.len() == 1 => Feature::Vertex(0),
        Some(end) => Feature::Vertex(end as u32),
        None => Feature::Edge(0),
    };
    let between = on_b - on_a;
    let distance = between.length();
    let (of_a, of_b) = (feature(a, s), feature(b, t));
    let crossing = matches!((of_a, of_b), (Feature::Edge(_), Feature::Edge(_)));
    let before = pair.remembered_normal();
    let normal = if distance > ONE_PLACE * pair.size {
        let joining = between * (1.0 / distance);
        // Two segments that cross have no inside: the side they were on before tells which way is apart.
        let reach = REACH_OF_MEMORY * p[0].distance(p[1]).min(q[0].distance(q[1]));
        let passed = crossing && distance <= reach && before.is_some_and(|before| before.dot(joining) < 0.0);
        if passed { -joining } else { joining }
    } else {
        square_to(p[1] - p[0], q[1] - q[0], before)
    };
    if normal.dot(between) - radii[0] - radii[1] > pair.query.margin || !distance.is_finite() {
        return if distance.is_finite() { pair.apart(normal) } else { SpatialManifold::EMPTY };
    }

    let mut draft = Draft::new(&pair.a_in_world, normal, pair.query.margin);
    if let Some(stretch) = segment::beside(p, q) {
        for (s, t) in stretch {
            let (of_a, of_b) = (feature(a, s), feature(b, t));
            let (on_a, on_b) = (p[0].lerp(p[1], s), q[0].lerp(q[1], t));
            draft.between(on_a, on_b, radii, feature_id(of_a, of_b), kind_of(of_a, of_b, radii));
        }
    } else {
        draft.between(on_a, on_b, radii, feature_id(of_a, of_b), kind_of(of_a, of_b, radii));
    }
    draft.finish()
}

/// A unit vector square to both directions, on the side of the normal before; square to one of them, or any, where there is none.
fn square_to(u: DVec3, v: DVec3, before: Option<DVec3>) -> DVec3 {
    let fallback = || {
        let along = if u == DVec3::ZERO { v } else { u };
        let guess = before.unwrap_or(DVec3::Y);
        let across = guess - along * (guess.dot(along) / along.length_squared().max(f64::MIN_POSITIVE));
        across.try_normalize().or_else(|| along.any_orthogonal_vector().try_normalize()).unwrap_or(DVec3::Y)
    };
    let across = u.cross(v).try_normalize().unwrap_or_else(fallback);
    if before.is_some_and(|before| before.dot(across) < 0.0) { -across } else { across }
}
