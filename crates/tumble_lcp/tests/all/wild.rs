//! Wild but finite input: every solver ends, nothing panics, and what it calls a solution is one.

use proptest::collection::vec;
use proptest::prelude::{Just, ProptestConfig, Strategy, prop_assert, prop_oneof, proptest};
use proptest::test_runner::RngSeed;
use tumble_lcp::cone::{BlockGaussSeidel, ConeNewton, ContactSpace, FrictionProblem};
use tumble_lcp::{
    Bound, GaussSeidel, InteriorPoint, Lcp, Lemke, Matrix, Newton, PrincipalPivoting, ProjectedGradient, Solution,
    SolveError, enumerate, solve, solve_from,
};

/// Numbers of any size, with many zeros, ones and repetitions.
fn wild_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => Just(0.0),
        2 => Just(1.0),
        2 => Just(-1.0),
        4 => -3.0..3.0_f64,
        1 => (-300..300_i32, -1.0..1.0_f64).prop_map(|(exponent, sign)| sign * 10.0_f64.powi(exponent)),
        1 => (-12..12_i32, -1.0..1.0_f64).prop_map(|(exponent, sign)| sign * 10.0_f64.powi(exponent)),
        1 => prop_oneof![Just(f64::MAX), Just(f64::MIN), Just(f64::MIN_POSITIVE), Just(5e-324), Just(-0.0)],
    ]
}

/// A bound of any kind for row `i`.
fn bound(kind: u8, a: f64, b: f64) -> Bound {
    match kind {
        0..=3 => Bound::Nonnegative,
        4 => Bound::Free,
        5 => Bound::Box { lower: a.min(b), upper: a.max(b) },
        6 => Bound::Box { lower: a, upper: f64::INFINITY },
        7 => Bound::Box { lower: f64::NEG_INFINITY, upper: b },
        _ => Bound::Friction { normal: 0, coefficient: a.abs() },
    }
}

/// Few iterations are enough to meet every way of ending.
fn all_outcomes(problem: &Lcp) -> Vec<(&'static str, Result<Solution, SolveError>, f64)> {
    let near = vec![0.5; problem.dimension()];
    let scale = |outcome: &Result<Solution, SolveError>| outcome.as_ref().map_or(0.0, |s| problem.scale(&s.z));
    let q = problem.q().iter().fold(1.0, |most: f64, q| most.max(q.abs()));
    let gauss_seidel = GaussSeidel { max_sweeps: 100, ..GaussSeidel::default() }.solve(problem);
    let gradient = ProjectedGradient { max_iterations: 100, ..ProjectedGradient::default() }.solve(problem);
    let mut outcomes = vec![("Gauss–Seidel", gauss_seidel, 1e-8 * q), ("gradient", gradient, 1e-8 * q)];
    for (name, outcome, tolerance) in [
        ("Lemke", Lemke::default().solve(problem), 1e-12),
        ("Lemke, warm", Lemke::default().solve_from(problem, &near), 1e-12),
        ("principal", PrincipalPivoting::default().solve(problem), 1e-12),
        ("principal, warm", PrincipalPivoting::default().solve_from(problem, &near), 1e-12),
        ("Newton", Newton { max_steps: 30, ..Newton::default() }.solve(problem), 1e-12),
        ("interior point", InteriorPoint::default().solve(problem), 1e-9),
        ("solve", solve(problem).map(|s| s.solution), 1e-9),
        ("solve, warm", solve_from(problem, &near).map(|s| s.solution), 1e-9),
    ] {
        let bar = tolerance * scale(&outcome);
        outcomes.push((name, outcome, bar));
    }
    outcomes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, rng_seed: RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_solver_ends_and_solutions_are_solutions(
        n in 0_usize..=6,
        entries in vec(wild_number(), 36),
        q in vec(wild_number(), 6),
        symmetric in proptest::bool::ANY,
        kinds in vec(0_u8..=11, 6),
        sides in vec((-2.0..2.0_f64, -2.0..2.0_f64), 6),
    ) {
        let entry = |i: usize, j: usize| entries[6 * i + j];
        let matrix = Matrix::from_fn(n, n, |i, j| if symmetric { entry(i.min(j), i.max(j)) } else { entry(i, j) });
        let bounds = (0..n)
            .map(|i| if i == 0 { Bound::Nonnegative } else { bound(kinds[i], sides[i].0, sides[i].1) })
            .collect();
        let problem = Lcp::new(matrix, q[..n].to_vec()).unwrap().with_bounds(bounds).unwrap();
        for (name, outcome, bar) in all_outcomes(&problem) {
            if let Ok(solution) = outcome {
                prop_assert!(problem.residual(&solution.z) <= bar, "{name}: {solution:?}");
                prop_assert!(solution.z.iter().chain(&solution.w).all(|x| x.is_finite()), "{name}");
            }
        }
        for solution in enumerate(&problem).unwrap() {
            prop_assert!(problem.residual(&solution.z) <= 1e-12 * problem.scale(&solution.z));
        }
    }

    #[test]
    fn every_friction_solver_ends_and_solutions_are_solutions(
        contacts in 0_usize..=2,
        entries in vec(wild_number(), 36),
        q in vec(wild_number(), 6),
        coefficients in vec(0.0..3.0_f64, 2),
        symmetric in proptest::bool::ANY,
        boost in 0.0..5.0_f64,
    ) {
        let n = 3 * contacts;
        let entry = |i: usize, j: usize| entries[6 * i + j] + if i == j { boost } else { 0.0 };
        let matrix = Matrix::from_fn(n, n, |i, j| if symmetric { entry(i.min(j), i.max(j)) } else { entry(i, j) });
        let problem = FrictionProblem::new(matrix, q[..n].to_vec(), coefficients[..contacts].to_vec(), ContactSpace::Spatial).unwrap();
        let size = q[..n].iter().fold(1.0, |most: f64, q| most.max(q.abs()));
        if let Ok(solution) = (BlockGaussSeidel { max_sweeps: 100, ..BlockGaussSeidel::default() }).solve(&problem) {
            prop_assert!(problem.residual(&solution.impulses) <= 1e-8 * size);
        }
        if let Ok(solution) = (ConeNewton { max_steps: 6, ..ConeNewton::default() }).solve(&problem) {
            prop_assert!(problem.residual(&solution.impulses) <= 1e-12 * problem.scale(&solution.impulses));
        }
    }
}

#[test]
fn a_guess_that_is_not_finite_or_has_the_wrong_size_is_refused() {
    let problem = Lcp::new(Matrix::identity(2), vec![-1.0; 2]).unwrap();
    for guess in [vec![f64::NAN, 0.0], vec![f64::INFINITY, 0.0], vec![1.0]] {
        assert_eq!(Lemke::default().solve_from(&problem, &guess), Err(SolveError::NotFinite));
        assert_eq!(PrincipalPivoting::default().solve_from(&problem, &guess), Err(SolveError::NotFinite));
        assert_eq!(GaussSeidel::default().solve_from(&problem, &guess), Err(SolveError::NotFinite));
        assert_eq!(Newton::default().solve_from(&problem, &guess), Err(SolveError::NotFinite));
        assert_eq!(ProjectedGradient::default().solve_from(&problem, &guess), Err(SolveError::NotFinite));
    }
}
