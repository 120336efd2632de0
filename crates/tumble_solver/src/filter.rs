//! Velocity filter for touching contacts: takes out of the velocities what contacts forbid (R7, R10).
//!
//! Idea: after v += a Δt the contact points of resting bodies approach by what gravity added in this step. Each touching point gets an
//! impulse that stops its approach and, within Coulomb's bounds, its slip. The impulses are *accumulated*: a point may take back
//! what it gave too much of, as long as its sum pushes and never pulls.
//!
//! ```text
//! 0 ≤ λ_n ⟂ v_n + u ≥ 0         u = gap/Δt for a resting point whose gap may still close, 0 for one that touches
//! sticking:  v_t = 0,                   |λ_t| ≤ μ_s λ_n
//! sliding:   λ_t = −μ_k λ_n v_t/|v_t|
//! ```
//!
//! Method: Gauss–Seidel over the points, forwards and backwards in turn, begun with the impulses of the last step (warm starting), until
//! no point's speed changes by more than a tolerance. Two coefficients are met in two stages: first every sticking point may use μ_s; a
//! point that slips all the same is sliding, and a second stage solves again with μ_k for the sliding points. A sliding point
//! whose friction suffices to stop it sticks again, and so does one whose friction turned round: its slip passed through rest, where μ_s
//! counts.
//!
//! Good at: rest, stacks, any size. Bad at: tall stacks and large mass ratios from a cold start (many sweeps; warm starting
//! spreads them over steps).

use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;
use crate::joint::Joints;
use crate::{ContactRow, Ending, Report, Slip, SolverBody};

/// How long to sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterSettings {
    /// Most sweeps over all points; half as many again where points break away [1].
    pub iterations: u32,
    /// A sweep that changes no point's speed by more than this is the last [m/s].
    pub tolerance: f64,
}

/// What a sweep needs of a row besides its geometry.
#[derive(Clone, Copy, Debug)]
pub struct PreparedRow<D: Dim> {
    /// K in the contact frame [1/kg].
    compliance: D::Matrix,
    /// 1 / K_ii; 0 where nothing yields [kg].
    inverse_diagonal: D::Vector,
    /// Friction impulse of the step before, in the contact frame [N·s].
    friction_before: D::Vector,
}

/// Filters the velocities of `bodies` through touching contacts; `rows[i].impulse` and `slip` are updated.
///
/// `prepared` is scratch space, kept by the caller so that a steady step allocates nothing.
pub fn filter_velocities<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &mut [ContactRow<D>],
    prepared: &mut Vec<PreparedRow<D>>,
    settings: &FilterSettings,
) -> Report {
    filter(bodies, rows, &mut None, prepared, settings)
}

/// The same with joints, all of them as one block at the end of each sweep, so that they hold exactly whenever it ends.
///
/// Impulses of joint rows are a first guess on entry, like those of contacts.
pub fn filter_velocities_and_joints<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &mut [ContactRow<D>],
    joints: Joints<'_, D>,
    prepared: &mut Vec<PreparedRow<D>>,
    settings: &FilterSettings,
) -> Report {
    for row in joints.rows.iter() {
        row.apply(bodies, row.impulse);
    }
    filter(bodies, rows, &mut Some(joints), prepared, settings)
}

fn filter<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &mut [ContactRow<D>],
    joints: &mut Option<Joints<'_, D>>,
    prepared: &mut Vec<PreparedRow<D>>,
    settings: &FilterSettings,
) -> Report {
    prepared.clear();
    prepared.extend(rows.iter().map(|row| prepare(row, bodies)));
    for row in rows.iter() {
        row.apply(bodies, row.impulse);
    }

    let first = sweep_until_still(bodies, rows, joints, prepared, settings);
    let mut any_changed = false;
    for (row, prepared) in rows.iter_mut().zip(prepared.iter()) {
        let passed_through_rest = tangential(row.impulse).dot(prepared.friction_before) < 0.0;
        let slip = match row.slip {
            Slip::Sticking if slips(row, bodies, row.surface.static_friction, settings.tolerance) => Slip::Sliding,
            Slip::Sliding if passed_through_rest => Slip::Sticking,
            unchanged => unchanged,
        };
        any_changed |= slip != row.slip;
        row.slip = slip;
    }
    // The second stage begins near its answer.
    let again = FilterSettings { iterations: settings.iterations.div_ceil(2), ..*settings };
    let second = any_changed.then(|| sweep_until_still(bodies, rows, joints, prepared, &again));
    for row in rows.iter_mut().filter(|row| row.slip == Slip::Sliding) {
        if !slips(row, bodies, row.surface.kinetic_friction, settings.tolerance) {
            row.slip = Slip::Sticking;
        }
    }

    let second_iterations = second.map_or(0, |report| report.iterations);
    Report { iterations: first.iterations + second_iterations, ..second.unwrap_or(first) }
}

fn prepare<D: Dim>(row: &ContactRow<D>, bodies: &[SolverBody<D>]) -> PreparedRow<D> {
    let compliance = row.compliance(bodies);
    let mut inverse_diagonal = D::Vector::ZERO;
    for axis in 0..D::Vector::AXES {
        let diagonal = compliance.column(axis)[axis];
        inverse_diagonal[axis] = if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 };
    }
    PreparedRow { compliance, inverse_diagonal, friction_before: tangential(row.impulse) }
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
    joints: &mut Option<Joints<'_, D>>,
    prepared: &[PreparedRow<D>],
    settings: &FilterSettings,
) -> Report {
    let mut report = Report::default();
    if let Some(joints) = joints {
        joints.block.stop(bodies, joints.rows);
    }
    while report.iterations < settings.iterations {
        let backwards = report.iterations % 2 == 1;
        report.iterations += 1;
        report.residual = 0.0;
        for i in 0..rows.len() {
            let i = if backwards { rows.len() - 1 - i } else { i };
            report.residual = report.residual.max(solve_point(bodies, &mut rows[i], &prepared[i]));
        }
        if let Some(joints) = joints {
            joints.block.stop(bodies, joints.rows);
        }
        if report.residual <= settings.tolerance {
            return report;
        }
    }
    report.ending = Ending::NotConverged;
    report
}

/// Solves one point with all others as they are: first its normal, then its friction; returns how much its speed changed [m/s].
#[inline]
fn solve_point<D: Dim>(bodies: &mut [SolverBody<D>], row: &mut ContactRow<D>, prepared: &PreparedRow<D>) -> f64 {
    let PreparedRow { compliance, inverse_diagonal, .. } = prepared;
    let velocity = row.relative_velocity(bodies);
    let normal = (row.impulse[0] - (velocity[0] + row.allowance) * inverse_diagonal[0]).max(0.0);
    // K says what the normal change does to the slip, so the bodies need to be asked only once.
    let velocity = velocity + compliance.column(0) * (normal - row.impulse[0]);

    let friction = match row.slip {
        Slip::Sticking => row.surface.static_friction,
        Slip::Sliding => row.surface.kinetic_friction,
    };
    let bound = friction * normal;
    let tried = tangential(row.impulse - velocity.scale_by(*inverse_diagonal));
    // Most points stick, and need no square root to know it.
    let squared = tried.dot(tried);
    let mut solved = if squared > bound * bound { tried * (bound / squared.sqrt()) } else { tried };
    solved[0] = normal;
    let change = solved - row.impulse;
    if change == D::Vector::ZERO {
        return 0.0;
    }
    row.impulse = solved;
    row.apply(bodies, change);
    let mut worst: f64 = 0.0;
    for axis in 0..D::Vector::AXES {
        worst = worst.max(change[axis].abs() * compliance.column(axis)[axis]);
    }
    worst
}
