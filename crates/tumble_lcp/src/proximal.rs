//! Singular problems made regular, and the change taken back again (the proximal point method, Rockafellar 1976).
//!
//! Solve with M + ε I and q − ε z_k in place of M and q, and let z_{k+1} be the answer. The ε cancels at a fixed point, so the limit
//! solves the original problem; for positive semidefinite M it converges whatever the rank, and with small ε in two or three rounds.
//! Beginning at z₀ = 0, the first round picks nearly the solution of least norm, and the later ones hardly move along the kernel.

use crate::matrix::{Matrix, largest};
use crate::outcome::{PIVOTING_TOLERANCE, Report, Solution, SolveError, pivoting_bar};
use crate::problem::Lcp;

/// ε, in units of the largest diagonal entry: large enough to stand far above rounding, small enough to vanish in two rounds.
const STRENGTH: f64 = 1e-7;

/// Solves by rounds of `solve_from(regular problem, warm start)`.
pub(crate) fn proximal(
    problem: &Lcp,
    mut solve_from: impl FnMut(&Lcp, &[f64]) -> Result<Solution, SolveError>,
) -> Result<Solution, SolveError> {
    let n = problem.dimension();
    let diagonal = (0..n).map(|i| problem.matrix()[(i, i)]).fold(0.0, f64::max);
    let epsilon = STRENGTH * if diagonal > 0.0 { diagonal } else { largest(problem.matrix().entries()).max(1.0) };
    let mut regular: Matrix = problem.matrix().clone();
    (0..n).for_each(|i| regular[(i, i)] += epsilon);

    let mut z = vec![0.0; n];
    let mut iterations = 0;
    let mut best: Option<Solution> = None;
    let mut rounds_without_progress = 0;
    // With friction rows the rounds need not improve every time.
    while rounds_without_progress < 6 {
        let q = problem.q().iter().zip(&z).map(|(q, z)| q - epsilon * z).collect();
        let round = Lcp::new(regular.clone(), q)
            .and_then(|round| round.with_bounds(problem.bounds().to_vec()))
            .map_err(|_| SolveError::NotFinite)?;
        let answer = solve_from(&round, &z)?;
        iterations += answer.report.iterations;
        z = answer.z;
        let report = Report { iterations, residual: problem.residual(&z), ..answer.report };
        let last = best.as_ref().map_or(f64::INFINITY, |best| best.report.residual);
        // A round that gains less than this is rounding.
        let gains = report.residual < 0.5 * last;
        rounds_without_progress = if gains { 0 } else { rounds_without_progress + 1 };
        if report.residual < last {
            best = Some(Solution { w: problem.w(&z), z: z.clone(), report });
        }
        if let Some(found) = best.as_ref().filter(|best| best.report.residual <= pivoting_bar(problem, &best.z))
            && (!gains || found.report.residual <= 1e-2 * PIVOTING_TOLERANCE * problem.scale(&found.z))
        {
            break;
        }
    }
    let Some(Solution { z, w, report }) = best else { return Err(SolveError::NotFinite) };
    let report = Report { iterations, ..report };
    if report.residual <= pivoting_bar(problem, &z) {
        Ok(Solution { z, w, report })
    } else {
        Err(SolveError::NotConverged { z, report })
    }
}
