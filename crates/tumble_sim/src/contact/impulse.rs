//! The impulse model's three systems: velocity filter, position filter, one-by-one impulses.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Matrix};
use tumble_solver::filter::{FilterSettings, filter_velocities as filter_slices};
use tumble_solver::impact::{Approach, ImpactSettings, resolve_one_by_one};
use tumble_solver::position::{Displacements, PositionSettings};
use tumble_solver::{ContactRow, Slip};

use super::problem::{BodyQuery, ContactProblem, ContactReport, PairQuery, Points, RowSource};
use super::Detection;
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::schedule::StepSystems;
use crate::settings::Integrator;
use crate::simulation::Beginning;
use crate::{Clock, Settings};

/// Displacements found by the position filter, for the positions that are about to be updated.
#[derive(Resource, Debug)]
pub struct PositionCorrections<D: Dim>(Displacements<D>);

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

/// Takes out of the velocities what touching contacts forbid; see [`tumble_solver::filter`].
pub fn filter_velocities<D: Geometry>(
    settings: Res<Settings<D>>,
    detection: Res<Detection<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut report: ResMut<ContactReport>,
    mut fault: ResMut<Fault>,
    mut pairs: PairQuery<D>,
    mut bodies: BodyQuery<D>,
) {
    let problem = &mut *problem;
    // The rows are those that `resolve_impulses` gathered when they were found.
    if problem.rows.is_empty() {
        return;
    }
    problem.gather_bodies(&bodies, detection.motions().len());
    problem.admit_resting(&settings);
    if problem.resting == 0 {
        return;
    }
    let filter = FilterSettings {
        iterations: settings.sweeps(problem.resting),
        tolerance: settings.impulse.tolerance * settings.length_scale,
    };
    let resting = &mut problem.rows[..problem.resting];
    report.add(filter_slices(&mut problem.bodies, resting, &mut problem.prepared, &filter));
    problem.scatter_bodies(&mut bodies, &mut fault, StepSystems::FilterVelocities);

    for (row, source) in problem.rows.iter().zip(&problem.sources).take(problem.resting) {
        if let Ok((.., mut memory)) = pairs.get_mut(source.entity) {
            let memory = &mut memory.bypass_change_detection().0.as_mut()[source.point as usize];
            (memory.impulse, memory.slip) = (row.impulse, row.slip);
            memory.given += row.frame.apply(row.impulse);
        }
    }
}

/// Finds the displacements that keep gaps from closing beyond touch and take out overlaps; see [`tumble_solver::position`].
pub fn filter_positions<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    mut corrections: ResMut<PositionCorrections<D>>,
    fault: Res<Fault>,
    mut pairs: PairQuery<D>,
    bodies: BodyQuery<D>,
) {
    let problem = &mut *problem;
    if problem.rows.is_empty() || !fault.is_none() {
        corrections.0.bodies.clear();
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
    corrections.0.find(&problem.bodies, &problem.rows, clock.dt, &filter);

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
    mut problem: ResMut<ContactProblem<D>>,
    mut report: ResMut<ContactReport>,
    mut fault: ResMut<Fault>,
    mut pairs: PairQuery<D>,
    mut bodies: BodyQuery<D>,
) {
    if !fault.is_none() {
        return;
    }
    let problem = &mut *problem;
    problem.gather_rows(&detection, &pairs, Points::Near, settings.touch_tolerance());
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
        Reading { dt: clock.dt, integrator: settings.integrator, touch_tolerance: settings.touch_tolerance() };
    let mut approaches: Vec<Approach> = rows
        .iter()
        .zip(sources)
        .map(|(row, source)| match *beginning {
            Beginning::No => {
                let approach = reading.approach(row, -row.separating_speed(&problem.bodies), source, &detection);
                Approach { threshold: threshold(row), ..approach }
            }
            Beginning::Yes => Approach::default(),
        })
        .collect();
    let solved = resolve_one_by_one(&mut problem.bodies, rows, &mut approaches, &mut problem.given, &impact);
    report.add(solved);
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

/// Whether a point slides after its impact.
fn slip_after<D: Geometry>(row: &ContactRow<D>, bodies: &[tumble_solver::SolverBody<D>], tolerance: f64) -> Slip {
    let slip = tumble_solver::contact::tangential(row.relative_velocity(bodies));
    if slip.length() > 10.0 * tolerance { Slip::Sliding } else { Slip::Sticking }
}

/// How to read the approach speed of a point at the end of a step.
struct Reading {
    dt: f64,
    integrator: Integrator,
    touch_tolerance: f64,
}

impl Reading {
    /// Corrects the approach speed of a point for the acceleration that its velocity contains.
    ///
    /// A point whose gap s closed within the step met the surface before the step ended, so its velocity has gained too much.
    /// Its speed at the surface follows from energy, with a_n the acceleration of the gap and v the velocity at the end:
    ///
    /// ```text
    /// w² = v₀² − 2 a_n s        v₀ = v − a_n Δt      ballistic
    ///                           v₀ = v − ½ a_n Δt    symplectic Euler, whose velocities run half a step ahead
    /// ```
    ///
    /// With it, ε = 1 keeps the (discrete) energy exactly. A point that touched before the step, or that the velocity filter held
    /// back in it, approaches by what solver and round-off left, which restitution does not answer.
    fn approach<D: Geometry>(
        &self,
        row: &ContactRow<D>,
        approach: f64,
        source: &RowSource,
        detection: &Detection<D>,
    ) -> Approach {
        let touched_before = source.separation_before.is_some_and(|separation| separation <= self.touch_tolerance);
        // A point with a gap that the velocity filter held back in this step rests too: its velocity has lost what forces added.
        if touched_before || source.held_back {
            let ignored = approach.max(0.0);
            return Approach { correction: -ignored, ignored, ..Approach::default() };
        }
        let gained = self.acceleration(row, detection) * self.dt;
        let (ahead, half_step) = match self.integrator {
            Integrator::SymplecticEuler => (0.5 * gained, (-0.5 * gained).max(0.0)),
            Integrator::Ballistic => (gained, 0.0),
        };
        let before = -approach - ahead;
        let at_surface = match source.separation_before {
            Some(gap) => (before * before - 2.0 * gained / self.dt * gap).max(0.0).sqrt(),
            // Nothing is known of the way here: it took the whole step.
            None => (-approach + gained - ahead).abs(),
        };
        Approach {
            correction: at_surface - approach,
            half_step,
            rest_below: (-0.5 * gained).max(0.0),
            ..Approach::default()
        }
    }

    /// Acceleration of the gap by the forces of the step [m/s²].
    fn acceleration<D: Geometry>(&self, row: &ContactRow<D>, detection: &Detection<D>) -> f64 {
        let of = |body: u32, arm: D::Vector| {
            let motion = &detection.motions()[body as usize];
            motion.acceleration + D::spin(motion.angular_acceleration, arm)
        };
        row.normal().dot(of(row.b, row.arm_b) - of(row.a, row.arm_a))
    }
}
