//! Principal pivoting (Cottle and Dantzig; Baraff 1994 for contacts): one row at a time, the finished ones kept finished.
//!
//! **Idea.** Take a row whose signs are wrong and push its z until its w is zero or a bound stops it. While it moves, all rows done
//! before keep their complementarity: those with w = 0 answer with their z, those at a bound watch their w. Whichever would break
//! first changes its side, and the push goes on.
//!
//! A few block pivots, which change all wrong rows at once, come first and often leave little to do.
//!
//! **Equations.** With C the rows that have w = 0 and d the row that is driven,
//!
//! ```text
//! Δz_d = ±1,   Δz_C = −(M E)_CC⁻¹ (M E)_Cd Δz_d,   Δw = M Δz
//! ```
//!
//! E lets friction at its limit follow its normal: Δz_t = ±μ Δz_n. (M E)_CC⁻¹ is bordered, shrunk or changed in one column per
//! pivot, O(k²), and rebuilt from an LU factorization now and then.
//!
//! **Good at.** Symmetric positive (semi)definite M and P-matrices; boxes and friction coupled to a normal without any extra
//! unknowns; starting from the answer of the last step; infeasible problems, whose ray is a Farkas vector.
//!
//! **Bad at.** Zero pivots that are not zero rows: bimatrix games and other skew problems (it reports `SingularPivot`); strong friction,
//! where a solution need not be reached (it stops, and says so). 2ⁿ pivots in the worst case.
//!
//! **When to choose.** Resting contact with or without friction, joints and motors, up to a few hundred rows.

mod run;

use self::run::{Run, Stop};
use crate::active_set::polish;
use crate::outcome::{Method, Report, Solution, SolveError, judge_pivoting, stopped};
use crate::problem::Lcp;
use crate::proximal::proximal;

/// Which solution to take when there are many, as with a table on four legs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Indeterminate {
    /// The one that pivoting meets first: few rows push. Quickest.
    #[default]
    Vertex,
    /// The one of least norm, to about 1e-6: equal legs push equally, whatever their order.
    LeastNorm,
}

/// Settings of principal pivoting.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrincipalPivoting {
    /// What to do where solutions are not unique. Default: the first one met.
    pub indeterminate: Indeterminate,
    /// Pivots after which the method gives up. Default: 1000 + 50 n.
    pub max_pivots: Option<usize>,
}

impl PrincipalPivoting {
    /// Solves from z = 0.
    pub fn solve(&self, problem: &Lcp) -> Result<Solution, SolveError> {
        self.choose(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves, starting from the sides on which `z` stands: no pivots at all when they are right.
    pub fn solve_from(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        if z.len() != problem.dimension() || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        self.choose(problem, z)
    }

    /// Pivots on M itself; where that meets pivots lost in rounding, or on request, on M made regular.
    fn choose(&self, problem: &Lcp, start: &[f64]) -> Result<Solution, SolveError> {
        let run = |problem: &Lcp, start: &[f64]| match Run::warm(problem, start) {
            Some(warm) => self.finish(problem, warm).or_else(|_| self.finish(problem, Run::cold(problem))),
            None => self.finish(problem, Run::cold(problem)),
        };
        let rounds = || {
            let mut first = Some(start);
            proximal(problem, |regular, z| run(regular, first.take().unwrap_or(z)))
        };
        if self.indeterminate == Indeterminate::LeastNorm
            && let Ok(solution) = rounds()
        {
            return Ok(solution);
        }
        match run(problem, start) {
            Err(
                error @ (SolveError::SingularPivot { .. }
                | SolveError::SecondaryRay { .. }
                | SolveError::CyclingStopped { .. }
                | SolveError::NotConverged { .. }),
            ) if (0..problem.dimension()).all(|i| problem.matrix()[(i, i)] >= 0.0) => rounds().map_err(|_| error),
            end => end,
        }
    }

    fn finish(&self, problem: &Lcp, mut run: Run) -> Result<Solution, SolveError> {
        let cap = self.max_pivots.unwrap_or(1000 + 50 * problem.dimension());
        let end = run.drive_all(cap);
        let Run { z, pivots, .. } = run;
        let report =
            |z: &[f64]| Report { method: Method::PrincipalPivoting, iterations: pivots, residual: problem.residual(z) };
        match end {
            Ok(()) => judge_pivoting(problem, polish(problem, z), Method::PrincipalPivoting, pivots),
            Err(Stop::Cap) => stopped(judge_pivoting(problem, polish(problem, z), Method::PrincipalPivoting, pivots)),
            Err(Stop::Singular(row)) => Err(SolveError::SingularPivot { row }),
            Err(Stop::NotFinite) => Err(SolveError::NotFinite),
            Err(Stop::Ray(ray)) => {
                let opposite = ray.iter().map(|r| -r).collect();
                let certificate = [ray.clone(), opposite].into_iter().find(|y| problem.is_infeasibility_certificate(y));
                Err(match certificate {
                    Some(certificate) => SolveError::Infeasible { certificate },
                    None => SolveError::SecondaryRay { ray, report: report(&z) },
                })
            }
        }
    }
}
