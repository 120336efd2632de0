//! One island of resting points: its complementarity problem, and whether it has none, one or several solutions.

use tumble_lcp::cone::{ConeNewton, ContactSpace, FrictionProblem};
use tumble_lcp::{Bound, Lcp, Lemke, Matrix as Dense, PrincipalPivoting, enumerate};
use tumble_math::{Dim, Linear, Vector};

use super::RestingStatus;
use crate::contact::tangential;
use crate::least_norm::{Freedom, make_smallest};
use crate::velocity_lcp::pivots_before_giving_up;
use crate::{Slip, Surface};

/// Islands of up to this many points are looked at from all sides where more than one outcome is possible.
const ENUMERATE_UP_TO: usize = 4;

/// What friction does at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Friction<V> {
    /// Whatever it takes to stay, up to μ_s.
    Resting,
    /// This times the normal force: −μ_k v_t/|v_t|.
    Sliding(V),
}

/// A point at rest along its normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<V> {
    /// b: acceleration of the gap and of the slip without contact forces [m/s²].
    pub free: V,
    pub friction: Friction<V>,
    pub surface: Surface,
}

/// The forces of an island.
pub(super) struct Solved<V> {
    pub status: RestingStatus,
    /// Force and state of each point.
    pub forces: Vec<(V, Slip)>,
    pub iterations: usize,
    /// [m/s²]
    pub residual: f64,
}

/// Steps of Newton's method on the discs of an island, and sweeps between them, before it is given up: two to ten are enough where it succeeds [1].
const MOST_DISC_STEPS: usize = 15;

/// Part of μ_s f_n that counts as all of it, for a point that accelerates [1].
const USED_UP: f64 = 1.0 - 1e-9;

/// A guess counts as the answer only when it is as exact as an answer, which is far better than the tolerance asks [1].
const KNOWN_WITHIN: f64 = 1e-3;

/// Solves an island with the matrix `a` (rows point by point, normal first), beginning with a guess of the forces.
pub(super) fn solve<D: Dim>(
    a: &Dense,
    mut points: Vec<Point<D::Vector>>,
    guess: &[D::Vector],
    tolerance: f64,
) -> Solved<D::Vector> {
    let mut stage = Stage::<D>::of(a, &points);
    let mut first = stage.solve(guess, tolerance);
    if first.status != RestingStatus::NoSolution {
        let mut breaks = false;
        for (k, point) in points.iter_mut().enumerate() {
            let (force, pull) = (first.forces[k], tangential(first.accelerations[k]));
            let used_up = tangential(force).length() >= point.surface.static_friction * force[0] * USED_UP;
            if point.friction == Friction::Resting && force[0] > 0.0 && used_up && pull.length() > 10.0 * tolerance {
                point.friction = Friction::Sliding(pull * (-point.surface.kinetic_friction / pull.length()));
                breaks = true;
            }
        }
        if breaks {
            stage = Stage::of(a, &points);
            let second = stage.solve(&first.forces, tolerance);
            first = Outcome { iterations: first.iterations + second.iterations, ..second };
        }
    }
    let slip = |k: usize| match points[k].friction {
        Friction::Sliding(_) => Slip::Sliding,
        Friction::Resting => Slip::Sticking,
    };
    let forces = first.forces.iter().enumerate().map(|(k, force)| (*force, slip(k))).collect();
    Solved { status: first.status, forces, iterations: first.iterations, residual: first.residual }
}

/// An island with what friction does at each point decided.
struct Stage<'a, D: Dim> {
    a: &'a Dense,
    points: &'a [Point<D::Vector>],
    unknowns: Vec<Unknown<D::Vector>>,
    bounds: Vec<Bound>,
}

/// One unknown of the problem and its row.
#[derive(Clone, Copy)]
struct Unknown<V> {
    point: usize,
    /// Component of the point's acceleration in its row.
    component: usize,
    /// Force of the point per unit of the unknown.
    force: V,
}

/// Forces and what they do.
struct Outcome<V> {
    status: RestingStatus,
    forces: Vec<V>,
    accelerations: Vec<V>,
    iterations: usize,
    residual: f64,
}

impl<'a, D: Dim> Stage<'a, D> {
    fn of(a: &'a Dense, points: &'a [Point<D::Vector>]) -> Self {
        let (mut unknowns, mut bounds) = (Vec::new(), Vec::new());
        for (point, Point { friction, surface, .. }) in points.iter().enumerate() {
            let normal = bounds.len();
            bounds.push(Bound::Nonnegative);
            let unit = D::Vector::unit;
            match *friction {
                Friction::Sliding(direction) => {
                    unknowns.push(Unknown { point, component: 0, force: unit(0) + direction });
                }
                Friction::Resting => {
                    unknowns.extend((0..D::Vector::AXES).map(|k| Unknown { point, component: k, force: unit(k) }));
                    let bound = Bound::Friction { normal, coefficient: surface.static_friction };
                    bounds.extend((1..D::Vector::AXES).map(|_| bound));
                }
            }
        }
        Self { a, points, unknowns, bounds }
    }

    fn solve(&self, guess: &[D::Vector], tolerance: f64) -> Outcome<D::Vector> {
        let size = self.points.iter().map(|point| point.free.length()).fold(0.0, f64::max);
        let bar = tolerance * size.max(1.0);
        let may_have_several = self.may_have_several();
        let given = guess;
        let guess: Vec<f64> = self.unknowns.iter().map(|unknown| guess[unknown.point][unknown.component]).collect();
        let known = self.outcome(RestingStatus::Solved, self.forces(&guess), 0);
        if !may_have_several && known.residual <= KNOWN_WITHIN * bar {
            return known;
        }
        let Some(lcp) = self.problem() else { return self.nothing() };
        let mut status = RestingStatus::Solved;
        let mut found = None;
        if may_have_several
            && self.points.len() <= ENUMERATE_UP_TO
            && let Ok(mut all) = enumerate(&lcp)
        {
            let squares = |z: &[f64]| z.iter().map(|z| z * z).sum::<f64>();
            // Stable, so that of equals the first combination stays first.
            all.sort_by(|x, y| squares(&x.z).total_cmp(&squares(&y.z)));
            let Some(first) = all.first() else { return self.nothing() };
            let other = |w: &[f64]| w.iter().zip(&first.w).any(|(a, b)| (a - b).abs() > 10.0 * bar);
            if all.iter().any(|solution| other(&solution.w)) {
                status = RestingStatus::NotUnique;
            }
            found = Some((self.forces(&first.z), all.len()));
        }
        if self.has_discs() && status != RestingStatus::NotUnique {
            let begin = found.as_ref().map_or(given, |(forces, _)| forces);
            let on_discs = self.on_discs(begin).map(|(forces, steps)| self.outcome(status, forces, steps));
            // What Newton's method does not solve is bounded along two tangents, and its residual says so.
            if let Some(outcome) = on_discs.filter(|outcome| outcome.residual <= bar) {
                found = Some((outcome.forces, outcome.iterations));
            }
        }
        if found.is_none() {
            let max_pivots = Some(pivots_before_giving_up(lcp.dimension()));
            let pivoted = PrincipalPivoting { max_pivots, ..PrincipalPivoting::default() }
                .solve_from(&lcp, &guess)
                .or_else(|_| Lemke { max_pivots, ..Lemke::default() }.solve(&lcp));
            found = pivoted.ok().map(|solution| (self.forces(&solution.z), solution.report.iterations));
        }
        let Some((forces, iterations)) = found else { return self.nothing() };
        let outcome = self.outcome(status, forces, iterations);
        if status == RestingStatus::NotUnique {
            return outcome;
        }
        let mut smallest = outcome.forces.clone();
        let mut freedoms: Vec<_> = (0..self.points.len()).map(|k| self.freedom(k, &outcome, bar)).collect();
        let friction: Vec<f64> = self.points.iter().map(|point| point.surface.static_friction).collect();
        make_smallest::<D>(&mut smallest, &mut freedoms, &friction, self.a);
        let smallest = self.outcome(status, smallest, iterations);
        if smallest.residual <= bar.max(outcome.residual) { smallest } else { outcome }
    }

    /// Whether there may be no solution, or several.
    fn may_have_several(&self) -> bool {
        // Of points in space that all rest one solution is looked for: patterns of bounds along two tangents say nothing of discs.
        let slides = |point: &Point<D::Vector>| matches!(point.friction, Friction::Sliding(_));
        let may = D::Vector::AXES == 2 || self.points.iter().any(slides);
        may && !self.is_frictionless() && !self.has_positive_minors()
    }

    /// Whether friction of some point is bounded by a disc, which no linear problem has.
    fn has_discs(&self) -> bool {
        D::Vector::AXES > 2 && self.points.iter().any(|point| point.friction == Friction::Resting)
    }

    /// Forces with friction at rest within its disc, by Newton's method, and its steps. The columns of a sliding point hold its friction,
    /// and it has none besides.
    fn on_discs(&self, guess: &[D::Vector]) -> Option<(Vec<D::Vector>, usize)> {
        let axes = D::Vector::AXES;
        let n = axes * self.points.len();
        let matrix = Dense::from_fn(n, n, |row, column| {
            let (point, component) = (column / axes, column % axes);
            let dragged = match self.points[point].friction {
                Friction::Sliding(direction) if component == 0 => {
                    (1..axes).map(|k| self.a[(row, axes * point + k)] * direction[k]).sum()
                }
                _ => 0.0,
            };
            self.a[(row, column)] + dragged
        });
        let q = self.points.iter().flat_map(|point| (0..axes).map(|k| point.free[k])).collect();
        let coefficient = |point: &Point<D::Vector>| match point.friction {
            Friction::Resting => point.surface.static_friction,
            Friction::Sliding(_) => 0.0,
        };
        let coefficients = self.points.iter().map(coefficient).collect();
        let guess: Vec<f64> = self
            .points
            .iter()
            .zip(guess)
            .flat_map(|(point, force)| {
                let rests = point.friction == Friction::Resting;
                (0..axes).map(move |k| if k == 0 || rests { force[k] } else { 0.0 })
            })
            .collect();
        let discs = FrictionProblem::new(matrix, q, coefficients, ContactSpace::Spatial).ok()?;
        let newton = ConeNewton { max_steps: MOST_DISC_STEPS, ..ConeNewton::default() };
        let solution = newton.solve_from(&discs, &guess).ok()?;
        let force = |(point, r): (&Point<D::Vector>, &[f64])| {
            let mut force = D::Vector::ZERO;
            match point.friction {
                Friction::Resting => (0..axes).for_each(|k| force[k] = r[k]),
                Friction::Sliding(direction) => force = (D::Vector::unit(0) + direction) * r[0],
            }
            force
        };
        let forces = self.points.iter().zip(solution.impulses.chunks_exact(axes)).map(force).collect();
        Some((forces, solution.report.iterations))
    }

    /// w = M z + q of the island.
    fn problem(&self) -> Option<Lcp> {
        let n = self.unknowns.len();
        let m = Dense::from_fn(n, n, |r, c| self.entry(&self.unknowns[r], &self.unknowns[c]));
        let q = self.unknowns.iter().map(|row| self.points[row.point].free[row.component]).collect();
        Lcp::new(m, q).and_then(|lcp| lcp.with_bounds(self.bounds.clone())).ok()
    }

    /// Acceleration in one unknown's row per unit of another.
    fn entry(&self, row: &Unknown<D::Vector>, column: &Unknown<D::Vector>) -> f64 {
        let axes = D::Vector::AXES;
        let r = axes * row.point + row.component;
        (0..axes).map(|k| self.a[(r, axes * column.point + k)] * column.force[k]).sum()
    }

    fn is_frictionless(&self) -> bool {
        let free = |point: &Point<D::Vector>| point.friction == Friction::Sliding(D::Vector::ZERO);
        self.points.iter().all(free)
    }

    /// Whether every principal minor of the normal rows is positive, with friction of resting points at either bound; for larger islands
    /// only those of a single point.
    fn has_positive_minors(&self) -> bool {
        let n = self.points.len();
        let normal = |point: usize, force| Unknown { point, component: 0, force };
        let choices: Vec<Vec<D::Vector>> = self
            .points
            .iter()
            .map(|point| {
                let up = D::Vector::unit(0);
                match point.friction {
                    Friction::Sliding(direction) => vec![up + direction],
                    Friction::Resting => (1..D::Vector::AXES)
                        .flat_map(|axis| {
                            [1.0, -1.0].map(|sign| up + D::Vector::unit(axis) * (sign * point.surface.static_friction))
                        })
                        .collect(),
                }
            })
            .collect();
        if n > ENUMERATE_UP_TO {
            let own = |k: usize, force: &D::Vector| self.entry(&normal(k, *force), &normal(k, *force));
            return (0..n).all(|k| choices[k].iter().all(|force| own(k, force) > 0.0));
        }
        let combinations: usize = choices.iter().map(Vec::len).product();
        (0..combinations).all(|combination| {
            let mut rest = combination;
            let columns: Vec<Unknown<D::Vector>> = choices
                .iter()
                .enumerate()
                .map(|(k, forces)| {
                    let force = forces[rest % forces.len()];
                    rest /= forces.len();
                    normal(k, force)
                })
                .collect();
            (1_u32..1 << n).all(|subset| {
                let chosen: Vec<&Unknown<D::Vector>> =
                    (0..n).filter(|k| subset >> k & 1 == 1).map(|k| &columns[k]).collect();
                let minor = chosen.iter().map(|r| chosen.iter().map(|c| self.entry(r, c)).collect()).collect();
                is_clearly_positive(minor)
            })
        })
    }

    fn forces(&self, z: &[f64]) -> Vec<D::Vector> {
        let mut forces = vec![D::Vector::ZERO; self.points.len()];
        for (unknown, z) in self.unknowns.iter().zip(z) {
            forces[unknown.point] += unknown.force * *z;
        }
        forces
    }

    /// What these forces do, and how far they are from the conditions.
    fn outcome(&self, status: RestingStatus, forces: Vec<D::Vector>, iterations: usize) -> Outcome<D::Vector> {
        let axes = D::Vector::AXES;
        let mut accelerations: Vec<D::Vector> = self.points.iter().map(|point| point.free).collect();
        for (k, acceleration) in accelerations.iter_mut().enumerate() {
            for component in 0..axes {
                let row = self.a.row(axes * k + component);
                let sum: f64 = forces
                    .iter()
                    .zip(row.chunks_exact(axes))
                    .map(|(force, row)| row.iter().enumerate().map(|(i, a)| a * force[i]).sum::<f64>())
                    .sum();
                acceleration[component] += sum;
            }
        }
        let mut residual: f64 = 0.0;
        for (k, (point, (force, acceleration))) in self.points.iter().zip(forces.iter().zip(&accelerations)).enumerate()
        {
            let own = |component: usize| self.a[(axes * k + component, axes * k + component)];
            residual = residual.max(acceleration[0].min(own(0) * force[0]).abs());
            if point.friction == Friction::Resting {
                let own = (1..axes).map(own).sum::<f64>() / (axes - 1) as f64;
                let bound = own * point.surface.static_friction * force[0].max(0.0);
                let (held, pull) = (tangential(*force) * own, tangential(*acceleration));
                // Natural map of the disc; an interval in the plane.
                let target = held - pull;
                let error = if target.length() <= bound { pull } else { held - target * (bound / target.length()) };
                residual = residual.max(error.length());
            }
        }
        // A minimum hides what is no number.
        if !accelerations.iter().all(|acceleration| acceleration.is_finite()) {
            residual = f64::NAN;
        }
        Outcome { status, forces, accelerations, iterations, residual }
    }

    /// No forces at all, because there are none that fit.
    fn nothing(&self) -> Outcome<D::Vector> {
        let forces = vec![D::Vector::ZERO; self.points.len()];
        let accelerations = self.points.iter().map(|point| point.free).collect();
        Outcome { status: RestingStatus::NoSolution, forces, accelerations, iterations: 0, residual: 0.0 }
    }

    /// What a point may still do without a change of accelerations.
    fn freedom(&self, k: usize, outcome: &Outcome<D::Vector>, bar: f64) -> Freedom<D::Vector> {
        let along = |direction: D::Vector| direction.try_normalize().map_or(Freedom::None, Freedom::Along);
        let (acceleration, point) = (outcome.accelerations[k], &self.points[k]);
        let pull = tangential(acceleration);
        let up = D::Vector::unit(0);
        match point.friction {
            _ if acceleration[0] > bar => Freedom::None,
            Friction::Sliding(direction) => along(up + direction),
            Friction::Resting if pull.length() <= bar => Freedom::All,
            Friction::Resting if outcome.forces[k][0] > 0.0 => along(outcome.forces[k]),
            Friction::Resting => along(up + pull * (-point.surface.static_friction / pull.length())),
        }
    }
}

/// Whether a determinant is positive beyond rounding, by elimination with the rows in order and the columns by size.
fn is_clearly_positive(mut m: Vec<Vec<f64>>) -> bool {
    let n = m.len();
    let scale: f64 = (0..n).map(|i| m[i].iter().fold(0.0_f64, |most, entry| most.max(entry.abs()))).product();
    let mut determinant = 1.0;
    for k in 0..n {
        let pivot = (k..n).fold(k, |best, j| if m[k][j].abs() > m[k][best].abs() { j } else { best });
        if pivot != k {
            m.iter_mut().for_each(|row| row.swap(k, pivot));
            determinant = -determinant;
        }
        determinant *= m[k][k];
        if m[k][k] == 0.0 {
            return false;
        }
        let (done, left) = m.split_at_mut(k + 1);
        for row in left {
            let factor = row[k] / done[k][k];
            row.iter_mut().zip(&done[k]).skip(k).for_each(|(entry, above)| *entry -= factor * above);
        }
    }
    determinant > 1e-12 * scale
}
