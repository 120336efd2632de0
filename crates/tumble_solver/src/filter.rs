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

use crate::contact::{tangential, within_disc};
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

/// Slips of so many tolerances are motion [1].
const SLIP_TOLERANCES: f64 = 10.0;

/// What a sweep needs of a row, and no more.
#[derive(Clone, Copy, Debug)]
pub struct PreparedRow<D: Dim> {
    a: u32,
    b: u32,
    frame: D::Matrix,
    arm_a: D::Vector,
    arm_b: D::Vector,
    allowance: f64,
    /// The coefficient that bounds friction: μ_s or μ_k [1].
    friction: f64,
    impulse: D::Vector,
    /// First column of K in the contact frame: what a normal impulse does [1/kg].
    normal_response: D::Vector,
    /// K_ii [1/kg].
    diagonal: D::Vector,
    /// 1 / K_ii; 0 where nothing yields [kg].
    inverse_diagonal: D::Vector,
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
    prepared.extend(rows.iter().map(|row| PreparedRow::of(row, bodies)));
    for row in rows.iter() {
        row.apply(bodies, row.impulse);
    }

    let Swept { report: first, error } = sweep_until_still(bodies, joints, prepared, settings);
    // A slip that more sweeps would take away is none.
    let slip_above = SLIP_TOLERANCES * settings.tolerance.max(error);
    let (mut any_changed, mut any_doubt) = (false, false);
    for (row, prepared) in rows.iter_mut().zip(prepared.iter_mut()) {
        let passed_through_rest = tangential(prepared.impulse).dot(tangential(row.impulse)) < 0.0;
        row.impulse = prepared.impulse;
        let slip = match row.slip {
            Slip::Sticking if slips(row, bodies, row.surface.static_friction, slip_above) => Slip::Sliding,
            Slip::Sliding if passed_through_rest => Slip::Sticking,
            unchanged => unchanged,
        };
        any_changed |= slip != row.slip;
        any_doubt |= error > 0.0
            && slip == Slip::Sticking
            && slips(row, bodies, row.surface.static_friction, SLIP_TOLERANCES * settings.tolerance);
        row.slip = slip;
        prepared.friction = friction(row);
    }
    // The second stage begins near its answer.
    let again = FilterSettings { iterations: settings.iterations.div_ceil(2), ..*settings };
    let second = (any_changed || any_doubt).then(|| sweep_until_still(bodies, joints, prepared, &again).report);
    for (row, prepared) in rows.iter_mut().zip(prepared.iter()) {
        row.impulse = prepared.impulse;
        if row.slip == Slip::Sliding
            && !slips(row, bodies, row.surface.kinetic_friction, SLIP_TOLERANCES * settings.tolerance)
        {
            row.slip = Slip::Sticking;
        }
    }

    let second_iterations = second.map_or(0, |report| report.iterations);
    Report { iterations: first.iterations + second_iterations, ..second.unwrap_or(first) }
}

/// The coefficient that bounds friction at a point [1].
fn friction<D: Dim>(row: &ContactRow<D>) -> f64 {
    match row.slip {
        Slip::Sticking => row.surface.static_friction,
        Slip::Sliding => row.surface.kinetic_friction,
    }
}

/// Whether friction is used up and the point slips all the same.
fn slips<D: Dim>(row: &ContactRow<D>, bodies: &[SolverBody<D>], friction: f64, slip_above: f64) -> bool {
    let bound = friction * row.impulse[0];
    // Round-off of the projection onto the bound, not a physical allowance.
    let used_up = tangential(row.impulse).length() >= bound * (1.0 - 1e-12);
    used_up && tangential(row.relative_velocity(bodies)).length() > slip_above
}

/// What sweeps did.
struct Swept {
    report: Report,
    /// By how much speeds may still be off, were the last changes the terms of a geometric series [m/s].
    error: f64,
}

fn sweep_until_still<D: Dim>(
    bodies: &mut [SolverBody<D>],
    joints: &mut Option<Joints<'_, D>>,
    prepared: &mut [PreparedRow<D>],
    settings: &FilterSettings,
) -> Swept {
    let (mut report, mut before) = (Report::default(), f64::INFINITY);
    if let Some(joints) = joints {
        joints.block.stop(bodies, joints.rows);
    }
    while report.iterations < settings.iterations {
        let backwards = report.iterations % 2 == 1;
        report.iterations += 1;
        before = report.residual;
        let residual = |worst: f64, row: &mut PreparedRow<D>| worst.max(row.solve(bodies));
        report.residual = match backwards {
            false => prepared.iter_mut().fold(0.0, residual),
            true => prepared.iter_mut().rev().fold(0.0, residual),
        };
        if let Some(joints) = joints {
            joints.block.stop(bodies, joints.rows);
        }
        if report.residual <= settings.tolerance {
            return Swept { report, error: 0.0 };
        }
    }
    report.ending = Ending::NotConverged;
    let error =
        if report.residual < before { report.residual / (1.0 - report.residual / before) } else { f64::INFINITY };
    Swept { report, error }
}

impl<D: Dim> PreparedRow<D> {
    fn of(row: &ContactRow<D>, bodies: &[SolverBody<D>]) -> Self {
        let compliance = row.compliance(bodies);
        let (mut diagonal, mut inverse_diagonal) = (D::Vector::ZERO, D::Vector::ZERO);
        for axis in 0..D::Vector::AXES {
            diagonal[axis] = compliance.column(axis)[axis];
            inverse_diagonal[axis] = if diagonal[axis] > 0.0 { 1.0 / diagonal[axis] } else { 0.0 };
        }
        Self {
            a: row.a,
            b: row.b,
            frame: row.frame,
            arm_a: row.arm_a,
            arm_b: row.arm_b,
            allowance: row.allowance,
            friction: friction(row),
            impulse: row.impulse,
            normal_response: compliance.column(0),
            diagonal,
            inverse_diagonal,
        }
    }

    /// Solves one point with all others as they are: first its normal, then its friction; returns how much its speed changed [m/s].
    #[inline]
    fn solve(&mut self, bodies: &mut [SolverBody<D>]) -> f64 {
        let (mut a, mut b) = (bodies[self.a as usize], bodies[self.b as usize]);
        let velocity = self.frame.apply_transposed(b.point_velocity(self.arm_b) - a.point_velocity(self.arm_a));
        let normal = (self.impulse[0] - (velocity[0] + self.allowance) * self.inverse_diagonal[0]).max(0.0);
        // K says what the normal change does to the slip, so the bodies need to be asked only once.
        let velocity = velocity + self.normal_response * (normal - self.impulse[0]);

        let tried = tangential(self.impulse - velocity.scale_by(self.inverse_diagonal));
        let mut solved = within_disc(tried, self.friction * normal);
        solved[0] = normal;
        let change = solved - self.impulse;
        if change == D::Vector::ZERO {
            return 0.0;
        }
        self.impulse = solved;
        let push = self.frame.apply(change);
        b.apply_impulse(self.arm_b, push);
        a.apply_impulse(self.arm_a, -push);
        bodies[self.b as usize] = b;
        bodies[self.a as usize] = a;
        let speeds = change.scale_by(self.diagonal);
        (0..D::Vector::AXES).map(|axis| speeds[axis].abs()).fold(0.0, f64::max)
    }
}
