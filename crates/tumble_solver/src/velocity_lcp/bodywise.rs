//! An island of the plane solved in the velocities of its bodies: augmented Lagrangian with Newton's method, for many contacts.
//!
//! Contacts outnumber what bodies can do: a pyramid of 210 boxes has 800 points and 630 speeds, so W = J M⁻¹ Jᵀ is singular and dense within layers, while the
//! bodies' own matrix is regular and sparse. With v the change of the bodies' velocities, in units that make every mass 1, and impulses λ so far,
//!
//! ```text
//! y = λ − ρ (J v + q)           what each contact would push with, ρ a multiple of 1 / W_ii
//! p(y) = (max(c, y_n), y_t kept within ±b)      b: μ times the λ_n so far
//! v − Jᵀ p(y) = 0               Newton's method: (1 + Jᵀ ρ J of the rows that are not at a bound) Δv = Jᵀ p(y) − v
//! λ ← p(y)                      and again
//! ```
//!
//! Each v minimises ½ |v|² + Σ (½ p² and linear beyond)/ρ, a convex function made of quadratic pieces, so that the lowest point along each step is found. The outer loop is the proximal
//! method of multipliers (Rockafellar 1976): its error shrinks by about 1/(1 + ρ w) each time, w the smallest yield of W that counts; where friction does
//! not slip, b is right as soon as λ_n is. The matrix is factored within its envelope, bodies numbered after Cuthill and McKee (1969), and kept as long as the same rows
//! are at their bounds.

use tumble_math::{Dim, Inertia, Linear, Matrix, Vector};

use super::problem::Problem;
use crate::ContactRow;
use crate::SolverBody;
use crate::skyline::Skyline;

/// ρ times W_ii: each round shrinks the error about as often, and rounding leaves as many units in the last place [1].
const STIFFNESS: f64 = 1e4;
/// Most rounds of multipliers; a few are the rule.
const ROUNDS: usize = 60;
/// Most steps of Newton's method in a round.
const STEPS: usize = 60;
/// Halvings of a step, about.
const LINE_SEARCH: usize = 20;
/// Speeds of a body of the plane.
const FREEDOMS: usize = 3;
/// A contact's side that nothing moves.
const STILL: usize = usize::MAX;

/// A contact in the units of this file.
struct Contact {
    /// Its two bodies in the numbering of the envelope, or [`STILL`].
    bodies: [usize; 2],
    /// Rows of J, normal and tangent: for each body its three speeds.
    rows: [[[f64; FREEDOMS]; 2]; 2],
    /// ρ of both rows.
    stiffness: [f64; 2],
    q: [f64; 2],
    impulse: [f64; 2],
    held: f64,
    bound: f64,
}

/// Which of a contact's rows yield: neither is at a bound.
type Yielding = [bool; 2];

impl Contact {
    /// J v + q.
    fn velocity(&self, v: &[f64]) -> [f64; 2] {
        let rate = self.rate(v);
        [self.q[0] + rate[0], self.q[1] + rate[1]]
    }

    /// J v.
    fn rate(&self, v: &[f64]) -> [f64; 2] {
        let mut u = [0.0; 2];
        for (u, row) in u.iter_mut().zip(&self.rows) {
            for (body, row) in self.bodies.iter().zip(row).filter(|(body, _)| **body != STILL) {
                *u += (0..FREEDOMS).map(|k| row[k] * v[FREEDOMS * body + k]).sum::<f64>();
            }
        }
        u
    }

    /// y.
    fn wish(&self, v: &[f64]) -> [f64; 2] {
        let u = self.velocity(v);
        [0, 1].map(|k| self.impulse[k] - self.stiffness[k] * u[k])
    }

    /// p(y).
    fn push(&self, wish: [f64; 2]) -> [f64; 2] {
        [wish[0].max(self.held), wish[1].max(-self.bound).min(self.bound)]
    }

    fn yielding(&self, wish: [f64; 2]) -> Yielding {
        [wish[0] > self.held, wish[1].abs() < self.bound]
    }

    /// Adds Jᵀ p.
    fn add(&self, push: [f64; 2], to: &mut [f64]) {
        for (push, row) in push.iter().zip(&self.rows) {
            for (body, row) in self.bodies.iter().zip(row).filter(|(body, _)| **body != STILL) {
                (0..FREEDOMS).for_each(|k| to[FREEDOMS * body + k] += row[k] * push);
            }
        }
    }
}

/// Solves an island from the impulses that are there, until its error is below `goal`, or shrinks no more; returns the Newton steps, or `None` where this is
/// no method for it. An error below `enough` is worth no long wait.
pub(super) fn solve<D: Dim>(
    problem: &mut Problem<D>,
    contacts: &[u32],
    rows: &[ContactRow<D>],
    bodies: &[SolverBody<D>],
    enough: f64,
    goal: f64,
) -> Option<usize> {
    if D::Vector::AXES != 2 {
        return None;
    }
    let mut island = Island::new(problem, contacts, rows, bodies)?;
    let (mut steps, mut least, mut stalled) = (0, f64::INFINITY, 0);
    let mut best: Vec<D::Vector> = contacts.iter().map(|i| problem.impulses[*i as usize]).collect();
    for _ in 0..ROUNDS {
        for (contact, i) in island.contacts.iter_mut().zip(contacts) {
            contact.bound = problem.friction[*i as usize] * contact.impulse[0].max(0.0);
        }
        let Some(taken) = island.minimise() else { break };
        steps += taken;
        for (contact, i) in island.contacts.iter_mut().zip(contacts) {
            contact.impulse = contact.push(contact.wish(&island.v));
            let impulse = &mut problem.impulses[*i as usize];
            (impulse[0], impulse[1]) = (contact.impulse[0], contact.impulse[1]);
        }
        let residual = problem.residual(contacts);
        if residual < least {
            stalled = if residual > 0.5 * least { stalled + 1 } else { 0 };
            least = residual;
            best.iter_mut().zip(contacts).for_each(|(best, i)| *best = problem.impulses[*i as usize]);
        } else {
            stalled += 1;
        }
        let patience = if least <= enough { 1 } else { 5 };
        if least <= goal || stalled >= patience || residual.is_nan() {
            break;
        }
    }
    best.iter().zip(contacts).for_each(|(best, i)| problem.impulses[*i as usize] = *best);
    Some(steps)
}

struct Island {
    contacts: Vec<Contact>,
    v: Vec<f64>,
    /// First column of each body's rows in the envelope.
    first: Vec<usize>,
    skyline: Skyline,
    /// The rows that the factors are of.
    factored: Vec<Yielding>,
}

impl Island {
    fn new<D: Dim>(
        problem: &Problem<D>,
        contacts: &[u32],
        rows: &[ContactRow<D>],
        bodies: &[SolverBody<D>],
    ) -> Option<Self> {
        let number = numbering(contacts.iter().map(|i| [rows[*i as usize].a, rows[*i as usize].b]), bodies);
        let count = number.iter().filter(|number| **number != STILL).count();
        let turn = D::torque(D::Vector::unit(0), D::Vector::unit(1));
        let mut island = Vec::with_capacity(contacts.len());
        let mut first: Vec<usize> = (0..count).collect();
        for i in contacts.iter().map(|i| *i as usize) {
            let row = &rows[i];
            let ends = [(row.a, row.arm_a, -1.0), (row.b, row.arm_b, 1.0)];
            let numbers = ends.map(|(body, ..)| number[body as usize]);
            if numbers.iter().all(|number| *number != STILL) {
                let least = numbers[0].min(numbers[1]);
                numbers.iter().for_each(|number| first[*number] = first[*number].min(least));
            }
            let jacobian = [0, 1].map(|axis| {
                let direction = row.frame.column(axis);
                ends.map(|(body, arm, sign)| {
                    let body = &bodies[body as usize];
                    let lever = D::torque(arm, direction).dot(turn);
                    let inertia = body.inverse_inertia.apply(turn).dot(turn);
                    [
                        sign * direction[0] * body.inverse_mass[0].sqrt(),
                        sign * direction[1] * body.inverse_mass[1].sqrt(),
                        sign * lever * inertia.sqrt(),
                    ]
                })
            });
            let own = problem.coupling.own(i);
            let stiffness = [0, 1].map(|axis| STIFFNESS / own.column(axis)[axis]);
            if !stiffness.iter().all(|stiffness| stiffness.is_finite()) {
                return None;
            }
            island.push(Contact {
                bodies: numbers,
                rows: jacobian,
                stiffness,
                q: [problem.q[i][0], problem.q[i][1]],
                impulse: [problem.impulses[i][0], problem.impulses[i][1]],
                held: problem.held[i],
                bound: 0.0,
            });
        }
        let v = vec![0.0; FREEDOMS * count];
        Some(Self { contacts: island, v, first, skyline: Skyline::default(), factored: Vec::new() })
    }

    /// Finds the v of the present impulses; returns the steps, or `None` if they do not lead to it.
    fn minimise(&mut self) -> Option<usize> {
        // The impulses so far are a good guess of those to come.
        self.v.fill(0.0);
        for contact in &self.contacts {
            contact.add(contact.impulse, &mut self.v);
        }
        for step in 1..=STEPS {
            let wishes: Vec<[f64; 2]> = self.contacts.iter().map(|contact| contact.wish(&self.v)).collect();
            let mut change: Vec<f64> = self.v.iter().map(|v| -v).collect();
            for (contact, wish) in self.contacts.iter().zip(&wishes) {
                contact.add(contact.push(*wish), &mut change);
            }
            let yielding = |(contact, wish): (&Contact, &[f64; 2])| contact.yielding(*wish);
            let yielding: Vec<Yielding> = self.contacts.iter().zip(&wishes).map(yielding).collect();
            if yielding != self.factored {
                self.factor(yielding);
            }
            self.skyline.solve(0, &mut change);
            let part = self.lowest(&wishes, &change);
            self.v.iter_mut().zip(&change).for_each(|(v, change)| *v += part * change);
            let is_known = |(contact, known): (&Contact, &Yielding)| contact.yielding(contact.wish(&self.v)) == *known;
            if part == 1.0 && self.contacts.iter().zip(&self.factored).all(is_known) {
                return Some(step);
            }
        }
        None
    }

    /// The part of a step, at most all of it, that leads to the lowest point: where the slope along it, which only rises, is zero.
    fn lowest(&self, wishes: &[[f64; 2]], change: &[f64]) -> f64 {
        let rates: Vec<[f64; 2]> = self.contacts.iter().map(|contact| contact.rate(change)).collect();
        let own: f64 = self.v.iter().zip(change).map(|(v, change)| v * change).sum();
        let bend: f64 = change.iter().map(|change| change * change).sum();
        let slope = |part: f64| {
            let contacts = self.contacts.iter().zip(wishes).zip(&rates).map(|((contact, wish), rate)| {
                let push = contact.push([0, 1].map(|k| wish[k] - part * contact.stiffness[k] * rate[k]));
                push[0] * rate[0] + push[1] * rate[1]
            });
            own + part * bend - contacts.sum::<f64>()
        };
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (slope(low), slope(high));
        // A slope that is rounding is none.
        if at_high <= 1e-9 * at_low.abs() {
            return 1.0;
        }
        for _ in 0..LINE_SEARCH {
            // Secants, and halves where these stick to one end.
            let secant = low + (high - low) * at_low / (at_low - at_high);
            let tried = if secant - low < 0.1 * (high - low) { low + 0.1 * (high - low) } else { secant };
            let tried = tried.min(high - 0.1 * (high - low));
            let there = slope(tried);
            if there < 0.0 { (low, at_low) = (tried, there) } else { (high, at_high) = (tried, there) }
        }
        0.5 * (low + high)
    }

    /// Factors 1 + Jᵀ ρ J of the rows that yield.
    fn factor(&mut self, yielding: Vec<Yielding>) {
        let size = self.v.len();
        let start = |row: usize| FREEDOMS * self.first[row / FREEDOMS];
        let mut places = Vec::with_capacity(size);
        let mut total = 0;
        for row in 0..size {
            places.push(total);
            total += row + 1 - start(row);
        }
        let mut entries = vec![0.0; total];
        for (contact, yielding) in self.contacts.iter().zip(&yielding) {
            for axis in (0..2).filter(|axis| yielding[*axis]) {
                for (body, row) in contact.bodies.iter().zip(&contact.rows[axis]).filter(|(body, _)| **body != STILL) {
                    for (other, column) in
                        contact.bodies.iter().zip(&contact.rows[axis]).filter(|(other, _)| *other <= body)
                    {
                        for (k, value) in row.iter().enumerate() {
                            let at = FREEDOMS * body + k;
                            let upto = if other == body { k + 1 } else { FREEDOMS };
                            for (l, column) in column[..upto].iter().enumerate() {
                                let place = places[at] + FREEDOMS * other + l - start(at);
                                entries[place] += contact.stiffness[axis] * value * column;
                            }
                        }
                    }
                }
            }
        }
        self.skyline.clear();
        for (row, place) in places.iter().enumerate() {
            let first = start(row);
            self.skyline.push_row(first, 1.0 + entries[place + row - first]);
            (first..row).for_each(|column| self.skyline.set(column, entries[place + column - first]));
        }
        self.skyline.factor();
        self.factored = yielding;
    }
}

/// Numbers the bodies that can move and have a contact so that neighbours have near numbers: breadth first, from a body with few neighbours.
fn numbering<D: Dim>(pairs: impl Iterator<Item = [u32; 2]>, bodies: &[SolverBody<D>]) -> Vec<usize> {
    let moves = |body: u32| crate::island::can_move(&bodies[body as usize]);
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); bodies.len()];
    let mut touched = Vec::new();
    for [a, b] in pairs {
        touched.extend([a, b].into_iter().filter(|body| moves(*body)));
        if moves(a) && moves(b) {
            neighbours[a as usize].push(b);
            neighbours[b as usize].push(a);
        }
    }
    touched.sort_unstable();
    touched.dedup();
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    let degree = |body: &u32| (neighbours[*body as usize].len(), *body);
    let mut number = vec![STILL; bodies.len()];
    let mut queue: Vec<u32> = Vec::with_capacity(touched.len());
    touched.sort_by_key(degree);
    for start in touched {
        if number[start as usize] != STILL {
            continue;
        }
        number[start as usize] = queue.len();
        let mut next = queue.len();
        queue.push(start);
        while let Some(body) = queue.get(next).copied() {
            next += 1;
            let mut new: Vec<u32> =
                neighbours[body as usize].iter().copied().filter(|body| number[*body as usize] == STILL).collect();
            new.sort_by_key(degree);
            for body in new {
                number[body as usize] = queue.len();
                queue.push(body);
            }
        }
    }
    number
}
