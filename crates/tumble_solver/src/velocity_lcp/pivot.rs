//! An island as a dense problem for the solvers of `tumble_lcp`.

use tumble_lcp::cone::{ConeNewton, ContactSpace, FrictionProblem};
use tumble_lcp::{Bound, Lcp, Lemke, Matrix as Dense, PrincipalPivoting};
use tumble_math::{Dim, Vector};

use super::problem::Problem;

/// Solves an island of the plane by pivoting, from the impulses that are there; returns the pivots, or `None` without a solution.
///
/// Friction of a contact with c > 0 is a box of ±μ c as long as its normal gives c; one that approaches all the same is released to push
/// harder, and the problem is solved again.
pub(super) fn pivot<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], w: &Dense, tolerance: f64) -> Option<usize> {
    if D::Vector::AXES != 2 {
        return None;
    }
    let (q, guess) = flat(problem, contacts);
    let mut is_held: Vec<bool> = contacts.iter().map(|i| problem.held[*i as usize] > 0.0).collect();
    let mut pivots = 0;
    loop {
        let bounds = contacts.iter().enumerate().flat_map(|(k, i)| {
            let (coefficient, held) = (problem.friction[*i as usize], problem.held[*i as usize]);
            if is_held[k] {
                let most = coefficient * held;
                [Bound::Box { lower: held, upper: held }, Bound::Box { lower: -most, upper: most }]
            } else {
                [Bound::Nonnegative, Bound::Friction { normal: 2 * k, coefficient }]
            }
        });
        let lcp = Lcp::new(w.clone(), q.clone()).and_then(|lcp| lcp.with_bounds(bounds.collect())).ok()?;
        let max_pivots = Some(pivots_before_giving_up(lcp.dimension()));
        let solution = PrincipalPivoting { max_pivots, ..PrincipalPivoting::default() }
            .solve_from(&lcp, &guess)
            .or_else(|_| Lemke { max_pivots, ..Lemke::default() }.solve_from(&lcp, &guess));
        let solution = solution.ok()?;
        pivots += solution.report.iterations;
        let mut released = false;
        for (k, is_held) in is_held.iter_mut().enumerate() {
            if *is_held && solution.w[2 * k] < -tolerance {
                (*is_held, released) = (false, true);
            }
        }
        if !released {
            put(problem, contacts, &solution.z);
            return Some(pivots);
        }
    }
}

/// Pivots on an island of so many rows, a few times what one takes that can be solved: another method follows.
pub(crate) fn pivots_before_giving_up(rows: usize) -> usize {
    50 + 5 * rows
}

/// Solves an island by Newton's method on the friction cones; returns the steps, or `None` without a solution.
pub(super) fn newton<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], w: &Dense) -> Option<usize> {
    if contacts.iter().any(|i| problem.held[*i as usize] > 0.0) {
        return None;
    }
    let space = if D::Vector::AXES == 2 { ContactSpace::Planar } else { ContactSpace::Spatial };
    let (q, guess) = flat(problem, contacts);
    let coefficients = contacts.iter().map(|i| problem.friction[*i as usize]).collect();
    let cones = FrictionProblem::new(w.clone(), q, coefficients, space).ok()?;
    let solution = ConeNewton::default().solve_from(&cones, &guess).ok()?;
    put(problem, contacts, &solution.impulses);
    Some(solution.report.iterations)
}

/// q and the present impulses of an island, in its rows.
fn flat<D: Dim>(problem: &Problem<D>, contacts: &[u32]) -> (Vec<f64>, Vec<f64>) {
    let rows = |of: &[D::Vector]| {
        contacts.iter().flat_map(|i| (0..D::Vector::AXES).map(|axis| of[*i as usize][axis])).collect()
    };
    (rows(&problem.q), rows(&problem.impulses))
}

/// Takes over the impulses of an island from its rows.
fn put<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], z: &[f64]) {
    for (contact, z) in contacts.iter().zip(z.chunks_exact(D::Vector::AXES)) {
        for (axis, z) in z.iter().enumerate() {
            problem.impulses[*contact as usize][axis] = *z;
        }
    }
}
