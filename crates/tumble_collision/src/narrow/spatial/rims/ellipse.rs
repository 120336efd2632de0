//! A rim and a straight line: seen along the line, an ellipse and a point.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::Rims;

/// Share of the longer half axis below which the shorter one counts as zero: the rim is seen edge-on [1].
const EDGE_ON: f64 = 1e-12;

/// Distance from the ellipse, as a share of its longer half axis, below which its own normal is taken [1].
const ON_IT: f64 = 1e-6;

/// Most rounds of Newton's method; it takes about eight.
const ROUNDS: u32 = 60;

/// The unit vectors square to a line, out of the rim, along which rim (or tip) and line are farthest apart or least deep in each other.
///
/// Up to two, one for either side of the plane of the rim: only one end's rim faces each. None where a flat end or the side has that
/// direction.
pub(super) fn square_to_line(rims: &Rims, end: usize, point: DVec3, along: DVec3) -> SmallVec<[DVec3; 2]> {
    let arm = point - rims.ends[end];
    let flat = arm - along * arm.dot(along);
    let radius = rims.radii[end];
    if radius == 0.0 {
        return flat.try_normalize().into_iter().collect();
    }
    // Half axes r along u × e and r |u · e| square to it.
    let Some(x_axis) = rims.axis.cross(along).try_normalize() else { return SmallVec::new() };
    let y_axis = along.cross(x_axis);
    let half = DVec2::new(radius, radius * rims.axis.dot(along).abs());
    let at = DVec2::new(flat.dot(x_axis), flat.dot(y_axis));
    let sign = |value: f64| if value < 0.0 { -1.0 } else { 1.0 };
    let in_space = |out: DVec2| {
        let out = x_axis * (out.x * sign(at.x)) + y_axis * (out.y * sign(at.y));
        // Exactly square to the line once more.
        (out - along * out.dot(along)).try_normalize()
    };
    [nearest(half, at.abs()), across(half, at.abs())].into_iter().flatten().filter_map(in_space).collect()
}

/// The outward direction at the point of an ellipse that is closest to a point of the first quadrant.
fn nearest(half: DVec2, at: DVec2) -> Option<DVec2> {
    if half.y <= EDGE_ON * half.x {
        // A line from −half.x to half.x: beside it the flat end faces the point.
        return if at.x > half.x { Some(DVec2::new(at.x - half.x, at.y)) } else { None };
    }
    let foot = closest(half, at);
    let beyond = at - foot;
    let outside = (at / half).length_squared() > 1.0;
    if outside && beyond.length() > ON_IT * half.x {
        return Some(beyond);
    }
    Some(foot / (half * half))
}

/// The point of an ellipse that is closest to a point of the first quadrant [m].
///
/// The foot is (a² x/(t + a² − b²), b² y/t), t the largest root of G(t) = (a x/(t + a² − b²))² + (b y/t)² − 1 (Eberly, *Distance from a
/// Point to an Ellipse*, 2013, with t counted from −b²). For t > 0 it falls and is convex, so that Newton's method from b y, where G is
/// not negative, comes to the root from one side. In the code t is in units of b².
fn closest(half: DVec2, at: DVec2) -> DVec2 {
    let (a, b) = (half.x, half.y);
    if at.y == 0.0 {
        let (numerator, denominator) = (a * at.x, a * a - b * b);
        if numerator < denominator {
            let share = numerator / denominator;
            return DVec2::new(a * share, b * (1.0 - share * share).sqrt());
        }
        return DVec2::new(a, 0.0);
    }
    let ratio = (a / b) * (a / b);
    let t = root(ratio, at / half, 1.0).unwrap_or(at.y / b);
    DVec2::new(ratio * at.x / (t + (ratio - 1.0)), at.y / t)
}

/// The outward direction at the point below the long axis that is closest to a point of the first quadrant, among its neighbours.
///
/// There t is negative, and so near 0 that x is not: between −(a² − b²) and 0, where G is convex as well.
fn across(half: DVec2, at: DVec2) -> Option<DVec2> {
    let (a, b) = (half.x, half.y);
    if b <= EDGE_ON * a {
        return None;
    }
    if at.y == 0.0 {
        let foot = closest(half, at);
        return (foot.y > 0.0).then(|| DVec2::new(foot.x, -foot.y) / (half * half));
    }
    let ratio = (a / b) * (a / b);
    let t = root(ratio, at / half, -1.0)?;
    let foot = DVec2::new(ratio * at.x / (t + (ratio - 1.0)), at.y / t);
    Some(foot / (half * half))
}

/// The root of G next to 0 on the side of a sign, in units of b²; `None` where there is none.
fn root(ratio: f64, z: DVec2, side: f64) -> Option<f64> {
    let mut t = side * z.y;
    for _ in 0..ROUNDS {
        let (one, two) = (ratio * z.x / (t + (ratio - 1.0)), z.y / t);
        let value = one * one + two * two - 1.0;
        let slope = -2.0 * (one * one / (t + (ratio - 1.0)) + two * two / t);
        let next = t - value / slope;
        // At the root to rounding: no step away from 0 any more.
        if value <= 0.0 || next == t {
            return Some(t);
        }
        // Past the lowest place of G without a root.
        if slope * side >= 0.0 || next * side <= t * side || next <= 1.0 - ratio {
            return (side > 0.0).then_some(t);
        }
        t = next;
    }
    Some(t)
}
