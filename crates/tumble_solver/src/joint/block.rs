//! All joints of a scene as one block: the smallest impulses that stop what joints forbid.
//!
//! ```text
//! J M⁻¹ Jᵀ λ = c − J v,     v += M⁻¹ Jᵀ λ                 c: speeds asked for, 0 to stop
//! ```
//!
//! Of all changes of velocity that reach c this is the one with the least kinetic energy (Gauss' principle of least constraint). The
//! matrix is factored once per [`prepare`](JointBlock::prepare), island by island, within its envelope; each solve is repeated once on what
//! rounding left.
//!
//! Rows that follow from others (a loop with more joints than it needs) are left out by rank and counted. If such a row wants something
//! else than those that it follows from, no motion can satisfy both; [`JointReport::unreachable`] says by how much. A row between
//! bodies that cannot move is left out the same way.

use tumble_math::{Dim, Linear, Matrix, Vector};

use super::JointRow;
use crate::island::{Islands, can_move};
use crate::skyline::Skyline;
use crate::{ContactRow, SolverBody};

/// The factored joints of a scene.
#[derive(Clone, Debug, Default)]
pub struct JointBlock<D: Dim> {
    islands: Islands,
    /// Row of each place in the factors; islands one after the other.
    places: Vec<u32>,
    /// Where each island begins in `places`; one more at the end.
    starts: Vec<u32>,
    factors: Skyline,
    redundant: u32,
    /// Bodies of each island that can move, in rising order.
    members: Vec<u32>,
    member_starts: Vec<u32>,
    /// Bodies at rest with the masses of [`JointBlock::prepare`].
    at_rest: Vec<SolverBody<D>>,
    /// Bodies of `at_rest` that move at present.
    stirred: Vec<u32>,
    impulses: Vec<f64>,
}

/// What joints could do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReport {
    /// Rows that follow from others and were left out.
    pub redundant: u32,
    /// Largest error in the speed of a row that was solved [m/s] or [rad/s].
    pub residual: f64,
    /// Largest error in the speed of a row that was left out: contradictory joints when clearly above the residual [m/s] or [rad/s].
    pub unreachable: f64,
    /// The row that has it.
    pub unreachable_row: Option<u32>,
}

impl<D: Dim> JointBlock<D> {
    /// Factors J M⁻¹ Jᵀ of these rows.
    pub fn prepare(&mut self, bodies: &[SolverBody<D>], rows: &[JointRow<D>]) {
        self.islands.find(bodies, rows.iter().map(|row| [row.a, row.b]));
        self.factors.clear();
        self.places.clear();
        self.starts.clear();
        self.members.clear();
        self.member_starts.clear();
        self.starts.push(0);
        self.member_starts.push(0);
        // Places of the rows at each body, so that a row meets only those that it shares a body with.
        let mut at_body: Vec<Vec<u32>> = vec![Vec::new(); if rows.is_empty() { 0 } else { bodies.len() }];
        for island in 0..self.islands.len() {
            let first_member = self.members.len();
            for &i in self.islands.links(island) {
                let row = &rows[i as usize];
                let place = self.places.len();
                let ends = [row.a, row.b];
                let movable = ends.iter().filter(|body| can_move(&bodies[**body as usize]));
                let partners = movable.clone().flat_map(|body| at_body[*body as usize].iter().copied());
                let first = partners.clone().min().map_or(place, |first| first as usize);
                self.factors.push_row(first, row.coupling(row, bodies));
                for partner in partners {
                    let other = &rows[self.places[partner as usize] as usize];
                    self.factors.set(partner as usize, row.coupling(other, bodies));
                }
                self.places.push(i);
                for &body in movable {
                    if at_body[body as usize].is_empty() {
                        self.members.push(body);
                    }
                    if at_body[body as usize].last() != Some(&(place as u32)) {
                        at_body[body as usize].push(place as u32);
                    }
                }
            }
            self.members[first_member..].sort_unstable();
            self.member_starts.push(self.members.len() as u32);
            self.starts.push(self.places.len() as u32);
        }
        self.redundant = (self.factors.factor() + self.islands.idle().len()) as u32;
        self.at_rest.clear();
        self.stirred.clear();
        if !rows.is_empty() {
            let still = |body: &SolverBody<D>| SolverBody {
                velocity: D::Vector::ZERO,
                angular_velocity: D::Angular::ZERO,
                ..*body
            };
            self.at_rest.extend(bodies.iter().map(still));
        }
    }

    /// Whether there are no joints that anything could be done about.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Makes J v = 0 and adds the impulses to the rows.
    pub fn stop(&mut self, bodies: &mut [SolverBody<D>], rows: &mut [JointRow<D>]) -> JointReport {
        for island in 0..self.islands.len() {
            self.drive(island, bodies, rows, |_| 0.0);
            self.count(island, rows);
        }
        self.report(bodies, rows, |_| 0.0)
    }

    /// Makes J v = 0 for the joints that hang together with either of two bodies, and adds the impulses to the rows.
    pub fn stop_near(&mut self, ends: [u32; 2], bodies: &mut [SolverBody<D>], rows: &mut [JointRow<D>]) {
        for island in self.near(ends).into_iter().flatten() {
            self.drive(island, bodies, rows, |_| 0.0);
            self.count(island, rows);
        }
    }

    /// Makes J Δx = −C: `displacements` carry displacements [m] and turns [rad] in place of velocities.
    pub fn correct(&mut self, displacements: &mut [SolverBody<D>], rows: &[JointRow<D>]) -> JointReport {
        self.reach(displacements, rows, |row| -row.error)
    }

    /// Makes J a = −J̇ v: `accelerations` carry accelerations in place of velocities. Adds the forces [N] to `forces`, one per row.
    pub fn accelerate(
        &mut self,
        accelerations: &mut [SolverBody<D>],
        rows: &[JointRow<D>],
        forces: &mut [f64],
    ) -> JointReport {
        for island in 0..self.islands.len() {
            self.drive(island, accelerations, rows, |row| -row.drift);
            for place in self.range(island) {
                forces[self.places[place] as usize] += self.impulses[place];
            }
        }
        self.report(accelerations, rows, |row| -row.drift)
    }

    /// Makes J v = c for a speed c per row, without counting the impulses.
    pub fn reach(
        &mut self,
        bodies: &mut [SolverBody<D>],
        rows: &[JointRow<D>],
        target: impl Fn(&JointRow<D>) -> f64,
    ) -> JointReport {
        for island in 0..self.islands.len() {
            self.drive(island, bodies, rows, &target);
        }
        self.report(bodies, rows, target)
    }

    /// Makes J v = c for a speed c per row, and adds the impulses to the rows.
    pub fn drive_to(&mut self, bodies: &mut [SolverBody<D>], rows: &mut [JointRow<D>], speeds: &[f64]) {
        // The speeds ride in a copy of the rows, where those that leave `drive` cannot be mistaken for errors.
        let asked: Vec<JointRow<D>> =
            rows.iter().zip(speeds).map(|(row, speed)| JointRow { error: *speed, ..*row }).collect();
        for island in 0..self.islands.len() {
            self.drive(island, bodies, &asked, |row| row.error);
            self.count(island, rows);
        }
    }

    /// Velocities that an impulse of a contact frame gives to bodies at rest whose joints hold: P Jᵀ λ with
    /// P = M⁻¹ − M⁻¹ Jᵀ (J M⁻¹ Jᵀ)⁻¹ J M⁻¹ over the joints.
    ///
    /// Only the bodies of [`JointBlock::reached_by`] move.
    pub fn response(&mut self, rows: &[JointRow<D>], contact: &ContactRow<D>, impulse: D::Vector) -> &[SolverBody<D>] {
        let mut at_rest = std::mem::take(&mut self.at_rest);
        for body in self.stirred.drain(..) {
            let body = &mut at_rest[body as usize];
            (body.velocity, body.angular_velocity) = (D::Vector::ZERO, D::Angular::ZERO);
        }
        let ends = [contact.a, contact.b];
        contact.apply(&mut at_rest, impulse);
        for island in self.near(ends).into_iter().flatten() {
            self.drive(island, &mut at_rest, rows, |_| 0.0);
        }
        let mut stirred = std::mem::take(&mut self.stirred);
        stirred.extend(self.reached_by(ends));
        self.stirred = stirred;
        self.at_rest = at_rest;
        &self.at_rest
    }

    /// K of a contact with the joints held: relative velocity per impulse, in the contact frame [1/kg].
    pub fn compliance(&mut self, rows: &[JointRow<D>], contact: &ContactRow<D>) -> D::Matrix {
        let mut columns = [D::Vector::ZERO; 3];
        for (axis, column) in columns.iter_mut().enumerate().take(D::Vector::AXES) {
            *column = contact.relative_velocity(self.response(rows, contact, D::Vector::unit(axis)));
        }
        D::Matrix::from_columns(|axis| columns[axis])
    }

    /// Bodies that can feel an impulse on these two: themselves, and those in joint islands with them. A body may come twice.
    pub fn reached_by(&self, ends: [u32; 2]) -> impl Iterator<Item = u32> {
        let of_island =
            |island: usize| &self.members[self.member_starts[island] as usize..self.member_starts[island + 1] as usize];
        self.near(ends).into_iter().flatten().flat_map(of_island).copied().chain(ends)
    }

    /// The islands of two bodies, each once.
    fn near(&self, [a, b]: [u32; 2]) -> [Option<usize>; 2] {
        if self.is_empty() {
            return [None; 2];
        }
        let (a, b) = (self.islands.of_body(a), self.islands.of_body(b));
        [a, b.filter(|_| a != b)]
    }

    /// Places of an island's rows.
    fn range(&self, island: usize) -> std::ops::Range<usize> {
        self.starts[island] as usize..self.starts[island + 1] as usize
    }

    /// Solves one island and applies the impulses; they are left in `self.impulses`.
    fn drive(
        &mut self,
        island: usize,
        bodies: &mut [SolverBody<D>],
        rows: &[JointRow<D>],
        target: impl Fn(&JointRow<D>) -> f64,
    ) {
        let range = self.range(island);
        self.impulses.resize(self.places.len(), 0.0);
        self.impulses[range.clone()].fill(0.0);
        let mut change = vec![0.0; range.len()];
        // The second round takes out what rounding left of the first.
        for _ in 0..2 {
            for (place, right) in range.clone().zip(change.iter_mut()) {
                let row = &rows[self.places[place] as usize];
                *right = target(row) - row.speed(bodies);
            }
            self.factors.solve(range.start, &mut change);
            for (place, impulse) in range.clone().zip(&change) {
                if *impulse != 0.0 {
                    rows[self.places[place] as usize].apply(bodies, *impulse);
                    self.impulses[place] += impulse;
                }
            }
        }
    }

    /// Adds the impulses of the last solve of an island to its rows.
    fn count(&self, island: usize, rows: &mut [JointRow<D>]) {
        for place in self.range(island) {
            rows[self.places[place] as usize].impulse += self.impulses[place];
        }
    }

    fn report(
        &self,
        bodies: &[SolverBody<D>],
        rows: &[JointRow<D>],
        target: impl Fn(&JointRow<D>) -> f64,
    ) -> JointReport {
        let mut report = JointReport { redundant: self.redundant, ..JointReport::default() };
        let left_out = |place: usize| self.factors.is_left_out(place);
        let placed = self.places.iter().enumerate().map(|(place, row)| (*row, left_out(place)));
        for (i, left_out) in placed.chain(self.islands.idle().iter().map(|row| (*row, true))) {
            let row = &rows[i as usize];
            let error = (target(row) - row.speed(bodies)).abs();
            if !left_out {
                report.residual = report.residual.max(error);
            } else if error > report.unreachable {
                (report.unreachable, report.unreachable_row) = (error, Some(i));
            }
        }
        report
    }
}
