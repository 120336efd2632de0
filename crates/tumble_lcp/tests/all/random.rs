//! Random problems: against enumeration, against an interior-point solver of others, and laws that need no oracle.

use proptest::prelude::{ProptestConfig, any, prop_assert, prop_assert_eq, proptest};
use proptest::test_runner::{RngSeed, TestCaseError};
use tumble_lcp::families::Family;
use tumble_lcp::{
    Bound, GaussSeidel, Indeterminate, InteriorPoint, Lcp, Lemke, Matrix, Newton, PIVOTING_TOLERANCE,
    PrincipalPivoting, ProjectedGradient, Solution, SolveError, WeightedGram, enumerate, solve, solve_from,
};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(5), failure_persistence: None, ..ProptestConfig::default() }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The promise of every pivoting solution.
fn meets_the_bar(problem: &Lcp, solution: &Solution) -> bool {
    let residual = problem.residual(&solution.z);
    residual == solution.report.residual && residual <= PIVOTING_TOLERANCE * problem.scale(&solution.z)
}

fn assert_solves(name: &str, problem: &Lcp, outcome: Result<Solution, SolveError>) -> Result<Vec<f64>, TestCaseError> {
    match outcome {
        Ok(solution) => {
            prop_assert!(meets_the_bar(problem, &solution), "{name}: {:?}", solution.report);
            Ok(solution.z)
        }
        Err(error) => Err(TestCaseError::fail(format!("{name}: {error}"))),
    }
}

/// Families whose solution is unique, with all solvers that must find it.
const UNIQUE: [Family; 5] =
    [Family::PositiveDefinite, Family::NonsymmetricDefinite, Family::MMatrix, Family::PMatrix, Family::Degenerate];

proptest! {
    #![proptest_config(config(80))]

    #[test]
    fn unique_solutions_agree_with_enumeration(seed in any::<u64>(), n in 1_usize..=10, family in 0..UNIQUE.len()) {
        let sample = UNIQUE[family].sample(n, seed);
        let problem = &sample.problem;
        let all = enumerate(problem).unwrap();
        prop_assert_eq!(all.len(), 1);
        // Conditioning below 1e4 times residuals of 1e-13.
        prop_assert!(distance(&all[0].z, sample.z.as_ref().unwrap()) <= 1e-8);
        for (name, outcome) in [
            ("Lemke", Lemke::default().solve(problem)),
            ("principal pivoting", PrincipalPivoting::default().solve(problem)),
            ("Newton", Newton::default().solve(problem)),
            ("solve", solve(problem).map(|solved| solved.solution)),
        ] {
            let z = assert_solves(name, problem, outcome)?;
            prop_assert!(distance(&z, &all[0].z) <= 1e-8, "{name}");
        }
    }

    #[test]
    fn semidefinite_problems_have_one_w(seed in any::<u64>(), n in 1_usize..=10) {
        let sample = Family::Semidefinite.sample(n, seed);
        let (problem, w) = (&sample.problem, sample.problem.w(sample.z.as_ref().unwrap()));
        for vertex in enumerate(problem).unwrap() {
            prop_assert!(distance(&vertex.w, &w) <= 1e-8);
        }
        for outcome in [Lemke::default().solve(problem), PrincipalPivoting::default().solve(problem), solve(problem).map(|s| s.solution)] {
            let z = assert_solves("pivoting", problem, outcome)?;
            prop_assert!(distance(&problem.w(&z), &w) <= 1e-8);
        }
    }

    #[test]
    fn copositive_problems_are_solved_by_one_of_the_enumerated(seed in any::<u64>(), n in 1_usize..=8) {
        let problem = Family::Copositive.sample(n, seed).problem;
        let all = enumerate(&problem).unwrap();
        for outcome in [Lemke::default().solve(&problem), solve(&problem).map(|s| s.solution)] {
            let z = assert_solves("Lemke", &problem, outcome)?;
            prop_assert!(all.iter().any(|solution| distance(&solution.z, &z) <= 1e-7));
        }
    }

    #[test]
    fn indefinite_problems_are_solved_or_refused_as_enumeration_says(entries in proptest::collection::vec(-3_i8..=3, 20), n in 1_usize..=4) {
        // Small integers: full of ties, zero pivots and singular blocks.
        let matrix = Matrix::from_fn(n, n, |i, j| f64::from(entries[4 * i + j]));
        let problem = Lcp::new(matrix, entries[16..16 + n].iter().map(|&q| f64::from(q)).collect()).unwrap();
        let all = enumerate(&problem).unwrap();
        match solve(&problem) {
            Ok(solved) => {
                prop_assert!(meets_the_bar(&problem, &solved.solution));
                prop_assert!(!all.is_empty());
            }
            Err(SolveError::Infeasible { certificate }) => {
                prop_assert!(problem.is_infeasibility_certificate(&certificate));
                prop_assert!(all.is_empty());
            }
            Err(error) => prop_assert!(all.is_empty() && error == SolveError::NoSolution, "{error}, but {all:?}"),
        }
    }

    #[test]
    fn infeasible_problems_come_back_with_their_certificate(seed in any::<u64>(), n in 2_usize..=60) {
        let problem = Family::Infeasible.sample(n, seed).problem;
        for outcome in [Lemke::default().solve(&problem), solve(&problem).map(|s| s.solution)] {
            match outcome {
                Err(SolveError::Infeasible { certificate }) => prop_assert!(problem.is_infeasibility_certificate(&certificate)),
                other => prop_assert!(false, "{other:?}"),
            }
        }
        for outcome in [PrincipalPivoting::default().solve(&problem), Newton::default().solve(&problem), InteriorPoint::default().solve(&problem)] {
            prop_assert!(outcome.is_err(), "{outcome:?}");
        }
    }

    #[test]
    fn boxes_and_free_rows_agree_with_enumeration(seed in any::<u64>(), n in 1_usize..=6, kinds in proptest::collection::vec(0..5_u8, 6)) {
        let matrix = Family::NonsymmetricDefinite.sample(n, seed).problem.matrix().clone();
        let q: Vec<f64> = (0..n).map(|i| ((seed >> (8 * i)) & 255) as f64 / 32.0 - 4.0).collect();
        let bounds = kinds[..n]
            .iter()
            .map(|kind| match kind {
                0 => Bound::Nonnegative,
                1 => Bound::Free,
                2 => Bound::Box { lower: -0.3, upper: 0.2 },
                3 => Bound::Box { lower: f64::NEG_INFINITY, upper: 0.1 },
                _ => Bound::Box { lower: 0.25, upper: f64::INFINITY },
            })
            .collect();
        let problem = Lcp::new(matrix, q).unwrap().with_bounds(bounds).unwrap();
        let all = enumerate(&problem).unwrap();
        prop_assert_eq!(all.len(), 1);
        for (name, outcome) in [
            ("Lemke", Lemke::default().solve(&problem)),
            ("principal pivoting", PrincipalPivoting::default().solve(&problem)),
            ("Newton", Newton::default().solve(&problem)),
            ("solve", solve(&problem).map(|s| s.solution)),
        ] {
            let z = assert_solves(name, &problem, outcome)?;
            prop_assert!(distance(&z, &all[0].z) <= 1e-9, "{name}");
        }
        // Its own bar is 1e-9 of a scale below 1e3.
        let interior = InteriorPoint::default().solve(&problem);
        prop_assert!(interior.as_ref().is_ok_and(|s| distance(&s.z, &all[0].z) <= 1e-5), "{interior:?}");
    }

    #[test]
    fn singular_free_blocks_are_solved_where_they_are_consistent(seed in any::<u64>(), n in 2_usize..=8) {
        // Two identical joints: rows 0 and 1 are the same.
        let base = Family::PositiveDefinite.sample(n, seed).problem;
        let pick = |i: usize| if i == 1 { 0 } else { i };
        let matrix = Matrix::from_fn(n, n, |i, j| base.matrix()[(pick(i), pick(j))]);
        let q = (0..n).map(|i| base.q()[pick(i)]).collect();
        let bounds = (0..n).map(|i| if i < 2 { Bound::Free } else { Bound::Nonnegative }).collect();
        let problem = Lcp::new(matrix, q).unwrap().with_bounds(bounds).unwrap();
        assert_solves("Lemke", &problem, Lemke::default().solve(&problem))?;
        assert_solves("principal pivoting", &problem, PrincipalPivoting::default().solve(&problem))?;
    }
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn a_warm_start_from_the_answer_takes_no_pivots(seed in any::<u64>(), n in 1_usize..=40) {
        let problem = Family::PositiveDefinite.sample(n, seed).problem;
        let z = PrincipalPivoting::default().solve(&problem).unwrap().z;
        for again in [PrincipalPivoting::default().solve_from(&problem, &z), Lemke::default().solve_from(&problem, &z), Newton::default().solve_from(&problem, &z)] {
            let again = again.unwrap();
            prop_assert_eq!(again.report.iterations, 0);
            prop_assert!(distance(&again.z, &z) <= 1e-10);
        }
        prop_assert!(GaussSeidel::default().solve_from(&problem, &z).unwrap().report.iterations == 0);
        prop_assert!(solve_from(&problem, &z).is_ok());
    }

    #[test]
    fn frictional_piles_are_solved_to_the_bar(seed in any::<u64>(), n in 1_usize..=90) {
        let problem = Family::FrictionalContact.sample(n, seed).problem;
        let solved = solve(&problem);
        prop_assert!(solved.as_ref().is_ok_and(|s| meets_the_bar(&problem, &s.solution)), "{:?}", solved.map(|s| s.solution.report));
    }

    #[test]
    fn iterative_methods_meet_their_stated_tolerance(seed in any::<u64>(), n in 1_usize..=60) {
        let problem = Family::Contact.sample(n, seed).problem;
        let bar = 1e-6 * problem.q().iter().fold(1.0, |most: f64, q| most.max(q.abs()));
        let gauss_seidel = GaussSeidel { tolerance: 1e-6, ..GaussSeidel::default() }.solve(&problem).unwrap();
        let gradient = ProjectedGradient { tolerance: 1e-6, ..ProjectedGradient::default() }.solve(&problem).unwrap();
        for solution in [gauss_seidel, gradient] {
            prop_assert!(problem.residual(&solution.z) <= bar && solution.report.residual <= bar);
        }
        let interior = InteriorPoint::default().solve(&problem);
        prop_assert!(interior.as_ref().is_ok_and(|s| problem.residual(&s.z) <= 1e-9 * problem.scale(&s.z)), "{interior:?}");
    }

    #[test]
    fn an_unbuilt_matrix_gives_the_answer_of_the_built_one(seed in any::<u64>(), n in 1_usize..=30) {
        let mut state = seed;
        let mut next = || { state = state.wrapping_mul(6364136223846793005).wrapping_add(1); (state >> 11) as f64 / (1_u64 << 53) as f64 };
        let rows = (0..n).map(|i| vec![(i, 1.0 + next()), ((i + 1) % (n + 1), -next())]).collect();
        let gram = WeightedGram::new(rows, (0..=n).map(|_| 0.5 + next()).collect()).unwrap();
        let q: Vec<f64> = (0..n).map(|_| next() - 0.7).collect();
        let dense = solve(&Lcp::new(gram.to_matrix(), q.clone()).unwrap()).unwrap().solution.z;
        let unbuilt = Lcp::from_operator(gram, q).unwrap();
        // Residual 1e-8 over the least eigenvalue, which is above 1e-3.
        prop_assert!(distance(&GaussSeidel::default().solve(&unbuilt).unwrap().z, &dense) <= 1e-5);
        prop_assert!(distance(&ProjectedGradient::default().solve(&unbuilt).unwrap().z, &dense) <= 1e-5);
    }
}

#[test]
fn least_norm_shares_the_load_of_a_table_equally() {
    let m = [[3.0, 1.0, -1.0, 1.0], [1.0, 3.0, 1.0, -1.0], [-1.0, 1.0, 3.0, 1.0], [1.0, -1.0, 1.0, 3.0]];
    let problem = Lcp::new(Matrix::from_rows(m), vec![-9.81; 4]).unwrap();
    let method = PrincipalPivoting { indeterminate: Indeterminate::LeastNorm, ..PrincipalPivoting::default() };
    let z = method.solve(&problem).unwrap().z;
    // The regularisation is 1e-7, and moves the least-norm point by about as much.
    assert!(distance(&z, &[9.81 / 4.0; 4]) <= 1e-6, "{z:?}");
}

#[test]
fn the_same_problem_gives_the_same_bits() {
    for family in Family::ALL {
        let problem = family.sample(30, 3).problem;
        let (first, second) = (solve(&problem), solve(&problem));
        assert_eq!(format!("{first:?}"), format!("{second:?}"));
    }
}
