//! Newton's method on the Fischer–Burmeister function, with a line search.
//!
//! **Idea.** φ(a, b) = a + b − √(a² + b²) is zero exactly when 0 ≤ a ⟂ b ≥ 0. Solve φ(zᵢ, wᵢ) = 0 in all rows by Newton's method; the
//! squared sum is smooth, so a line search makes it safe. When the sides no longer change, one linear system gives all digits.
//!
//! **Equations.** Φᵢ = φ(zᵢ − lᵢ, −φ(uᵢ − zᵢ, −wᵢ)) (Billups 1995; an infinite bound drops out: φ(∞, b) = b). J = ∂Φ/∂z,
//! J Δz = −Φ; Armijo's rule on θ = ½ |Φ|². Where J is singular or the step is no descent: −∇θ = −Jᵀ Φ.
//!
//! **Good at.** Few iterations (5–20) whatever n; all bounds and friction; nonsymmetric M; a good warm start converges in two or
//! three steps; P-matrices on which active-set methods cycle.
//!
//! **Bad at.** One LU factorization of M's size per iteration; where M is no P₀-matrix θ has minima that are not solutions; slow near
//! solutions that are not isolated.
//!
//! **When to choose.** After Gauss–Seidel, from a warm start, or when pivots would be many.

use crate::active_set::polish;
use crate::factor::Lu;
use crate::matrix::{Matrix, add_scaled, dot, largest};
use crate::outcome::{Method, Solution, SolveError, judge, relative_bar};
use crate::problem::{Bound, Lcp};

/// Settings of Newton's method.
#[derive(Clone, Debug, PartialEq)]
pub struct Newton {
    /// Steps after which it gives up. Default 200.
    pub max_steps: usize,
    /// Accepted residual, in units of max(1, ‖q‖∞, ‖M‖∞ ‖z‖∞) \[1\]. Default 1e-12; what comes back is usually at rounding.
    pub tolerance: f64,
}

impl Default for Newton {
    fn default() -> Self {
        Self { max_steps: 200, tolerance: 1e-12 }
    }
}

impl Newton {
    /// Solves from z = 0.
    pub fn solve(&self, problem: &Lcp) -> Result<Solution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves from a first guess.
    pub fn solve_from(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        if z.len() != problem.dimension() || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let mut z = z.to_vec();
        let mut point = Point::at(problem, &z);
        let mut steps = 0;
        loop {
            if !point.merit.is_finite() {
                return Err(SolveError::NotFinite);
            }
            // Sides settle long before the last digits do, so try to finish by one linear system. It costs as much as a step.
            let finished = polish(problem, z.clone());
            let bar = relative_bar(problem, &finished, self.tolerance);
            if problem.residual(&finished) <= bar || steps >= self.max_steps {
                return judge(problem, finished, Method::Newton, steps, bar);
            }
            let Some((next, next_point)) = line_search(problem, &z, &point) else {
                return judge(problem, finished, Method::Newton, steps, bar);
            };
            (z, point) = (next, next_point);
            steps += 1;
        }
    }
}

/// Φ, its derivatives by its own z, w and limit, and θ.
struct Point {
    phi: Vec<f64>,
    by_z: Vec<f64>,
    by_w: Vec<f64>,
    /// By z_n of friction rows: ∂Φ/∂l · (−μ) + ∂Φ/∂u · μ.
    by_normal: Vec<f64>,
    merit: f64,
}

impl Point {
    fn at(problem: &Lcp, z: &[f64]) -> Self {
        let n = z.len();
        let w = problem.w(z);
        let mut point =
            Self { phi: vec![0.0; n], by_z: vec![0.0; n], by_w: vec![0.0; n], by_normal: vec![0.0; n], merit: 0.0 };
        for i in 0..n {
            let (lower, upper) = problem.limits(i, z);
            let inner = fischer_burmeister(upper - z[i], -w[i]);
            let outer = fischer_burmeister(z[i] - lower, -inner.value);
            point.phi[i] = outer.value;
            point.by_z[i] = outer.by_a + outer.by_b * inner.by_a;
            point.by_w[i] = outer.by_b * inner.by_b;
            if let Bound::Friction { normal, coefficient } = problem.bounds()[i]
                && z[normal] > 0.0
            {
                point.by_normal[i] = coefficient * (outer.by_a - outer.by_b * inner.by_a);
            }
        }
        point.merit = 0.5 * dot(&point.phi, &point.phi);
        point
    }

    /// ∂Φ/∂z.
    fn jacobian(&self, problem: &Lcp) -> Matrix {
        let n = self.phi.len();
        let mut jacobian = Matrix::from_fn(n, n, |i, j| self.by_w[i] * problem.matrix()[(i, j)]);
        for i in 0..n {
            jacobian[(i, i)] += self.by_z[i];
            if let Bound::Friction { normal, .. } = problem.bounds()[i] {
                jacobian[(i, normal)] += self.by_normal[i];
            }
        }
        jacobian
    }
}

/// φ(a, b) and its derivatives.
struct FischerBurmeister {
    value: f64,
    by_a: f64,
    by_b: f64,
}

fn fischer_burmeister(a: f64, b: f64) -> FischerBurmeister {
    if a == f64::INFINITY {
        return FischerBurmeister { value: b, by_a: 0.0, by_b: 1.0 };
    }
    let size = a.abs().max(b.abs());
    if size == 0.0 {
        // At the kink any element of the generalized gradient will do; this is its centre of symmetry.
        let slope = 1.0 - 0.5_f64.sqrt();
        return FischerBurmeister { value: 0.0, by_a: slope, by_b: slope };
    }
    let (x, y) = (a / size, b / size);
    let root = (x * x + y * y).sqrt();
    // a + b − √(a² + b²) = 2 a b / (a + b + √(a² + b²)), which does not cancel when both are positive.
    let value = if x + y > 0.0 { size * (2.0 * x * y / (x + y + root)) } else { size * (x + y - root) };
    FischerBurmeister { value, by_a: 1.0 - x / root, by_b: 1.0 - y / root }
}

/// The next iterate: along Newton's direction if that descends, along the gradient otherwise; `None` when neither does.
fn line_search(problem: &Lcp, z: &[f64], point: &Point) -> Option<(Vec<f64>, Point)> {
    let jacobian = point.jacobian(problem);
    let gradient = jacobian.transpose_multiply(&point.phi);
    let opposite = |x: &[f64]| x.iter().map(|x| -x).collect::<Vec<f64>>();
    let right = opposite(&point.phi);
    // A little of the identity in M helps where solutions are not isolated: the step of a proximal point method.
    let epsilon = 1e-8 * largest(problem.matrix().entries());
    let mut regular = jacobian.clone();
    (0..z.len()).for_each(|i| regular[(i, i)] += epsilon * point.by_w[i]);
    let newton = Lu::factor(jacobian).map(|lu| lu.solve(&right));
    let proximal = Lu::factor(regular).map(|lu| lu.solve(&right));
    // A gradient of the merit has its units squared; this step has the right ones.
    let squared = dot(&gradient, &gradient);
    let descent = (squared > 0.0).then(|| gradient.iter().map(|g| -g * (2.0 * point.merit / squared)).collect());
    for direction in [newton, proximal, descent].into_iter().flatten() {
        let slope = dot(&gradient, &direction);
        if !(slope < 0.0 && largest(&direction).is_finite()) {
            continue;
        }
        let mut step = 1.0;
        for _ in 0..40 {
            let mut next = z.to_vec();
            add_scaled(&mut next, step, &direction);
            let next_point = Point::at(problem, &next);
            if next_point.merit <= point.merit + 1e-4 * step * slope && next_point.merit < point.merit {
                return Some((next, next_point));
            }
            step *= 0.5;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fischer_burmeister_vanishes_exactly_on_complementary_pairs() {
        for (a, b) in [(0.0, 0.0), (0.0, 3.0), (1e300, 0.0), (f64::INFINITY, 0.0)] {
            assert_eq!(fischer_burmeister(a, b).value, 0.0, "φ({a}, {b})");
        }
        assert!(fischer_burmeister(1.0, 2.0).value > 0.0);
        assert!(fischer_burmeister(-1e-9, 2.0).value < 0.0);
        assert!(fischer_burmeister(-1.0, -2.0).value < 0.0);
    }

    #[test]
    fn jacobian_is_the_slope_of_the_function() {
        let m = Matrix::from_rows([[3.0, 1.0, -0.5], [0.2, 2.0, 0.1], [-0.3, 0.4, 1.5]]);
        let bounds = vec![
            Bound::Nonnegative,
            Bound::Friction { normal: 0, coefficient: 0.6 },
            Bound::Box { lower: -1.0, upper: 0.5 },
        ];
        let problem = Lcp::new(m, vec![-1.0, 0.7, 0.3]).unwrap().with_bounds(bounds).unwrap();
        let z = [0.4, -0.1, 0.2];
        let jacobian = Point::at(&problem, &z).jacobian(&problem);
        let h = 1e-6;
        for j in 0..3 {
            let (mut ahead, mut behind) = (z, z);
            ahead[j] += h;
            behind[j] -= h;
            let (ahead, behind) = (Point::at(&problem, &ahead), Point::at(&problem, &behind));
            for i in 0..3 {
                // Central difference: h² of curvature plus 1e-16 / h of rounding.
                assert!((jacobian[(i, j)] - (ahead.phi[i] - behind.phi[i]) / (2.0 * h)).abs() < 1e-8);
            }
        }
    }
}
