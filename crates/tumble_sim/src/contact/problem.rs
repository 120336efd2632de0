//! Contacts and bodies as the slices that contact models work on, gathered from the world and scattered back.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Pose};
use tumble_solver::filter::PreparedRow;
use tumble_solver::resting_lcp::RestingReport;
use tumble_solver::velocity_lcp::VelocityReport;
use tumble_solver::{ContactRow, Ending, Report, SolverBody};

use super::found::{FoundPoints, Points};
use super::{ContactManifold, ContactMemory, ContactPair, Detection};
use crate::Settings;
use crate::body::{
    AngularVelocity, BodyIndex, InverseInertia, InverseMass, LinearVelocity, Orientation, Position, PreviousVelocity,
};
use crate::fault::{Fault, Quantity};
use crate::geometry::Geometry;
use crate::schedule::StepSystems;

/// What the contact solvers did in this step.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactReport {
    /// Work and remaining error; `None` where nothing was solved.
    pub solved: Option<Report>,
    /// Islands where the solver that was asked for failed and another took over.
    pub fell_back: u32,
    /// Islands without resting forces that satisfy all conditions (Painlevé): resolved by impulses.
    pub no_solution: u32,
    /// Islands with more than one outcome: the smallest forces were taken.
    pub not_unique: u32,
}

impl ContactReport {
    /// Adds the report of one solver: work adds up, the worst error stays.
    pub(crate) fn add(&mut self, report: Report) {
        let sum = self.solved.get_or_insert_with(Report::default);
        sum.iterations += report.iterations;
        sum.residual = sum.residual.max(report.residual);
        if report.ending == Ending::NotConverged {
            sum.ending = Ending::NotConverged;
        }
    }
}

impl ContactReport {
    /// Adds the report of a velocity problem.
    pub(crate) fn add_velocity(&mut self, report: &VelocityReport) {
        self.fell_back += report.fell_back;
        self.add(Report { iterations: report.iterations, residual: report.residual, ending: report.ending });
    }

    /// Adds the report of a resting problem, its error as the speed that it makes in a step.
    pub(crate) fn add_resting(&mut self, report: &RestingReport, dt: f64) {
        self.no_solution += report.no_solution;
        self.not_unique += report.not_unique;
        let residual = report.residual * dt;
        self.add(Report { iterations: report.iterations, residual, ending: Ending::Converged });
    }
}

/// Bodies by rank, and contact points in the order of their pairs.
#[derive(Resource, Debug)]
pub struct ContactProblem<D: Geometry> {
    /// Bodies, by rank; the world is the last.
    pub(crate) bodies: Vec<SolverBody<D>>,
    /// Touching points first, then those with a gap; in the order of pairs and features as gathered.
    pub(super) rows: Vec<ContactRow<D>>,
    /// Where each row comes from.
    pub(super) sources: Vec<RowSource>,
    /// How many rows, from the first, touch.
    pub(super) touching: usize,
    /// How many rows, from the first, the velocity filter is to hold.
    pub(super) resting: usize,
    found: FoundPoints<D>,
    /// Velocities at the start of the part of the step, by rank.
    starts: Vec<SolverBody<D>>,
    pub(super) prepared: Vec<PreparedRow<D>>,
    pub(super) given: Vec<D::Vector>,
}

/// Where a row comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowSource {
    pub entity: Entity,
    pub point: u8,
    /// What the point's memory says of the position filter.
    pub held: bool,
    /// Separation found by the detection before; `None` for a new point [m].
    pub separation_before: Option<f64>,
    /// Whether the velocity filter held the point back on the way here.
    pub held_back: bool,
}

impl<D: Geometry> Default for ContactProblem<D> {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            rows: Vec::new(),
            sources: Vec::new(),
            touching: 0,
            resting: 0,
            found: FoundPoints::default(),
            starts: Vec::new(),
            prepared: Vec::new(),
            given: Vec::new(),
        }
    }
}

/// The components of a body that a contact model reads and writes.
pub(crate) type BodyQuery<'w, 's, D> = Query<
    'w,
    's,
    (
        &'static BodyIndex,
        &'static mut LinearVelocity<<D as Dim>::Vector>,
        &'static mut AngularVelocity<<D as Dim>::Angular>,
        &'static InverseMass<<D as Dim>::Vector>,
        &'static InverseInertia<<D as Dim>::Inertia>,
        &'static Orientation<<D as Dim>::Rotation>,
        Option<&'static PreviousVelocity<<D as Dim>::Vector, <D as Dim>::Angular>>,
        &'static Position<<D as Dim>::Vector>,
    ),
>;

/// The components of a contact entity.
pub(super) type PairQuery<'w, 's, D> =
    Query<'w, 's, (Entity, &'static ContactPair, &'static ContactManifold<D>, &'static mut ContactMemory<D>)>;

impl<D: Geometry> ContactProblem<D> {
    /// Gathers the points of solid pairs.
    pub(super) fn gather_rows(&mut self, detection: &Detection<D>, pairs: &PairQuery<D>, wanted: Points) {
        let Self { rows, sources, found, .. } = self;
        rows.clear();
        sources.clear();
        found.find(detection, pairs, wanted);
        found.sort();
        found.pour(Points::Touching, rows, sources);
        self.touching = rows.len();
        if wanted == Points::Near {
            found.pour(Points::Near, rows, sources);
        }
    }

    /// Moves rows with a gap that rest all the same to those that touch: points that approach no faster than gravity makes them in a
    /// step and a half, across a gap that this speed can close. Without them, a resting point that solver error has
    /// lifted by a hair would fall, and land, and be lifted again.
    ///
    /// Where steps are cut at impacts, touching points that part instead are set aside: they fly.
    pub(super) fn admit_resting(&mut self, settings: &Settings<D>, bodies: &BodyQuery<D>) {
        self.resting = self.touching;
        if settings.cuts_at_impacts() {
            return self.set_aside_leaving(settings, bodies);
        }
        for i in self.resting..self.rows.len() {
            let slow = 3.0 * settings.rest_speed(self.rows[i].normal());
            let row = &self.rows[i];
            if row.separation <= slow * settings.dt && -row.separating_speed(&self.bodies) <= slow {
                self.rows[i].allowance = row.separation / settings.dt;
                self.rows.swap(i, self.resting);
                self.sources.swap(i, self.resting);
                self.resting += 1;
            }
        }
    }

    fn set_aside_leaving(&mut self, settings: &Settings<D>, bodies: &BodyQuery<D>) {
        self.starts.clear();
        self.starts.resize(self.bodies.len(), SolverBody::default());
        for (index, velocity, spin, .., previous, _) in bodies {
            let start = &mut self.starts[index.0 as usize];
            (start.velocity, start.angular_velocity) =
                previous.map_or((velocity.0, spin.0), |previous| (previous.linear, previous.angular));
        }
        let mut i = 0;
        while i < self.resting {
            let row = &self.rows[i];
            if row.separating_speed(&self.starts) > settings.rest_speed(row.normal()) {
                self.resting -= 1;
                self.rows.swap(i, self.resting);
                self.sources.swap(i, self.resting);
            } else {
                i += 1;
            }
        }
    }

    /// Makes room for so many bodies, and the world after them, which nothing moves.
    pub(super) fn begin_bodies(&mut self, count: usize) {
        self.bodies.resize_with(count + 1, SolverBody::default);
        self.bodies[count] = SolverBody::default();
    }

    /// Forgets all rows.
    pub(super) fn forget_rows(&mut self) {
        self.rows.clear();
        self.sources.clear();
        (self.touching, self.resting) = (0, 0);
    }

    /// Gathers velocities and inverse masses of all bodies, and the world after them, which nothing moves.
    pub(crate) fn gather_bodies(&mut self, bodies: &BodyQuery<D>, count: usize) {
        self.begin_bodies(count);
        for (index, velocity, spin, inverse_mass, inverse_inertia, orientation, ..) in bodies {
            self.bodies[index.0 as usize] = SolverBody {
                velocity: velocity.0,
                angular_velocity: spin.0,
                inverse_mass: inverse_mass.0,
                inverse_inertia: inverse_inertia.0.in_world(&orientation.0),
            };
        }
    }

    /// Sets the velocities with which bodies are going to move: for ballistic bodies the mean over the step.
    pub(crate) fn gather_mean_velocities(&mut self, bodies: &BodyQuery<D>) {
        for (index, velocity, spin, .., previous, _) in bodies {
            let body = &mut self.bodies[index.0 as usize];
            (body.velocity, body.angular_velocity) = match previous {
                None => (velocity.0, spin.0),
                Some(previous) => ((previous.linear + velocity.0) * 0.5, (previous.angular + spin.0) * 0.5),
            };
        }
    }

    /// The rows that the velocity filter held, or that touch under a model without one, and the present velocities.
    pub(crate) fn gathered(&mut self, bodies: &BodyQuery<D>, count: usize) -> (&[ContactRow<D>], &[SolverBody<D>]) {
        self.gather_bodies(bodies, count);
        (&self.rows[..self.resting.max(self.touching).min(self.rows.len())], &self.bodies)
    }

    /// The poses of all bodies, each with its rank.
    pub(crate) fn poses(bodies: &BodyQuery<D>) -> impl Iterator<Item = (u32, Pose<D>)> {
        bodies.iter().map(|(index, .., orientation, _, position)| {
            (index.0, Pose { position: position.0, rotation: orientation.0 })
        })
    }

    /// Writes the velocities back.
    pub(crate) fn scatter_bodies(&self, bodies: &mut BodyQuery<D>, fault: &mut Fault, phase: StepSystems) {
        for (index, mut velocity, mut spin, ..) in bodies.iter_mut() {
            let body = &self.bodies[index.0 as usize];
            let finite = body.velocity.is_finite() && body.angular_velocity.is_finite();
            fault.check(finite, index.0, Quantity::Velocity, phase);
            velocity.bypass_change_detection().0 = body.velocity;
            spin.bypass_change_detection().0 = body.angular_velocity;
        }
    }
}
