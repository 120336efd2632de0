//! The catalogue of small problems with known answers, K1 to K25, for every solver that claims them.
//!
//! Tolerances: 1e-12 of the problem's scale for pivoting and Newton; 1e-8 for iterative methods; z is compared at these times the
//! conditioning of the (tiny, well-conditioned) problem, so 1e-11 and 1e-6.

use tumble_lcp::families::Family;
use tumble_lcp::{
    Covering, GaussSeidel, InteriorPoint, Lcp, Lemke, Matrix, Method, Newton, PrincipalPivoting, ProjectedGradient,
    Scaling, Solution, SolveError, enumerate, solve,
};

const EXACT: f64 = 1e-11;
const ITERATIVE: f64 = 1e-6;

fn lcp<const N: usize>(m: [[f64; N]; N], q: [f64; N]) -> Lcp {
    Lcp::new(Matrix::from_rows(m), q.to_vec()).unwrap()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn assert_is(solution: &Solution, expected: &[f64], tolerance: f64) {
    assert!(distance(&solution.z, expected) <= tolerance, "{:?}, expected {expected:?}", solution);
}

/// Solvers that solve to rounding.
fn exact_solvers(problem: &Lcp) -> Vec<(&'static str, Result<Solution, SolveError>)> {
    vec![
        ("Lemke", Lemke::default().solve(problem)),
        ("Lemke unscaled", Lemke { scaling: Scaling::None, ..Lemke::default() }.solve(problem)),
        ("principal pivoting", PrincipalPivoting::default().solve(problem)),
        ("Newton", Newton::default().solve(problem)),
        ("solve", solve(problem).map(|solved| solved.solution)),
    ]
}

fn assert_all_exact_solvers_find(problem: &Lcp, expected: &[f64]) {
    for (name, outcome) in exact_solvers(problem) {
        match outcome {
            Ok(solution) => assert_is(&solution, expected, EXACT),
            Err(error) => panic!("{name}: {error}"),
        }
    }
    let all = enumerate(problem).unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    assert_is(&all[0], expected, EXACT);
}

/// Every solution that comes back, from whatever solver, is one of those listed.
fn assert_solutions_are_among(problem: &Lcp, expected: &[&[f64]]) {
    for (name, outcome) in exact_solvers(problem) {
        if let Ok(solution) = outcome {
            assert!(expected.iter().any(|z| distance(z, &solution.z) <= EXACT), "{name}: {solution:?}");
        }
    }
    let all = enumerate(problem).unwrap();
    assert_eq!(all.len(), expected.len(), "{all:?}");
    for z in expected {
        assert!(all.iter().any(|found| distance(z, &found.z) <= EXACT), "{z:?} is not among {all:?}");
    }
}

fn assert_infeasible(problem: &Lcp) {
    for (name, outcome) in
        [("Lemke", Lemke::default().solve(problem)), ("solve", solve(problem).map(|solved| solved.solution))]
    {
        match outcome {
            Err(SolveError::Infeasible { certificate }) => assert!(problem.is_infeasibility_certificate(&certificate)),
            other => panic!("{name}: {other:?}"),
        }
    }
    assert_eq!(enumerate(problem).unwrap(), vec![]);
}

#[test]
fn k1_positive_definite() {
    let problem = lcp([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0]);
    let expected = [4.0 / 3.0, 7.0 / 3.0];
    assert_all_exact_solvers_find(&problem, &expected);
    assert_is(&GaussSeidel::default().solve(&problem).unwrap(), &expected, ITERATIVE);
    assert_is(
        &GaussSeidel { relaxation: 1.2, ..GaussSeidel::default() }.solve(&problem).unwrap(),
        &expected,
        ITERATIVE,
    );
    assert_is(&ProjectedGradient::default().solve(&problem).unwrap(), &expected, ITERATIVE);
    assert_is(&InteriorPoint::default().solve(&problem).unwrap(), &expected, EXACT);
}

#[test]
fn k2_singular_semidefinite_has_a_segment_of_solutions() {
    let problem = lcp([[1.0, 1.0], [1.0, 1.0]], [-1.0, -1.0]);
    let on_segment = |name: &str, outcome: Result<Solution, SolveError>, tolerance: f64| {
        let solution = outcome.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!((solution.z[0] + solution.z[1] - 1.0).abs() <= tolerance, "{name}: {solution:?}");
        assert!(solution.z.iter().all(|&z| z >= 0.0) && solution.w.iter().all(|w| w.abs() <= tolerance));
    };
    for (name, outcome) in exact_solvers(&problem) {
        on_segment(name, outcome, EXACT);
    }
    on_segment("Gauss–Seidel", GaussSeidel::default().solve(&problem), ITERATIVE);
    on_segment("projected gradient", ProjectedGradient::default().solve(&problem), ITERATIVE);
    on_segment("interior point", InteriorPoint::default().solve(&problem), ITERATIVE);
    let vertices = enumerate(&problem).unwrap();
    assert_eq!(vertices.len(), 2);
}

#[test]
fn k3_zero_diagonal() {
    let problem = lcp([[0.0, -1.0, 2.0], [2.0, 0.0, -2.0], [-1.0, 1.0, 0.0]], [-3.0, 6.0, -1.0]);
    assert_eq!(GaussSeidel::default().solve(&problem), Err(SolveError::SingularPivot { row: 0 }));
    let expected = [0.0, 1.0, 3.0];
    assert_is(&solve(&problem).unwrap().solution, &expected, EXACT);
    assert_is(&Lemke::default().solve(&problem).unwrap(), &expected, EXACT);
    assert_solutions_are_among(&problem, &[&expected]);
}

#[test]
fn k4_bimatrix_game_stops_lemke_on_a_ray_and_still_gets_solved() {
    let problem = lcp(
        [[0.0, 0.0, 10.0, 20.0], [0.0, 0.0, 30.0, 15.0], [10.0, 20.0, 0.0, 0.0], [30.0, 15.0, 0.0, 0.0]],
        [-1.0; 4],
    );
    assert!(matches!(Lemke::default().solve(&problem), Err(SolveError::SecondaryRay { .. })));
    let expected: [&[f64]; 3] =
        [&[0.1, 0.0, 0.1, 0.0], &[0.0, 1.0 / 15.0, 0.0, 1.0 / 15.0], &[1.0 / 90.0, 2.0 / 45.0, 1.0 / 90.0, 2.0 / 45.0]];
    assert_solutions_are_among(&problem, &expected);
    assert!(solve(&problem).is_ok());
}

#[test]
fn k5_solutions_form_a_ray() {
    let problem = lcp([[1.0, -1.0], [-1.0, 1.0]], [1.0, -1.0]);
    for (name, outcome) in exact_solvers(&problem) {
        let solution = outcome.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!((solution.z[1] - solution.z[0] - 1.0).abs() <= EXACT && solution.z[0] >= 0.0, "{name}: {solution:?}");
    }
    let vertices = enumerate(&problem).unwrap();
    assert_eq!(vertices.len(), 1);
    assert_is(&vertices[0], &[0.0, 1.0], EXACT);
}

#[test]
fn k6_negative_scalar_is_infeasible() {
    assert_infeasible(&lcp([[-1.0]], [-1.0]));
    for (name, outcome) in exact_solvers(&lcp([[-1.0]], [-1.0])) {
        assert!(outcome.is_err(), "{name}: {outcome:?}");
    }
}

#[test]
fn k7_indefinite_scalar_has_two_solutions() {
    assert_solutions_are_among(&lcp([[-1.0]], [1.0]), &[&[0.0], &[1.0]]);
}

#[test]
fn k8_skew_is_infeasible_with_its_farkas_vector() {
    let problem = lcp([[0.0, 1.0], [-1.0, 0.0]], [-1.0, -1.0]);
    assert_infeasible(&problem);
    let Err(SolveError::Infeasible { certificate }) = solve(&problem) else { panic!("not infeasible") };
    // Only multiples of (0, 1) satisfy Mᵀ y ≤ 0 with y ≥ 0 here.
    assert!(certificate[0].abs() <= 1e-12 * certificate[1], "{certificate:?}");
}

#[test]
fn k9_three_isolated_solutions() {
    let problem = lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0]);
    assert_solutions_are_among(&problem, &[&[1.0, 0.0], &[0.0, 1.0], &[1.0 / 3.0, 1.0 / 3.0]]);
    assert!(solve(&problem).is_ok());
}

#[test]
fn k10_p_matrix_on_which_gauss_seidel_circles() {
    let problem = lcp([[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]], [-1.0; 3]);
    assert_all_exact_solvers_find(&problem, &[1.0 / 3.0; 3]);
    assert!(matches!(
        GaussSeidel::default().solve(&problem),
        Err(SolveError::NotConverged { report, .. }) if report.iterations == 20_000
    ));
    // The start from which the plain active-set iteration goes round with period 3.
    assert_is(&Newton::default().solve_from(&problem, &[1.0, 0.0, 0.0]).unwrap(), &[1.0 / 3.0; 3], EXACT);
}

#[test]
fn k11_four_rows() {
    let m = [[3.0, 1.0, 0.0, -1.0], [-1.0, 2.0, 1.0, 1.0], [0.0, 1.0, 3.0, -1.0], [0.0, 0.0, 1.0, 2.0]];
    assert_all_exact_solvers_find(&lcp(m, [-2.0, 1.0, -1.0, 1.0]), &[2.0 / 3.0, 0.0, 1.0 / 3.0, 0.0]);
}

const PANG: [[f64; 3]; 3] = [[0.0, -1.0, -1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];

#[test]
fn k12_isolated_but_not_stable() {
    let problem = lcp(PANG, [0.0, -1.0, 1.0]);
    assert_is(&solve(&problem).unwrap().solution, &[1.0, 0.0, 0.0], EXACT);
    assert_solutions_are_among(&problem, &[&[1.0, 0.0, 0.0]]);
    assert_infeasible(&lcp(PANG, [-1e-4, -1.0, 1.0]));
}

#[test]
fn k13_unbounded_solution_set() {
    let m = [[0.0, -1.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    let problem = lcp(m, [-1e-4, -1.0, 1.0]);
    let z = solve(&problem).unwrap().solution.z;
    assert!((z[0] - 1.0).abs() <= EXACT && (z[2] - z[1] - 1e-4).abs() <= EXACT, "{z:?}");
    assert!(Lemke::default().solve(&problem).is_ok());
}

#[test]
fn k14_optimality_conditions_of_a_quadratic_program() {
    let m = [[11.0, 0.0, 10.0, -1.0], [0.0, 11.0, 10.0, -1.0], [10.0, 10.0, 21.0, -1.0], [1.0, 1.0, 1.0, 0.0]];
    for l in [-40.0, 0.0, 10.0, 23.0, 50.0, 400.0_f64] {
        let a = if l <= 23.0 { (l + 16.0) / 13.0 } else { 3.0 };
        let expected =
            [a, a, (2.0 * (23.0 - l) / 13.0).max(0.0), if l <= 23.0 { (1286.0 - 9.0 * l) / 13.0 } else { 83.0 }];
        let problem = lcp(m, [50.0, 50.0, l, -6.0]);
        let answer = solve(&problem).unwrap().solution;
        // Below l = −16 the first two rows would go negative and leave the formula's range.
        if l >= -16.0 {
            assert_is(&answer, &expected, 1e-10);
            assert_is(&Lemke::default().solve(&problem).unwrap(), &expected, 1e-10);
            assert_is(&InteriorPoint::default().solve(&problem).unwrap(), &expected, 1e-6);
        }
    }
}

fn murty_upper(n: usize) -> Matrix {
    Matrix::from_fn(n, n, |i, j| match i.cmp(&j) {
        std::cmp::Ordering::Less => 2.0,
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Greater => 0.0,
    })
}

fn unit(n: usize, at: usize) -> Vec<f64> {
    (0..n).map(|i| if i == at { 1.0 } else { 0.0 }).collect()
}

fn plain_lemke(max_pivots: usize) -> Lemke {
    Lemke { scaling: Scaling::None, covering: Covering::Ones, max_pivots: Some(max_pivots) }
}

#[test]
fn k15_murty_upper_takes_lemke_two_pivots() {
    for n in 2..=12 {
        let problem = Lcp::new(murty_upper(n), vec![-1.0; n]).unwrap();
        let solution = plain_lemke(100).solve(&problem).unwrap();
        assert_is(&solution, &unit(n, n - 1), EXACT);
        assert_eq!(solution.report.iterations, 2);
        assert_is(&solve(&problem).unwrap().solution, &unit(n, n - 1), EXACT);
    }
}

#[test]
fn k16_murty_upper_with_the_worst_q_takes_lemke_two_to_the_n() {
    for n in 4..=10_u32 {
        let q: Vec<f64> = (1..=n).map(|i| -(f64::from(1 << (n + 1)) - f64::from(1 << i))).collect();
        if n == 6 {
            assert_eq!(q, [-126.0, -124.0, -120.0, -112.0, -96.0, -64.0]);
        }
        let problem = Lcp::new(murty_upper(n as usize), q).unwrap();
        let mut expected = vec![0.0; n as usize];
        expected[n as usize - 1] = f64::from(1 << n);
        let solution = plain_lemke(5000).solve(&problem).unwrap();
        assert_is(&solution, &expected, 1e-9);
        assert_eq!(solution.report.iterations, 1 << n);
        // Stopped half way, it says so, unless the final linear system happens to find the solution from there.
        let cap = 1 << (n - 1);
        match plain_lemke(cap).solve(&problem) {
            Ok(solution) => {
                assert_is(&solution, &expected, 1e-9);
                assert_eq!(solution.report.iterations, cap);
            }
            Err(error) => {
                assert!(matches!(error, SolveError::CyclingStopped { report, .. } if report.iterations == cap))
            }
        }
        assert_is(&solve(&problem).unwrap().solution, &expected, 1e-9);
    }
}

#[test]
fn k17_murty_lower_takes_lemke_two_to_the_n_and_principal_pivoting_at_most_n() {
    for n in 4..=10 {
        let problem = Lcp::new(murty_upper(n).transpose(), vec![-1.0; n]).unwrap();
        let solution = plain_lemke(5000).solve(&problem).unwrap();
        assert_is(&solution, &unit(n, 0), EXACT);
        assert_eq!(solution.report.iterations, 1 << n);
        let solution = PrincipalPivoting::default().solve(&problem).unwrap();
        assert_is(&solution, &unit(n, 0), EXACT);
        assert!(solution.report.iterations <= n, "{:?}", solution.report);
    }
}

#[test]
fn k18_fathi_is_bad_for_lemke_and_easy_for_others() {
    for n in [4, 6, 7, 20] {
        let lower = murty_upper(n).transpose();
        let matrix = lower.product(&lower.transpose());
        if n == 4 {
            let expected = [[1.0, 2.0, 2.0, 2.0], [2.0, 5.0, 6.0, 6.0], [2.0, 6.0, 9.0, 10.0], [2.0, 6.0, 10.0, 13.0]];
            assert_eq!(matrix, Matrix::from_rows(expected));
        }
        let problem = Lcp::new(matrix, vec![-1.0; n]).unwrap();
        let sweep = GaussSeidel::default().solve(&problem).unwrap();
        assert_is(&sweep, &unit(n, 0), EXACT);
        assert_eq!(sweep.report.iterations, 1);
        let solved = solve(&problem).unwrap();
        assert_is(&solved.solution, &unit(n, 0), EXACT);
        assert_eq!(solved.solution.report.method, Method::PrincipalPivoting);
        // Entries of the inverse grow like 4ⁿ; beyond n = 7 rounding breaks the ties that make the path long.
        if n <= 7 {
            assert_eq!(plain_lemke(5000).solve(&problem).unwrap().report.iterations, 1 << n);
        }
    }
}

#[test]
fn k19_zero_matrix() {
    let problem = lcp([[0.0, 0.0], [0.0, 0.0]], [1.0, 0.0]);
    for (name, outcome) in exact_solvers(&problem) {
        let z = outcome.unwrap_or_else(|error| panic!("{name}: {error}")).z;
        assert!(z[0] == 0.0 && z[1] >= 0.0, "{name}: {z:?}");
    }
    assert_eq!(enumerate(&problem).unwrap()[0].z, [0.0, 0.0]);
}

#[test]
fn k20_zero_is_preferred_where_copositivity_fails() {
    let problem = lcp([[1.0, -2.0], [-2.0, 1.0]], [1.0, 1.0]);
    assert_solutions_are_among(&problem, &[&[0.0, 0.0], &[1.0, 1.0]]);
    for (name, outcome) in exact_solvers(&problem) {
        assert_eq!(outcome.unwrap_or_else(|error| panic!("{name}: {error}")).z, [0.0, 0.0], "{name}");
    }
}

#[test]
fn k21_table_with_four_legs() {
    let m = [[3.0, 1.0, -1.0, 1.0], [1.0, 3.0, 1.0, -1.0], [-1.0, 1.0, 3.0, 1.0], [1.0, -1.0, 1.0, 3.0]];
    let problem = lcp(m, [-9.81; 4]);
    // Any mixture of the two vertices carries the table: z = 2.4525 + s (1, −1, 1, −1).
    let carries = |name: &str, solution: &Solution, tolerance: f64| {
        let z = &solution.z;
        assert!((z.iter().sum::<f64>() - 9.81).abs() <= 4.0 * tolerance, "{name}: {z:?}");
        assert!((z[0] - z[2]).abs() <= tolerance && (z[1] - z[3]).abs() <= tolerance, "{name}: {z:?}");
        assert!(solution.w.iter().all(|w| w.abs() <= tolerance) && z.iter().all(|&z| z >= 0.0), "{name}: {solution:?}");
    };
    for (name, outcome) in exact_solvers(&problem) {
        carries(name, &outcome.unwrap_or_else(|error| panic!("{name}: {error}")), 1e-10);
    }
    carries("Gauss–Seidel", &GaussSeidel::default().solve(&problem).unwrap(), ITERATIVE);
    carries("projected gradient", &ProjectedGradient::default().solve(&problem).unwrap(), ITERATIVE);
    carries("interior point", &InteriorPoint::default().solve(&problem).unwrap(), ITERATIVE);
    let vertices = enumerate(&problem).unwrap();
    for expected in [[4.905, 0.0, 4.905, 0.0], [0.0, 4.905, 0.0, 4.905]] {
        assert!(vertices.iter().any(|v| distance(&v.z, &expected) <= EXACT), "{vertices:?}");
    }
}

#[test]
fn k22_diagonal() {
    let matrix = Matrix::from_fn(9, 9, |i, j| if i == j { (i + 1) as f64 } else { 0.0 });
    let problem = Lcp::new(matrix, vec![-1.0; 9]).unwrap();
    let expected: Vec<f64> = (1..=9).map(|i| 1.0 / f64::from(i)).collect();
    assert_all_exact_solvers_find(&problem, &expected);
    assert_is(&GaussSeidel::default().solve(&problem).unwrap(), &expected, ITERATIVE);
    assert_is(&ProjectedGradient::default().solve(&problem).unwrap(), &expected, ITERATIVE);
}

#[test]
fn k23_empty() {
    let problem = Lcp::new(Matrix::zeros(0, 0), vec![]).unwrap();
    for (name, outcome) in exact_solvers(&problem) {
        assert_eq!(outcome.unwrap_or_else(|error| panic!("{name}: {error}")).z, Vec::<f64>::new());
    }
    assert!(GaussSeidel::default().solve(&problem).is_ok());
    assert!(ProjectedGradient::default().solve(&problem).is_ok());
    assert!(InteriorPoint::default().solve(&problem).is_ok());
    assert_eq!(enumerate(&problem).unwrap().len(), 1);
}

#[test]
fn k24_nothing_pushes_when_q_is_positive() {
    for n in [1, 5, 30] {
        let matrix = Family::PositiveDefinite.sample(n, 7).problem.matrix().clone();
        let problem = Lcp::new(matrix, (0..n).map(|i| i as f64).collect()).unwrap();
        for (name, outcome) in exact_solvers(&problem) {
            let solution = outcome.unwrap();
            assert_eq!(solution.z, vec![0.0; n], "{name}");
            assert_eq!(solution.report.iterations, 0, "{name}");
        }
    }
}

#[test]
fn k25_families_of_all_sizes() {
    for family in Family::ALL {
        for n in [2, 5, 17, 60, 200] {
            let sample = family.sample(n, 1000 + n as u64);
            let outcome = solve(&sample.problem);
            if family == Family::Infeasible {
                let Err(SolveError::Infeasible { certificate }) = outcome else { panic!("{n}: {outcome:?}") };
                assert!(sample.problem.is_infeasibility_certificate(&certificate));
                continue;
            }
            let solution = outcome.unwrap_or_else(|error| panic!("{family:?} {n}: {error}")).solution;
            // Semidefinite: z is one of many, w is unique.
            let (found, expected) = match (&sample.z, family) {
                (None, _) | (_, Family::Copositive) => continue,
                (Some(z), Family::Semidefinite) => (&solution.w, sample.problem.w(z)),
                (Some(z), _) => (&solution.z, z.clone()),
            };
            // Condition numbers reach 1e6 (n = 200, smallest eigenvalue 0.1), times a residual of 1e-13.
            assert!(distance(found, &expected) <= 1e-7, "{family:?} {n}: {}", distance(found, &expected));
        }
    }
}
