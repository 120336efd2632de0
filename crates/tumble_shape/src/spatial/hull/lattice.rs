//! Points on a lattice of integers, so that the question "on which side of a plane?" has an exact answer.
//!
//! Coordinates are at most 2³⁸ in size and their differences 2³⁹, so a cross product of two differences is at most 2⁷⁹ and its
//! product with a third 2¹²⁰: `i128` holds all of them without rounding.

use glam::DVec3;

/// A point of the lattice.
pub(super) type LatticePoint = [i64; 3];

/// A vector square to a triangle of lattice points, of twice its area.
pub(super) type LatticeNormal = [i128; 3];

/// Half the number of lattice steps along the longest side of the cloud [1].
const HALF_STEPS: f64 = 274_877_906_944.0; // 2³⁸

/// Puts points [m] on a lattice that divides the longest side of their box into 2³⁹ steps.
///
/// A point moves by at most a step, 2e-12 of that side. `extent` is the side's length, above zero [m].
pub(super) fn snap(points: &[DVec3], centre: DVec3, extent: f64) -> Vec<LatticePoint> {
    let per_metre = 2.0 * HALF_STEPS / extent;
    let steps = |coordinate: f64| (coordinate * per_metre).round() as i64;
    points.iter().map(|&point| (point - centre).to_array().map(steps)).collect()
}

/// (b − a) × (c − a): out of the side from which a, b, c run counter-clockwise.
pub(super) fn normal(a: LatticePoint, b: LatticePoint, c: LatticePoint) -> LatticeNormal {
    let (u, v) = (difference(b, a), difference(c, a));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// How far a point is above the plane through `on`, times the length of the normal.
pub(super) fn height(normal: LatticeNormal, on: LatticePoint, point: LatticePoint) -> i128 {
    let d = difference(point, on);
    normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]
}

fn difference(a: LatticePoint, b: LatticePoint) -> [i128; 3] {
    std::array::from_fn(|axis| i128::from(a[axis] - b[axis]))
}
