//! What solvers return: a solution with its report, or a reason.

use crate::matrix::{Matrix, largest};
use crate::operator::Operator;
use crate::problem::{Lcp, residual_with};

/// Which method did it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Nothing to do: z at its bounds solves the problem.
    Trivial,
    /// [`Lemke`](crate::Lemke).
    Lemke,
    /// [`PrincipalPivoting`](crate::PrincipalPivoting).
    PrincipalPivoting,
    /// [`GaussSeidel`](crate::GaussSeidel).
    GaussSeidel,
    /// [`Newton`](crate::Newton).
    Newton,
    /// [`ProjectedGradient`](crate::ProjectedGradient).
    ProjectedGradient,
    /// [`InteriorPoint`](crate::InteriorPoint).
    InteriorPoint,
    /// [`enumerate`](crate::enumerate()).
    Enumeration,
    /// [`BlockGaussSeidel`](crate::cone::BlockGaussSeidel).
    BlockGaussSeidel,
    /// [`ConeNewton`](crate::cone::ConeNewton).
    ConeNewton,
}

/// How a solver ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// The method.
    pub method: Method,
    /// Pivots, sweeps, Newton steps or gradient steps taken.
    pub iterations: usize,
    /// Largest magnitude of the natural map; max |min(zᵢ, wᵢ)| for plain rows.
    pub residual: f64,
}

/// z, w = M z + q, and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The unknowns.
    pub z: Vec<f64>,
    /// M z + q.
    pub w: Vec<f64>,
    /// Iterations and residual.
    pub report: Report,
}

/// Why there is no solution to return.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The path of pivots runs off along a ray: z + t · ray. It proves nothing unless M is copositive-plus.
    #[error("the path ended on a secondary ray after {} pivots", report.iterations)]
    SecondaryRay {
        /// Direction of the ray in z.
        ray: Vec<f64>,
        /// Where it began.
        report: Report,
    },
    /// No z within the bounds gives w the required signs, and `certificate` proves it: see
    /// [`Lcp::is_infeasibility_certificate`].
    #[error("the problem is infeasible, which a Farkas vector certifies")]
    Infeasible {
        /// The Farkas vector y.
        certificate: Vec<f64>,
    },
    /// Every complementary basis was tried and none is a solution.
    #[error("no complementary basis solves the problem")]
    NoSolution,
    /// The iterations ran out, or no step made progress, before the tolerance was met.
    #[error("not converged: residual {:e} after {} iterations", report.residual, report.iterations)]
    NotConverged {
        /// The best z found.
        z: Vec<f64>,
        /// Its residual.
        report: Report,
    },
    /// Pivots of zero length went round in a circle, or their number passed its cap.
    #[error("cycling was stopped after {} pivots", report.iterations)]
    CyclingStopped {
        /// Where it stopped.
        z: Vec<f64>,
        /// Its residual.
        report: Report,
    },
    /// A pivot that the method cannot do without is zero.
    #[error("a pivot in row {row} is zero to rounding")]
    SingularPivot {
        /// The row.
        row: usize,
    },
    /// Numbers overflowed on the way, or a warm start was not finite.
    #[error("numbers left the finite range")]
    NotFinite,
    /// The method does not solve problems like this one.
    #[error("{method:?} does not apply: {reason}")]
    NotApplicable {
        /// The method.
        method: Method,
        /// Why not.
        reason: &'static str,
    },
}

/// The bar for pivoting methods: residual ≤ this · max(1, ‖q‖∞, ‖M‖∞ ‖z‖∞). A few thousand roundings.
///
/// Nor may it exceed 1e-6 ‖q‖∞: where there is no solution, z runs off to infinity and would take the bar along.
pub const PIVOTING_TOLERANCE: f64 = 1e-12;

/// Accepts z if its residual is within `tolerance` · scale, and says what it is otherwise.
pub(crate) fn judge<A: Operator>(
    problem: &Lcp<A>,
    z: Vec<f64>,
    method: Method,
    iterations: usize,
    bar: f64,
) -> Result<Solution, SolveError> {
    let w = problem.w(&z);
    let report = Report { method, iterations, residual: residual_with(problem, &z, &w) };
    if !(report.residual.is_finite() && bar.is_finite()) {
        Err(SolveError::NotFinite)
    } else if report.residual <= bar {
        Ok(Solution { z, w, report })
    } else {
        Err(SolveError::NotConverged { z, report })
    }
}

/// Accepts z by the bar for pivoting methods.
pub(crate) fn judge_pivoting(
    problem: &Lcp<Matrix>,
    z: Vec<f64>,
    method: Method,
    pivots: usize,
) -> Result<Solution, SolveError> {
    let bar = pivoting_bar(problem, &z);
    judge(problem, z, method, pivots, bar)
}

/// Where pivots were stopped at their cap: a solution all the same, if the place happens to be one.
pub(crate) fn stopped(end: Result<Solution, SolveError>) -> Result<Solution, SolveError> {
    end.map_err(|error| match error {
        SolveError::NotConverged { z, report } => SolveError::CyclingStopped { z, report },
        other => other,
    })
}

/// The largest residual a pivoting method may return with z.
pub(crate) fn pivoting_bar(problem: &Lcp<Matrix>, z: &[f64]) -> f64 {
    relative_bar(problem, z, PIVOTING_TOLERANCE)
}

/// The largest residual accepted with z at a given tolerance.
pub(crate) fn relative_bar(problem: &Lcp<Matrix>, z: &[f64], tolerance: f64) -> f64 {
    (tolerance * problem.scale(z)).min(1e-6 * largest(problem.q()))
}
