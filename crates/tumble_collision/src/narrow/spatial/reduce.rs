//! At most four points carry a face: those that span the most.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::cut::{Cut, CutPoint};

/// Share by which another choice must be better to be taken, so that rounding does not change it [1].
const BETTER: f64 = 1e-9;

/// Chooses, from points in the order of a convex polygon, four that span much, a deepest one among them.
///
/// Of the points that are as deep as the deepest, to a tolerance [m], the one farthest from the middle of all is taken: a corner of the
/// polygon that sticks out, and not a fifth one that is deeper by a hair. With it, no other three span more.
pub(super) fn to_four(points: &mut Cut, normal: DVec3, tolerance: f64) {
    if points.len() <= 4 {
        return;
    }
    let deepest = points.iter().map(|point| point.height).fold(f64::INFINITY, f64::min);
    let middle = points.iter().fold(DVec3::ZERO, |sum, point| sum + point.place) * (1.0 / points.len() as f64);
    let mut first = (0.0, 0);
    for (i, point) in points.iter().enumerate().filter(|(_, point)| point.height <= deepest + tolerance) {
        let reach = point.place.distance_squared(middle);
        if reach > first.0 * (1.0 + BETTER) {
            first = (reach, i);
        }
    }
    let four: Cut = widest_with(points, normal, first.1).iter().map(|&i| points[i]).collect();
    *points = four;
}

/// The widest quadrilateral with a given corner.
///
/// For each opposite corner k, the two others are the farthest from the diagonal on either side; as k goes round they only move
/// forward, because the polygon is convex.
fn widest_with(points: &[CutPoint], normal: DVec3, first: usize) -> [usize; 4] {
    let count = points.len();
    // In the plane of the polygon, seen from the first corner.
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    let flat = |i: usize| {
        let arm = points[(first + i) % count].place - points[first].place;
        DVec2::new(u.dot(arm), v.dot(arm))
    };
    let at: SmallVec<[DVec2; 12]> = (0..count).map(flat).collect();
    let span = |i: usize, k: usize| at[k].perp_dot(at[i]).abs();
    let mut best = (f64::NEG_INFINITY, [0, 1, 2, 3]);
    let (mut j, mut l) = (1, 3);
    for k in 2..count - 1 {
        while j + 1 < k && span(j + 1, k) >= span(j, k) {
            j += 1;
        }
        l = l.max(k + 1);
        while l + 1 < count && span(l + 1, k) >= span(l, k) {
            l += 1;
        }
        let area = span(j, k) + span(l, k);
        if area > best.0 * (1.0 + BETTER) {
            best = (area, [0, j, k, l]);
        }
    }
    best.1.map(|i| (first + i) % count)
}
