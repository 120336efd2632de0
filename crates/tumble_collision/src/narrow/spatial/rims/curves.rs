//! Rims over the sides and rims of other rims.

use glam::DVec3;
use smallvec::SmallVec;

use super::{Rims, ellipse};

/// Places round a rim at which the search for stationary directions begins [1].
const STARTS: usize = 16;

/// Halvings of an interval of a sixteenth of a turn, down to rounding [1].
const HALVINGS: u32 = 52;

/// The best starts from which Newton's method goes on, and its rounds [1].
const TRIED: usize = 3;
const ROUNDS: u32 = 12;

type Directions = SmallVec<[DVec3; 8]>;

/// A unit vector across the axis, and the one a right angle further on.
fn round(rims: &Rims, share: f64) -> (DVec3, DVec3) {
    let first = rims.axis.any_orthonormal_vector();
    let (sine, cosine) = tumble_math::trig::sin_cos(std::f64::consts::TAU * share);
    let out = first * cosine + rims.axis.cross(first) * sine;
    (out, rims.axis.cross(out))
}

/// Normals of a side along which a rim of another shape is farthest away, each at least among its neighbours.
///
/// With the normal m at the unit vector ρ across the axis, τ square to both, and p the point of the rim that is lowest along m,
/// the separation changes along τ by a positive multiple of τ · (p − c), c any point of the axis.
pub(super) fn side_and_rim(side: &Rims, other: &Rims, end: usize) -> Directions {
    let slope = |out: DVec3| {
        let normal = side.side_normal(out);
        let lowest = other.ends[end] - other.radial(normal) * other.radii[end];
        side.axis.cross(out).dot(lowest - side.ends[0])
    };
    let outs: [DVec3; STARTS] = std::array::from_fn(|i| round(side, i as f64 / STARTS as f64).0);
    let slopes = outs.map(slope);
    let mut found = Directions::new();
    for i in 0..STARTS {
        let next = (i + 1) % STARTS;
        // A maximum: it rises at first, and then falls.
        if slopes[i] < 0.0 || slopes[next] >= 0.0 {
            continue;
        }
        let (mut low, mut high) = (outs[i], outs[next]);
        for _ in 0..HALVINGS {
            let middle = (low + high).normalize();
            *(if slope(middle) >= 0.0 { &mut low } else { &mut high }) = middle;
        }
        found.push(side.side_normal((low + high).normalize()));
    }
    found
}

/// Directions from one rim out to another that are stationary, or nearly the best among sixteen.
pub(super) fn rim_and_rim(rims: &Rims, own: usize, other: &Rims, its: usize) -> Directions {
    let separation = |out: DVec3| -other.height(-out) - rims.height(out);
    // The tangent at a place of one rim is a line that the other rim is farthest from along some direction.
    let mut starts: SmallVec<[(f64, DVec3); 64]> = SmallVec::new();
    for i in 0..STARTS {
        let share = i as f64 / STARTS as f64;
        for (line_of, end, rim_of, rim, sign) in [(other, its, rims, own, 1.0), (rims, own, other, its, -1.0)] {
            let (radial, tangent) = round(line_of, share);
            let place = line_of.ends[end] + radial * line_of.radii[end];
            for out in ellipse::square_to_line(rim_of, rim, place, tangent) {
                starts.push((separation(out * sign), out * sign));
            }
        }
    }
    starts.extend((other.ends[its] - rims.ends[own]).try_normalize().map(|out| (separation(out), out)));
    starts.sort_by(|one, two| two.0.total_cmp(&one.0));
    let best = starts.iter().take(TRIED).map(|(_, out)| *out);
    let stationary: Directions = best.clone().filter_map(|out| stationary(rims, own, other, its, out)).collect();
    best.chain(stationary).collect()
}

/// The direction square to both rims where they pass each other, near a first guess.
///
/// Newton's method for d · τ_a = d · τ_b = 0, with d between two places on the rims and τ the tangents there.
fn stationary(rims: &Rims, own: usize, other: &Rims, its: usize, guess: DVec3) -> Option<DVec3> {
    let (r_a, r_b) = (rims.radii[own], other.radii[its]);
    let (mut out_a, mut out_b) = (rims.radial(guess), -other.radial(guess));
    for _ in 0..ROUNDS {
        let (tangent_a, tangent_b) = (rims.axis.cross(out_a), other.axis.cross(out_b));
        let between = other.ends[its] + out_b * r_b - rims.ends[own] - out_a * r_a;
        let (f, g) = (between.dot(tangent_a), between.dot(tangent_b));
        let cosine = tangent_a.dot(tangent_b);
        // Rows of the Jacobian of (f, g) by the two angles.
        let (fa, fb) = (-r_a - between.dot(out_a), r_b * cosine);
        let (ga, gb) = (-r_a * cosine, r_b - between.dot(out_b));
        let determinant = fa * gb - fb * ga;
        let (turn_a, turn_b) = ((g * fb - f * gb) / determinant, (f * ga - g * fa) / determinant);
        if !(turn_a.is_finite() && turn_b.is_finite()) {
            return None;
        }
        // Half a radian at a time.
        let scale = 0.5 / turn_a.abs().max(turn_b.abs()).max(0.5);
        out_a = (out_a + tangent_a * (turn_a * scale)).normalize();
        out_b = (out_b + tangent_b * (turn_b * scale)).normalize();
        if turn_a.abs().max(turn_b.abs()) < 1e-14 {
            break;
        }
    }
    let between = other.ends[its] + out_b * r_b - rims.ends[own] - out_a * r_a;
    let square = rims.axis.cross(out_a).cross(other.axis.cross(out_b));
    // Square to both tangents, which says it better than the difference of two places near each other; unless they are parallel.
    let out = if square.length() > 1e-3 { square.normalize() } else { between.try_normalize()? };
    Some(if out.dot(guess) < 0.0 { -out } else { out })
}
