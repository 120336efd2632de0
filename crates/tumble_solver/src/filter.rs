//! Velocity filter for touching contacts: takes out of the velocities what contacts forbid (R7, R10).
//!
//! Idea: after v += a Δt the contact points of resting bodies approach by what gravity added in this step. Each touching point gets an
//! impulse that stops its approach and, within Coulomb's bounds, its slip. The impulses are *accumulated*: a point may take back
//! what it gave too much of, as long as its sum pushes and never pulls.
//!
//! ```text
//! 0 ≤ λ_n ⟂ v_n ≥ 0
//! sticking:  v_t = 0,                   |λ_t| ≤ μ_s λ_n
//! sliding:   λ_t = −μ_k λ_n v_t/|v_t|
//! ```
//!
//! Method: Gauss–Seidel over the points, forwards and backwards in turn, begun with the impulses of the last step (warm starting), until
//! no point's speed changes by more than a tolerance. Two coefficients are met in two stages: first every sticking point may use μ_s; a
//! point that slips all the same is sliding, and a second stage solves again with μ_k for the sliding points. A sliding point
//! whose friction suffices to stop it sticks again.
//!
//! Good at: rest, stacks, any size. Bad at: tall stacks and large mass ratios from a cold start (many sweeps; warm starting
//! spreads them over steps).

use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;
use crate::{ContactRow, Ending, Report, Slip, SolverBody};

/// How long to sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterSettings {
    /// Most sweeps over all points, per stage [1].
    pub iterations: u32,
    /// A sweep that changes no point's speed by more than this is the last [m/s].
    pub tolerance: f64,
}

/// Filters the velocities of `bodies` through touching contacts; `rows[i].impulse` and `slip` are updated.
///
/// `diagonals` is scratch space, kept by the caller so that a steady step allocates nothing.
pub fn filter_velocities<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &mut [ContactRow<D>],
    diagonals: &mut Vec<D::Vector>,
    settings: &FilterSettings,
) -> Report {
    diagonals.clear();
    diagonals.extend(rows.iter().map(|row| inverse_diagonal(row, bodies)));
    for row in rows.iter() {
        row.apply(bodies, row.impulse);
    }

    let first = sweep_until_still(bodies, rows, diagonals, settings);
    let mut any_broke_away = false;
    for row in rows.iter_mut().filter(|row| row.slip == Slip::Sticking) {
        if slips(row, bodies, row.surface.static_friction, settings.tolerance) {
            row.slip = Slip::Sliding;
            any_broke_away = true;
        }
    }
    let second = any_broke_away.then(|| sweep_until_still(bodies, rows, diagonals, settings));
    for row in rows.iter_mut().filter(|row| row.slip == Slip::Sliding) {
        if !slips(row, bodies, row.surface.kinetic_friction, settings.tolerance) {
            row.slip = Slip::Sticking;
        }
    }

    let second_iterations = second.map_or(0, |report| report.iterations);
    Report { iterations: first.iterations + second_iterations, ..second.unwrap_or(first) }
}

/// 1 / K_ii of each axis of the contact frame; 0 where nothing yields.
fn inverse_diagonal<D: Dim>(row: &ContactRow<D>, bodies: &[SolverBody<D>]) -> D::Vector {
    let compliance = row.compliance(bodies);
    let mut inverse = D::Vector::ZERO;
    for axis in 0..D::Vector::AXES {
        let diagonal = compliance.column(axis)[axis];
        inverse[axis] = if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 };
    }
    inverse
}

/// Whether friction is used up and the point slips all the same.
fn slips<D: Dim>(row: &ContactRow<D>, bodies: &[SolverBody<D>], friction: f64, tolerance: f64) -> bool {
    let bound = friction * row.impulse[0];
    // Round-off of the projection onto the bound, not a physical allowance.
    let used_up = tangential(row.impulse).length() >= bound * (1.0 - 1e-12);
    used_up && tangential(row.relative_velocity(bodies)).length() > 10.0 * tolerance
}

fn sweep_until_still<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &mut [ContactRow<D>],
    diagonals: &[D::Vector],
    settings: &FilterSettings,
) -> Report {
    let mut report = Report::default();
    while report.iterations < settings.iterations {
        let backwards = report.iterations % 2 == 1;
        report.iterations += 1;
        report.residual = 0.0;
        for i in 0..rows.len() {
            let i = if backwards { rows.len() - 1 - i } else { i };
            report.residual = report.residual.max(solve_point(bodies, &mut rows[i], diagonals[i]));
        }
        if report.residual <= settings.tolerance {
            return report;
        }
    }
    report.ending = Ending::NotConverged;
    report
}

/// Solves one point with all others as they are; returns how much its speed changed [m/s].
#[inline]
fn solve_point<D: Dim>(bodies: &mut [SolverBody<D>], row: &mut ContactRow<D>, inverse_diagonal: D::Vector) -> f64 {
    let mut total = row.impulse;
    total[0] = (total[0] - row.separating_speed(bodies) * inverse_diagonal[0]).max(0.0);
    let mut normal_change = D::Vector::ZERO;
    normal_change[0] = total[0] - row.impulse[0];
    row.apply(bodies, normal_change);

    let friction = match row.slip {
        Slip::Sticking => row.surface.static_friction,
        Slip::Sliding => row.surface.kinetic_friction,
    };
    let bound = friction * total[0];
    let tried = tangential(total - row.relative_velocity(bodies).scale_by(inverse_diagonal));
    let size = tried.length();
    let held = if size > bound { tried * (bound / size) } else { tried };
    let tangent_change = held - tangential(row.impulse);
    row.apply(bodies, tangent_change);
    row.impulse = held;
    row.impulse[0] = total[0];

    let mut worst: f64 = 0.0;
    let change = normal_change + tangent_change;
    for axis in 0..D::Vector::AXES {
        if inverse_diagonal[axis] > 0.0 {
            worst = worst.max(change[axis].abs() / inverse_diagonal[axis]);
        }
    }
    worst
}
