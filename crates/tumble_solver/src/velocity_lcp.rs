//! Velocity complementarity: all contacts at once, resting and colliding, with exact friction (L9).
//!
//! Idea: a contact at which the bodies approach gets an impulse; one at which they part gets none; which is which is decided for all
//! contacts together. With W = J P Jᵀ (P the [response](crate::joint::JointBlock::response) of bodies whose joints hold, M⁻¹ without
//! joints) and u = W λ + q the velocities after the impulses λ, in contact frames,
//!
//! ```text
//! 0 ≤ λ_n ⟂ u_n ≥ 0
//! sticking:  u_t = 0,                  |λ_t| ≤ μ_s λ_n
//! sliding:   λ_t = −μ_k λ_n u_t/|u_t|
//! ```
//!
//! **Filter.** [`VelocityLcp::filter`]: q is the velocity after v += a Δt, plus the speed at which a small gap may close. Nothing is
//! given back.
//!
//! **Impact, Newton's law.** [`VelocityLcp::impact`] with [`Restitution::Newton`]: q_n is lowered by the rebound speed ε v_n⁻, so that
//! u_n ≥ −ε v_n⁻ (Moreau 1988). With friction this can create energy (Kane's paradox): θ = 45°, v = (½, −1), μ = ε = 1 gains 0.109375 J.
//!
//! **Impact, Poisson's law**, the default, in two phases (Glocker and Pfeiffer 1995; Anitescu and Potra 1997). *Compression* solves with
//! ε = 0: λᶜ, u_c = W λᶜ + q. *Expansion* adds an impulse r whose normal part is at least ε λᶜ_n, friction within its cone:
//!
//! ```text
//! u⁺ = u_c + W r,    ε λᶜ_n ≤ r_n ⟂ u_n⁺ ≥ 0,    |r_t| ≤ μ r_n against u_t⁺
//! ```
//!
//! **Energy never grows** under Poisson's law. Compression changes it by
//!
//! ```text
//! ΔE_c = ½ (q + u_c) · λᶜ = u_c · λᶜ − ½ λᶜ · W λᶜ ≤ 0     since u_n λ_n = 0 and u_t · λ_t = −μ λ_n |u_t| ≤ 0
//! ```
//!
//! and expansion by ΔE_e = u_c · r + ½ r · W r. Without friction their sum is never positive, whatever the ε of the contacts: u_c · λᶜ =
//! u_c · r = 0, and
//!
//! ```text
//! (λᶜ − r) · W r ≥ 0        since W r ≥ 0 where λᶜ > 0, and r > ε λᶜ only where u_n⁺ = 0
//! r · W r ≤ λᶜ · W r ≤ √(λᶜ · W λᶜ) √(r · W r),   so   r · W r ≤ λᶜ · W λᶜ = −2 ΔE_c
//! ```
//!
//! With friction in several contacts the sum may be positive, rarely and for strong friction. Then r is scaled by the largest θ ∈ [0, 1]
//! for which ΔE_c + θ u_c · r + ½ θ² r · W r ≤ 0: cones and u_n ≥ 0 are convex, so every θ r keeps them, and θ = 0 always qualifies. The
//! report says so.
//!
//! Islands are solved apart. Pivoting and Newton's method give impulses to rounding, so that what sticks does not creep. Where statics
//! leaves the shares open (a table on more legs than it needs), the impulses of least norm are taken, in islands of up to 24 contacts;
//! beyond, they follow from the first guess.
//!
//! Good at: simultaneous impacts, rest, exactness. Bad at: thousands of contacts in one pile. Choose it for correct answers to coupled
//! contacts.

mod bodywise;
mod pivot;
mod problem;
mod solve;
mod sweep;

use tumble_math::{Dim, Linear};

pub(crate) use self::pivot::pivots_before_giving_up;
use self::problem::Problem;
use crate::island::Islands;
use crate::joint::Joints;
use crate::{ContactRow, Ending, Slip, SolverBody};

/// How an island is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VelocitySolver {
    /// By pivoting for few contacts, Newton's method for more, and sweeps for many; the next where one fails.
    #[default]
    Auto,
    /// By pivoting, exact to rounding; in the plane. Where that fails, Newton's method, then sweeps.
    Pivoting,
    /// By sweeps over the contacts, each solved exactly.
    BlockGaussSeidel,
    /// By Newton's method on the friction cones, then sweeps. An expansion phase goes to sweeps at once.
    Newton,
}

/// Which law gives back speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Restitution {
    /// ε is a ratio of impulses. Energy never grows.
    #[default]
    Poisson,
    /// ε is a ratio of speeds. With friction, energy can grow.
    Newton,
}

/// How velocity problems are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocitySettings {
    /// Default: [`VelocitySolver::Auto`].
    pub solver: VelocitySolver,
    /// Default: [`Restitution::Poisson`].
    pub restitution: Restitution,
    /// Error in a speed that is let pass, for speeds of 1 m/s and less; for faster ones in proportion [m/s]. Default 1e-12, well above
    /// rounding.
    pub tolerance: f64,
    /// Most sweeps over an island [1]. Default 500; a warm start needs a few.
    pub sweeps: u32,
    /// Islands none of whose contacts approaches faster than this have no impact [m/s]. Default 0.
    pub colliding_above: f64,
}

impl Default for VelocitySettings {
    fn default() -> Self {
        Self {
            solver: VelocitySolver::default(),
            restitution: Restitution::default(),
            tolerance: 1e-12,
            sweeps: 500,
            colliding_above: 0.0,
        }
    }
}

/// What one contact gives back in an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// ε of Poisson's law: the part of the compression impulse that comes again [1].
    pub restitution: f64,
    /// How many times the material's own ε that is; more than 1 where the approach speed at hand is less than the one that the surface met, which
    /// then is no creation of energy [1]. Default 1.
    pub reading: f64,
    /// Separating speed of Newton's law, ε times the approach speed that counts [m/s].
    pub speed: f64,
}

impl Default for Rebound {
    fn default() -> Self {
        Self { restitution: 0.0, reading: 1.0, speed: 0.0 }
    }
}

/// Work, remaining error and outcome of a velocity problem.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityReport {
    /// Islands that were solved.
    pub islands: u32,
    /// Those whose first guess was the answer.
    pub known: u32,
    /// Those solved by pivoting, or in closed form.
    pub pivoted: u32,
    /// Those solved by sweeps.
    pub swept: u32,
    /// Those solved by Newton's method.
    pub newton: u32,
    /// Those where the method that was asked for failed and another took over.
    pub fell_back: u32,
    /// Pivots, sweeps and Newton steps.
    pub iterations: u32,
    /// Error that is left: largest natural map, with impulses times W_ii [m/s].
    pub residual: f64,
    /// Whether that is within the tolerance everywhere.
    pub ending: Ending,
    /// Contacts that push and stick.
    pub sticking: u32,
    /// Contacts that push and slide.
    pub sliding: u32,
    /// Part of the expansion impulse that could be given without creating energy, smallest over the islands; 1 unless Poisson's law was
    /// restrained [1].
    pub expansion: f64,
}

/// The model, with its scratch space, so that a steady step allocates little.
#[derive(Clone, Debug, Default)]
pub struct VelocityLcp<D: Dim> {
    problem: Problem<D>,
    islands: Islands,
    /// Contacts of the island at hand.
    contacts: Vec<u32>,
}

impl<D: Dim> VelocityLcp<D> {
    /// Filters the velocities of `bodies` through touching contacts and joints; `rows[i].impulse` and `slip` are updated.
    ///
    /// On entry `rows[i].impulse` is a first guess, which the velocities do not contain. Joint rows need none; theirs is set.
    pub fn filter(
        &mut self,
        bodies: &mut [SolverBody<D>],
        rows: &mut [ContactRow<D>],
        mut joints: Option<Joints<'_, D>>,
        settings: &VelocitySettings,
    ) -> VelocityReport {
        if let Some(joints) = &mut joints {
            joints.rows.iter_mut().for_each(|row| row.impulse = 0.0);
        }
        self.begin(bodies, rows, &mut joints);
        for (i, row) in rows.iter().enumerate() {
            self.problem.q[i][0] += row.allowance;
            self.problem.impulses[i] = row.impulse;
            self.problem.slip[i] = row.slip;
        }
        let mut report = VelocityReport { expansion: 1.0, ..VelocityReport::default() };
        for island in 0..self.islands.len() {
            if self.take(island, rows.len()) {
                let world = World { rows, bodies, are_held: joints.is_some() };
                solve::solve_in_two_stages(&mut self.problem, &self.contacts, &world, settings, &mut report);
            }
        }
        self.islands.idle().iter().filter(|i| (**i as usize) < rows.len()).for_each(|i| {
            self.problem.impulses[*i as usize] = D::Vector::ZERO;
        });
        for (i, row) in rows.iter_mut().enumerate() {
            row.impulse = self.problem.impulses[i];
            row.slip = self.problem.slip[i];
            row.apply(bodies, row.impulse);
        }
        if let Some(joints) = &mut joints {
            joints.block.stop(bodies, joints.rows);
        }
        report
    }

    /// Answers all impacts at once; `rows` are touching points, and `given[i]` is set to the impulse at point i, in its frame [N·s].
    ///
    /// Impulses of joint rows are added to. Of two islands, one that has a contact approaching faster than
    /// [`VelocitySettings::colliding_above`] is answered as a whole, its resting contacts too; the other is left alone.
    pub fn impact(
        &mut self,
        bodies: &mut [SolverBody<D>],
        rows: &[ContactRow<D>],
        rebounds: &[Rebound],
        given: &mut Vec<D::Vector>,
        mut joints: Option<Joints<'_, D>>,
        settings: &VelocitySettings,
    ) -> VelocityReport {
        self.begin(bodies, rows, &mut joints);
        given.clear();
        given.resize(rows.len(), D::Vector::ZERO);
        let mut report = VelocityReport { expansion: 1.0, ..VelocityReport::default() };
        for island in 0..self.islands.len() {
            let any = self.take(island, rows.len());
            let collides = |i: &u32| self.problem.q[*i as usize][0] < -settings.colliding_above;
            if !(any && self.contacts.iter().any(collides)) {
                continue;
            }
            match settings.restitution {
                Restitution::Newton => {
                    for i in self.contacts.iter().map(|i| *i as usize) {
                        self.problem.q[i][0] -= rebounds[i].speed;
                    }
                    let world = World { rows, bodies, are_held: joints.is_some() };
                    solve::solve_in_two_stages(&mut self.problem, &self.contacts, &world, settings, &mut report);
                    self.contacts.iter().map(|i| *i as usize).for_each(|i| given[i] = self.problem.impulses[i]);
                }
                Restitution::Poisson => {
                    let world = World { rows, bodies, are_held: joints.is_some() };
                    self.compress_and_expand(&world, rebounds, given, settings, &mut report);
                }
            }
        }
        for (row, impulse) in rows.iter().zip(given.iter()) {
            if *impulse != D::Vector::ZERO {
                row.apply(bodies, *impulse);
            }
        }
        if let Some(joints) = &mut joints {
            joints.block.stop(bodies, joints.rows);
        }
        report
    }

    /// Both phases of Poisson's law for the island at hand.
    fn compress_and_expand(
        &mut self,
        world: &World<'_, D>,
        rebounds: &[Rebound],
        given: &mut [D::Vector],
        settings: &VelocitySettings,
        report: &mut VelocityReport,
    ) {
        solve::solve_in_two_stages(&mut self.problem, &self.contacts, world, settings, report);
        let indices = || self.contacts.iter().map(|i| *i as usize);
        let problem = &mut self.problem;
        let compressed: Vec<D::Vector> = indices().map(|i| problem.velocity(i)).collect();
        let mut energy = 0.0;
        for (i, after) in indices().zip(&compressed) {
            energy += 0.5 * (problem.q[i] + *after).dot(problem.impulses[i]);
            given[i] = problem.impulses[i];
        }
        if indices().all(|i| rebounds[i].restitution * given[i][0] <= 0.0) {
            return;
        }
        for (i, after) in indices().zip(&compressed) {
            problem.q[i] = *after;
            problem.held[i] = rebounds[i].restitution * given[i][0];
            problem.impulses[i] = given[i] * rebounds[i].restitution;
        }
        // The islands and contacts were counted by the first phase.
        let mut second = VelocityReport::default();
        solve::solve_in_two_stages(problem, &self.contacts, world, settings, &mut second);
        report.iterations += second.iterations;
        report.residual = report.residual.max(second.residual);
        report.fell_back += second.fell_back;
        if second.ending == Ending::NotConverged {
            report.ending = Ending::NotConverged;
        }
        let (mut work, mut yielding) = (0.0, 0.0);
        for (i, before) in self.contacts.iter().map(|i| *i as usize).zip(&compressed) {
            work += before.dot(self.problem.impulses[i]);
            yielding += self.problem.coupling.velocity(i, &self.problem.impulses).dot(self.problem.impulses[i]);
        }
        let read = self.contacts.iter().map(|i| rebounds[*i as usize].reading).fold(1.0, f64::max);
        let part = largest_part(energy, work / read, yielding / (read * read));
        report.expansion = report.expansion.min(part);
        for i in self.contacts.iter().map(|i| *i as usize) {
            given[i] += self.problem.impulses[i] * part;
            self.problem.held[i] = 0.0;
        }
    }

    /// Stops the joints and reads velocities, W and islands.
    fn begin(&mut self, bodies: &mut [SolverBody<D>], rows: &[ContactRow<D>], joints: &mut Option<Joints<'_, D>>) {
        if let Some(joints) = joints {
            joints.block.stop(bodies, joints.rows);
        }
        self.problem.coupling.build(bodies, rows, joints);
        let contacts = rows.iter().map(|row| [row.a, row.b]);
        match joints {
            Some(joints) => {
                let joints = joints.rows.iter().map(|row| [row.a, row.b]);
                self.islands.find(bodies, contacts.chain(joints));
            }
            None => self.islands.find(bodies, contacts),
        }
        let problem = &mut self.problem;
        problem.q.clear();
        problem.q.extend(rows.iter().map(|row| row.relative_velocity(bodies)));
        problem.friction.clear();
        problem.friction.resize(rows.len(), 0.0);
        problem.held.clear();
        problem.held.resize(rows.len(), 0.0);
        problem.slip.clear();
        problem.slip.resize(rows.len(), Slip::Sticking);
        problem.impulses.clear();
        problem.impulses.resize(rows.len(), D::Vector::ZERO);
    }

    /// Takes the contacts of an island in hand; whether there are any.
    fn take(&mut self, island: usize, contacts: usize) -> bool {
        self.contacts.clear();
        self.contacts.extend(self.islands.links(island).iter().filter(|i| (**i as usize) < contacts));
        !self.contacts.is_empty()
    }
}

/// What a problem was made of.
struct World<'a, D: Dim> {
    rows: &'a [ContactRow<D>],
    bodies: &'a [SolverBody<D>],
    /// Whether joints hold bodies, so that these yield otherwise than alone.
    are_held: bool,
}

/// The largest θ ∈ [0, 1] with `energy` + θ `work` + ½ θ² `yielding` ≤ 0, where `energy` ≤ 0 ≤ `yielding`.
fn largest_part(energy: f64, work: f64, yielding: f64) -> f64 {
    // Rounding of the sum must not count as energy.
    if energy + work + 0.5 * yielding <= 1e-14 * (energy.abs() + work.abs() + yielding) {
        return 1.0;
    }
    let root = (work * work - 2.0 * yielding * energy).max(0.0).sqrt();
    // The form without cancellation.
    let part = if work > 0.0 { -2.0 * energy / (work + root) } else { (root - work) / yielding };
    part.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expansion_is_given_up_to_the_energy_there_was() {
        // Nothing to restrain, to the last bit of energy; then too much, with work of either sign.
        assert_eq!(largest_part(-2.0, 1.0, 2.0), 1.0);
        for (energy, work, yielding) in [(-2.0, 1.0, 5.0), (-1.0, -0.5, 4.0), (-1.0, 3.0, 0.0)] {
            let part = largest_part(energy, work, yielding);
            assert!(part > 0.0 && part < 1.0);
            assert!((energy + part * work + 0.5 * part * part * yielding).abs() < 1e-15);
        }
        assert_eq!(largest_part(0.0, 1.0, 1.0), 0.0);
    }
}
