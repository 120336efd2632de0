//! Prints how the time of each solver grows with the number of rows, class by class.
//!
//! You will see a table of microseconds per solution at n = 24, 48, 96 and 192, the exponent p of time ∝ nᵖ fitted to it, and the
//! iterations at the largest size. A dash means that the solver does not claim this class, or gave up on it.

use std::time::Instant;

use tumble_lcp::families::Family;
use tumble_lcp::{
    GaussSeidel, InteriorPoint, Lcp, Lemke, Newton, PrincipalPivoting, ProjectedGradient, Solution, SolveError, solve,
};

type Solver = (&'static str, fn(&Lcp) -> Result<Solution, SolveError>);

const SIZES: [usize; 4] = [24, 48, 96, 192];

const SOLVERS: [Solver; 7] = [
    ("Lemke", |problem| Lemke::default().solve(problem)),
    ("principal pivoting", |problem| PrincipalPivoting::default().solve(problem)),
    ("Newton", |problem| Newton::default().solve(problem)),
    ("interior point", |problem| InteriorPoint::default().solve(problem)),
    ("Gauss–Seidel 1e-6", |problem| GaussSeidel { tolerance: 1e-6, ..GaussSeidel::default() }.solve(problem)),
    ("gradient 1e-6", |problem| ProjectedGradient { tolerance: 1e-6, ..ProjectedGradient::default() }.solve(problem)),
    ("solve", |problem| solve(problem).map(|solved| solved.solution)),
];

fn main() {
    let mut fastest_seen = f64::INFINITY;
    for family in Family::ALL.into_iter().filter(|family| *family != Family::Infeasible) {
        println!("\n{family:?}\n{:20} {:>9} {:>9} {:>9} {:>9}  exponent  iterations", "[µs]", 24, 48, 96, 192);
        for (name, run) in SOLVERS {
            let measured: Vec<Option<(f64, usize)>> = SIZES.iter().map(|&n| measure(family, n, run)).collect();
            let cells: String = measured
                .iter()
                .map(|m| m.map_or(format!(" {:>9}", "–"), |(time, _)| format!(" {time:>9.1}")))
                .collect();
            let exponent = exponent(&measured).map_or("–".to_string(), |p| format!("{p:.2}"));
            let iterations =
                measured.last().copied().flatten().map_or("–".to_string(), |(_, count)| count.to_string());
            println!("{name:20}{cells}  {exponent:>8}  {iterations:>10}");
            fastest_seen = measured.iter().flatten().map(|(time, _)| *time).fold(fastest_seen, f64::min);
        }
    }
    assert!(fastest_seen.is_finite(), "some solver must have solved something");
}

/// Shortest time of a few runs on each of three problems [µs], and the iterations; `None` when any of them was not solved.
fn measure(family: Family, n: usize, run: fn(&Lcp) -> Result<Solution, SolveError>) -> Option<(f64, usize)> {
    let (mut total, mut iterations) = (0.0, 0);
    for seed in 0..3 {
        let problem = family.sample(n, seed).problem;
        let mut best = f64::INFINITY;
        for _ in 0..3 {
            let start = Instant::now();
            let outcome = run(&problem);
            best = best.min(start.elapsed().as_secs_f64() * 1e6);
            iterations += outcome.ok()?.report.iterations;
        }
        total += best;
    }
    Some((total / 3.0, iterations / 9))
}

/// Least-squares slope of log time over log n.
fn exponent(measured: &[Option<(f64, usize)>]) -> Option<f64> {
    let points: Vec<(f64, f64)> = SIZES
        .iter()
        .zip(measured)
        .filter_map(|(&n, m)| m.map(|(time, _)| (libm::log(n as f64), libm::log(time))))
        .collect();
    let count = points.len() as f64;
    if count < 3.0 {
        return None;
    }
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    Some(covariance / points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>())
}
