//! Newton's method on the projections onto the friction discs (Alart and Curnier 1991), with sweeps to get into its range.
//!
//! **Idea.** Contact is a fixed point of "step against the velocity, put it back into the disc". Solve this fixed-point equation by
//! Newton's method; where its step does not help, a few Gauss–Seidel sweeps do.
//!
//! **Equations.** With x = r − ρ u per contact:
//!
//! ```text
//! F_n = r_n − max(0, x_n),   F_t = r_t − P(x_t),   P onto the disc of radius μ max(0, x_n)
//! ∂P: stick  I;   slide  μ e dx_n + μ x_n / |x_t| (I − e eᵀ) dx_t,  e = x_t / |x_t|;   open  0
//! ```
//!
//! ρ = 1 / W_nn and 1 / ½ tr W_tt. W gets 1e-10 of its diagonal added in the derivative, so that hyperstatic contacts have a step.
//!
//! **Good at.** Residuals at rounding in 5–15 iterations, any friction coefficient, mass ratios, warm starts.
//!
//! **Bad at.** One LU factorization of W's size per iteration; no proof of convergence, like everything for Coulomb friction.
//!
//! **When to choose.** When creep must be nil: exact sticking contacts, comparison runs.

use super::gauss_seidel::{blocks_of, sweep_once};
use super::local::Block;
use super::problem::{FrictionProblem, FrictionSolution, block, judge, length};
use crate::factor::Lu;
use crate::matrix::{Matrix, add_scaled, dot, largest};
use crate::outcome::{Method, SolveError};

/// Settings of Newton's method for friction.
#[derive(Clone, Debug, PartialEq)]
pub struct ConeNewton {
    /// Newton steps after which it gives up. Default 100.
    pub max_steps: usize,
    /// Gauss–Seidel sweeps where a Newton step does not help; doubled each time. Default 20.
    pub sweeps: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞, ‖W‖∞ ‖r‖∞) \[1\]. Default 1e-12.
    pub tolerance: f64,
}

impl Default for ConeNewton {
    fn default() -> Self {
        Self { max_steps: 100, sweeps: 20, tolerance: 1e-12 }
    }
}

impl ConeNewton {
    /// Solves from r = 0.
    pub fn solve(&self, problem: &FrictionProblem) -> Result<FrictionSolution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.q().len()])
    }

    /// Solves from a first guess.
    pub fn solve_from(&self, problem: &FrictionProblem, impulses: &[f64]) -> Result<FrictionSolution, SolveError> {
        if impulses.len() != problem.q().len() || impulses.iter().any(|r| !r.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let blocks = blocks_of(problem);
        if let Some(contact) = blocks.iter().position(|w| w[0][0].is_nan() || w[0][0] <= 0.0) {
            return Err(SolveError::SingularPivot { row: contact * problem.space().rows() });
        }
        let bar = |r: &[f64]| (self.tolerance * problem.scale(r)).min(1e-6 * largest(problem.q()));
        let mut r = impulses.to_vec();
        let mut best = (r.clone(), f64::INFINITY);
        let mut sweeps = self.sweeps.max(1);
        for step in 0..=self.max_steps {
            let residual = problem.residual(&r);
            if !residual.is_finite() {
                return Err(SolveError::NotFinite);
            }
            if residual < best.1 {
                best = (r.clone(), residual);
            }
            if best.1 <= bar(&best.0) || step == self.max_steps {
                // One more Newton step usually squares what is left.
                if let Some(last) = newton_step(problem, &blocks, &best.0)
                    && problem.residual(&last) < best.1
                {
                    best.0 = last;
                }
                let bar = bar(&best.0);
                return judge(problem, best.0, Method::ConeNewton, step, bar);
            }
            let next = newton_step(problem, &blocks, &r);
            if let Some(next) = next {
                r = next;
            } else {
                r.clone_from(&best.0);
                let mut tracked = r.clone();
                for _ in 0..sweeps {
                    sweep_once(problem, &blocks, &mut r, &mut tracked);
                }
                // Not near enough yet: come nearer before the next try.
                sweeps = (2 * sweeps).min(5000);
            }
        }
        let bar = bar(&best.0);
        judge(problem, best.0, Method::ConeNewton, self.max_steps, bar)
    }
}

/// The next iterate, if some part of Newton's step makes |F| clearly smaller.
fn newton_step(problem: &FrictionProblem, blocks: &[Block], r: &[f64]) -> Option<Vec<f64>> {
    let (defect, jacobian) = linearise(problem, blocks, r);
    let before = dot(&defect, &defect);
    if before == 0.0 {
        return None;
    }
    let right: Vec<f64> = defect.iter().map(|f| -f).collect();
    let direction = Lu::factor(jacobian)?.solve(&right);
    if !largest(&direction).is_finite() {
        return None;
    }
    let mut step = 1.0;
    for _ in 0..3 {
        let mut next = r.to_vec();
        add_scaled(&mut next, step, &direction);
        let after = defect_of(problem, blocks, &next);
        if dot(&after, &after) < (1.0 - 0.5 * step) * before {
            return Some(next);
        }
        step *= 0.5;
    }
    None
}

/// ρ of a contact for its normal and its tangents.
fn step_sizes(w: &Block, rows: usize) -> [f64; 3] {
    let tangent = if rows == 2 { w[1][1] } else { 0.5 * (w[1][1] + w[2][2]) };
    let tangent = if tangent > 0.0 { 1.0 / tangent } else { 1.0 / w[0][0] };
    [1.0 / w[0][0], tangent, tangent]
}

/// F.
fn defect_of(problem: &FrictionProblem, blocks: &[Block], r: &[f64]) -> Vec<f64> {
    let rows = problem.space().rows();
    let u = problem.velocities(r);
    let mut defect = vec![0.0; r.len()];
    for (contact, w) in blocks.iter().enumerate() {
        let (x, own) = (target(r, &u, contact, w, rows), block(r, contact, rows));
        let (y, z) = super::problem::project_on_disc(x[1], x[2], problem.coefficients()[contact] * x[0].max(0.0));
        let projected = [x[0].max(0.0), y, z];
        for k in 0..rows {
            defect[contact * rows + k] = own[k] - projected[k];
        }
    }
    defect
}

/// x = r − ρ u of a contact.
fn target(r: &[f64], u: &[f64], contact: usize, w: &Block, rows: usize) -> [f64; 3] {
    let rho = step_sizes(w, rows);
    let (r, u) = (block(r, contact, rows), block(u, contact, rows));
    std::array::from_fn(|k| r[k] - rho[k] * u[k])
}

/// F and an element of its generalized derivative, I − ∂P (I − ρ W).
fn linearise(problem: &FrictionProblem, blocks: &[Block], r: &[f64]) -> (Vec<f64>, Matrix) {
    let rows = problem.space().rows();
    let n = r.len();
    let u = problem.velocities(r);
    let mut jacobian = Matrix::identity(n);
    for (contact, w) in blocks.iter().enumerate() {
        let mu = problem.coefficients()[contact];
        let x = target(r, &u, contact, w, rows);
        let slope = slope_of_projection(x, mu);
        let rho = step_sizes(w, rows);
        let first = contact * rows;
        for i in 0..rows {
            for (k, &rho) in rho.iter().enumerate().take(rows) {
                let factor = slope[i][k];
                if factor == 0.0 {
                    continue;
                }
                jacobian[(first + i, first + k)] -= factor * (1.0 - 1e-10);
                add_scaled(jacobian.row_mut(first + i), factor * rho, problem.matrix().row(first + k));
            }
        }
    }
    (defect_of(problem, blocks, r), jacobian)
}

/// ∂P at x.
fn slope_of_projection(x: [f64; 3], mu: f64) -> [[f64; 3]; 3] {
    if x[0] <= 0.0 {
        return [[0.0; 3]; 3];
    }
    let slip = length(x[1], x[2]);
    if slip <= mu * x[0] {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let e = [x[1] / slip, x[2] / slip];
    let bend = mu * x[0] / slip;
    [
        [1.0, 0.0, 0.0],
        [mu * e[0], bend * (1.0 - e[0] * e[0]), -bend * e[0] * e[1]],
        [mu * e[1], -bend * e[0] * e[1], bend * (1.0 - e[1] * e[1])],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone::ContactSpace;

    #[test]
    fn jacobian_is_the_slope_of_the_function() {
        let w = Matrix::from_rows([[15.0, -1.0, -2.0], [-1.0, 14.0, 1.0], [-2.0, 1.0, 16.0]]);
        let problem = FrictionProblem::new(w, vec![-1.0, 2.0, 3.0], vec![0.3], ContactSpace::Spatial).unwrap();
        let blocks = blocks_of(&problem);
        for r in [[0.07, -0.003, -0.005], [0.2, 0.01, -0.02], [0.4, -0.15, -0.2]] {
            let (_, jacobian) = linearise(&problem, &blocks, &r);
            let h = 1e-6;
            for j in 0..3 {
                let (mut ahead, mut behind) = (r, r);
                ahead[j] += h;
                behind[j] -= h;
                let (ahead, behind) = (defect_of(&problem, &blocks, &ahead), defect_of(&problem, &blocks, &behind));
                for i in 0..3 {
                    // Central difference: h² of curvature, 1e-16 / h of rounding, and the 1e-10 that was added.
                    assert!((jacobian[(i, j)] - (ahead[i] - behind[i]) / (2.0 * h)).abs() < 1e-8, "{r:?} {i} {j}");
                }
            }
        }
    }
}
