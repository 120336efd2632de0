//! Lemke's method: complementary pivoting along a path from a covering vector.
//!
//! **Idea.** Add so much of a positive vector d to q that z = 0 is a solution; then take it away again, pivoting so that every row but
//! one stays complementary. The path never branches and never returns.
//!
//! **Equations.** w = M z + q + d z₀. The basis B is made of columns of I (basic w), −M (basic z) and −d (z₀); x_B = B⁻¹ q. After a
//! variable leaves, its complement enters. Ratio test: min xᵢ / αᵢ over αᵢ > 0, α = B⁻¹ a_entering; ties are decided by the rows of
//! [x_B, B⁻¹] / αᵢ in lexicographic order, which makes cycling impossible (Cottle, Pang, Stone 1992, section 4.9). B⁻¹ is updated
//! by one elementary matrix per pivot and rebuilt from an LU factorization now and then; the answer is refined on the original M.
//!
//! **Good at.** Solves every copositive-plus problem (all positive semidefinite ones, P-matrices, frictional contact in polyhedral
//! form) or proves it infeasible. Any bounds, by [plain form](crate::Bound).
//!
//! **Bad at.** O(n²) per pivot with pivots ∝ n in practice, but 2ⁿ in the worst case (Murty); for matrices outside its classes a
//! secondary ray says nothing.
//!
//! **When to choose.** Up to a few hundred rows, when M is not symmetric, or when certainty is wanted.

mod path;

use self::path::{Path, PathEnd};
use crate::active_set::polish;
use crate::factor::{Definiteness, definiteness};
use crate::matrix::{Matrix, largest};
use crate::outcome::{Method, Report, Solution, SolveError, judge_pivoting, stopped};
use crate::problem::Lcp;
use crate::proximal::proximal;
use crate::standard::{Standard, equilibrate};

/// The vector d that covers negative q.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Covering {
    /// All ones.
    #[default]
    Ones,
    /// Numbers between 1 and 2, different for each seed: another path, which may miss a secondary ray.
    Spread(u32),
}

/// Whether rows are brought into similar units first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scaling {
    /// M, q as given.
    None,
    /// Rows and columns times powers of two, which rounds nothing.
    #[default]
    PowersOfTwo,
}

/// Settings of Lemke's method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lemke {
    /// The covering vector. Default: ones.
    pub covering: Covering,
    /// Units. Default: powers of two.
    pub scaling: Scaling,
    /// Pivots after which the method gives up. Default: 1000 + 50 n.
    pub max_pivots: Option<usize>,
}

impl Lemke {
    /// Solves from scratch.
    pub fn solve(&self, problem: &Lcp) -> Result<Solution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves, starting from the basis in which the positive entries of `z` are basic: few pivots when z is nearly right.
    pub fn solve_from(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        if z.len() != problem.dimension() || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        // The guarantees of the path hold from z = 0; from elsewhere it may meet a ray where there is a solution.
        let cold = vec![0.0; z.len()];
        let run = |problem: &Lcp, z: &[f64]| match self.run(problem, z) {
            Err(
                SolveError::SecondaryRay { .. } | SolveError::SingularPivot { .. } | SolveError::NotConverged { .. },
            ) if z != cold => self.run(problem, &cold),
            end => end,
        };
        match run(problem, z) {
            // Pivots lost in rounding: the same on M made regular, as long as that is what M is near.
            Err(
                error @ (SolveError::SingularPivot { .. }
                | SolveError::SecondaryRay { .. }
                | SolveError::NotConverged { .. }),
            ) if problem.has_friction() || definiteness(problem.matrix()) != Definiteness::Indefinite => {
                proximal(problem, run).map_err(|_| error)
            }
            end => end,
        }
    }

    fn run(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        let standard = Standard::of(problem);
        let (mut matrix, mut q) = (standard.matrix.clone(), standard.q.clone());
        let units = match self.scaling {
            Scaling::None => vec![1.0; q.len()],
            Scaling::PowersOfTwo => equilibrate(&mut matrix, &mut q).of_x,
        };
        if !(largest(matrix.entries()).is_finite() && largest(&q).is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let recover = |x: &[f64]| standard.recover(problem, &in_units(x, &units));
        let cap = self.max_pivots.unwrap_or(1000 + 50 * q.len());
        let warm: Vec<bool> = standard.project(z).iter().map(|&x| x > 0.0).collect();
        let mut path = Path::new(&matrix, &q, warm);
        let end = path.follow(self.covering, cap);
        let (x, pivots) = (path.z(), path.pivots);
        match end {
            PathEnd::Solution => judge_pivoting(problem, polish(problem, recover(&x)), Method::Lemke, pivots),
            PathEnd::Ray(ray) => {
                // z₀ may be zero already, tied with the row that opened the ray.
                let here = recover(&x);
                if problem.residual(&here) <= 1e-9 * problem.scale(&here) {
                    let here = judge_pivoting(problem, polish(problem, here), Method::Lemke, pivots);
                    if here.is_ok() {
                        return here;
                    }
                }
                let ray = in_units(&ray, &units);
                // On a copositive-plus problem the ray itself is a Farkas vector; otherwise a linear program may find one.
                let from_ray = [standard.recover_certificate(problem, &ray)];
                let certificate = from_ray
                    .into_iter()
                    .chain(
                        infeasibility(&matrix, &q)
                            .map(|y| standard.recover_certificate(problem, &in_units(&y, &units))),
                    )
                    .find(|y| problem.is_infeasibility_certificate(y));
                if let Some(certificate) = certificate {
                    return Err(SolveError::Infeasible { certificate });
                }
                let residual = problem.residual(&recover(&x));
                let report = Report { method: Method::Lemke, iterations: pivots, residual };
                let origin = standard.recover(problem, &vec![0.0; ray.len()]);
                let ray = standard.recover(problem, &ray).iter().zip(&origin).map(|(end, start)| end - start).collect();
                Err(SolveError::SecondaryRay { ray, report })
            }
            PathEnd::Singular => Err(SolveError::SingularPivot { row: 0 }),
            PathEnd::NotFinite => Err(SolveError::NotFinite),
            PathEnd::OutOfPivots => {
                stopped(judge_pivoting(problem, polish(problem, recover(&x)), Method::Lemke, pivots))
            }
        }
    }
}

/// x in the original units.
fn in_units(x: &[f64], units: &[f64]) -> Vec<f64> {
    x.iter().zip(units).map(|(x, unit)| x * unit).collect()
}

/// A vector y ≥ 0 with Mᵀ y ≤ 0 and qᵀ y < 0, if z ≥ 0, M z + q ≥ 0 is infeasible; the caller checks it.
///
/// The feasibility of a linear system is itself an LCP, [[0, −Mᵀ], [M, 0]] with (0, q); it is skew, so Lemke's method decides it.
fn infeasibility(matrix: &Matrix, q: &[f64]) -> Option<Vec<f64>> {
    let n = q.len();
    // Twice the size and only worth it where the answer is wanted: beyond this it would dominate everything else.
    if n > 300 {
        return None;
    }
    let skew = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) => -matrix[(j - n, i)],
        (false, true) => matrix[(i - n, j)],
        _ => 0.0,
    });
    let padded: Vec<f64> = std::iter::repeat_n(0.0, n).chain(q.iter().copied()).collect();
    let mut path = Path::new(&skew, &padded, vec![false; 2 * n]);
    match path.follow(Covering::Ones, 1000 + 50 * n) {
        PathEnd::Ray(ray) => Some(ray[n..].to_vec()),
        _ => None,
    }
}
