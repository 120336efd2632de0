//! Accelerated projected gradient descent (Nesterov 1983; for contacts Mazhar et al. 2015).
//!
//! **Idea.** For symmetric M the problem is the minimum of ½ zᵀ M z + qᵀ z within the bounds. Walk down the gradient w from a point that
//! carries some momentum, put the result back within the bounds, forget the momentum when it points uphill.
//!
//! **Equations.** In units x = z √Mᵢᵢ:  x⁺ = clamp(y − t w(y)),  y⁺ = x⁺ + β (x⁺ − x),  β = θ (1 − θ) / (θ² + θ⁺),
//! θ⁺² = (1 − θ⁺) θ². The step t halves until dᵀ M d ≤ |d|² / t for d = x⁺ − y; restart when w(y) · (x⁺ − x) > 0
//! (O'Donoghue and Candès 2015).
//!
//! **Good at.** One product M z per iteration and nothing else; error ∝ 1/k² however singular M is; large problems.
//!
//! **Bad at.** Symmetric positive semidefinite M only, no friction rows; hundreds of iterations for small residuals.
//!
//! **When to choose.** Thousands of rows that are never written as a matrix.

use crate::matrix::{dot, largest};
use crate::operator::{Operator, Scaled};
use crate::outcome::{Method, Solution, SolveError, judge};
use crate::problem::Lcp;

/// Settings of accelerated projected gradient descent.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectedGradient {
    /// Products M z after which it gives up. Default 20 000.
    pub max_iterations: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞) \[1\]. Default 1e-8.
    pub tolerance: f64,
}

impl Default for ProjectedGradient {
    fn default() -> Self {
        Self { max_iterations: 20_000, tolerance: 1e-8 }
    }
}

impl ProjectedGradient {
    /// Solves from z = 0. M must be symmetric and positive semidefinite, which is not checked.
    pub fn solve<A: Operator>(&self, problem: &Lcp<A>) -> Result<Solution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves from a first guess.
    pub fn solve_from<A: Operator>(&self, problem: &Lcp<A>, z: &[f64]) -> Result<Solution, SolveError> {
        let n = problem.dimension();
        let method = Method::ProjectedGradient;
        if z.len() != n || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        if problem.has_friction() {
            return Err(SolveError::NotApplicable { method, reason: "friction rows make M E nonsymmetric" });
        }
        let scale: Vec<f64> =
            (0..n).map(|i| problem.matrix().diagonal(i)).map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 1.0 }).collect();
        let bar = self.tolerance * largest(problem.q()).max(1.0);
        let scaled = Scaled { operator: problem.matrix(), scale: &scale };
        let q: Vec<f64> = problem.q().iter().zip(&scale).map(|(q, d)| q * d).collect();
        let project = |x: &mut [f64]| {
            for (i, x) in x.iter_mut().enumerate() {
                let (lower, upper) = problem.limits(i, &[]);
                *x = x.max(lower / scale[i]).min(upper / scale[i]);
            }
        };
        let to_z = |x: &[f64]| -> Vec<f64> {
            let mut z: Vec<f64> = x.iter().zip(&scale).map(|(x, d)| x * d).collect();
            problem.clamp(&mut z);
            z
        };

        let mut x: Vec<f64> = z.iter().zip(&scale).map(|(z, d)| z / d).collect();
        project(&mut x);
        let mut image = vec![0.0; n];
        scaled.apply(&x, &mut image);
        let (mut y, mut y_image) = (x.clone(), image.clone());
        let (mut step, mut theta) = (1.0_f64, 1.0_f64);
        let mut iterations = 1;
        let (mut best, mut best_residual) = (x.clone(), f64::INFINITY);
        loop {
            let residual = residual_of(problem, &to_z(&x), &image, &q, &scale);
            if !residual.is_finite() {
                return Err(SolveError::NotFinite);
            }
            if residual < best_residual {
                (best, best_residual) = (x.clone(), residual);
            }
            if best_residual <= bar || iterations >= self.max_iterations {
                return judge(problem, to_z(&best), method, iterations, bar);
            }
            let gradient: Vec<f64> = y_image.iter().zip(&q).map(|(m, q)| m + q).collect();
            let (next, next_image) = loop {
                let mut next: Vec<f64> = y.iter().zip(&gradient).map(|(y, g)| y - step * g).collect();
                project(&mut next);
                let mut next_image = vec![0.0; n];
                scaled.apply(&next, &mut next_image);
                iterations += 1;
                let d: Vec<f64> = next.iter().zip(&y).map(|(a, b)| a - b).collect();
                let image_of_d: Vec<f64> = next_image.iter().zip(&y_image).map(|(a, b)| a - b).collect();
                if dot(&d, &image_of_d) <= dot(&d, &d) / step || step < 1e-12 || iterations >= self.max_iterations {
                    break (next, next_image);
                }
                step *= 0.5;
            };
            let moved: Vec<f64> = next.iter().zip(&x).map(|(a, b)| a - b).collect();
            if dot(&gradient, &moved) > 0.0 {
                theta = 1.0;
                (y, y_image) = (next.clone(), next_image.clone());
            } else {
                let squared = theta * theta;
                let next_theta = 0.5 * ((squared * squared + 4.0 * squared).sqrt() - squared);
                let beta = theta * (1.0 - theta) / (squared + next_theta);
                theta = next_theta;
                y = next.iter().zip(&moved).map(|(x, d)| x + beta * d).collect();
                y_image = next_image.iter().zip(&image).map(|(a, b)| a + beta * (a - b)).collect();
            }
            (x, image) = (next, next_image);
            // Let the step find its way up again after a stiff region.
            step *= 1.05;
        }
    }
}

/// Residual of z from the image in scaled units.
fn residual_of<A: Operator>(problem: &Lcp<A>, z: &[f64], image: &[f64], q: &[f64], scale: &[f64]) -> f64 {
    let w: Vec<f64> = (0..z.len()).map(|i| (image[i] + q[i]) / scale[i]).collect();
    crate::problem::residual_with(problem, z, &w)
}
