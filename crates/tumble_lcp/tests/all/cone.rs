//! Frictional contact: published problems, laws of the cone, and agreement of all forms.

use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};
use proptest::test_runner::RngSeed;
use tumble_lcp::cone::{BlockGaussSeidel, ConeNewton, ContactSpace, FrictionProblem, FrictionSolution};
use tumble_lcp::{GaussSeidel, Lemke, Matrix, Newton, PrincipalPivoting, SolveError, WeightedGram, solve};

fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn both_solvers(problem: &FrictionProblem) -> [FrictionSolution; 2] {
    [
        BlockGaussSeidel { tolerance: 1e-13, ..BlockGaussSeidel::default() }.solve(problem).unwrap(),
        ConeNewton::default().solve(problem).unwrap(),
    ]
}

#[test]
fn siconos_one_contact_slides_under_full_coupling() {
    let w = Matrix::from_rows([[15.0, -1.0, -2.0], [-1.0, 14.0, 1.0], [-2.0, 1.0, 16.0]]);
    let problem = FrictionProblem::new(w, vec![-1.0, 2.0, 3.0], vec![0.1], ContactSpace::Spatial).unwrap();
    for solution in both_solvers(&problem) {
        // The reference has eight decimals.
        assert!(distance(&solution.impulses, &[0.06569568, -0.00367861, -0.00544307]) < 6e-9, "{solution:?}");
        assert!(distance(&solution.velocities, &[0.0, 1.87736064, 2.77784089]) < 6e-9, "{solution:?}");
        assert!(problem.cone_residual(&solution.impulses) < 1e-12);
    }
}

#[test]
fn siconos_one_contact_with_masses_far_apart() {
    let (a, b, c) = (-9.421e-7, 0.001486, 0.0001733);
    let w = Matrix::from_rows([[0.01344, a, b], [a, 0.1061, c], [b, c, 0.001442]]);
    let problem = FrictionProblem::new(w, vec![-0.1458, -0.2484, -0.1515], vec![0.6], ContactSpace::Spatial).unwrap();
    for solution in both_solvers(&problem) {
        assert!(distance(&solution.impulses, &[10.20587606, 1.93188837, 5.81079801]) < 6e-9, "{solution:?}");
        assert!(distance(&solution.velocities, &[0.0, -0.04242925, -0.12762010]) < 6e-9, "{solution:?}");
        assert!(problem.cone_residual(&solution.impulses) < 1e-12);
    }
}

#[test]
fn siconos_three_decoupled_contacts_slide_alike() {
    let q = [-1.0, 1.0, 3.0].repeat(3);
    let problem = FrictionProblem::new(Matrix::identity(9), q, vec![0.1; 3], ContactSpace::Spatial).unwrap();
    let expected = [1.0, -0.1 / 10.0_f64.sqrt(), -0.3 / 10.0_f64.sqrt()].repeat(3);
    for solution in both_solvers(&problem) {
        assert!(distance(&solution.impulses, &expected) < 1e-14, "{solution:?}");
    }
}

#[test]
fn rod_that_jams_is_answered_by_sticking() {
    // Impact without collision: a rod sliding at −2 that friction drives into the floor; normal first.
    let w = Matrix::from_rows([[1.6, -1.2], [-1.2, 3.4]]);
    let problem = FrictionProblem::new(w, vec![-9.81e-3, -2.0], vec![1.6], ContactSpace::Planar).unwrap();
    let expected = [0.6083385, 0.802943];
    for solution in both_solvers(&problem) {
        assert!(distance(&solution.impulses, &expected) < 5e-7, "{solution:?}");
    }
    let planar = problem.to_planar_lcp().unwrap();
    assert!(distance(&Lemke::default().solve(&planar).unwrap().z, &expected) < 5e-7);
    assert!(distance(&PrincipalPivoting::default().solve(&planar).unwrap().z, &expected) < 5e-7);
}

#[test]
fn bad_problems_are_refused() {
    let build =
        |mu: f64, q: f64| FrictionProblem::new(Matrix::identity(3), vec![q, 0.0, 0.0], vec![mu], ContactSpace::Spatial);
    assert!(build(0.5, -1.0).is_ok());
    for (mu, q) in [(-0.1, -1.0), (f64::NAN, -1.0), (0.5, f64::INFINITY)] {
        assert!(build(mu, q).is_err());
    }
    assert!(FrictionProblem::new(Matrix::identity(4), vec![0.0; 4], vec![0.5], ContactSpace::Spatial).is_err());
    let massless = FrictionProblem::new(Matrix::zeros(3, 3), vec![-1.0, 0.0, 0.0], vec![0.5], ContactSpace::Spatial);
    assert_eq!(BlockGaussSeidel::default().solve(&massless.unwrap()), Err(SolveError::SingularPivot { row: 0 }));
}

/// Numbers in [−1, 1) from a seed (an additive sequence of golden-ratio multiples, hashed).
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Contacts on a few bodies: W = J M⁻¹ Jᵀ with q in the range of J, as it is for bodies.
fn contacts(count: usize, rows: usize, seed: u64) -> (WeightedGram, Vec<f64>) {
    let mut next = numbers(seed);
    let bodies = count.max(2);
    let weights: Vec<f64> = (0..bodies * rows).map(|_| 1.0 + 0.8 * next()).collect();
    let velocity: Vec<f64> = (0..bodies * rows).map(|i| if i % rows == 0 { -0.5 + next() } else { next() }).collect();
    let mut jacobian = Vec::new();
    for contact in 0..count {
        for row in 0..rows {
            let mut entries: Vec<(usize, f64)> =
                (0..rows).map(|k| (contact * rows + k, if k == row { 1.0 } else { 0.4 * next() })).collect();
            if contact > 0 {
                entries
                    .extend((0..rows).map(|k| ((contact - 1) * rows + k, if k == row { -1.0 } else { 0.4 * next() })));
            }
            jacobian.push(entries);
        }
    }
    let q = jacobian
        .iter()
        .map(|row: &Vec<(usize, f64)>| row.iter().map(|&(column, value)| value * velocity[column]).sum())
        .collect();
    (WeightedGram::new(jacobian, weights).unwrap(), q)
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(11), failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn a_contact_obeys_signorini_and_coulomb(seed in any::<u64>(), mu in 0.0..2.0_f64) {
        let (gram, q) = contacts(1, 3, seed);
        let problem = FrictionProblem::new(gram.to_matrix(), q, vec![mu], ContactSpace::Spatial).unwrap();
        let solution = BlockGaussSeidel { tolerance: 1e-12, ..BlockGaussSeidel::default() }.solve(&problem).unwrap();
        let (r, u) = (&solution.impulses, &solution.velocities);
        let slip = (u[1] * u[1] + u[2] * u[2]).sqrt();
        let friction = (r[1] * r[1] + r[2] * r[2]).sqrt();
        // Rounding of numbers near one, through blocks of condition below 1e3.
        prop_assert!(r[0] >= 0.0 && u[0] >= -1e-12 && (r[0] * u[0]).abs() <= 1e-12);
        prop_assert!(friction <= mu * r[0] + 1e-12);
        if slip > 1e-9 && r[0] > 1e-9 {
            prop_assert!((r[1] * u[1] + r[2] * u[2] + friction * slip).abs() <= 1e-11, "opposes slip");
            prop_assert!((friction - mu * r[0]).abs() <= 1e-11, "at its limit");
        }
    }

    #[test]
    fn turning_the_tangents_turns_the_answer(seed in any::<u64>(), turn in 0.0..6.0_f64) {
        let (gram, q) = contacts(3, 3, seed);
        let w = gram.to_matrix();
        let (sine, cosine) = libm::sincos(turn);
        let rotation = Matrix::from_fn(9, 9, |i, j| match (i / 3 == j / 3, i % 3, j % 3) {
            (true, 0, 0) => 1.0,
            (true, 1, 1) | (true, 2, 2) => cosine,
            (true, 1, 2) => -sine,
            (true, 2, 1) => sine,
            _ => 0.0,
        });
        let turned_w = rotation.product(&w.product(&rotation.transpose()));
        let mut turned_q = vec![0.0; 9];
        rotation.multiply(&q, &mut turned_q);
        let build = |w: Matrix, q: Vec<f64>| FrictionProblem::new(w, q, vec![0.5; 3], ContactSpace::Spatial).unwrap();
        let straight = ConeNewton::default().solve(&build(w, q)).unwrap();
        let turned = ConeNewton::default().solve(&build(turned_w, turned_q)).unwrap();
        let mut expected = vec![0.0; 9];
        rotation.multiply(&straight.impulses, &mut expected);
        // Residuals of 1e-12 through a condition number below 1e4.
        prop_assert!(distance(&expected, &turned.impulses) < 1e-8);
    }

    #[test]
    fn sweeps_newton_and_unbuilt_operator_agree(seed in any::<u64>(), count in 1_usize..12) {
        let (gram, q) = contacts(count, 3, seed);
        let dense = FrictionProblem::new(gram.to_matrix(), q.clone(), vec![0.4; count], ContactSpace::Spatial).unwrap();
        let unbuilt = FrictionProblem::from_operator(gram, q, vec![0.4; count], ContactSpace::Spatial).unwrap();
        let sweeps = BlockGaussSeidel { tolerance: 1e-11, ..BlockGaussSeidel::default() };
        let (a, b) = (sweeps.solve(&dense).unwrap(), sweeps.solve(&unbuilt).unwrap());
        let c = ConeNewton::default().solve(&dense).unwrap();
        // Residual 1e-11 over a least eigenvalue above 1e-4.
        prop_assert!(distance(&a.impulses, &b.impulses) < 1e-6);
        prop_assert!(distance(&a.impulses, &c.impulses) < 1e-6);
        prop_assert!(c.report.residual < 1e-12 * dense.scale(&c.impulses));
        prop_assert!(dense.cone_residual(&c.impulses) < 1e-10);
    }

    #[test]
    fn in_the_plane_all_forms_have_one_residual(seed in any::<u64>(), count in 1_usize..10, mu in 0.0..0.8_f64) {
        let (gram, q) = contacts(count, 2, seed);
        let problem = FrictionProblem::new(gram.to_matrix(), q, vec![mu; count], ContactSpace::Planar).unwrap();
        let planar = problem.to_planar_lcp().unwrap();
        let polyhedral = problem.to_polyhedral_lcp(2).unwrap();
        let lemke = Lemke::default().solve(&polyhedral.problem).unwrap();
        let swept = GaussSeidel { tolerance: 1e-13, ..GaussSeidel::default() }.solve(&planar).unwrap().z;
        let answers = [
            ConeNewton::default().solve(&problem).unwrap().impulses,
            polyhedral.impulses(&lemke),
            Lemke::default().solve(&planar).unwrap().z,
            solve(&planar).unwrap().solution.z,
            Newton::default().solve_from(&planar, &swept).unwrap().z,
            swept,
        ];
        for answer in &answers {
            // The bar of pivoting, 1e-12 of a scale below 100.
            prop_assert!(problem.residual(answer) < 1e-10);
            prop_assert!((problem.residual(answer) - planar.residual(answer)).abs() < 1e-15);
        }
    }

    #[test]
    fn polygons_of_more_sides_come_nearer_to_the_disc(seed in any::<u64>()) {
        let (gram, q) = contacts(2, 3, seed);
        let problem = FrictionProblem::new(gram.to_matrix(), q, vec![0.3; 2], ContactSpace::Spatial).unwrap();
        let exact = ConeNewton::default().solve(&problem).unwrap().impulses;
        let error = |sides: usize| {
            let form = problem.to_polyhedral_lcp(sides).unwrap();
            distance(&form.impulses(&Lemke::default().solve(&form.problem).unwrap()), &exact)
        };
        // The direction of friction is off by at most π / sides: with |r| below 3 and μ = 0.3 that is 3 · 0.3 · 0.1, times the coupling.
        prop_assert!(error(32) < 0.2, "{}", error(32));
    }
}
