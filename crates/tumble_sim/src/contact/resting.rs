//! The resting-contact model's systems: contact forces from conditions on accelerations; see [`tumble_solver::resting_lcp`].
//!
//! Phase 1 finds the forces. Phase 3 removes what they leave of the velocities at points that push: accelerations are exact for an instant, velocities after a
//! step of Δt are not. Impacts are the impulse model's, one by one.

use bevy_ecs::prelude::*;
use tumble_collision::CornerOf;
use tumble_math::{Dim, Inertia, Linear, Matrix, Pose, Rotation, Vector};
use tumble_solver::contact::tangential;
use tumble_solver::joint::{JointBlock, JointRow};
use tumble_solver::resting_lcp::{self, Gap, NormalCarrier, RestingLcp, RestingReport, RestingSettings};
use tumble_solver::{ContactRow, Slip, SolverBody};

use super::problem::{BodyQuery, ContactProblem, ContactReport, PairQuery};
use super::{ContactManifold, ContactPair};
use crate::body::{BodyInertia, BodyTable, Force, Torque};
use crate::contact::Colliders;
use crate::geometry::Geometry;
use crate::joint::{JointProblem, JointTable};
use crate::ledger::Books;
use crate::notice::Notices;
use crate::{Clock, Settings};

/// The resting model with its scratch space, and what phase 3 needs of phase 1.
#[derive(Resource, Debug)]
pub struct RestingModel<D: Dim> {
    lcp: RestingLcp<D>,
    rows: Vec<ContactRow<D>>,
    /// Row of the contact problem of each row here.
    of_problem: Vec<u32>,
    gaps: Vec<Gap<D>>,
    /// Poses of the bodies, by rank.
    poses: Vec<Pose<D>>,
    /// Slip of each row before its forces act, in the contact frame; zero where it is round-off [m/s].
    slips: Vec<D::Vector>,
    accelerations: Vec<resting_lcp::Acceleration<D>>,
    forces: Vec<D::Vector>,
    /// Whether some island had no solution, so that the step is resolved by impulses.
    pub(super) unsolved: bool,
    holds: Vec<JointRow<D>>,
    /// How many of them, from the first, are joints.
    joints: usize,
    block: JointBlock<D>,
}

impl<D: Dim> Default for RestingModel<D> {
    fn default() -> Self {
        Self {
            lcp: RestingLcp::default(),
            rows: Vec::new(),
            of_problem: Vec::new(),
            gaps: Vec::new(),
            poses: Vec::new(),
            slips: Vec::new(),
            accelerations: Vec::new(),
            forces: Vec::new(),
            unsolved: false,
            holds: Vec::new(),
            joints: 0,
            block: JointBlock::default(),
        }
    }
}

/// A gap that opens more slowly than this stands still: what rounding leaves of a speed that was stopped [length scales per second].
const ROUNDING: f64 = 1e-12;

/// Adds the forces of all points at rest.
pub fn apply_resting_forces<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    table: Res<BodyTable>,
    colliders: Res<Colliders<D>>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut model: ResMut<RestingModel<D>>,
    mut report: ResMut<ContactReport>,
    mut notices: ResMut<Notices>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    bodies: BodyQuery<D>,
    mut forces: Query<(&mut Force<D::Vector>, &mut Torque<D::Angular>, &BodyInertia<D::Inertia>)>,
) {
    let (problem, model) = (&mut *problem, &mut *model);
    model.unsolved = false;
    model.rows.clear();
    problem.rows.iter_mut().for_each(|row| row.impulse = D::Vector::ZERO);
    if problem.touching == 0 && joint_table.entries().is_empty() {
        return;
    }
    problem.gather_bodies(&bodies, table.entries().len());
    joints.build(&joint_table, ContactProblem::poses(&bodies), &problem.bodies);
    model.poses.resize(problem.bodies.len(), Pose::default());
    ContactProblem::poses(&bodies).for_each(|(rank, pose)| model.poses[rank as usize] = pose);
    model.gather(problem, &settings, &colliders, &pairs);
    model.accelerations.clear();
    model.accelerations.resize(problem.bodies.len(), resting_lcp::Acceleration::default());
    for (rank, entry) in table.entries().iter().enumerate() {
        if let Ok((force, torque, inertia)) = forces.get(entry.entity) {
            let body = &problem.bodies[rank];
            // Euler's equation: part of the torque turns the angular momentum along.
            let momentum = inertia.0.in_world(&model.poses[rank].rotation).apply(body.angular_velocity);
            let gyroscopic = D::gyroscopic_torque(body.angular_velocity, momentum);
            model.accelerations[rank] = resting_lcp::Acceleration {
                linear: force.0.scale_by(body.inverse_mass),
                angular: body.inverse_inertia.apply(torque.0 - gyroscopic),
            };
        }
    }

    let RestingModel { lcp, rows, gaps, accelerations, forces: found, .. } = model;
    let resting = RestingSettings { sliding_above: settings.touch_tolerance(), ..RestingSettings::default() };
    let solved = lcp.solve(&problem.bodies, accelerations, rows, gaps, found, joints.as_joints(), &resting);
    report.add_resting(&solved, clock.part());
    model.unsolved = solved.no_solution + solved.too_large > 0;
    note(&mut notices, &solved, clock.step + 1);

    // Joints act in phase 3, as impulses.
    let mut push = |body: u32, arm: D::Vector, force: D::Vector| {
        if let Some(entry) = table.entries().get(body as usize)
            && let Ok((mut sum, mut torque, _)) = forces.get_mut(entry.entity)
        {
            sum.bypass_change_detection().0 += force;
            torque.bypass_change_detection().0 += D::torque(arm, force);
        }
    };
    for ((row, force), source) in model.rows.iter_mut().zip(&model.forces).zip(&model.of_problem) {
        let world = row.frame.apply(*force);
        push(row.b, row.arm_b, world);
        push(row.a, row.arm_a, -world);
        if let Some(books) = &mut books {
            books.count_friction(row, *force);
        }
        row.impulse = *force * clock.part();
        let (problem_row, source) = (&mut problem.rows[*source as usize], problem.sources[*source as usize]);
        (problem_row.impulse, problem_row.slip) = (row.impulse, row.slip);
        if let Ok((.., mut memory)) = pairs.get_mut(source.entity) {
            let memory = &mut memory.bypass_change_detection().0.as_mut()[source.point as usize];
            (memory.impulse, memory.slip) = (row.impulse, row.slip);
            memory.pending += world * clock.part();
        }
    }
}

fn note(notices: &mut Notices, solved: &RestingReport, step: u64) {
    if solved.no_solution > 0 {
        notices.no_solution(step);
    }
    if solved.not_unique > 0 {
        notices.not_unique(step);
    }
    if solved.too_large > 0 {
        notices.too_large(step);
    }
}

impl<D: Geometry> RestingModel<D> {
    /// Takes the touching rows that do not part.
    fn gather(
        &mut self,
        problem: &ContactProblem<D>,
        settings: &Settings<D>,
        colliders: &Colliders<D>,
        pairs: &PairQuery<D>,
    ) {
        self.of_problem.clear();
        self.gaps.clear();
        self.slips.clear();
        for (i, (row, source)) in problem.rows.iter().zip(&problem.sources).take(problem.touching).enumerate() {
            let Ok((_, pair, manifold, _)) = pairs.get(source.entity) else { continue };
            let gap = gap(row, pair, manifold, source.point, colliders, &self.poses);
            // A gap that opens faster than gravity could make up for within the step is no rest, unless the bodies turned that far in the
            // last one: their velocities are tangents.
            let turning = 1.5 * gap.drift(row, &problem.bodies)[0].abs() * settings.dt;
            let slow = settings.rest_speed(row.normal()).max(ROUNDING * settings.length_scale) + turning;
            if row.separating_speed(&problem.bodies) > slow {
                continue;
            }
            self.gaps.push(gap);
            let slip = tangential(row.relative_velocity(&problem.bodies));
            self.slips.push(if slip.length() > settings.touch_tolerance() { slip } else { D::Vector::ZERO });
            self.rows.push(ContactRow { impulse: D::Vector::ZERO, ..*row });
            self.of_problem.push(i as u32);
        }
    }

    /// The rows of contact points in the last [`stop_leftover`](Self::stop_leftover), with their impulses.
    pub(super) fn leftovers(&self) -> &[JointRow<D>] {
        &self.holds[self.joints.min(self.holds.len())..]
    }

    /// Makes points that push neither approach nor part, and those that stick stand still: the least change of velocity that does so.
    ///
    /// Joints hold with them.
    pub(super) fn stop_leftover(&mut self, bodies: &mut [SolverBody<D>], joints: &mut [JointRow<D>]) {
        self.holds.clear();
        self.holds.extend_from_slice(joints);
        for (row, slip) in self.rows.iter().zip(&self.slips).filter(|(row, _)| row.impulse[0] > 0.0) {
            // Friction that turns a slip round has stopped it within the step.
            let turned_round = tangential(row.relative_velocity(bodies)).dot(*slip) < 0.0;
            let axes = if row.slip == Slip::Sticking || turned_round { D::Vector::AXES } else { 1 };
            for axis in 0..axes {
                let direction = row.frame.column(axis);
                self.holds.push(JointRow {
                    a: row.a,
                    b: row.b,
                    linear: direction,
                    angular_a: D::torque(row.arm_a, direction),
                    angular_b: D::torque(row.arm_b, direction),
                    error: 0.0,
                    drift: 0.0,
                    impulse: 0.0,
                });
            }
        }
        self.block.prepare(bodies, &self.holds);
        self.block.stop(bodies, &mut self.holds);
        joints.copy_from_slice(&self.holds[..joints.len()]);
        self.joints = joints.len();
    }
}

/// What the gap of a point is measured between: corners and sides as they are, rounds and circles by their centres.
fn gap<D: Geometry>(
    row: &ContactRow<D>,
    pair: &ContactPair,
    manifold: &ContactManifold<D>,
    point: u8,
    colliders: &Colliders<D>,
    poses: &[Pose<D>],
) -> Gap<D> {
    let feature = D::points(&manifold.0)[point as usize].feature;
    let corner = feature.corner();
    let normal = row.normal();
    let shape = |k: usize| &colliders.as_slice()[pair.colliders[k] as usize].shape;
    let rotation = |k: usize| &poses[pair.bodies[k] as usize].rotation;
    let round = |k: usize| D::rounding(shape(k));
    let inwards = |k: usize| round(k) + 0.5 * row.separation;
    let (mut feature_a, mut feature_b) = (row.arm_a, row.arm_b);
    if corner != CornerOf::B && round(0) > 0.0 {
        feature_a -= normal * inwards(0);
    }
    if corner != CornerOf::A && round(1) > 0.0 {
        feature_b += normal * inwards(1);
    }
    let carrier = match corner {
        CornerOf::A => NormalCarrier::B,
        CornerOf::B => NormalCarrier::A,
        CornerOf::Both => {
            let edge = |k: usize, number| Some(rotation(k).rotate(D::edge_direction(shape(k), number)?));
            let edges = feature.as_edges().and_then(|(of_a, of_b)| edge(0, of_a).zip(edge(1, of_b)));
            edges.map_or(NormalCarrier::Line, |(of_a, of_b)| NormalCarrier::Edges(of_a, of_b))
        }
    };
    let mut circles = [None; 2];
    for (k, feature, other_side) in [(0, &mut feature_a, CornerOf::A), (1, &mut feature_b, CornerOf::B)] {
        if let Some([through, axis]) = D::round_axis(shape(k)).filter(|_| corner == other_side) {
            let (through, axis) = (rotation(k).rotate(through), rotation(k).rotate(axis));
            *feature = through + axis * axis.dot(*feature - through);
            circles[k] = Some(axis);
        }
    }
    Gap { feature_a, feature_b, carrier, circles }
}
