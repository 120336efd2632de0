//! The penalty model's systems: contact forces from overlaps; see [`tumble_solver::penalty`].

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Matrix};
use tumble_solver::contact::tangential;
use tumble_solver::penalty::{self, LectureFloor, SpringDamper};
use tumble_solver::{ContactRow, Slip, SolverBody};

use super::found::Points;
use super::problem::{BodyQuery, ContactProblem, PairQuery};
use super::{Colliders, ContactPair, Detection};
use crate::body::{BodyTable, Force, Torque};
use crate::geometry::Geometry;
use crate::ledger::{Books, ForceLine};
use crate::notice::Notices;
use crate::settings::{PenaltyLaw, SpringDamperSettings};
use crate::{Clock, Settings};

/// Adds the forces of all overlapping points.
pub fn apply_penalty_forces<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    colliders: Res<Colliders<D>>,
    detection: Res<Detection<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut notices: ResMut<Notices>,
    table: Res<BodyTable>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    bodies: BodyQuery<D>,
    mut forces: Forces<D>,
) {
    let PenaltyLaw::SpringDamper(law) = settings.penalty.law else { return };
    let problem = &mut *problem;
    problem.gather_rows(&detection, &pairs, Points::Touching);
    if problem.rows.is_empty() {
        return;
    }
    problem.gather_bodies(&bodies, detection.motions().len());
    for (row, source) in problem.rows.iter_mut().zip(&problem.sources) {
        let Ok((_, pair, _, mut memory)) = pairs.get_mut(source.entity) else { continue };
        let contact = spring_damper(&law, pair, row, &problem.bodies, &colliders, clock.part(), &mut notices);
        let force = penalty::contact_force(row, &problem.bodies, &contact, clock.part());
        memory.bypass_change_detection().0.as_mut()[source.point as usize].given +=
            row.frame.apply(force) * clock.part();
        push(row, force, &table, &mut forces);
        row.impulse = force * clock.part();
        // Beyond the slip speed friction falls to its kinetic value; below, it holds what it can.
        let slip = tangential(row.relative_velocity(&problem.bodies)).length();
        row.slip = if slip < contact.slip_speed { Slip::Sticking } else { Slip::Sliding };
        if let Some(books) = &mut books {
            books.count_friction(row, force);
        }
    }
}

/// Spring and damper of a pair: as given, or from Δt and restitution.
fn spring_damper<D: Geometry>(
    law: &SpringDamperSettings,
    pair: &ContactPair,
    row: &ContactRow<D>,
    bodies: &[SolverBody<D>],
    colliders: &Colliders<D>,
    dt: f64,
    notices: &mut Notices,
) -> SpringDamper {
    let [extent_a, extent_b] = pair.colliders.map(|collider| colliders.as_slice()[collider as usize].extent());
    let (a, b) = (&bodies[row.a as usize], &bodies[row.b as usize]);
    let bound = penalty::compliance_bound(a, extent_a, b, extent_b);
    let ratio = penalty::damping_ratio(pair.surface.restitution);
    let stiffness = law.stiffness.unwrap_or_else(|| penalty::default_stiffness(bound, ratio, dt));
    let compliance = row.normal_compliance(bodies);
    let damping = law.damping.unwrap_or_else(|| penalty::damping_coefficient(stiffness, compliance, ratio));
    // The damping ratio that this damping makes at the most yielding point of the pair.
    let frequency = (stiffness * bound).sqrt();
    let ratio = if frequency > 0.0 { 0.5 * damping * bound / frequency } else { 0.0 };
    let stable = penalty::stable_step(frequency, ratio);
    if dt > stable {
        notices.unstable_step(stable);
    }
    SpringDamper { stiffness, damping, slip_speed: law.slip_speed }
}

/// World positions of rod ends in the step before, by rank of the part: R9's finite differences need them.
#[derive(Resource, Debug)]
pub struct PreviousEnds<D: Geometry>(Vec<Option<[D::Vector; 2]>>);

impl<D: Geometry> Default for PreviousEnds<D> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<D: Geometry> PreviousEnds<D> {
    /// Forgets all ends: ranks have changed.
    pub(crate) fn forget(&mut self) {
        self.0.clear();
    }
}

/// Adds the homework's floor forces (R9): rod ends on half-planes, and nothing else.
pub fn apply_lecture_floor<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    colliders: Res<Colliders<D>>,
    detection: Res<Detection<D>>,
    mut previous: ResMut<PreviousEnds<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    table: Res<BodyTable>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    mut forces: Forces<D>,
) {
    let PenaltyLaw::Lecture { stiffness, viscosity } = settings.penalty.law else { return };
    let floor = LectureFloor { stiffness, viscosity };
    let list = colliders.as_slice();
    let ends_now: Vec<Option<[D::Vector; 2]>> = list
        .iter()
        .map(|part| {
            let pose = &detection.motions()[part.body as usize].pose;
            D::rod_ends(&part.shape).map(|ends| ends.map(|end| pose.transform_point(end)))
        })
        .collect();
    previous.0.resize(list.len(), None);

    let problem = &mut *problem;
    problem.gather_rows(&detection, &pairs, Points::Near);
    for (row, source) in problem.rows.iter().zip(&problem.sources) {
        let Ok((_, pair, _, mut memory)) = pairs.get_mut(source.entity) else { continue };
        let Some(rod) = rod_on_half_space::<D>(pair, list) else { continue };
        let body = list[rod].body;
        let motion = &detection.motions()[body as usize];
        let Some(ends) = ends_now[rod] else { continue };
        let point = motion.pose.position + if body == row.b { row.arm_b } else { row.arm_a };
        let k = usize::from((ends[1] - point).length() < (ends[0] - point).length());
        let velocity = match previous.0[rod] {
            Some(before) => (ends[k] - before[k]) * (1.0 / clock.part()),
            None => motion.velocity + D::spin(motion.angular_velocity, ends[k] - motion.pose.position),
        };
        // The contact frame describes b against a; the floor pushes the rod, whichever of the two it is.
        let side = if body == row.b { 1.0 } else { -1.0 };
        let in_frame = row.frame.apply_transposed(velocity * side);
        let force = penalty::lecture_force(row.separation, in_frame, &floor);
        memory.bypass_change_detection().0.as_mut()[source.point as usize].given +=
            row.frame.apply(force) * clock.part();
        let arm = ends[k] - motion.pose.position;
        push_at::<D>(arm, body, row.frame.apply(force) * side, &table, &mut forces);
        if let Some(books) = &mut books {
            let friction = row.frame.apply(tangential(force)) * side;
            let torque = D::torque(arm, friction);
            books.move_to(ForceLine::Friction, ForceLine::Contacts, body as usize, friction, torque);
        }
    }
    previous.0 = ends_now;
}

/// Rank of the rod, if one part of the pair is a rod and the other a half-space.
fn rod_on_half_space<D: Geometry>(pair: &ContactPair, list: &[super::Collider<D>]) -> Option<usize> {
    let [a, b] = pair.colliders.map(|collider| collider as usize);
    let unbounded = |i: usize| D::extent(&list[i].shape).is_none();
    let rod = |i: usize| D::rod_ends(&list[i].shape).is_some();
    if rod(a) && unbounded(b) {
        Some(a)
    } else if rod(b) && unbounded(a) {
        Some(b)
    } else {
        None
    }
}

type Forces<'w, 's, D> =
    Query<'w, 's, (&'static mut Force<<D as Dim>::Vector>, &'static mut Torque<<D as Dim>::Angular>)>;

/// Adds a force of the contact frame to b and its opposite to a.
fn push<D: Geometry>(row: &ContactRow<D>, force: D::Vector, table: &BodyTable, forces: &mut Forces<D>) {
    let force = row.frame.apply(force);
    push_at::<D>(row.arm_b, row.b, force, table, forces);
    push_at::<D>(row.arm_a, row.a, -force, table, forces);
}

/// Adds a world force at an arm of a body.
fn push_at<D: Geometry>(arm: D::Vector, body: u32, force: D::Vector, table: &BodyTable, forces: &mut Forces<D>) {
    if let Ok((mut sum, mut torque)) = forces.get_mut(table.entry(body).entity) {
        sum.bypass_change_detection().0 += force;
        torque.bypass_change_detection().0 += D::torque(arm, force);
    }
}
