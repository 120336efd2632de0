//! A primal–dual interior-point method (Mehrotra's predictor and corrector).
//!
//! **Idea.** Stay strictly inside the bounds and follow the central path, on which every product of slack and multiplier is the same μ, while μ
//! goes to zero. When the sides are clear, one linear system gives all digits.
//!
//! **Equations.** With a = z − l, b = u − z and multipliers s, t > 0:
//!
//! ```text
//! M z + q = s − t,   a s = μ,   b t = μ
//! (M + s/a + t/b) Δz = −(M z + q − s + t) + (σμ − a s)/a − (σμ − b t)/b
//! ```
//!
//! **Good at.** Positive semidefinite M, symmetric or not, with any bounds; 10–25 iterations whatever n and however degenerate.
//!
//! **Bad at.** One LU factorization of M's size per iteration; no warm start; infeasible problems are not certified; not for friction
//! rows or indefinite M.
//!
//! **When to choose.** Several hundred rows or more, where pivots would be as many.

use crate::active_set::polish;
use crate::factor::Lu;
use crate::matrix::largest;
use crate::outcome::{Method, Solution, SolveError, judge, relative_bar};
use crate::problem::Lcp;

/// Settings of the interior-point method.
#[derive(Clone, Debug, PartialEq)]
pub struct InteriorPoint {
    /// Iterations after which it gives up. Default 100.
    pub max_iterations: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞, ‖M‖∞ ‖z‖∞) \[1\]. Default 1e-9; isolated solutions come back at rounding.
    pub tolerance: f64,
}

impl Default for InteriorPoint {
    fn default() -> Self {
        Self { max_iterations: 100, tolerance: 1e-9 }
    }
}

impl InteriorPoint {
    /// Solves the problem. M must be positive semidefinite, which is not checked.
    pub fn solve(&self, problem: &Lcp) -> Result<Solution, SolveError> {
        let n = problem.dimension();
        let method = Method::InteriorPoint;
        let limits: Vec<(f64, f64)> = (0..n).map(|i| problem.limits(i, &vec![0.0; n])).collect();
        if problem.has_friction() {
            return Err(SolveError::NotApplicable { method, reason: "friction rows make M E nonsymmetric" });
        }
        if limits.iter().any(|(lower, upper)| lower == upper) {
            return Err(SolveError::NotApplicable { method, reason: "a box without width has no interior" });
        }
        let mut point = Point::inside(&limits, largest(problem.q()).max(1.0));
        let mut best = point.z.clone();
        let mut best_ratio = f64::INFINITY;
        for iteration in 0..=self.max_iterations {
            let mut z = point.z.clone();
            problem.clamp(&mut z);
            let scale = problem.scale(&z);
            let ratio = problem.residual(&z) / scale;
            if ratio < best_ratio {
                (best, best_ratio) = (z, ratio);
            }
            // From here on the sides are usually clear.
            let nearly = ratio <= 1e-7;
            if nearly || iteration == self.max_iterations {
                let finished = polish(problem, best.clone());
                let bar = relative_bar(problem, &finished, self.tolerance);
                let end = judge(problem, finished, method, iteration, bar);
                if end.is_ok() || iteration == self.max_iterations {
                    return end;
                }
            }
            if !point.advance(problem, &limits) {
                let finished = polish(problem, best);
                let bar = relative_bar(problem, &finished, self.tolerance);
                return judge(problem, finished, method, iteration, bar);
            }
        }
        let bar = relative_bar(problem, &best, self.tolerance);
        judge(problem, best, method, self.max_iterations, bar)
    }
}

/// A strictly interior point; s and t are zero where their side is infinite.
struct Point {
    z: Vec<f64>,
    s: Vec<f64>,
    t: Vec<f64>,
}

impl Point {
    fn inside(limits: &[(f64, f64)], size: f64) -> Self {
        let middle = |&(lower, upper): &(f64, f64)| match (lower.is_finite(), upper.is_finite()) {
            (true, true) => 0.5 * lower + 0.5 * upper,
            (true, false) => lower + 1.0,
            (false, true) => upper - 1.0,
            (false, false) => 0.0,
        };
        Self {
            z: limits.iter().map(middle).collect(),
            s: limits.iter().map(|(lower, _)| if lower.is_finite() { size } else { 0.0 }).collect(),
            t: limits.iter().map(|(_, upper)| if upper.is_finite() { size } else { 0.0 }).collect(),
        }
    }

    /// One predictor–corrector step; false when no further progress is possible.
    fn advance(&mut self, problem: &Lcp, limits: &[(f64, f64)]) -> bool {
        let n = self.z.len();
        let a: Vec<f64> = (0..n).map(|i| self.z[i] - limits[i].0).collect();
        let b: Vec<f64> = (0..n).map(|i| limits[i].1 - self.z[i]).collect();
        let w = problem.w(&self.z);
        let sides = limits.iter().map(|(l, u)| usize::from(l.is_finite()) + usize::from(u.is_finite())).sum::<usize>();
        let product = |a: f64, s: f64| if s > 0.0 { a * s } else { 0.0 };
        let gap: f64 = (0..n).map(|i| product(a[i], self.s[i]) + product(b[i], self.t[i])).sum();
        let mu = gap / sides.max(1) as f64;

        let mut matrix = problem.matrix().clone();
        for i in 0..n {
            // A slack of infinity divides to zero.
            matrix[(i, i)] += self.s[i] / a[i] + self.t[i] / b[i];
        }
        // Near the end the diagonal spans twenty orders of magnitude; in units of its roots the pivots do not.
        let root: Vec<f64> = (0..n).map(|i| matrix[(i, i)]).map(|d| if d > 0.0 { d.sqrt() } else { 1.0 }).collect();
        for i in 0..n {
            matrix.row_mut(i).iter_mut().zip(&root).for_each(|(m, r)| *m /= root[i] * r);
        }
        let Some(lu) = Lu::factor(matrix) else { return false };
        let solve = |right: Vec<f64>| -> Vec<f64> {
            let scaled: Vec<f64> = right.iter().zip(&root).map(|(x, r)| x / r).collect();
            lu.solve(&scaled).iter().zip(&root).map(|(x, r)| x / r).collect()
        };
        // Directions for given targets of the products a s and b t.
        let directions = |of_a: &dyn Fn(usize) -> f64, of_b: &dyn Fn(usize) -> f64| {
            let right: Vec<f64> = (0..n)
                .map(|i| {
                    let (s, t) = (self.s[i], self.t[i]);
                    let lower = if s > 0.0 { of_a(i) / a[i] } else { 0.0 };
                    let upper = if t > 0.0 { of_b(i) / b[i] } else { 0.0 };
                    // −r + (target − a s)/a − (target − b t)/b, in which s and t cancel.
                    -w[i] + lower - upper
                })
                .collect();
            let dz = solve(right);
            let (mut ds, mut dt) = (vec![0.0; n], vec![0.0; n]);
            for i in 0..n {
                if self.s[i] > 0.0 {
                    ds[i] = (of_a(i) - self.s[i] * dz[i]) / a[i] - self.s[i];
                }
                if self.t[i] > 0.0 {
                    dt[i] = (of_b(i) + self.t[i] * dz[i]) / b[i] - self.t[i];
                }
            }
            (dz, ds, dt)
        };
        let longest = |(dz, ds, dt): &(Vec<f64>, Vec<f64>, Vec<f64>)| {
            let mut step = 1.0_f64;
            for i in 0..n {
                for (value, change) in [(a[i], dz[i]), (b[i], -dz[i]), (self.s[i], ds[i]), (self.t[i], dt[i])] {
                    if change < 0.0 && value.is_finite() {
                        step = step.min(-value / change);
                    }
                }
            }
            step
        };

        let predictor = directions(&|_| 0.0, &|_| 0.0);
        let step = longest(&predictor);
        let (dz, ds, dt) = &predictor;
        let ahead: f64 = (0..n)
            .map(|i| {
                product(a[i] + step * dz[i], self.s[i] + step * ds[i])
                    + product(b[i] - step * dz[i], self.t[i] + step * dt[i])
            })
            .sum();
        let fraction = if gap > 0.0 { (ahead / gap).clamp(0.01, 1.0) } else { 0.0 };
        let centring = fraction * fraction * fraction * mu;
        // The correction assumes a full step; where the predictor could not take one, take less of it (Colombo and Gondzio 2008).
        let weight = step * step;
        let corrected = directions(&|i| centring - weight * dz[i] * ds[i], &|i| centring + weight * dz[i] * dt[i]);
        let (dz, ds, dt) = &corrected;
        // Stay near the path: no product may fall far behind their mean, or later steps are short.
        let is_central = |step: f64| {
            let products: Vec<f64> = (0..n)
                .flat_map(|i| {
                    let lower = (self.s[i] > 0.0).then(|| (a[i] + step * dz[i]) * (self.s[i] + step * ds[i]));
                    let upper = (self.t[i] > 0.0).then(|| (b[i] - step * dz[i]) * (self.t[i] + step * dt[i]));
                    lower.into_iter().chain(upper)
                })
                .collect();
            let mean = products.iter().sum::<f64>() / products.len().max(1) as f64;
            products.iter().all(|&product| product >= 1e-3 * mean)
        };
        let mut step = (0.995 * longest(&corrected)).min(1.0);
        while step > 1e-10 && !is_central(step) {
            step *= 0.8;
        }
        if !(largest(dz).is_finite() && step > 1e-10) {
            return false;
        }
        for i in 0..n {
            self.z[i] += step * dz[i];
            self.s[i] += step * ds[i];
            self.t[i] += step * dt[i];
        }
        // Rounding may put a slack on its bound, where the method cannot go on.
        (0..n).all(|i| self.z[i] > limits[i].0 && self.z[i] < limits[i].1)
            && (0..n).all(|i| (self.s[i] > 0.0) == limits[i].0.is_finite())
            && (0..n).all(|i| (self.t[i] > 0.0) == limits[i].1.is_finite())
    }
}
