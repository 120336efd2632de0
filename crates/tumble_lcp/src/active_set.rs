//! From a guess of which rows touch their bounds to the z that this implies, by one linear system.
//!
//! ```text
//! sides:   z_i = l_i   or   z_i = u_i   or   w_i = 0 (then z_i is unknown; these rows are C)
//! system:  (M E)_CC z_C = −(q + M z_fixed)_C
//! ```
//!
//! E adds what follows an unknown: friction at its limit is ±μ times its normal. Pivoting methods end here to take rounding out of
//! their answer; methods that converge end here to reach the last digits.

use crate::factor::Lu;
use crate::matrix::{Matrix, dot};
use crate::problem::{Bound, Lcp, residual_with};

/// Where the z of a row stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// At its lower bound.
    Lower,
    /// Between its bounds, with w = 0.
    Between,
    /// At its upper bound.
    Upper,
}

/// The sides at which the natural map of each row is smallest.
pub(crate) fn sides_of(problem: &Lcp, z: &[f64], w: &[f64]) -> Vec<Side> {
    (0..z.len())
        .map(|i| {
            let (lower, upper) = problem.limits(i, z);
            if w[i] >= z[i] - lower {
                Side::Lower
            } else if w[i] <= z[i] - upper {
                Side::Upper
            } else {
                Side::Between
            }
        })
        .collect()
}

/// The linear system that a choice of sides implies.
pub(crate) struct SideSystem {
    /// The rows C with w = 0.
    pub active: Vec<usize>,
    /// z with its fixed entries filled in, and zero elsewhere.
    fixed: Vec<f64>,
    /// Friction rows at their limit: (row, normal, ±μ).
    followers: Vec<(usize, usize, f64)>,
}

impl SideSystem {
    /// Sorts the rows by side.
    pub fn new(problem: &Lcp, sides: &[Side]) -> Self {
        let n = sides.len();
        let mut fixed = vec![0.0; n];
        let mut followers = Vec::new();
        for (i, &side) in sides.iter().enumerate() {
            if side == Side::Between {
                continue;
            }
            match problem.bounds()[i] {
                Bound::Box { lower, .. } if side == Side::Lower => fixed[i] = lower,
                Bound::Box { upper, .. } => fixed[i] = upper,
                Bound::Friction { normal, coefficient } if sides[normal] == Side::Between => {
                    followers.push((i, normal, if side == Side::Lower { -coefficient } else { coefficient }));
                }
                Bound::Nonnegative | Bound::Free | Bound::Friction { .. } => {}
            }
        }
        let active = (0..n).filter(|&i| sides[i] == Side::Between).collect();
        Self { active, fixed, followers }
    }

    /// Matrix and right side for the given rows; the unknowns are always the active z.
    pub fn equations(&self, problem: &Lcp, rows: &[usize]) -> (Matrix, Vec<f64>) {
        let (m, q) = (problem.matrix(), problem.q());
        let mut position = vec![usize::MAX; q.len()];
        self.active.iter().enumerate().for_each(|(k, &i)| position[i] = k);
        let mut matrix = Matrix::from_fn(rows.len(), self.active.len(), |r, c| m[(rows[r], self.active[c])]);
        for &(row, normal, slope) in &self.followers {
            for (r, &i) in rows.iter().enumerate() {
                matrix[(r, position[normal])] += slope * m[(i, row)];
            }
        }
        let right = rows.iter().map(|&i| -(q[i] + dot(m.row(i), &self.fixed))).collect();
        (matrix, right)
    }

    /// The whole z, from its active entries.
    pub fn assemble(&self, active_z: &[f64]) -> Vec<f64> {
        let mut z = self.fixed.clone();
        self.active.iter().zip(active_z).for_each(|(&i, &value)| z[i] = value);
        self.followers.iter().for_each(|&(row, normal, slope)| z[row] = slope * z[normal]);
        z
    }
}

/// The z that a choice of sides implies; `None` when it is not unique.
pub(crate) fn solve_sides(problem: &Lcp, sides: &[Side]) -> Option<Vec<f64>> {
    let system = SideSystem::new(problem, sides);
    let (matrix, right) = system.equations(problem, &system.active);
    let active_z = Lu::factor(matrix.clone())?.solve_refined(&matrix, &right);
    Some(system.assemble(&active_z))
}

/// Puts z within its bounds and takes out rounding errors, as long as that makes the residual smaller.
pub(crate) fn polish(problem: &Lcp, mut z: Vec<f64>) -> Vec<f64> {
    problem.clamp(&mut z);
    let mut w = problem.w(&z);
    let mut residual = residual_with(problem, &z, &w);
    for _ in 0..4 {
        if residual == 0.0 || residual.is_nan() {
            break;
        }
        let Some(mut better) = solve_sides(problem, &sides_of(problem, &z, &w)) else { break };
        problem.clamp(&mut better);
        let better_w = problem.w(&better);
        let better_residual = residual_with(problem, &better, &better_w);
        if better_residual < residual {
            (z, w, residual) = (better, better_w, better_residual);
        } else {
            break;
        }
    }
    z
}
