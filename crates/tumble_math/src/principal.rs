//! Principal moments of a symmetric tensor.

use glam::DVec3;

use crate::SymmetricTensor;

impl SymmetricTensor {
    /// Its three eigenvalues, smallest first: the moments about the principal axes.
    ///
    /// Jacobi's method (1846): turn in one coordinate plane after the other so that its off-diagonal entry becomes zero. Converges
    /// quadratically, and each eigenvalue is good to a few roundings of the largest.
    pub fn principal_moments(self) -> [f64; 3] {
        let DVec3 { x: a00, y: a11, z: a22 } = self.diagonal;
        let DVec3 { x: a12, y: a02, z: a01 } = self.off_diagonal;
        let mut a = [[a00, a01, a02], [a01, a11, a12], [a02, a12, a22]];
        for _ in 0..20 {
            let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
            if off == 0.0 || off.is_nan() {
                break;
            }
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                turn_to_zero(&mut a, p, q);
            }
        }
        let mut moments = [a[0][0], a[1][1], a[2][2]];
        moments.sort_by(f64::total_cmp);
        moments
    }
}

/// Turns in the plane of two axes so that their mixed entry becomes zero.
///
/// t = tan of the angle solves t² + 2 θ t − 1 = 0 with θ = (a_qq − a_pp) / (2 a_pq); the smaller root is the stable one.
fn turn_to_zero(a: &mut [[f64; 3]; 3], p: usize, q: usize) {
    let mixed = a[p][q];
    if mixed == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * mixed);
    let t =
        if theta.is_finite() { 1.0_f64.copysign(theta) / (theta.abs() + (theta * theta + 1.0).sqrt()) } else { 0.0 };
    let cos = 1.0 / (t * t + 1.0).sqrt();
    let sin = t * cos;
    let r = 3 - p - q;
    a[p][p] -= t * mixed;
    a[q][q] += t * mixed;
    (a[p][q], a[q][p]) = (0.0, 0.0);
    let (to_p, to_q) = (a[r][p], a[r][q]);
    a[r][p] = cos * to_p - sin * to_q;
    a[r][q] = sin * to_p + cos * to_q;
    (a[p][r], a[q][r]) = (a[r][p], a[r][q]);
}
