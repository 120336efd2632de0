//! Resting contact: forces at all touching points at once, from conditions on accelerations (L7, L8; Baraff 1989, 1994; Baraff and
//! Witkin, part D).
//!
//! Idea: a point at rest pushes just as hard as it takes for its gap not to close, and not at all where the gap opens by itself. With A
//! = J P Jᵀ (P the [response](crate::joint::JointBlock::response) of bodies whose joints hold) and b all that does not depend on the
//! forces f of the points ([`Gap::drift`], and given accelerations, joints held),
//!
//! ```text
//! d̈ = (A f + b)_n,   0 ≤ f_n ⟂ d̈ ≥ 0
//! at rest:   a_t = 0,                        |f_t| ≤ μ_s f_n
//! breaks:    f_t = −μ_k f_n a_t/|a_t|        where μ_s does not hold it
//! sliding:   f_t = −μ_k f_n v_t/|v_t|
//! ```
//!
//! A sliding point has only f_n as unknown, and its column of A becomes A (n − μ_k v_t/|v_t|), which is not symmetric.
//!
//! **Break-away.** Points at rest are solved with μ_s. One that accelerates all the same slides from now on: the island is solved again
//! with μ_k against the acceleration it had.
//!
//! **None, one, several.** With friction there may be no solution, or more than one (Painlevé 1895). Both need a matrix that is no
//! P-matrix: with all principal minors of the normal rows positive (friction of sliding points in their columns) a problem of sliding
//! points has just one solution for every b (Cottle, Pang, Stone 1992, theorem 3.3.7). An island of up to four points with a minor that
//! is not positive is therefore enumerated: every choice of which points push, stick or break. No solution is
//! [`RestingStatus::NoSolution`]; several with different accelerations are [`RestingStatus::NotUnique`], of which the smallest f is
//! taken (0 where allowed). In larger islands only the diagonal is looked at, and a solver that ends on a ray counts as no solution.
//!
//! **Indeterminate.** Where statics leaves the shares open but not the accelerations, the forces of least norm are taken.
//!
//! **Discs.** In space friction at rest is bounded by a disc, which no linear problem has: an island with resting points is solved by Newton's method on
//! the discs (Alart and Curnier 1991), with the friction of sliding points in their columns. Where that fails within its steps, and in an island of which
//! more than one outcome was found, each of the two tangents of the frame has a bound of its own.
//!
//! Good at: contact forces as such, exact rest, exact sliding. Bad at: impacts (it has none), Painlevé's configurations, large piles.
//! Choose it to see forces, and for few contacts.

mod gap;
mod island;

pub use gap::{Gap, NormalCarrier};

use tumble_math::{Dim, Linear, Vector};

use self::island::{Friction, Point};
use crate::contact::tangential;
use crate::coupling::Coupling;
use crate::island::Islands;
use crate::joint::Joints;
use crate::{ContactRow, Slip, SolverBody};

/// Acceleration of a body by everything but contacts and joints, in world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acceleration<D: Dim> {
    /// Of the centre of mass [m/s²].
    pub linear: D::Vector,
    /// Of the rate of turn [rad/s²].
    pub angular: D::Angular,
}

/// What counts as sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestingSettings {
    /// A point that slips faster than this slides, with μ_k [m/s]. Default 1e-9.
    pub sliding_above: f64,
    /// Error in an acceleration that is let pass, for accelerations of 1 m/s² and less; for larger ones in proportion [m/s²]. Default
    /// 1e-10.
    pub tolerance: f64,
    /// Islands of more contacts are left to impulses, since the cost grows with the cube [1]. Default 100.
    pub largest_island: usize,
}

impl Default for RestingSettings {
    fn default() -> Self {
        Self { sliding_above: 1e-9, tolerance: 1e-10, largest_island: 100 }
    }
}

/// Whether there are forces that satisfy all conditions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum RestingStatus {
    /// Yes, and accelerations are unique as far as was looked.
    #[default]
    Solved,
    /// Yes, with more than one outcome; the smallest forces were taken.
    NotUnique,
    /// No: only an impulse can resolve the island. Its forces are zero.
    NoSolution,
}

/// Outcome of a resting problem.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RestingReport {
    /// Worst of all islands.
    pub status: RestingStatus,
    /// Islands that were looked at.
    pub islands: u32,
    /// Those with more than one outcome.
    pub not_unique: u32,
    /// Those without a solution.
    pub no_solution: u32,
    /// Those with more contacts than [`RestingSettings::largest_island`], which were left without forces.
    pub too_large: u32,
    /// Pivots.
    pub iterations: u32,
    /// Error that is left in the islands that were solved: largest natural map, with forces times A_ii [m/s²].
    pub residual: f64,
    /// Points that push and stick.
    pub sticking: u32,
    /// Points that push and slide.
    pub sliding: u32,
}

/// The model, with its scratch space.
#[derive(Clone, Debug, Default)]
pub struct RestingLcp<D: Dim> {
    coupling: Coupling<D>,
    islands: Islands,
    /// Bodies with accelerations in place of velocities.
    accelerated: Vec<SolverBody<D>>,
    /// b [m/s²].
    free: Vec<D::Vector>,
    unsolved: Vec<u32>,
    joint_forces: Vec<f64>,
}

impl<D: Dim> RestingLcp<D> {
    /// Finds the force at each point, in its contact frame, on b [N], and adds what contacts and joints do to `accelerations`.
    ///
    /// `rows` are the points at rest: touching, with no speed along the normal; their `slip` is updated. `gaps` say how their normals
    /// turn. Forces of the step before, if they are as many, are the first guess. Joints must have been stopped, with the drift of the
    /// present velocities in their rows.
    pub fn solve(
        &mut self,
        bodies: &[SolverBody<D>],
        accelerations: &mut [Acceleration<D>],
        rows: &mut [ContactRow<D>],
        gaps: &[Gap<D>],
        forces: &mut Vec<D::Vector>,
        mut joints: Option<Joints<'_, D>>,
        settings: &RestingSettings,
    ) -> RestingReport {
        self.begin(bodies, accelerations, rows, gaps, &mut joints);
        if forces.len() != rows.len() || forces.iter().any(|force| !force.is_finite()) {
            forces.clear();
        }
        forces.resize(rows.len(), D::Vector::ZERO);
        self.unsolved.clear();
        let mut report = RestingReport::default();
        let mut contacts: Vec<u32> = Vec::new();
        for number in 0..self.islands.len() {
            contacts.clear();
            contacts.extend(self.islands.links(number).iter().filter(|i| (**i as usize) < rows.len()));
            if contacts.is_empty() {
                continue;
            }
            if contacts.len() > settings.largest_island {
                report.islands += 1;
                report.too_large += 1;
                self.unsolved.extend(&contacts);
                continue;
            }
            let points = contacts.iter().map(|i| self.point(&rows[*i as usize], bodies, *i, settings)).collect();
            let guess: Vec<D::Vector> = contacts.iter().map(|i| forces[*i as usize]).collect();
            let solved = island::solve::<D>(&self.coupling.dense(&contacts), points, &guess, settings.tolerance);
            report.islands += 1;
            report.iterations += solved.iterations as u32;
            report.residual = report.residual.max(solved.residual);
            report.status = report.status.max(solved.status);
            match solved.status {
                RestingStatus::Solved => {}
                RestingStatus::NotUnique => report.not_unique += 1,
                RestingStatus::NoSolution => {
                    report.no_solution += 1;
                    self.unsolved.extend(&contacts);
                }
            }
            for (i, (force, slip)) in contacts.iter().zip(solved.forces) {
                let i = *i as usize;
                (forces[i], rows[i].slip) = (force, slip);
                if force[0] > 0.0 {
                    *(if slip == Slip::Sliding { &mut report.sliding } else { &mut report.sticking }) += 1;
                }
            }
        }
        self.islands.idle().iter().filter(|i| (**i as usize) < rows.len()).for_each(|i| {
            forces[*i as usize] = D::Vector::ZERO;
        });
        self.end(accelerations, rows, forces, &mut joints);
        report
    }

    /// Rows of islands without a solution in the last solve.
    pub fn unsolved(&self) -> &[u32] {
        &self.unsolved
    }

    /// Force of each joint row in the last solve [N] or [N·m].
    pub fn joint_forces(&self) -> &[f64] {
        &self.joint_forces
    }

    /// Reads accelerations with joints held, W, islands and b.
    fn begin(
        &mut self,
        bodies: &[SolverBody<D>],
        accelerations: &[Acceleration<D>],
        rows: &[ContactRow<D>],
        gaps: &[Gap<D>],
        joints: &mut Option<Joints<'_, D>>,
    ) {
        self.accelerated.clear();
        self.accelerated.extend(bodies.iter().zip(accelerations).map(|(body, acceleration)| SolverBody {
            velocity: acceleration.linear,
            angular_velocity: acceleration.angular,
            ..*body
        }));
        self.joint_forces.clear();
        let contacts = rows.iter().map(|row| [row.a, row.b]);
        match joints {
            Some(joints) => {
                self.joint_forces.resize(joints.rows.len(), 0.0);
                joints.block.accelerate(&mut self.accelerated, joints.rows, &mut self.joint_forces);
                let joints = joints.rows.iter().map(|row| [row.a, row.b]);
                self.islands.find(bodies, contacts.chain(joints));
            }
            None => self.islands.find(bodies, contacts),
        }
        self.coupling.build(bodies, rows, joints);
        self.free.clear();
        let free =
            |(row, gap): (&ContactRow<D>, &Gap<D>)| row.relative_velocity(&self.accelerated) + gap.drift(row, bodies);
        self.free.extend(rows.iter().zip(gaps).map(free));
    }

    /// What an island needs to know of a point.
    fn point(
        &self,
        row: &ContactRow<D>,
        bodies: &[SolverBody<D>],
        index: u32,
        settings: &RestingSettings,
    ) -> Point<D::Vector> {
        let slip = tangential(row.relative_velocity(bodies));
        let friction = match slip.try_normalize() {
            Some(direction) if slip.length() > settings.sliding_above => {
                Friction::Sliding(direction * -row.surface.kinetic_friction)
            }
            _ if row.surface.static_friction > 0.0 => Friction::Resting,
            _ => Friction::Sliding(D::Vector::ZERO),
        };
        Point { free: self.free[index as usize], friction, surface: row.surface }
    }

    /// Lets contacts and joints act.
    fn end(
        &mut self,
        accelerations: &mut [Acceleration<D>],
        rows: &[ContactRow<D>],
        forces: &[D::Vector],
        joints: &mut Option<Joints<'_, D>>,
    ) {
        for (row, force) in rows.iter().zip(forces) {
            row.apply(&mut self.accelerated, *force);
        }
        if let Some(joints) = joints {
            joints.block.accelerate(&mut self.accelerated, joints.rows, &mut self.joint_forces);
        }
        for (acceleration, body) in accelerations.iter_mut().zip(&self.accelerated) {
            *acceleration = Acceleration { linear: body.velocity, angular: body.angular_velocity };
        }
    }
}
