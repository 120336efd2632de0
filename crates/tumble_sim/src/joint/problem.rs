//! Joints as the rows that contact models take along.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Pose, Rotation};
use tumble_solver::SolverBody;
use tumble_solver::joint::{JointBlock, JointEnds, JointRow, Joints};

use super::table::{JointEntry, JointTable};
use crate::geometry::Geometry;

/// All joints as rows at the present poses, and what they did in this step.
#[derive(Resource, Debug)]
pub struct JointProblem<D: Geometry> {
    rows: Vec<JointRow<D>>,
    /// First row of each joint; one more at the end.
    first_rows: Vec<u32>,
    block: JointBlock<D>,
    /// By rank, the world last.
    poses: Vec<Pose<D>>,
    /// The bodies that joints hold.
    held: Vec<Held<D>>,
    /// `poses` after a move; only those of held bodies are kept up.
    poses_after: Vec<Pose<D>>,
    /// Sum of the impulses of this step on the second body of each joint: along world axes at its anchor, and the angular part about its centre of
    /// mass.
    given: Vec<(D::Vector, D::Angular)>,
    /// Impulse of each row in phases 1 to 4 of this step, along its direction before the move [N·s], [N·m·s].
    before_move: Vec<f64>,
    /// `given` when this part of the step began.
    given_before: Vec<(D::Vector, D::Angular)>,
    /// Rows of moved poses.
    moved: Vec<JointRow<D>>,
    moved_block: JointBlock<D>,
    speeds: Vec<f64>,
}

impl<D: Geometry> Default for JointProblem<D> {
    fn default() -> Self {
        Self {
            rows: Vec::new(),
            first_rows: Vec::new(),
            block: JointBlock::default(),
            poses: Vec::new(),
            held: Vec::new(),
            poses_after: Vec::new(),
            given: Vec::new(),
            before_move: Vec::new(),
            given_before: Vec::new(),
            moved: Vec::new(),
            moved_block: JointBlock::default(),
            speeds: Vec::new(),
        }
    }
}

/// A body that joints hold.
#[derive(Clone, Copy, Debug)]
struct Held<D: Geometry> {
    rank: u32,
    /// I and I⁻¹ in world axes; `None` for a body that is not turned by torques.
    inertia: Option<[D::Inertia; 2]>,
}

/// Most rounds of the search for the velocities that end the step on the joints: enough for each to halve the error.
const CURVATURE_ROUNDS: usize = 50;
/// Rounds of the search for the displacements that do, each with the directions found by the one before.
const MENDING_ROUNDS: usize = 20;
/// Most of an error that a round takes out, in tolerances: a hundredth of the length scale.
const MENDED_PER_ROUND: f64 = 1e12;

impl<D: Geometry> JointProblem<D> {
    /// Whether there are no joints.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The rows of all joints, in the order of their table.
    pub fn rows(&self) -> &[JointRow<D>] {
        &self.rows
    }

    /// The rows, for a model that solves them itself.
    pub(crate) fn rows_mut(&mut self) -> &mut [JointRow<D>] {
        &mut self.rows
    }

    /// Sum of the impulses of this step on the second body of a joint [N·s], and its torque about that body's centre of mass [N·m·s].
    pub fn given(&self, joint: usize) -> (D::Vector, D::Angular) {
        self.given.get(joint).copied().unwrap_or((D::Vector::ZERO, D::Angular::ZERO))
    }

    /// Largest |C| of all rows [m] or [rad].
    pub fn error(&self) -> f64 {
        self.rows.iter().map(|row| row.error.abs()).fold(0.0, f64::max)
    }

    /// Forgets the impulses of the last step.
    pub(crate) fn begin_step(&mut self, joints: usize) {
        self.given.clear();
        self.given.resize(joints, (D::Vector::ZERO, D::Angular::ZERO));
        self.begin_part();
    }

    /// Begins a part of a step.
    pub(crate) fn begin_part(&mut self) {
        self.before_move.clear();
        self.given_before.clone_from(&self.given);
    }

    /// Forgets what the joints gave in this part.
    pub(crate) fn take_back_part(&mut self) {
        self.before_move.clear();
        self.given.clone_from(&self.given_before);
    }

    /// Builds the rows at these poses (by rank, without the world) and factors them; `bodies` has the world last.
    pub(crate) fn build(
        &mut self,
        table: &JointTable<D>,
        poses: impl Iterator<Item = (u32, Pose<D>)>,
        bodies: &[SolverBody<D>],
    ) {
        self.rows.clear();
        self.held.clear();
        self.first_rows.clear();
        if table.entries().is_empty() {
            self.first_rows.push(0);
            return;
        }
        self.poses.clear();
        self.poses.resize(bodies.len(), Pose::default());
        for (rank, pose) in poses {
            self.poses[rank as usize] = pose;
        }
        for entry in table.entries() {
            self.first_rows.push(self.rows.len() as u32);
            push_rows(entry, &self.poses, bodies, &mut self.rows);
        }
        self.first_rows.push(self.rows.len() as u32);
        self.block.prepare(bodies, &self.rows);
        let mut ranks: Vec<u32> = table.entries().iter().flat_map(|entry| entry.bodies).collect();
        ranks.sort_unstable();
        ranks.dedup();
        self.held.extend(ranks.into_iter().map(|rank| Held::of(rank, &bodies[rank as usize])));
    }

    /// The joints for a contact model; `None` without joints.
    pub(crate) fn as_joints(&mut self) -> Option<Joints<'_, D>> {
        (!self.rows.is_empty()).then_some(Joints { block: &mut self.block, rows: &mut self.rows })
    }

    /// Moves the impulses of the rows to what the joints gave in this step.
    pub(crate) fn collect_impulses(&mut self) {
        self.before_move.resize(self.rows.len(), 0.0);
        for (sum, row) in self.before_move.iter_mut().zip(&self.rows) {
            *sum += row.impulse;
        }
        for (joint, given) in self.given.iter_mut().enumerate() {
            for row in &mut self.rows[self.first_rows[joint] as usize..self.first_rows[joint + 1] as usize] {
                given.0 += row.linear * row.impulse;
                given.1 += row.angular_b * row.impulse;
                row.impulse = 0.0;
            }
        }
    }

    /// Takes back half of what the rows gave before the move: the half that belongs to the directions after it.
    pub(crate) fn take_back_half(&mut self, bodies: &mut [SolverBody<D>]) {
        for (joint, given) in self.given.iter_mut().enumerate() {
            for i in self.first_rows[joint] as usize..self.first_rows[joint + 1] as usize {
                let (row, half) = (&self.rows[i], 0.5 * self.before_move.get(i).copied().unwrap_or(0.0));
                row.apply(bodies, -half);
                given.0 -= row.linear * half;
                given.1 -= row.angular_b * half;
            }
        }
    }

    /// Makes J v = 0.
    pub(crate) fn stop(&mut self, bodies: &mut [SolverBody<D>]) {
        self.block.stop(bodies, &mut self.rows);
        self.collect_impulses();
    }

    /// Changes the velocities such that moving with them for `dt` leaves every C as it is: C(x + Δt v) = C(x).
    ///
    /// `bodies` carry the velocities with which bodies are going to move, of which the velocities at the end of the step are
    /// `share` apart: 1 for symplectic Euler; ½ for ballistic bodies, which move with the mean of two. Impulses act along the directions of the joints
    /// before the move. Returns whether that was possible: bodies that turn by half a radian in a step have left those directions behind.
    pub(crate) fn follow_curvature(
        &mut self,
        table: &JointTable<D>,
        bodies: &mut [SolverBody<D>],
        dt: f64,
        share: f64,
        tolerance: f64,
    ) -> bool {
        let mut before = f64::INFINITY;
        let mut found = false;
        for _ in 0..CURVATURE_ROUNDS {
            self.move_rows(table, bodies, None, dt);
            if self.moved.len() != self.rows.len() {
                break;
            }
            let bent = self.moved.iter().zip(&self.rows).map(|(after, before)| after.error - before.error);
            let worst = bent.clone().map(f64::abs).fold(0.0, f64::max);
            // Converged, or as far as rounding lets it.
            if worst <= tolerance || (worst >= 0.5 * before && worst <= 1e3 * tolerance) {
                found = true;
                break;
            }
            // Each round leaves about ω Δt of the error. Where that is much, the answer may be a leap to the far side of a joint.
            if worst >= 0.5 * before || worst.is_nan() {
                break;
            }
            before = worst;
            self.speeds.clear();
            self.speeds.extend(self.rows.iter().zip(bent).map(|(row, bent)| row.speed(bodies) - bent / dt));
            self.block.drive_to(bodies, &mut self.rows, &self.speeds);
        }
        for row in &mut self.rows {
            row.impulse = if found { row.impulse / share } else { 0.0 };
        }
        self.collect_impulses();
        found
    }

    /// Adds to displacements what lets the step end with C = 0: for bodies that move with these velocities, and are displaced besides.
    pub(crate) fn mend(
        &mut self,
        table: &JointTable<D>,
        displacements: &mut [SolverBody<D>],
        bodies: &[SolverBody<D>],
        dt: f64,
        tolerance: f64,
    ) {
        let reach = MENDED_PER_ROUND * tolerance;
        let mut least = f64::INFINITY;
        for _ in 0..MENDING_ROUNDS {
            self.move_rows(table, bodies, Some(displacements), dt);
            let worst = self.moved.iter().map(|row| row.error.abs()).fold(0.0, f64::max);
            // Contradictory joints end where they cannot come any nearer.
            if worst <= tolerance || worst > 4.0 * least {
                break;
            }
            least = least.min(worst);
            // Directions hold for small displacements only: a joint that is far apart is closed in several rounds, and steps.
            let part = (reach / worst).min(1.0);
            self.moved_block.prepare(bodies, &self.moved);
            let shifted: Vec<f64> = self.moved.iter().map(|row| row.speed(displacements) - part * row.error).collect();
            self.moved_block.drive_to(displacements, &mut self.moved, &shifted);
        }
    }

    /// Builds the rows for bodies that have moved with these velocities, and were displaced.
    fn move_rows(
        &mut self,
        table: &JointTable<D>,
        bodies: &[SolverBody<D>],
        displacements: Option<&[SolverBody<D>]>,
        dt: f64,
    ) {
        self.poses_after.clone_from(&self.poses);
        for held in &self.held {
            let rank = held.rank as usize;
            let pose = &mut self.poses_after[rank];
            *pose = held.moved(pose, &bodies[rank], dt);
            if let Some(shift) = displacements.map(|displacements| &displacements[rank]) {
                *pose = moved(pose, shift.velocity, shift.angular_velocity);
            }
        }
        self.moved.clear();
        for entry in table.entries() {
            push_rows(entry, &self.poses_after, bodies, &mut self.moved);
        }
    }

    /// The arm from the centre of mass of a joint's second body to its anchor, in world axes [m].
    pub fn arm_b(&self, entry: &JointEntry<D>) -> D::Vector {
        match self.poses.get(entry.bodies[1] as usize) {
            Some(pose) => pose.rotation.rotate(entry.anchors[1]),
            None => D::Vector::ZERO,
        }
    }

    /// Where a joint's second body is held, in world axes [m].
    pub fn anchor_b(&self, entry: &JointEntry<D>) -> D::Vector {
        self.poses.get(entry.bodies[1] as usize).map_or(D::Vector::ZERO, |pose| pose.transform_point(entry.anchors[1]))
    }
}

impl<D: Geometry> Held<D> {
    fn of(rank: u32, body: &SolverBody<D>) -> Self {
        let inverse = body.inverse_inertia;
        let inertia = if D::Rotation::INERTIA_IS_CONSTANT { None } else { inverse.try_inverse() };
        Self { rank, inertia: inertia.map(|inertia| [inertia, inverse]) }
    }

    /// Where the body is after a step without forces, as the integrator moves it.
    fn moved(&self, pose: &Pose<D>, body: &SolverBody<D>, dt: f64) -> Pose<D> {
        let rate = match &self.inertia {
            None => body.angular_velocity,
            Some([inertia, inverse]) => {
                D::midpoint_rate(D::Rotation::default(), inertia, inverse, body.angular_velocity, dt)
            }
        };
        moved(pose, body.velocity * dt, rate * dt)
    }
}

fn moved<D: Dim>(pose: &Pose<D>, shift: D::Vector, turn: D::Angular) -> Pose<D> {
    Pose { position: pose.position + shift, rotation: pose.rotation.turned(turn) }
}

/// Appends the rows of a joint; a distance joint whose anchors coincide has none for as long as they do.
fn push_rows<D: Geometry>(
    entry: &JointEntry<D>,
    poses: &[Pose<D>],
    bodies: &[SolverBody<D>],
    rows: &mut Vec<JointRow<D>>,
) {
    let [a, b] = entry.bodies;
    let [pose_a, pose_b] = entry.bodies.map(|body| &poses[body as usize]);
    let arms = [pose_a.rotation.rotate(entry.anchors[0]), pose_b.rotation.rotate(entry.anchors[1])];
    let ends = JointEnds::at((a, pose_a.position, arms[0]), (b, pose_b.position, arms[1]));
    let _ = D::push_joint_rows(entry, &ends, [&pose_a.rotation, &pose_b.rotation], bodies, rows);
}
