//! At most four points carry a face: those that span the most.

use glam::DVec3;

use super::cut::{Cut, CutPoint};

/// Share by which another choice must be better to be taken, so that rounding does not change it [1].
const BETTER: f64 = 1e-9;

/// Chooses, from points in the order of a convex polygon, four of the largest area among those with a deepest point.
///
/// Points that are as deep as the deepest, to a tolerance [m], may all stand for it: so four flush corners win over a fifth one that
/// is deeper by a hair. Every other four with such a point span at most the area of these.
pub(super) fn to_four(points: &mut Cut, normal: DVec3, tolerance: f64) {
    if points.len() <= 4 {
        return;
    }
    let deepest = points.iter().map(|point| point.height).fold(f64::INFINITY, f64::min);
    let mut best = (f64::NEG_INFINITY, [0, 1, 2, 3]);
    for first in (0..points.len()).filter(|&i| points[i].height <= deepest + tolerance) {
        let (area, four) = widest_with(points, normal, first);
        if area > best.0 * (1.0 + BETTER) {
            best = (area, four);
        }
    }
    let four: Cut = best.1.iter().map(|&i| points[i]).collect();
    *points = four;
}

/// The widest quadrilateral with a given corner, and twice its area [m²].
///
/// For each opposite corner k, the two others are the farthest from the diagonal on either side; as k goes round they only move
/// forward, because the polygon is convex.
fn widest_with(points: &[CutPoint], normal: DVec3, first: usize) -> (f64, [usize; 4]) {
    let count = points.len();
    let at = |i: usize| points[(first + i) % count].place;
    let span = |i: usize, k: usize| normal.dot((at(k) - at(0)).cross(at(i) - at(0))).abs();
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
    (best.0, best.1.map(|i| (first + i) % count))
}
