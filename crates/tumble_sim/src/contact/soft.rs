//! The system of the soft-step model; see [`tumble_solver::soft_step`].

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Matrix};
use tumble_solver::soft_step::{SoftPair, SoftPoint, SoftStep, Width};
use tumble_solver::{ContactRow, SolverBody};

use super::problem::{BodyQuery, ContactProblem, ContactReport, PairQuery, RowSource};
use super::{Detection, PositionCorrections};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, InverseInertia, InverseMass,
    LinearVelocity, Orientation, Position,
};
use crate::fault::{Fault, Quantity};
use crate::geometry::Geometry;
use crate::joint::{JointProblem, JointTable, joint_tolerance};
use crate::ledger::Books;
use crate::part::Response;
use crate::schedule::StepSystems;
use crate::{Clock, Settings};

/// The soft-step model with its scratch space.
#[derive(Resource, Debug)]
pub struct SoftModel<D: Geometry> {
    model: SoftStep<D>,
    points: Vec<SoftPoint<D>>,
    /// Whether a contact pushed a body in this step, by rank.
    pushed: Vec<bool>,
}

impl<D: Geometry> Default for SoftModel<D> {
    fn default() -> Self {
        Self { model: SoftStep::default(), points: Vec::new(), pushed: Vec::new() }
    }
}

impl<D: Geometry> SoftModel<D> {
    /// Chooses how the kernels run: all ways give the same bits.
    pub fn set_width(&mut self, width: Width) {
        self.model.width = width;
    }
}

/// Slower approaches than gravity makes in this many steps do not rebound: they are rest [1].
const REST_STEPS: f64 = 2.0;

type SoftBodies<'w, 's, D> = Query<
    'w,
    's,
    (
        &'static BodyIndex,
        &'static mut LinearVelocity<<D as Dim>::Vector>,
        &'static mut AngularVelocity<<D as Dim>::Angular>,
        &'static Acceleration<<D as Dim>::Vector>,
        &'static AngularAcceleration<<D as Dim>::Angular>,
        &'static InverseMass<<D as Dim>::Vector>,
        &'static InverseInertia<<D as Dim>::Inertia>,
        &'static Orientation<<D as Dim>::Rotation>,
        &'static Position<<D as Dim>::Vector>,
    ),
>;

/// Takes the substeps: contacts and joints change the velocities, and what else they displace is left for the move.
pub fn take_soft_steps<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    table: Res<BodyTable>,
    detection: Res<Detection<D>>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut soft: ResMut<SoftModel<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut corrections: ResMut<PositionCorrections<D>>,
    mut report: ResMut<ContactReport>,
    mut fault: ResMut<Fault>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    mut bodies: SoftBodies<D>,
) {
    if !fault.is_none() {
        return;
    }
    let dt = clock.part();
    let (how, substep) = (&settings.soft_step, dt / f64::from(settings.soft_step.substeps));
    let SoftModel { model, points, pushed } = &mut *soft;
    let problem = &mut *problem;
    problem.begin_bodies(table.entries().len());
    for (index, velocity, spin, a, alpha, mass, inertia, orientation, _) in &bodies {
        problem.bodies[index.0 as usize] = SolverBody {
            velocity: velocity.0 - a.0 * dt,
            angular_velocity: spin.0 - alpha.0 * dt,
            inverse_mass: mass.0,
            inverse_inertia: inertia.0.in_world(&orientation.0),
        };
    }
    model.begin(&problem.bodies);
    for (index, _, _, a, alpha, ..) in &bodies {
        model.accelerate(index.0, a.0, alpha.0, substep);
    }

    let solid = |pair: &super::ContactPair, manifold: &super::ContactManifold<D>| {
        pair.response == Response::Solid && !D::points(&manifold.0).is_empty()
    };
    for (_, pair, manifold, _) in pairs.iter().filter(|(_, pair, manifold, _)| solid(pair, manifold)) {
        let [a, b] = pair.bodies;
        model.announce(a, b, D::points(&manifold.0).len(), &problem.bodies);
    }
    model.lay_out();
    let mut number = 0;
    for (_, pair, manifold, memory) in pairs.iter().filter(|(_, pair, manifold, _)| solid(pair, manifold)) {
        let [a, b] = pair.bodies;
        let [at_a, at_b] = pair.bodies.map(|body| detection.motions()[body as usize].pose.position);
        points.clear();
        points.extend(D::points(&manifold.0).iter().zip(memory.0.as_ref()).map(|(point, memory)| SoftPoint {
            arm_a: point.point - at_a,
            arm_b: point.point - at_b,
            separation: point.separation,
            impulse: memory.impulse,
            slip: memory.slip,
        }));
        let normal = D::normal(&manifold.0);
        let rest_speed = 2.0 * REST_STEPS * settings.rest_speed(normal);
        let pair = SoftPair { a, b, normal, surface: pair.surface, rest_speed, points };
        model.fill(number, &pair, &problem.bodies);
        number += 1;
    }
    joints.build(
        &joint_table,
        bodies.iter().map(|(index, .., orientation, position)| {
            (index.0, tumble_math::Pose { position: position.0, rotation: orientation.0 })
        }),
        &problem.bodies,
    );
    let acts = number > 0 || !joints.is_empty();
    problem.forget_rows();
    corrections.0.bodies.clear();
    if !acts {
        return;
    }
    report.add(model.solve(dt, settings.gravity.length(), how, joints.as_joints(), &mut problem.bodies));

    pushed.clear();
    pushed.resize(problem.bodies.len(), false);
    let mut number = 0;
    for (entity, pair, manifold, mut memory) in &mut pairs {
        if !solid(pair, manifold) {
            continue;
        }
        let frame = D::contact_frame(D::normal(&manifold.0));
        for (k, (point, memory)) in
            D::points(&manifold.0).iter().zip(memory.bypass_change_detection().0.as_mut()).enumerate()
        {
            let outcome = model.outcome(number, k);
            (memory.impulse, memory.slip) = (outcome.impulse, outcome.slip);
            memory.pending += frame.apply(outcome.total);
            // It met the surface in this step, wherever the rest of the step took it.
            memory.held = outcome.total[0] > 0.0;
            if memory.held {
                for body in pair.bodies {
                    pushed[body as usize] = true;
                }
            }
            if books.is_some() && (point.separation <= 0.0 || outcome.total[0] > 0.0) {
                let [at_a, at_b] = pair.bodies.map(|body| detection.motions()[body as usize].pose.position);
                problem.rows.push(ContactRow {
                    a: pair.bodies[0],
                    b: pair.bodies[1],
                    frame,
                    arm_a: point.point - at_a,
                    arm_b: point.point - at_b,
                    separation: point.separation,
                    allowance: point.separation.max(0.0) / substep,
                    surface: pair.surface,
                    impulse: outcome.total,
                    slip: outcome.slip,
                });
                problem.sources.push(RowSource {
                    entity,
                    point: k as u8,
                    held: false,
                    separation_before: memory.separation_before,
                    held_back: memory.held_back,
                });
            }
        }
        number += 1;
    }
    // In n substeps a free body moves by v₁ Δt − a Δt² (n − 1)/2n, with v₁ its velocity at the end; a whole step of symplectic Euler, by v₁ Δt.
    // A body that no contact pushed takes the whole step: under a force that is constant over the step, substeps would make it swing ever wider.
    let n = f64::from(how.substeps);
    let behind = -0.5 * dt * dt * (n - 1.0) / n;
    corrections.0.begin(&problem.bodies);
    let mut before = books.as_ref().map(|_| problem.bodies.clone());
    for (index, mut velocity, mut spin, a, alpha, ..) in &mut bodies {
        if let Some(before) = &mut before {
            let before = &mut before[index.0 as usize];
            (before.velocity, before.angular_velocity) = (velocity.0, spin.0);
        }
        let shift = &mut corrections.0.bodies[index.0 as usize];
        let (dv, dw) = model.change(index.0, how);
        velocity.bypass_change_detection().0 += dv;
        spin.bypass_change_detection().0 += dw;
        let mut finite = dv.is_finite() && dw.is_finite();
        if pushed[index.0 as usize] {
            let (dx, turn) = model.displacement(index.0, dt, how);
            shift.velocity = dx - dv * dt + a.0 * behind;
            shift.angular_velocity = turn - dw * dt + alpha.0 * behind;
            finite &= dx.is_finite() && turn.is_finite();
        }
        fault.check(finite, index.0, Quantity::Velocity, StepSystems::FilterVelocities);
        let body = &mut problem.bodies[index.0 as usize];
        (body.velocity, body.angular_velocity) = (velocity.0, spin.0);
    }

    problem.resting = problem.rows.len();
    if let (Some(books), Some(before)) = (&mut books, before) {
        let impulses = problem.rows.iter().map(|row| row.impulse);
        books.count_impulses(&problem.rows, impulses, joints.rows(), &before, &problem.bodies);
    }
    joints.collect_impulses();
}

/// Adds to the displacements what lets joints end the step closed.
pub fn mend_soft_joints<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut corrections: ResMut<PositionCorrections<D>>,
    fault: Res<Fault>,
    bodies: BodyQuery<D>,
) {
    if joints.is_empty() || !fault.is_none() {
        return;
    }
    let problem = &mut *problem;
    problem.gather_mean_velocities(&bodies);
    let displaced = &mut corrections.0.bodies;
    joints.mend(&joint_table, displaced, &problem.bodies, clock.part(), joint_tolerance(&settings));
}
