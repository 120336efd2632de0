//! Turns bounds, free rows and friction into a plain 0 ≤ x ⟂ w ≥ 0, for methods that know nothing else.
//!
//! ```text
//! free          eliminated by its own block of M:  z_F = −M_FF⁻¹ (q_F + M_FR z_R)
//!               or, when that is singular, split:  z = x⁺ − x⁻,   w ≥ 0 ⟂ x⁺,   −w ≥ 0 ⟂ x⁻
//! one side      z = l + x  or  z = u − x
//! two sides     z = l + x,         w + λ ≥ 0 ⟂ x ≥ 0,    u − l − x ≥ 0 ⟂ λ ≥ 0
//! friction      z = x⁺ − x⁻,   ±w + λ ≥ 0 ⟂ x± ≥ 0,   μ z_n − x⁺ − x⁻ ≥ 0 ⟂ λ ≥ 0
//! ```
//!
//! Each keeps M positive semidefinite if it was (friction: copositive), so Lemke's method keeps its guarantees.

use crate::factor::Lu;
use crate::matrix::{Matrix, add_scaled, dot};
use crate::problem::{Bound, Lcp};

/// A plain problem, and the way back.
pub(crate) struct Standard {
    /// The plain matrix.
    pub matrix: Matrix,
    /// The plain q.
    pub q: Vec<f64>,
    /// Plain unknowns that are parts of a z: (row, sign). Multipliers come after them.
    parts: Vec<(usize, f64)>,
    /// z where all plain unknowns are zero.
    origin: Vec<f64>,
    /// Free rows that were eliminated, with their factored block.
    eliminated: Option<(Vec<usize>, Matrix, Lu)>,
}

impl Standard {
    /// The plain form of a problem.
    pub fn of(problem: &Lcp) -> Self {
        let n = problem.dimension();
        let free: Vec<usize> = (0..n).filter(|&i| problem.bounds()[i] == Bound::Free).collect();
        let block = Matrix::from_fn(free.len(), free.len(), |r, c| problem.matrix()[(free[r], free[c])]);
        let mut matrix = problem.matrix().clone();
        let mut q = problem.q().to_vec();
        let lu = if free.is_empty() { None } else { Lu::factor(block.clone()) };
        if let Some(lu) = &lu {
            eliminate(&mut matrix, &mut q, &free, &block, lu);
        }
        let eliminated = lu.map(|lu| (free, block, lu));
        let mut standard = Self { matrix, q, parts: Vec::new(), origin: vec![0.0; n], eliminated };
        standard.split(problem.bounds());
        standard
    }

    /// Writes the kept rows in plain unknowns.
    fn split(&mut self, bounds: &[Bound]) {
        let mut parts = Vec::new();
        let mut multipliers = Vec::new();
        for (i, bound) in bounds.iter().enumerate() {
            match *bound {
                Bound::Free if self.eliminated.is_some() => {}
                Bound::Nonnegative => parts.push((i, 1.0)),
                Bound::Free => parts.extend([(i, 1.0), (i, -1.0)]),
                Bound::Friction { .. } => {
                    parts.extend([(i, 1.0), (i, -1.0)]);
                    multipliers.push(i);
                }
                Bound::Box { lower, upper } if lower.is_finite() => {
                    self.origin[i] = lower;
                    parts.push((i, 1.0));
                    if upper.is_finite() {
                        multipliers.push(i);
                    }
                }
                Bound::Box { upper, .. } if upper.is_finite() => {
                    self.origin[i] = upper;
                    parts.push((i, -1.0));
                }
                Bound::Box { .. } => parts.extend([(i, 1.0), (i, -1.0)]),
            }
        }
        let (p, size) = (parts.len(), parts.len() + multipliers.len());
        let mut plain = Matrix::zeros(size, size);
        let mut plain_q = vec![0.0; size];
        for (a, &(i, sign)) in parts.iter().enumerate() {
            for (b, &(j, other)) in parts.iter().enumerate() {
                plain[(a, b)] = sign * other * self.matrix[(i, j)];
            }
            plain_q[a] = sign * (self.q[i] + dot(self.matrix.row(i), &self.origin));
        }
        for (m, &i) in multipliers.iter().enumerate() {
            for (a, &(j, _)) in parts.iter().enumerate() {
                if i == j {
                    plain[(a, p + m)] = 1.0;
                    plain[(p + m, a)] = -1.0;
                }
                if matches!(bounds[i], Bound::Friction { normal, .. } if normal == j)
                    && let Bound::Friction { coefficient, .. } = bounds[i]
                {
                    plain[(p + m, a)] = coefficient;
                }
            }
            if let Bound::Box { lower, upper } = bounds[i] {
                plain_q[p + m] = upper - lower;
            }
        }
        (self.matrix, self.q, self.parts) = (plain, plain_q, parts);
    }

    /// z of the original problem.
    pub fn recover(&self, problem: &Lcp, x: &[f64]) -> Vec<f64> {
        let mut z = self.origin.clone();
        self.parts.iter().zip(x).for_each(|(&(i, sign), &x)| z[i] += sign * x);
        if let Some((free, block, lu)) = &self.eliminated {
            let right: Vec<f64> = free.iter().map(|&i| -(problem.q()[i] + dot(problem.matrix().row(i), &z))).collect();
            free.iter().zip(lu.solve_refined(block, &right)).for_each(|(&i, value)| z[i] = value);
        }
        z
    }

    /// A Farkas vector of the original problem from one of the plain problem; the caller checks it.
    pub fn recover_certificate(&self, problem: &Lcp, y: &[f64]) -> Vec<f64> {
        let mut original = vec![0.0; problem.dimension()];
        self.parts.iter().zip(y).for_each(|(&(i, sign), &y)| original[i] += sign * y);
        if let Some((free, block, _)) = &self.eliminated {
            // (Mᵀ y)_F = 0 fixes y_F.
            let image = problem.matrix().transpose_multiply(&original);
            let right: Vec<f64> = free.iter().map(|&i| -image[i]).collect();
            if let Some(lu) = Lu::factor(block.transpose()) {
                free.iter().zip(lu.solve(&right)).for_each(|(&i, value)| original[i] = value);
            }
        }
        original
    }

    /// Plain unknowns that belong to a z of the original problem; multipliers are left at zero.
    pub fn project(&self, z: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.q.len()];
        for (x, &(i, sign)) in x.iter_mut().zip(&self.parts) {
            *x = (sign * (z[i] - self.origin[i])).max(0.0);
        }
        x
    }
}

/// Schur complement of the free block, written over the other rows; free columns become zero.
fn eliminate(matrix: &mut Matrix, q: &mut [f64], free: &[usize], block: &Matrix, lu: &Lu) {
    let n = q.len();
    let mut is_free = vec![false; n];
    free.iter().for_each(|&i| is_free[i] = true);
    let solve = |column: Vec<f64>| lu.solve_refined(block, &column);
    let solved_q = solve(free.iter().map(|&i| q[i]).collect());
    let solved_rows: Vec<Vec<f64>> =
        (0..n).filter(|&j| !is_free[j]).map(|j| solve(free.iter().map(|&i| matrix[(i, j)]).collect())).collect();
    let kept: Vec<usize> = (0..n).filter(|&j| !is_free[j]).collect();
    for &i in &kept {
        let coupling: Vec<f64> = free.iter().map(|&f| matrix[(i, f)]).collect();
        q[i] -= dot(&coupling, &solved_q);
        let mut change = vec![0.0; n];
        kept.iter().zip(&solved_rows).for_each(|(&j, solved)| change[j] = dot(&coupling, solved));
        add_scaled(matrix.row_mut(i), -1.0, &change);
        free.iter().for_each(|&f| matrix[(i, f)] = 0.0);
    }
}

/// Units for the unknowns, as powers of two, so that changing them rounds nothing.
///
/// x = factor · D x', M' = D M D / m, q' = D q / s: entries of M' and q' end up near one.
pub(crate) struct Units {
    /// Factor from the scaled unknown to the plain one.
    pub of_x: Vec<f64>,
}

/// Brings a plain problem into good units; returns how to read its unknowns.
pub(crate) fn equilibrate(matrix: &mut Matrix, q: &mut [f64]) -> Units {
    let n = q.len();
    let mut total = vec![1.0; n];
    for _ in 0..3 {
        let mut sizes = vec![0.0_f64; n];
        for i in 0..n {
            for (j, m) in matrix.row(i).iter().enumerate() {
                sizes[i] = sizes[i].max(m.abs());
                sizes[j] = sizes[j].max(m.abs());
            }
        }
        let factors: Vec<f64> = sizes.iter().map(|&size| 1.0 / power_of_two_below(size.sqrt())).collect();
        for i in 0..n {
            let own = factors[i];
            matrix.row_mut(i).iter_mut().zip(&factors).for_each(|(m, other)| *m = *m * own * other);
            total[i] *= own;
        }
    }
    q.iter_mut().zip(&total).for_each(|(q, d)| *q *= d);
    let size = power_of_two_below(crate::matrix::largest(q));
    q.iter_mut().for_each(|q| *q /= size);
    Units { of_x: total.into_iter().map(|d| d * size).collect() }
}

/// The largest power of two not above a positive number; 1 for zero.
fn power_of_two_below(x: f64) -> f64 {
    if x < f64::MIN_POSITIVE { 1.0 } else { f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_bring_masses_of_very_different_size_near_one_exactly() {
        let original = Matrix::from_rows([[1e8, 3.0], [3.0, 1e-6]]);
        let (mut m, mut q) = (original.clone(), vec![-5e9, 2e-3]);
        let units = equilibrate(&mut m, &mut q);
        assert!((0..2).all(|i| (0.25..4.0).contains(&m.row(i).iter().fold(0.0, |a, b| f64::max(a, b.abs())))));
        // Powers of two: undoing them gives back the same bits.
        let ratio = original[(0, 1)] / m[(0, 1)];
        assert_eq!(ratio.to_bits() << 12, 0);
        assert!(units.of_x.iter().all(|d| d.to_bits() << 12 == 0));
    }
}
