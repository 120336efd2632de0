//! One call that chooses: looks at M, picks methods in order of promise, says which it took and what the others said.

use crate::enumerate::enumerate;
pub use crate::factor::Definiteness;
use crate::factor::definiteness;
use crate::gauss_seidel::GaussSeidel;
use crate::interior_point::InteriorPoint;
use crate::lemke::{Covering, Lemke};
use crate::matrix::{Matrix, largest};
use crate::newton::Newton;
use crate::outcome::{Method, Report, Solution, SolveError};
use crate::principal::PrincipalPivoting;
use crate::problem::{Bound, Lcp};

/// What was found out about M.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatrixClass {
    /// M = Mᵀ, to rounding.
    pub symmetric: bool,
    /// Definiteness of (M + Mᵀ)/2.
    pub definiteness: Definiteness,
    /// No entry is negative and the diagonal is positive, which makes M strictly copositive: a solution exists for every q.
    pub strictly_copositive: bool,
}

impl MatrixClass {
    /// Looks at a matrix: O(n³) for the definiteness.
    pub fn of(matrix: &Matrix) -> Self {
        let n = matrix.rows();
        let noise = 1e-13 * largest(matrix.entries());
        let symmetric = (0..n).all(|i| (0..i).all(|j| (matrix[(i, j)] - matrix[(j, i)]).abs() <= noise));
        let strictly_copositive = matrix.entries().iter().all(|&m| m >= 0.0) && (0..n).all(|i| matrix[(i, i)] > 0.0);
        Self { symmetric, definiteness: definiteness(matrix), strictly_copositive }
    }
}

/// A solution, and how the method was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// z, w and the report, which names the method.
    pub solution: Solution,
    /// What M was found to be.
    pub class: MatrixClass,
    /// Methods that were tried before, and how they ended.
    pub attempts: Vec<(Method, SolveError)>,
}

/// Above this many rows pivots cost more than the factorizations of an interior-point method or of Newton's.
const LARGE: usize = 400;

/// Solves a problem by whatever suits it.
///
/// | M | up to 400 rows | more |
/// |---|---|---|
/// | friction rows | principal pivoting, Newton, Lemke | Newton, then the same |
/// | symmetric, definite | principal pivoting, interior point | interior point first |
/// | semidefinite, or not symmetric | Lemke, interior point, principal pivoting | interior point first |
/// | other | Lemke, principal pivoting, Newton, Lemke along other paths, enumeration up to n = 12 | Newton first |
///
/// A certificate of infeasibility ends the search. When all fail, the failure with the most to say is returned.
pub fn solve(problem: &Lcp) -> Result<Solved, SolveError> {
    solve_from(problem, &vec![0.0; problem.dimension()])
}

/// The same, from a first guess.
pub fn solve_from(problem: &Lcp, guess: &[f64]) -> Result<Solved, SolveError> {
    let class = MatrixClass::of(problem.matrix());
    let mut attempts = Vec::new();
    for candidate in candidates(problem, class) {
        match candidate.run(problem, guess) {
            Ok(solution) => return Ok(Solved { solution, class, attempts }),
            Err(error @ (SolveError::Infeasible { .. } | SolveError::NoSolution)) => return Err(error),
            Err(error) => attempts.push((candidate.method(), error)),
        }
    }
    Err(most_telling(attempts))
}

/// A method with its settings.
enum Candidate {
    Trivial,
    Principal,
    Lemke(Covering),
    Newton,
    InteriorPoint,
    GaussSeidelThenNewton,
    Enumeration,
}

impl Candidate {
    fn method(&self) -> Method {
        match self {
            Self::Trivial => Method::Trivial,
            Self::Principal => Method::PrincipalPivoting,
            Self::Lemke(_) => Method::Lemke,
            Self::Newton | Self::GaussSeidelThenNewton => Method::Newton,
            Self::InteriorPoint => Method::InteriorPoint,
            Self::Enumeration => Method::Enumeration,
        }
    }

    fn run(&self, problem: &Lcp, guess: &[f64]) -> Result<Solution, SolveError> {
        match self {
            Self::Trivial => trivial(problem),
            Self::Principal => PrincipalPivoting::default().solve_from(problem, guess),
            Self::Lemke(covering) => Lemke { covering: *covering, ..Lemke::default() }.solve_from(problem, guess),
            Self::Newton => Newton::default().solve_from(problem, guess),
            Self::InteriorPoint => InteriorPoint::default().solve(problem),
            Self::GaussSeidelThenNewton => {
                let near = match (GaussSeidel { max_sweeps: 200, ..GaussSeidel::default() }).solve_from(problem, guess)
                {
                    Ok(solution) => solution.z,
                    Err(SolveError::NotConverged { z, .. }) => z,
                    Err(error) => return Err(error),
                };
                Newton::default().solve_from(problem, &near)
            }
            Self::Enumeration => enumerate(problem)?.into_iter().next().ok_or(SolveError::NoSolution),
        }
    }
}

/// The methods worth trying, most promising first.
fn candidates(problem: &Lcp, class: MatrixClass) -> Vec<Candidate> {
    let n = problem.dimension();
    let mut list = vec![Candidate::Trivial];
    if n > LARGE {
        let monotone = class.definiteness != Definiteness::Indefinite && !problem.has_friction();
        list.push(if monotone { Candidate::InteriorPoint } else { Candidate::GaussSeidelThenNewton });
    }
    let ones = Candidate::Lemke(Covering::Ones);
    if problem.has_friction() {
        list.extend([Candidate::Principal, Candidate::Newton, ones, Candidate::GaussSeidelThenNewton]);
    } else if class.definiteness == Definiteness::Indefinite {
        list.extend([ones, Candidate::Principal, Candidate::Newton]);
    } else if class.symmetric && class.definiteness == Definiteness::Positive {
        list.extend([Candidate::Principal, Candidate::InteriorPoint, ones, Candidate::Newton]);
    } else {
        list.extend([ones, Candidate::InteriorPoint, Candidate::Principal, Candidate::Newton]);
    }
    list.extend((1..=4).map(|seed| Candidate::Lemke(Covering::Spread(seed))));
    if n <= 12 && problem.bounds().iter().all(|bound| matches!(bound, Bound::Nonnegative)) {
        list.push(Candidate::Enumeration);
    }
    list
}

/// The z nearest to zero, when it happens to be a solution.
fn trivial(problem: &Lcp) -> Result<Solution, SolveError> {
    let mut z = vec![0.0; problem.dimension()];
    problem.clamp(&mut z);
    let w = problem.w(&z);
    let report = Report { method: Method::Trivial, iterations: 0, residual: problem.residual(&z) };
    if report.residual == 0.0 { Ok(Solution { z, w, report }) } else { Err(SolveError::NotConverged { z, report }) }
}

/// A ray says more than iterations that ran out; among those the smallest residual says most.
fn most_telling(attempts: Vec<(Method, SolveError)>) -> SolveError {
    let rank = |error: &SolveError| match error {
        SolveError::NotConverged { report, .. } | SolveError::CyclingStopped { report, .. } => (1, report.residual),
        SolveError::SecondaryRay { .. } => (0, 0.0),
        _ => (2, 0.0),
    };
    attempts
        .into_iter()
        .filter(|(method, _)| *method != Method::Trivial)
        .map(|(_, error)| error)
        .min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal))
        .unwrap_or(SolveError::NotFinite)
}
