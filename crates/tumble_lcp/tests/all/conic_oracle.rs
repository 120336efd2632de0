//! Larger problems against an independent interior-point solver for conic programs: min ½ zᵀ M z + qᵀ z, z ≥ 0.

use clarabel::algebra::{CscMatrix, MatrixMathMut};
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};
use proptest::test_runner::RngSeed;
use tumble_lcp::families::Family;
use tumble_lcp::{InteriorPoint, Lcp, Lemke, Newton, PrincipalPivoting, solve};

/// z of the quadratic program.
fn clarabel_solution(problem: &Lcp) -> Vec<f64> {
    let n = problem.dimension();
    let m = problem.matrix();
    let upper: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| if i <= j { m[(i, j)] } else { 0.0 }).collect()).collect();
    let p = CscMatrix::from(&upper);
    // z ≥ 0 as −z + s = 0, s ≥ 0.
    let mut a = CscMatrix::identity(n);
    a.negate();
    let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
    let cones = [SupportedConeT::NonnegativeConeT(n)];
    let mut solver = DefaultSolver::new(&p, problem.q(), &a, &vec![0.0; n], &cones, settings).unwrap();
    solver.solve();
    let status = solver.solution.status;
    assert!(matches!(status, SolverStatus::Solved));
    solver.solution.x.clone()
}

/// ½ zᵀ M z + qᵀ z.
fn energy(problem: &Lcp, z: &[f64]) -> f64 {
    let w = problem.w(z);
    z.iter().zip(w.iter().zip(problem.q())).map(|(z, (w, q))| 0.5 * z * (w + q)).sum()
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// How much lower our minimum is; the oracle stops at 1e-8 of the energy, and may be that far outside of z ≥ 0.
fn gap(problem: &Lcp, ours: &[f64], oracle: &[f64]) -> f64 {
    let gap = energy(problem, oracle) - energy(problem, ours);
    let size = energy(problem, ours).abs().max(1.0);
    assert!(gap.abs() <= 1e-7 * size, "energies differ by {gap:e} of {size:e}");
    gap.max(0.0) + 1e-8 * size
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, rng_seed: RngSeed::Fixed(2), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn definite_problems_have_the_oracles_z(seed in any::<u64>(), n in 20_usize..=200, degenerate in any::<bool>()) {
        let family = if degenerate { Family::Degenerate } else { Family::PositiveDefinite };
        let problem = family.sample(n, seed).problem;
        let oracle = clarabel_solution(&problem);
        for (name, outcome) in [
            ("Lemke", Lemke::default().solve(&problem)),
            ("principal pivoting", PrincipalPivoting::default().solve(&problem)),
            ("Newton", Newton::default().solve(&problem)),
            ("interior point", InteriorPoint::default().solve(&problem)),
            ("solve", solve(&problem).map(|solved| solved.solution)),
        ] {
            prop_assert!(outcome.is_ok(), "{name}: {outcome:?}");
            let z = outcome.unwrap().z;
            // Strong convexity: energy above the minimum ≥ ½ · 0.1 |Δz|², as the least eigenvalue is at least 0.1.
            prop_assert!(squared_distance(&z, &oracle) <= 2.0 / 0.1 * gap(&problem, &z, &oracle), "{name}");
        }
    }

    #[test]
    fn semidefinite_problems_have_the_oracles_w(seed in any::<u64>(), n in 20_usize..=200, contact in any::<bool>()) {
        let family = if contact { Family::Contact } else { Family::Semidefinite };
        let problem = family.sample(n, seed).problem;
        let oracle = clarabel_solution(&problem);
        let solved = solve(&problem);
        prop_assert!(solved.is_ok(), "{solved:?}");
        let solution = solved.unwrap().solution;
        // The gradient is Lipschitz: energy above the minimum ≥ |Δw|² / (2 ‖M‖).
        let bound = 2.0 * problem.matrix().norm() * gap(&problem, &solution.z, &oracle);
        prop_assert!(squared_distance(&solution.w, &problem.w(&oracle)) <= bound);
    }
}
