//! The systems of joints that are not part of a contact model.

use bevy_ecs::prelude::*;
use tumble_math::Linear;
use tumble_solver::penalty;

use super::{JointProblem, JointTable};
use crate::body::{BodyTable, Force, Torque};
use crate::contact::{BodyQuery, ContactProblem};
use crate::fault::{Fault, Quantity};
use crate::geometry::Geometry;
use crate::schedule::StepSystems;
use crate::settings::Integrator;
use crate::simulation::Beginning;
use crate::{Clock, Settings};

/// Takes the curvature of the joints' motion into the velocities, so that the step ends with the joints as they were; see
/// [the module](super).
pub fn correct_curvature<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut fault: ResMut<Fault>,
    mut bodies: BodyQuery<D>,
) {
    if joints.is_empty() || !fault.is_none() {
        return;
    }
    let problem = &mut *problem;
    problem.gather_mean_velocities(&bodies);
    let before = problem.bodies.clone();
    let share = match settings.moves_by() {
        Integrator::SymplecticEuler => 1.0,
        Integrator::Ballistic => 0.5,
    };
    if !joints.follow_curvature(&table, &mut problem.bodies, clock.part(), share, joint_tolerance(&settings)) {
        // The position filter mends what is left, without the velocities.
        return;
    }
    for (index, mut velocity, mut spin, ..) in &mut bodies {
        let (before, after) = (&before[index.0 as usize], &problem.bodies[index.0 as usize]);
        velocity.bypass_change_detection().0 += (after.velocity - before.velocity) * (1.0 / share);
        spin.bypass_change_detection().0 += (after.angular_velocity - before.angular_velocity) * (1.0 / share);
        let finite = velocity.0.is_finite() && spin.0.is_finite();
        fault.check(finite, index.0, Quantity::Velocity, StepSystems::UpdatePositions);
    }
}

/// Round-off of an error that is the difference of two places some length scales away [m].
pub(crate) fn joint_tolerance<D: Geometry>(settings: &Settings<D>) -> f64 {
    1e-14 * settings.length_scale
}

/// J v = 0 at the end of the step, for bodies whose velocities belong there (RATTLE; Andersen 1983).
///
/// Half of the joints' impulses of a step act along their directions before the move, half after it.
pub(crate) fn stop_joints<D: Geometry>(
    beginning: Res<Beginning>,
    settings: Res<Settings<D>>,
    table: Res<JointTable<D>>,
    ranks: Res<BodyTable>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut fault: ResMut<Fault>,
    mut bodies: BodyQuery<D>,
) {
    let at_the_end = settings.moves_by() == Integrator::Ballistic || *beginning == Beginning::Yes;
    if table.entries().is_empty() || !fault.is_none() || !at_the_end {
        return;
    }
    let problem = &mut *problem;
    problem.gather_bodies(&bodies, ranks.entries().len());
    if *beginning == Beginning::No {
        joints.take_back_half(&mut problem.bodies);
    }
    joints.build(&table, ContactProblem::poses(&bodies), &problem.bodies);
    joints.stop(&mut problem.bodies);
    problem.scatter_bodies(&mut bodies, &mut fault, StepSystems::ResolveImpulses);
}

/// The penalty model's joints: a spring and a critically strong damper per row, so stiff that Δt is a tenth of the stable bound.
///
/// ```text
/// f = −(k C + c Ċ),   k and c as the penalty contact's for a body of mass 1/K
/// ```
pub fn apply_joint_springs<D: Geometry>(
    clock: Res<Clock>,
    table: Res<JointTable<D>>,
    ranks: Res<BodyTable>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    bodies: BodyQuery<D>,
    mut forces: Query<(&mut Force<D::Vector>, &mut Torque<D::Angular>)>,
) {
    let problem = &mut *problem;
    problem.gather_bodies(&bodies, ranks.entries().len());
    joints.build(&table, ContactProblem::poses(&bodies), &problem.bodies);
    joints.begin_step(table.entries().len());
    let Some(rows) = joints.as_joints() else { return };
    for row in rows.rows.iter_mut() {
        let compliance = row.compliance(&problem.bodies);
        if compliance <= 0.0 {
            continue;
        }
        let stiffness = penalty::default_stiffness(compliance, 1.0, clock.part());
        let damping = penalty::damping_coefficient(stiffness, compliance, 1.0);
        let force = -(stiffness * row.error + damping * row.speed(&problem.bodies));
        row.impulse = force * clock.part();
        for (body, side, angular) in [(row.a, -1.0, row.angular_a), (row.b, 1.0, row.angular_b)] {
            let Some(entry) = ranks.entries().get(body as usize) else { continue };
            if let Ok((mut sum, mut torque)) = forces.get_mut(entry.entity) {
                sum.bypass_change_detection().0 += row.linear * (force * side);
                torque.bypass_change_detection().0 += angular * (force * side);
            }
        }
    }
    joints.collect_impulses();
}
