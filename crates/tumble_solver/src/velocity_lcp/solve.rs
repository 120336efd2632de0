//! One island solved: which method, what if it fails, and friction in two stages.

use tumble_lcp::Matrix as Dense;
use tumble_math::{Dim, Linear, Matrix, Vector};

use super::problem::Problem;
use super::{VelocityReport, VelocitySettings, VelocitySolver, World, bodywise, pivot, sweep};
use crate::contact::tangential;
use crate::least_norm::{Freedom, make_smallest};
use crate::{Ending, Slip};

/// Up to this many rows pivoting is about as quick as Newton's method, and surer.
const PIVOT_UP_TO_ROWS: usize = 12;

/// Up to this many rows a Newton step, whose cost grows with their cube, is quicker than the sweeps that it saves.
const NEWTON_UP_TO_ROWS: usize = 120;

/// Up to this many rows it is worth a try where nothing else has come to rest.
const NEWTON_AFTER_SWEEPS_UP_TO_ROWS: usize = 150;

/// A first guess counts as the answer only when it is as exact as an answer, which is far better than the tolerance asks [1].
const KNOWN_WITHIN: f64 = 1e-4;

/// The same where the velocities of bodies are solved for, which ends earlier in rounding [1].
const KNOWN_WITHIN_BODYWISE: f64 = 0.02;

/// Rounding of a sum of impulses over many layers, as part of the largest of them [1].
const ROUNDING_OF_MANY: f64 = 5e-14;

/// Up to this many contacts indeterminate shares are brought to their least norm, whose cost grows with their cube.
const SMALLEST_UP_TO: usize = 24;

/// Solves an island with μ_s where contacts stick and μ_k where they slide.
///
/// First with the states that contacts have. A contact that should stick and slips all the same slides from now on; one that slid, and
/// whose friction turned round, passed through rest, where μ_s counts. If any state changed, the island is solved again from where it
/// is. A sliding contact that μ_k suffices to stop sticks in the next step.
pub(super) fn solve_in_two_stages<D: Dim>(
    problem: &mut Problem<D>,
    contacts: &[u32],
    world: &World<'_, D>,
    settings: &VelocitySettings,
    report: &mut VelocityReport,
) {
    let before: Vec<D::Vector> = contacts.iter().map(|i| tangential(problem.impulses[*i as usize])).collect();
    choose_friction(problem, contacts, world);
    let first = solve(problem, contacts, world, settings);
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
        choose_friction(problem, contacts, world);
        let before: Vec<D::Vector> = contacts.iter().map(|i| problem.impulses[*i as usize]).collect();
        last = solve(problem, contacts, world, settings);
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

fn choose_friction<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], world: &World<'_, D>) {
    for contact in contacts.iter().map(|i| *i as usize) {
        problem.friction[contact] = match problem.slip[contact] {
            Slip::Sticking => world.rows[contact].surface.static_friction,
            Slip::Sliding => world.rows[contact].surface.kinetic_friction,
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
    /// The impulses that were there solve it.
    FirstGuess,
    /// Or the closed form of a single contact.
    Pivoting,
    Sweeps,
    Newton,
    /// Newton's method on the velocities of the bodies.
    Bodywise,
}

impl IslandEnd {
    fn add_to(self, report: &mut VelocityReport) {
        report.islands += 1;
        report.iterations += self.iterations as u32;
        report.residual = report.residual.max(self.residual);
        match self.method {
            Method::FirstGuess => report.known += 1,
            Method::Pivoting => report.pivoted += 1,
            Method::Sweeps => report.swept += 1,
            Method::Newton | Method::Bodywise => report.newton += 1,
        }
        report.fell_back += u32::from(self.fell_back);
        if self.ending == Ending::NotConverged {
            report.ending = Ending::NotConverged;
        }
    }
}

/// Solves an island with μ as it is, from the impulses that are there.
fn solve<D: Dim>(
    problem: &mut Problem<D>,
    contacts: &[u32],
    world: &World<'_, D>,
    settings: &VelocitySettings,
) -> IslandEnd {
    let size = contacts.iter().map(|i| problem.q[*i as usize].length()).fold(0.0, f64::max);
    let bar = settings.tolerance * size.max(1.0);
    if contacts.len() == 1 {
        let contact = contacts[0] as usize;
        problem.impulses[contact] = D::Vector::ZERO;
        problem.impulses[contact] = problem.solve_alone(contact);
        return ended(problem, contacts, Method::Pivoting, 0, bar);
    }
    // Bodies that joints hold are not free to move one by one.
    let fits = |method: &&Method| **method != Method::Bodywise || (D::Vector::AXES == 2 && !world.are_held);
    let methods = || methods::<D>(settings.solver, contacts.len()).iter().filter(fits).copied();
    let is_bodywise = methods().next() == Some(Method::Bodywise);
    let good_guess = if is_bodywise {
        let own = |i: usize| problem.coupling.own(i).column(0)[0];
        let load = contacts.iter().map(|i| *i as usize).map(|i| problem.impulses[i][0] * own(i)).fold(0.0, f64::max);
        (ROUNDING_OF_MANY * load).clamp(KNOWN_WITHIN_BODYWISE * bar, 0.1 * bar)
    } else {
        KNOWN_WITHIN * bar
    };
    let known = ended(problem, contacts, Method::FirstGuess, 0, good_guess);
    if known.ending == Ending::Converged {
        return known;
    }

    let start = present(problem, contacts);
    let mut iterations = 0;
    let mut matrix = None;
    for (turn, method) in methods().enumerate() {
        let done = match method {
            Method::Bodywise => bodywise::solve(problem, contacts, world.rows, world.bodies, bar, good_guess),
            Method::Sweeps | Method::FirstGuess => Some(sweep::sweep(problem, contacts, bar, settings.sweeps) as usize),
            Method::Pivoting | Method::Newton => {
                let w = matrix.get_or_insert_with(|| problem.coupling.dense(contacts));
                if method == Method::Pivoting {
                    pivot::pivot(problem, contacts, w, bar)
                } else {
                    pivot::newton(problem, contacts, w)
                }
            }
        };
        iterations += done.unwrap_or(0);
        let end = IslandEnd { fell_back: turn > 0, ..ended(problem, contacts, method, iterations, bar) };
        if done.is_some() && end.ending == Ending::Converged {
            return match &matrix {
                Some(w) if contacts.len() <= SMALLEST_UP_TO => take_smallest(problem, contacts, w, end, bar),
                _ => end,
            };
        }
        // These leave something better than they found; after any other the next begins afresh.
        if !matches!(method, Method::Sweeps | Method::Bodywise) {
            restore(problem, contacts, &start);
        }
    }
    // Sweeps always leave something usable.
    if matrix.is_some() {
        iterations += sweep::sweep(problem, contacts, bar, settings.sweeps.max(LAST_RESORT_SWEEPS)) as usize;
        return IslandEnd { fell_back: true, ..ended(problem, contacts, Method::Sweeps, iterations, bar) };
    }
    ended(problem, contacts, Method::Sweeps, iterations, bar)
}

/// The methods to try, in this order.
fn methods<D: Dim>(solver: VelocitySolver, contacts: usize) -> &'static [Method] {
    let rows = contacts * D::Vector::AXES;
    match solver {
        VelocitySolver::Pivoting => &[Method::Pivoting, Method::Newton],
        VelocitySolver::BlockGaussSeidel => &[Method::Sweeps],
        VelocitySolver::Newton => &[Method::Newton],
        VelocitySolver::Auto if rows <= PIVOT_UP_TO_ROWS => &[Method::Pivoting, Method::Newton],
        VelocitySolver::Auto if rows <= NEWTON_UP_TO_ROWS => &[Method::Newton, Method::Pivoting],
        VelocitySolver::Auto if rows <= NEWTON_AFTER_SWEEPS_UP_TO_ROWS => {
            &[Method::Bodywise, Method::Sweeps, Method::Newton]
        }
        VelocitySolver::Auto => &[Method::Bodywise, Method::Sweeps],
    }
}

/// Of all impulses with the same velocities, takes the smallest.
fn take_smallest<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], w: &Dense, end: IslandEnd, bar: f64) -> IslandEnd {
    // What Poisson's law gives back has its shares from the compression.
    if contacts.iter().any(|i| problem.held[*i as usize] > 0.0) {
        return end;
    }
    let solved = present(problem, contacts);
    let mut smallest = solved.clone();
    let mut freedoms: Vec<_> = contacts.iter().map(|i| freedom(problem, *i as usize, bar)).collect();
    let friction: Vec<f64> = contacts.iter().map(|i| problem.friction[*i as usize]).collect();
    make_smallest::<D>(&mut smallest, &mut freedoms, &friction, w);
    if smallest == solved {
        return end;
    }
    restore(problem, contacts, &smallest);
    let better = IslandEnd { fell_back: end.fell_back, ..ended(problem, contacts, end.method, end.iterations, bar) };
    if better.ending == Ending::Converged {
        return better;
    }
    restore(problem, contacts, &solved);
    end
}

fn present<D: Dim>(problem: &Problem<D>, contacts: &[u32]) -> Vec<D::Vector> {
    contacts.iter().map(|i| problem.impulses[*i as usize]).collect()
}

fn restore<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], impulses: &[D::Vector]) {
    contacts.iter().zip(impulses).for_each(|(i, impulse)| problem.impulses[*i as usize] = *impulse);
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
fn ended<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], method: Method, iterations: usize, bar: f64) -> IslandEnd {
    contacts.iter().for_each(|i| problem.clamp(*i as usize));
    let residual = problem.residual(contacts);
    // The last change of a sweep is less than the error that is left.
    let met = residual <= 10.0 * bar;
    let ending = if met { Ending::Converged } else { Ending::NotConverged };
    IslandEnd { method, iterations, residual, ending, fell_back: false }
}
