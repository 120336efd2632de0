//! Enumeration: tries every choice of sides. The oracle for everything else.
//!
//! **Idea.** A solution touches a bound or has w = 0 in each row. Try all combinations, solve the linear system of each, keep
//! those that satisfy the signs.
//!
//! **Equations.** For each set C: M_CC z_C = −q_C, z = 0 elsewhere; accepted when z_C ≥ 0 and w ≥ 0. Where M_CC is singular, further
//! rows with w = 0 are added until z_C is determined, so that the vertices of a continuum of solutions are found as well.
//!
//! **Good at.** Finds all isolated solutions and all vertices of solution sets; no assumption on M; an empty list is a proof
//! (up to rounding) that no solution exists when z ≥ 0.
//!
//! **Bad at.** 2ⁿ systems (3ⁿ with boxes). It refuses more than 2¹⁶ combinations.
//!
//! **When to choose.** In tests, and for the smallest problems when all solutions are wanted.

use crate::active_set::{Side, SideSystem};
use crate::factor::Lu;
use crate::matrix::{Matrix, largest};
use crate::outcome::{Method, Solution, SolveError, judge_pivoting};
use crate::problem::{Bound, Lcp};

/// All isolated solutions, and the vertices of solution sets, in the order of their combinations of sides.
pub fn enumerate(problem: &Lcp) -> Result<Vec<Solution>, SolveError> {
    let choices: Vec<Vec<Side>> = problem.bounds().iter().map(choices_of).collect();
    let combinations = choices.iter().try_fold(1_usize, |product, c| product.checked_mul(c.len()));
    let Some(combinations) = combinations.filter(|&count| count <= 1 << 16) else {
        return Err(SolveError::NotApplicable { method: Method::Enumeration, reason: "more than 65536 combinations" });
    };
    let mut solutions: Vec<Solution> = Vec::new();
    for combination in 0..combinations {
        let mut rest = combination;
        let sides: Vec<Side> = choices
            .iter()
            .map(|c| {
                let side = c[rest % c.len()];
                rest /= c.len();
                side
            })
            .collect();
        for mut z in candidates(problem, &sides) {
            problem.clamp(&mut z);
            if let Ok(solution) = judge_pivoting(problem, z, Method::Enumeration, combinations)
                && !solutions.iter().any(|known| same(&known.z, &solution.z))
            {
                solutions.push(solution);
            }
        }
    }
    Ok(solutions)
}

/// The sides a bound has.
fn choices_of(bound: &Bound) -> Vec<Side> {
    match *bound {
        Bound::Nonnegative => vec![Side::Lower, Side::Between],
        Bound::Free => vec![Side::Between],
        Bound::Friction { .. } => vec![Side::Lower, Side::Between, Side::Upper],
        Bound::Box { lower, upper } => {
            let lower = lower.is_finite().then_some(Side::Lower);
            let upper = upper.is_finite().then_some(Side::Upper);
            lower.into_iter().chain([Side::Between]).chain(upper).collect()
        }
    }
}

/// The z that a choice of sides implies: one when its system is regular, else one per way to complete it.
fn candidates(problem: &Lcp, sides: &[Side]) -> Vec<Vec<f64>> {
    let system = SideSystem::new(problem, sides);
    let (matrix, right) = system.equations(problem, &system.active);
    if let Some(lu) = Lu::factor(matrix.clone()) {
        return vec![system.assemble(&lu.solve_refined(&matrix, &right))];
    }
    let missing = system.active.len() - rank(matrix);
    let idle: Vec<usize> = (0..sides.len()).filter(|&i| sides[i] != Side::Between).collect();
    subsets(&idle, missing)
        .into_iter()
        .filter_map(|extra| {
            let rows: Vec<usize> = system.active.iter().copied().chain(extra).collect();
            let (matrix, right) = system.equations(problem, &rows);
            solve_overdetermined(matrix, right)
        })
        .map(|active_z| system.assemble(&active_z))
        .collect()
}

/// All subsets of the given size.
fn subsets(items: &[usize], size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let Some((&first, rest)) = items.split_first() else { return Vec::new() };
    let mut with_first = subsets(rest, size - 1);
    with_first.iter_mut().for_each(|subset| subset.push(first));
    with_first.extend(subsets(rest, size));
    with_first
}

/// Solves A x = b for a tall A of full column rank by elimination with full pivoting; defects in b are left to the caller.
fn solve_overdetermined(mut a: Matrix, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let columns = a.columns();
    let order = eliminate(&mut a, &mut b);
    if order.len() < columns {
        return None;
    }
    let mut x = vec![0.0; columns];
    for (k, &column) in order.iter().enumerate().rev() {
        let known: f64 = order[k + 1..].iter().map(|&later| a[(k, later)] * x[later]).sum();
        x[column] = (b[k] - known) / a[(k, column)];
    }
    Some(x)
}

/// Rank, to rounding.
fn rank(mut a: Matrix) -> usize {
    let mut nothing = vec![0.0; a.rows()];
    eliminate(&mut a, &mut nothing).len()
}

/// Gaussian elimination with full pivoting in place; returns the pivot column of each eliminated row.
fn eliminate(a: &mut Matrix, b: &mut [f64]) -> Vec<usize> {
    let threshold = 1e-12 * largest(a.entries());
    let mut order = Vec::new();
    for k in 0..a.rows().min(a.columns()) {
        let mut pivot = (k, usize::MAX, threshold);
        for i in k..a.rows() {
            for j in (0..a.columns()).filter(|j| !order.contains(j)) {
                if a[(i, j)].abs() > pivot.2 {
                    pivot = (i, j, a[(i, j)].abs());
                }
            }
        }
        let (row, column, _) = pivot;
        if column == usize::MAX {
            break;
        }
        a.swap_rows(k, row);
        b.swap(k, row);
        for i in k + 1..a.rows() {
            let (above, below) = a.row_and_row_mut(k, i);
            let factor = below[column] / above[column];
            below.iter_mut().zip(above).for_each(|(x, y)| *x -= factor * y);
            b[i] -= factor * b[k];
        }
        order.push(column);
    }
    order
}

/// Equal up to the accuracy at which two systems give the same solution.
fn same(a: &[f64], b: &[f64]) -> bool {
    let scale = largest(a).max(largest(b));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * scale)
}
