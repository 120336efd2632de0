//! Closest points of two segments, and the parts of parallel ones that lie beside each other.

use glam::DVec3;

/// Sine of the angle below which two segments count as parallel and touch along a stretch [1].
const PARALLEL: f64 = 1e-2;

/// Places on two segments that are closest, as shares of the way from the first end to the second [1].
///
/// Ericson, Real-Time Collision Detection (2004), 5.1.9. Exactly parallel segments give one of the many answers.
pub(super) fn closest(p: [DVec3; 2], q: [DVec3; 2]) -> (f64, f64) {
    let (u, v, w) = (p[1] - p[0], q[1] - q[0], p[0] - q[0]);
    let (a, b, e) = (u.length_squared(), u.dot(v), v.length_squared());
    let (c, f) = (u.dot(w), v.dot(w));
    let clamp = |share: f64| share.clamp(0.0, 1.0);
    if a == 0.0 || e == 0.0 {
        return if a > 0.0 {
            (clamp(-c / a), 0.0)
        } else if e > 0.0 {
            (0.0, clamp(f / e))
        } else {
            (0.0, 0.0)
        };
    }
    // |u × v|², which unlike a e − b² keeps its digits for nearly parallel segments.
    let determinant = u.cross(v).length_squared();
    let s = if determinant > 0.0 { clamp(u.cross(v).dot((-w).cross(v)) / determinant) } else { 0.0 };
    let t = (b * s + f) / e;
    if t < 0.0 {
        (clamp(-c / a), 0.0)
    } else if t > 1.0 {
        (clamp((b - c) / a), 1.0)
    } else {
        (s, t)
    }
}

/// Where nearly parallel segments lie beside each other: shares of both at the two ends of the stretch; `None` for others [1].
///
/// Each end of the stretch is an end of the one or the other: `(share of p, share of q)` has a 0 or 1 in it.
pub(super) fn beside(p: [DVec3; 2], q: [DVec3; 2]) -> Option<[(f64, f64); 2]> {
    let (u, v) = (p[1] - p[0], q[1] - q[0]);
    let (a, e) = (u.length_squared(), v.length_squared());
    if u.cross(v).length_squared() > PARALLEL * PARALLEL * a * e || a == 0.0 || e == 0.0 {
        return None;
    }
    // Ends of q along p, in the order of p.
    let on_p = |point: DVec3| u.dot(point - p[0]) / a;
    let on_q = |share: f64| v.dot(p[0] + u * share - q[0]) / e;
    let (first, second) = (on_p(q[0]), on_p(q[1]));
    let ends = if first <= second { [(first, 0.0), (second, 1.0)] } else { [(second, 1.0), (first, 0.0)] };
    let low = if ends[0].0 > 0.0 { ends[0] } else { (0.0, on_q(0.0).clamp(0.0, 1.0)) };
    let high = if ends[1].0 < 1.0 { ends[1] } else { (1.0, on_q(1.0).clamp(0.0, 1.0)) };
    (low.0 < high.0).then_some([low, high])
}
