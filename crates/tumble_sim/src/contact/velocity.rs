//! The systems of the models that answer contacts by velocities: velocity filter, position filter, impacts.
//!
//! They gather rows, let the model of the scene solve them, and scatter what it found. The models themselves are in `tumble_solver`.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Matrix};
use tumble_solver::filter::{FilterSettings, filter_velocities as filter_slices, filter_velocities_and_joints};
use tumble_solver::impact::{Approach, ImpactSettings, resolve_one_by_one, resolve_one_by_one_with_joints};
use tumble_solver::position::{Displacements, PositionSettings};
use tumble_solver::velocity_lcp::{Rebound, VelocityLcp};
use tumble_solver::{ContactRow, Slip, SolverBody};

use super::approach::{Reading, at_impact};
use super::found::Points;
use super::problem::{BodyQuery, ContactProblem, ContactReport, PairQuery};
use super::{Detection, RestingModel};
use crate::body::BodyTable;
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::joint::{JointProblem, JointTable, joint_tolerance};
use crate::ledger::Books;
use crate::schedule::StepSystems;
use crate::settings::ContactModel;
use crate::simulation::Beginning;
use crate::{Clock, Settings};

/// Displacements found by the position filter, for the positions that are about to be updated.
#[derive(Resource, Debug)]
pub struct PositionCorrections<D: Dim>(pub(super) Displacements<D>);

impl<D: Dim> Default for PositionCorrections<D> {
    fn default() -> Self {
        Self(Displacements::default())
    }
}

impl<D: Dim> PositionCorrections<D> {
    /// Displacement [m] and turn [rad] of a body; `None` where nothing is displaced.
    pub fn of(&self, index: u32) -> Option<(D::Vector, D::Angular)> {
        self.0.bodies.get(index as usize).map(|body| (body.velocity, body.angular_velocity))
    }
}

/// The velocity model with its scratch space.
#[derive(Resource, Debug)]
pub struct VelocityModel<D: Dim>(VelocityLcp<D>, Vec<Rebound>);

impl<D: Dim> Default for VelocityModel<D> {
    fn default() -> Self {
        Self(VelocityLcp::default(), Vec::new())
    }
}

/// Takes out of the velocities what touching contacts and joints forbid; see [`tumble_solver::filter`] and [`tumble_solver::velocity_lcp`].
pub fn filter_velocities<D: Geometry>(
    settings: Res<Settings<D>>,
    table: Res<BodyTable>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut model: ResMut<VelocityModel<D>>,
    mut resting_model: ResMut<RestingModel<D>>,
    mut report: ResMut<ContactReport>,
    mut fault: ResMut<Fault>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    mut bodies: BodyQuery<D>,
) {
    let problem = &mut *problem;
    // The rows are those that `resolve_impulses` gathered when they were found.
    if problem.rows.is_empty() && joint_table.entries().is_empty() {
        return;
    }
    problem.gather_bodies(&bodies, table.entries().len());
    joints.build(&joint_table, ContactProblem::poses(&bodies), &problem.bodies);
    problem.admit_resting(&settings, &bodies);
    if problem.resting == 0 && joints.is_empty() {
        return;
    }
    let before = books.as_ref().map(|_| problem.bodies.clone());
    // Forces of resting contacts were counted as such when they were found.
    let counted = settings.contact == ContactModel::RestingLcp && !resting_model.unsolved;
    let resting = &mut problem.rows[..problem.resting];
    match settings.contact {
        ContactModel::VelocityLcp => {
            let velocity = settings.velocity();
            report.add_velocity(&model.0.filter(&mut problem.bodies, resting, joints.as_joints(), &velocity));
        }
        ContactModel::RestingLcp if counted => {
            resting_model.stop_leftover(&mut problem.bodies, joints.rows_mut());
        }
        ContactModel::RestingLcp => {
            resting.iter_mut().for_each(|row| row.impulse = D::Vector::ZERO);
            let velocity = settings.velocity();
            report.add_velocity(&model.0.filter(&mut problem.bodies, resting, joints.as_joints(), &velocity));
        }
        _ => {
            let filter = FilterSettings {
                iterations: settings.sweeps(problem.resting),
                tolerance: settings.impulse.tolerance * settings.length_scale,
            };
            let (bodies, prepared) = (&mut problem.bodies, &mut problem.prepared);
            report.add(match joints.as_joints() {
                None => filter_slices(bodies, resting, prepared, &filter),
                Some(joints) => filter_velocities_and_joints(bodies, resting, joints, prepared, &filter),
            });
        }
    }
    if let (Some(books), Some(before)) = (&mut books, &before) {
        let resting = &problem.rows[..if counted { 0 } else { problem.resting }];
        books.count_impulses(resting, resting.iter().map(|row| row.impulse), joints.rows(), before, &problem.bodies);
        if counted {
            books.count_leftovers(resting_model.leftovers(), before, &problem.bodies);
        }
    }
    joints.collect_impulses();
    problem.scatter_bodies(&mut bodies, &mut fault, StepSystems::FilterVelocities);
    if counted {
        return;
    }
    for (row, source) in problem.rows.iter().zip(&problem.sources).take(problem.resting) {
        if let Ok((.., mut memory)) = pairs.get_mut(source.entity) {
            let memory = &mut memory.bypass_change_detection().0.as_mut()[source.point as usize];
            (memory.impulse, memory.slip) = (row.impulse, row.slip);
            memory.pending += row.frame.apply(row.impulse);
        }
    }
}

/// Finds the displacements that keep gaps from closing beyond touch and take out overlaps; see [`tumble_solver::position`].
pub fn filter_positions<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut corrections: ResMut<PositionCorrections<D>>,
    fault: Res<Fault>,
    mut pairs: PairQuery<D>,
    bodies: BodyQuery<D>,
) {
    let problem = &mut *problem;
    corrections.0.bodies.clear();
    if problem.rows.is_empty() && joints.is_empty() || !fault.is_none() {
        return;
    }
    // Users may have changed velocities since they were filtered.
    problem.gather_mean_velocities(&bodies);
    let filter = PositionSettings {
        iterations: settings.position_sweeps(problem.rows.len()),
        tolerance: settings.impulse.tolerance * settings.length_scale,
        slop: settings.slop(),
        recovery: settings.impulse.recovery,
    };
    corrections.0.find(&problem.bodies, &problem.rows, clock.part(), &filter);
    if !joints.is_empty() {
        if corrections.0.bodies.is_empty() {
            corrections.0.begin(&problem.bodies);
        }
        let (displaced, tolerance) = (&mut corrections.0.bodies, joint_tolerance(&settings));
        joints.mend(&joint_table, displaced, &problem.bodies, clock.part(), tolerance);
    }

    for (i, source) in problem.sources.iter().enumerate() {
        let held = corrections.0.holds(i);
        if held != source.held
            && let Ok((.., mut memory)) = pairs.get_mut(source.entity)
        {
            memory.bypass_change_detection().0.as_mut()[source.point as usize].held = held;
        }
    }
}

/// Lets colliding contacts bounce; see [`tumble_solver::impact`].
pub fn resolve_impulses<D: Geometry>(
    clock: Res<Clock>,
    beginning: Res<Beginning>,
    settings: Res<Settings<D>>,
    detection: Res<Detection<D>>,
    joint_table: Res<JointTable<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut model: ResMut<VelocityModel<D>>,
    mut report: ResMut<ContactReport>,
    mut fault: ResMut<Fault>,
    mut books: Option<ResMut<Books<D>>>,
    mut pairs: PairQuery<D>,
    mut bodies: BodyQuery<D>,
) {
    if !fault.is_none() {
        return;
    }
    let problem = &mut *problem;
    problem.gather_rows(&detection, &pairs, Points::Near);
    if problem.touching == 0 {
        return;
    }
    problem.gather_bodies(&bodies, detection.motions().len());
    let (rows, sources) = (&mut problem.rows[..problem.touching], &problem.sources[..problem.touching]);
    let impact = ImpactSettings {
        colliding_above: settings.colliding_above(),
        impulses_per_contact: settings.impulses_per_contact(rows.len()),
    };
    let colliding = |row: &ContactRow<D>| -row.separating_speed(&problem.bodies) > impact.colliding_above;
    if !rows.iter().any(colliding) {
        return;
    }

    // Slower approaches than this are left to the velocity filter of the next step, which stops all of them at once.
    let threshold = |row: &ContactRow<D>| match (settings.impulse.colliding_above, row.surface.restitution) {
        (Some(_), _) => 0.0,
        (None, 0.0) => 0.5 * settings.gravity.length() * settings.dt,
        (None, _) => 0.02 * settings.rest_speed(row.normal()),
    };
    let reading =
        Reading { dt: clock.part(), integrator: settings.moves_by(), touch_tolerance: settings.touch_tolerance() };
    let mut approaches: Vec<Approach> = rows
        .iter()
        .zip(sources)
        .map(|(row, source)| match *beginning {
            Beginning::No if settings.cuts_at_impacts() => {
                at_impact(-row.separating_speed(&problem.bodies), source, settings.rest_speed(row.normal()))
            }
            Beginning::No => {
                let approach = reading.approach(row, -row.separating_speed(&problem.bodies), source, &detection);
                Approach { threshold: threshold(row), ..approach }
            }
            Beginning::Yes => Approach::default(),
        })
        .collect();
    joints.build(&joint_table, ContactProblem::poses(&bodies), &problem.bodies);
    let before = books.as_ref().map(|_| problem.bodies.clone());
    match settings.contact {
        ContactModel::VelocityLcp => {
            let collides = |(row, approach): (&ContactRow<D>, &Approach)| {
                -row.separating_speed(&problem.bodies) > impact.colliding_above + approach.ignored + approach.threshold
            };
            if !rows.iter().zip(&approaches).any(collides) {
                return;
            }
            let VelocityModel(lcp, rebounds) = &mut *model;
            rebounds.clear();
            rebounds
                .extend(rows.iter().zip(&approaches).map(|(row, approach)| rebound(row, approach, &problem.bodies)));
            let (bodies, given) = (&mut problem.bodies, &mut problem.given);
            let velocity = settings.velocity();
            report.add_velocity(&lcp.impact(bodies, rows, rebounds, given, joints.as_joints(), &velocity));
        }
        _ => {
            let (bodies, given) = (&mut problem.bodies, &mut problem.given);
            report.add(match joints.as_joints() {
                None => resolve_one_by_one(bodies, rows, &mut approaches, given, &impact),
                Some(joints) => resolve_one_by_one_with_joints(bodies, rows, &mut approaches, given, joints, &impact),
            });
        }
    }
    if let (Some(books), Some(before)) = (&mut books, &before) {
        books.count_impulses(rows, problem.given.iter().copied(), joints.rows(), before, &problem.bodies);
    }
    joints.collect_impulses();
    let slip_tolerance = settings.impulse.tolerance * settings.length_scale;
    for ((row, source), given) in rows.iter_mut().zip(sources).zip(&problem.given) {
        if *given != D::Vector::ZERO
            && let Ok((.., mut memory)) = pairs.get_mut(source.entity)
        {
            let memory = &mut memory.bypass_change_detection().0.as_mut()[source.point as usize];
            memory.given += row.frame.apply(*given);
            row.slip = slip_after(row, &problem.bodies, slip_tolerance);
            memory.slip = row.slip;
        }
    }
    problem.scatter_bodies(&mut bodies, &mut fault, StepSystems::ResolveImpulses);
}

/// What a contact gives back, with its approach speed as it was when it met the surface.
///
/// Poisson's ratio is set such that a contact hit alone separates with the speed that Newton's law gives it.
fn rebound<D: Geometry>(row: &ContactRow<D>, reading: &Approach, bodies: &[SolverBody<D>]) -> Rebound {
    let approach = -row.separating_speed(bodies);
    let speed = row.surface.restitution * (approach + reading.correction).max(0.0);
    let speed = if speed > reading.rest_below { speed + reading.half_step } else { 0.0 };
    // A contact at rest gives back what the others do to it.
    if approach <= reading.ignored {
        return Rebound { restitution: row.surface.restitution, speed, ..Rebound::default() };
    }
    let restitution = speed / approach;
    let law = row.surface.restitution;
    Rebound { restitution, reading: if law > 0.0 { restitution / law } else { 1.0 }, speed }
}

/// Whether a point slides after its impact.
fn slip_after<D: Geometry>(row: &ContactRow<D>, bodies: &[SolverBody<D>], tolerance: f64) -> Slip {
    let slip = tumble_solver::contact::tangential(row.relative_velocity(bodies));
    if slip.length() > 10.0 * tolerance { Slip::Sliding } else { Slip::Sticking }
}
