//! One island solved: which method, what if it fails, and friction in two stages.

use tumble_math::{Dim, Linear, Vector};

use super::problem::Problem;
use super::{VelocityReport, VelocitySettings, VelocitySolver, pivot, sweep};
use crate::contact::tangential;
use crate::least_norm::{Freedom, make_smallest};
use crate::{Ending, Slip, Surface};

/// Up to this many rows pivoting is quicker than sweeping; beyond, its cost grows with their cube.
const PIVOT_UP_TO_ROWS: usize = 120;

/// Up to this many rows a Newton step is worth its factorization where sweeps have not come to rest.
const NEWTON_UP_TO_ROWS: usize = 400;

/// Solves an island with μ_s where contacts stick and μ_k where they slide.
///
/// First with the states that contacts have. A contact that should stick and slips all the same slides from now on; one that slid, and
/// whose friction turned round, passed through rest, where μ_s counts. If any state changed, the island is solved again from where it
/// is. A sliding contact that μ_k suffices to stop sticks in the next step.
pub(super) fn solve_in_two_stages<D: Dim>(
    problem: &mut Problem<D>,
    contacts: &[u32],
    surfaces: impl Fn(usize) -> Surface,
    settings: &VelocitySettings,
    report: &mut VelocityReport,
) {
    let before: Vec<D::Vector> = contacts.iter().map(|i| tangential(problem.impulses[*i as usize])).collect();
    choose_friction(problem, contacts, &surfaces);
    let first = solve(problem, contacts, settings);
    let slip_above = 10.0 * settings.tolerance;
    let mut any_changed = false;
    for (contact, before) in contacts.iter().zip(&before) {
        let contact = *contact as usize;
        let passed_through_rest = problem.impulses[contact].dot(*before) < 0.0;
        let slip = match problem.slip[contact] {
            Slip::Sticking if problem.slips(contact, slip_above) => Slip::Sliding,
            Slip::Sliding if passed_through_rest => Slip::Sticking,
            unchanged => unchanged,
        };
        any_changed |= slip != problem.slip[contact];
        problem.slip[contact] = slip;
    }
    let mut last = first;
    if any_changed {
        choose_friction(problem, contacts, &surfaces);
        let before: Vec<D::Vector> = contacts.iter().map(|i| problem.impulses[*i as usize]).collect();
        last = solve(problem, contacts, settings);
        last.iterations += first.iterations;
        // Two coefficients can leave no solution where one had some; the first stage is one then.
        if last.residual.is_nan() {
            contacts.iter().zip(&before).for_each(|(i, impulse)| problem.impulses[*i as usize] = *impulse);
            last = first;
        }
    }
    for contact in contacts.iter().map(|i| *i as usize) {
        if problem.slip[contact] == Slip::Sliding && !problem.slips(contact, slip_above) {
            problem.slip[contact] = Slip::Sticking;
        }
        if problem.impulses[contact][0] > 0.0 {
            let count = if problem.slip[contact] == Slip::Sliding { &mut report.sliding } else { &mut report.sticking };
            *count += 1;
        }
    }
    last.add_to(report);
}

fn choose_friction<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], surfaces: &impl Fn(usize) -> Surface) {
    for contact in contacts.iter().map(|i| *i as usize) {
        problem.friction[contact] = match problem.slip[contact] {
            Slip::Sticking => surfaces(contact).static_friction,
            Slip::Sliding => surfaces(contact).kinetic_friction,
        };
    }
}

/// How one island ended.
#[derive(Clone, Copy, Debug)]
struct IslandEnd {
    method: Method,
    iterations: usize,
    residual: f64,
    ending: Ending,
    fell_back: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Pivoting,
    Sweeps,
    Newton,
}

impl IslandEnd {
    fn add_to(self, report: &mut VelocityReport) {
        report.islands += 1;
        report.iterations += self.iterations as u32;
        report.residual = report.residual.max(self.residual);
        match self.method {
            Method::Pivoting => report.pivoted += 1,
            Method::Sweeps => report.swept += 1,
            Method::Newton => report.newton += 1,
        }
        report.fell_back += u32::from(self.fell_back);
        if self.ending == Ending::NotConverged {
            report.ending = Ending::NotConverged;
        }
    }
}

/// Solves an island with μ as it is, from the impulses that are there.
fn solve<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], settings: &VelocitySettings) -> IslandEnd {
    let size = contacts.iter().map(|i| problem.q[*i as usize].length()).fold(0.0, f64::max);
    let bar = settings.tolerance * size.max(1.0);
    let rows = contacts.len() * D::Vector::AXES;
    let pivots_first = match settings.solver {
        VelocitySolver::Pivoting => true,
        VelocitySolver::Auto => rows <= PIVOT_UP_TO_ROWS && D::Vector::AXES == 2,
        VelocitySolver::BlockGaussSeidel | VelocitySolver::Newton => false,
    };
    let sweeps_first = match settings.solver {
        VelocitySolver::BlockGaussSeidel => true,
        VelocitySolver::Auto => !pivots_first,
        VelocitySolver::Pivoting | VelocitySolver::Newton => false,
    };
    if contacts.len() == 1 && settings.solver != VelocitySolver::Newton {
        let contact = contacts[0] as usize;
        problem.impulses[contact] = D::Vector::ZERO;
        problem.impulses[contact] = problem.solve_alone(contact);
        return ended(problem, contacts, Method::Pivoting, 1, bar, false);
    }

    let start: Vec<D::Vector> = contacts.iter().map(|i| problem.impulses[*i as usize]).collect();
    let restore = |problem: &mut Problem<D>, impulses: &[D::Vector]| {
        contacts.iter().zip(impulses).for_each(|(i, impulse)| problem.impulses[*i as usize] = *impulse);
    };
    let mut iterations = 0;
    if sweeps_first {
        iterations = sweep::sweep(problem, contacts, bar, settings.sweeps) as usize;
        let end = ended(problem, contacts, Method::Sweeps, iterations, bar, false);
        if end.ending == Ending::Converged
            || settings.solver == VelocitySolver::BlockGaussSeidel
            || rows > NEWTON_UP_TO_ROWS
        {
            return end;
        }
    }
    let w = problem.coupling.dense(contacts);
    if pivots_first && let Some(pivots) = pivot::pivot(problem, contacts, &w, bar) {
        let end = ended(problem, contacts, Method::Pivoting, pivots, bar, false);
        if end.ending == Ending::Converged {
            let vertex: Vec<D::Vector> = contacts.iter().map(|i| problem.impulses[*i as usize]).collect();
            let mut smallest = vertex.clone();
            let mut freedoms: Vec<_> = contacts.iter().map(|i| freedom(problem, *i as usize, bar)).collect();
            let friction: Vec<f64> = contacts.iter().map(|i| problem.friction[*i as usize]).collect();
            make_smallest::<D>(&mut smallest, &mut freedoms, &friction, &w);
            restore(problem, &smallest);
            let smallest = ended(problem, contacts, Method::Pivoting, pivots, bar, false);
            if smallest.ending == Ending::Converged {
                return smallest;
            }
            restore(problem, &vertex);
            return end;
        }
        restore(problem, &start);
    }
    if let Some(steps) = pivot::newton(problem, contacts, w) {
        let fell_back = settings.solver != VelocitySolver::Newton;
        let end = ended(problem, contacts, Method::Newton, iterations + steps, bar, fell_back);
        if end.ending == Ending::Converged {
            return end;
        }
    }
    if !sweeps_first {
        restore(problem, &start);
        iterations = sweep::sweep(problem, contacts, bar, settings.sweeps.max(LAST_RESORT_SWEEPS)) as usize;
    }
    ended(problem, contacts, Method::Sweeps, iterations, bar, true)
}

/// What a solved contact may still do without a change of velocities.
///
/// A contact that touches without pushing may push, too: a leg that others relieve.
fn freedom<D: Dim>(problem: &Problem<D>, contact: usize, tolerance: f64) -> Freedom<D::Vector> {
    let (impulse, velocity) = (problem.impulses[contact], problem.velocity(contact));
    let slip = tangential(velocity);
    if velocity[0] > tolerance {
        Freedom::None
    } else if problem.friction[contact] == 0.0 {
        Freedom::Along(D::Vector::unit(0))
    } else if !problem.slips(contact, tolerance) {
        Freedom::All
    } else if let Some(direction) = impulse.try_normalize() {
        Freedom::Along(direction)
    } else {
        let against = slip * (-problem.friction[contact] / slip.length());
        (D::Vector::unit(0) + against).try_normalize().map_or(Freedom::None, Freedom::Along)
    }
}

/// Sweeps where nothing else is left to try.
const LAST_RESORT_SWEEPS: u32 = 2000;

/// Ends with impulses within their bounds, whatever the error that leaves.
fn ended<D: Dim>(
    problem: &mut Problem<D>,
    contacts: &[u32],
    method: Method,
    iterations: usize,
    bar: f64,
    fell_back: bool,
) -> IslandEnd {
    contacts.iter().for_each(|i| problem.clamp(*i as usize));
    let residual = problem.residual(contacts);
    // The last change of a sweep is less than the error that is left.
    let met = residual <= 10.0 * bar;
    let ending = if met { Ending::Converged } else { Ending::NotConverged };
    IslandEnd { method, iterations, residual, ending, fell_back }
}
