//! Projected Gauss–Seidel, and with over-relaxation SOR: row after row, each solved for its own z and put back within its bounds.
//!
//! **Idea.** Solve each row for its own z as if the others were right, clamp, go on. Repeat.
//!
//! **Equations.** zᵢ ← clamp(zᵢ − ω (M z + q)ᵢ / Mᵢᵢ, lᵢ, uᵢ), with ω in (0, 2); friction rows take lᵢ = −μ z_n, uᵢ = μ z_n from the z_n
//! of the moment. Converges for symmetric positive definite M, and for M-matrices (Cottle, Pang, Stone 1992, section 5.3).
//!
//! **Good at.** O(nonzeros) per sweep, any size, never builds M, any bounds, uses a warm start fully, cannot crash.
//!
//! **Bad at.** The error falls by a constant factor per sweep, and that factor is near one for stacks and large mass ratios. Rows
//! without a positive diagonal are impossible. It may circle for ever when M is not symmetric (test K10).
//!
//! **When to choose.** Large problems where 1e-3 will do, or as a start for [`Newton`](crate::Newton).

use crate::matrix::largest;
use crate::operator::RowOperator;
use crate::outcome::{Method, Solution, SolveError, judge};
use crate::problem::{Bound, Lcp};

/// Settings of projected Gauss–Seidel.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussSeidel {
    /// ω: 1 is Gauss–Seidel, above it over-relaxation, which is faster on easy problems and fails beyond 2 \[1\]. Default 1.
    pub relaxation: f64,
    /// Sweeps after which it gives up. Default 20 000.
    pub max_sweeps: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞) \[1\]. Default 1e-8.
    pub tolerance: f64,
}

impl Default for GaussSeidel {
    fn default() -> Self {
        Self { relaxation: 1.0, max_sweeps: 20_000, tolerance: 1e-8 }
    }
}

impl GaussSeidel {
    /// Solves from z = 0.
    pub fn solve<A: RowOperator>(&self, problem: &Lcp<A>) -> Result<Solution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves from a first guess.
    pub fn solve_from<A: RowOperator>(&self, problem: &Lcp<A>, z: &[f64]) -> Result<Solution, SolveError> {
        let n = problem.dimension();
        if z.len() != n || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let operator = problem.matrix();
        let diagonal: Vec<f64> = (0..n).map(|i| operator.diagonal(i)).collect();
        if let Some(row) = diagonal.iter().position(|d| d.is_nan() || *d <= 0.0) {
            return Err(SolveError::SingularPivot { row });
        }
        // Friction after the normals, whatever their places.
        let is_friction = |i: &usize| matches!(problem.bounds()[*i], Bound::Friction { .. });
        let order: Vec<usize> = (0..n).filter(|i| !is_friction(i)).chain((0..n).filter(is_friction)).collect();

        let bar = self.tolerance * largest(problem.q()).max(1.0);
        let mut z = z.to_vec();
        problem.clamp(&mut z);
        let mut tracked = operator.track(&z);
        for sweep in 0..=self.max_sweeps {
            let mut largest_push = 0.0_f64;
            if sweep > 0 {
                for &i in &order {
                    let w = operator.row(i, &tracked) + problem.q()[i];
                    let (lower, upper) = problem.limits(i, &z);
                    let new = (z[i] - self.relaxation * w / diagonal[i]).max(lower).min(upper);
                    let change = new - z[i];
                    if change != 0.0 {
                        z[i] = new;
                        operator.change(i, change, &mut tracked);
                        largest_push = largest_push.max(change.abs() * diagonal[i]);
                    }
                }
            }
            // The residual costs a sweep; ask for it when the pushes have become small, and where one sweep may have been enough.
            if sweep <= 1 || largest_push <= bar || sweep == self.max_sweeps {
                match judge(problem, z, Method::GaussSeidel, sweep, bar) {
                    Err(SolveError::NotConverged { z: unfinished, report }) => {
                        if sweep == self.max_sweeps || (sweep > 1 && largest_push == 0.0) {
                            return Err(SolveError::NotConverged { z: unfinished, report });
                        }
                        z = unfinished;
                        // Rounding gathers in what is tracked.
                        tracked = operator.track(&z);
                    }
                    end => return end,
                }
            } else if !largest_push.is_finite() {
                return Err(SolveError::NotFinite);
            }
        }
        judge(problem, z, Method::GaussSeidel, self.max_sweeps, bar)
    }
}
