//! Block Gauss–Seidel: contact after contact, each solved exactly with its own friction disc (Jourdan, Alart, Jean 1998).
//!
//! **Idea.** Hold all other impulses, solve one contact for good, go on to the next. Repeat.
//!
//! **Equations.** For contact c: u_c = W_cc r_c + q̄_c with q̄_c = q_c + Σ_{d≠c} W_cd r_d; r_c by cases open, stick, slide.
//!
//! **Good at.** Any number of contacts, never builds W, exact disc, isotropic, uses a warm start fully, always gives something usable.
//!
//! **Bad at.** The error falls by a constant factor per sweep, slowly for stacks and large mass ratios.
//!
//! **When to choose.** By default for friction in space; then [`ConeNewton`](super::ConeNewton) for the last digits.

use super::local::{Block, solve_contact};
use super::problem::{FrictionProblem, FrictionSolution, block, judge};
use crate::matrix::largest;
use crate::operator::RowOperator;
use crate::outcome::{Method, SolveError};

/// Settings of block Gauss–Seidel.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockGaussSeidel {
    /// Sweeps after which it gives up. Default 20 000.
    pub max_sweeps: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞) \[1\]. Default 1e-8.
    pub tolerance: f64,
}

impl Default for BlockGaussSeidel {
    fn default() -> Self {
        Self { max_sweeps: 20_000, tolerance: 1e-8 }
    }
}

impl BlockGaussSeidel {
    /// Solves from r = 0.
    pub fn solve<A: RowOperator>(&self, problem: &FrictionProblem<A>) -> Result<FrictionSolution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.q().len()])
    }

    /// Solves from a first guess.
    pub fn solve_from<A: RowOperator>(
        &self,
        problem: &FrictionProblem<A>,
        impulses: &[f64],
    ) -> Result<FrictionSolution, SolveError> {
        if impulses.len() != problem.q().len() || impulses.iter().any(|r| !r.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let blocks = blocks_of(problem);
        if let Some(contact) = blocks.iter().position(|w| w[0][0].is_nan() || w[0][0] <= 0.0) {
            return Err(SolveError::SingularPivot { row: contact * problem.space().rows() });
        }
        let bar = self.tolerance * largest(problem.q()).max(1.0);
        let mut impulses = impulses.to_vec();
        let mut tracked = problem.matrix().track(&impulses);
        for sweep in 0..=self.max_sweeps {
            let push = if sweep > 0 { sweep_once(problem, &blocks, &mut impulses, &mut tracked) } else { 0.0 };
            if sweep <= 1 || push <= bar || sweep == self.max_sweeps {
                match judge(problem, impulses, Method::BlockGaussSeidel, sweep, bar) {
                    Err(SolveError::NotConverged { z, report }) => {
                        if sweep == self.max_sweeps || (sweep > 1 && push == 0.0) {
                            return Err(SolveError::NotConverged { z, report });
                        }
                        impulses = z;
                        tracked = problem.matrix().track(&impulses);
                    }
                    end => return end,
                }
            } else if !push.is_finite() {
                return Err(SolveError::NotFinite);
            }
        }
        judge(problem, impulses, Method::BlockGaussSeidel, self.max_sweeps, bar)
    }
}

/// The diagonal blocks of W.
pub(super) fn blocks_of<A: RowOperator>(problem: &FrictionProblem<A>) -> Vec<Block> {
    let rows = problem.space().rows();
    (0..problem.contacts())
        .map(|contact| {
            let first = contact * rows;
            // The missing tangent of the plane gets a row of its own that nothing moves.
            let mut w = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, problem.matrix().diagonal(first)]];
            for (i, row) in w.iter_mut().enumerate().take(rows) {
                for (j, entry) in row.iter_mut().enumerate().take(rows) {
                    *entry = problem.matrix().entry(first + i, first + j);
                }
            }
            w
        })
        .collect()
}

/// Solves every contact once; returns the largest change, as a velocity.
pub(super) fn sweep_once<A: RowOperator>(
    problem: &FrictionProblem<A>,
    blocks: &[Block],
    impulses: &mut [f64],
    tracked: &mut [f64],
) -> f64 {
    let rows = problem.space().rows();
    let mut largest_push = 0.0_f64;
    for (contact, w) in blocks.iter().enumerate() {
        let first = contact * rows;
        let old = block(impulses, contact, rows);
        let mut alone = [0.0; 3];
        for (i, value) in alone.iter_mut().enumerate().take(rows) {
            let own = w[i][0] * old[0] + w[i][1] * old[1] + w[i][2] * old[2];
            *value = problem.matrix().row(first + i, tracked) + problem.q()[first + i] - own;
        }
        let new = solve_contact(w, alone, problem.coefficients()[contact]);
        for k in 0..rows {
            let change = new[k] - old[k];
            if change != 0.0 {
                impulses[first + k] = new[k];
                problem.matrix().change(first + k, change, tracked);
                largest_push = largest_push.max(change.abs() * w[k][k].max(w[0][0]));
            }
        }
    }
    largest_push
}
