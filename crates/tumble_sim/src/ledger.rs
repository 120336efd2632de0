//! The books of a step: what each part of it did to the energy, and how well its contacts keep their conditions.
//!
//! Energy is E = K + V, with V of gravity and springs. A step changes it by
//!
//! ```text
//! ΔE = user + friction + impacts + joints + position correction + integrator defect + ledger error
//! ```
//!
//! where the work of gravity and of springs is on the books as well, but only moves energy between K and V. Every impulse λ on a row does the work
//! λ · ½ (u_before + u_after), with u the velocity of the row, exactly; every force f that acts for Δt does f · ½ (v_before + v_after) Δt.
//! The *integrator defect* is the difference between the work that gravity and springs did to the velocities and what the potential lost by the moves: symplectic
//! Euler moves with v₁ and not with ½ (v₀ + v₁). What is left is the ledger error: round-off.

use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};
use tumble_math::{Dim, Inertia, Linear, Pose, Rotation};
use tumble_solver::contact::tangential;
use tumble_solver::joint::JointRow;
use tumble_solver::{ContactRow, Ending, Slip, SolverBody};

use crate::body::{
    AngularVelocity, BodyIndex, BodyInertia, BodyKind, BodyTable, Force, InDim, LinearVelocity, Mass, Orientation,
    Position, Torque,
};
use crate::contact::{BodyQuery, ContactProblem, ContactReport, PositionCorrections};
use crate::force::{Anchor, GravityScale, Spring, spring_potential};
use crate::geometry::Geometry;
use crate::{Clock, Settings};

/// Work and violations of the last step. Filled where [`Simulation::keep_ledger`](crate::Simulation::keep_ledger) was called.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Largest speed at which a contact that touches still closes after the step [m/s].
    pub normal_violation: f64,
    /// Largest slip of a point that sticks after the step [m/s]; under the penalty model up to the slip speed, at which friction is full.
    pub tangent_violation: f64,
    /// Work of gravity [J].
    pub work_gravity: f64,
    /// Work of springs, without their dampers [J].
    pub work_springs: f64,
    /// Work of drag, dampers, applied forces and the user's forces [J].
    pub work_user: f64,
    /// Work of friction at contacts [J].
    pub work_friction: f64,
    /// Work along the normals of contacts: impacts, penalty springs [J].
    pub work_impacts: f64,
    /// Work of joints [J].
    pub work_joints: f64,
    /// Potential energy that displacements of the position filter gave [J].
    pub work_position_correction: f64,
    /// What moving with the velocities of the scheme gives besides [J].
    pub integrator_defect: f64,
    /// What no line of the books explains: round-off [J].
    #[serde(rename = "ledger_error")]
    pub error: f64,
    /// Contact points that push and stick.
    pub sticking: u32,
    /// Contact points that push and slide.
    pub sliding: u32,
    /// How the contact solver ended; `None` where nothing was solved.
    pub solver_end: Option<Ending>,
}

impl Ledger {
    /// This and the part of the step after it.
    fn joined(&self, next: &Self) -> Self {
        Self {
            normal_violation: self.normal_violation.max(next.normal_violation),
            tangent_violation: self.tangent_violation.max(next.tangent_violation),
            work_gravity: self.work_gravity + next.work_gravity,
            work_springs: self.work_springs + next.work_springs,
            work_user: self.work_user + next.work_user,
            work_friction: self.work_friction + next.work_friction,
            work_impacts: self.work_impacts + next.work_impacts,
            work_joints: self.work_joints + next.work_joints,
            work_position_correction: self.work_position_correction + next.work_position_correction,
            integrator_defect: self.integrator_defect + next.integrator_defect,
            error: self.error + next.error,
            ..*next
        }
    }
}

/// Force and torque on a body.
type Wrench<D> = (<D as Dim>::Vector, <D as Dim>::Angular);

/// Kinds of force that the books tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceLine {
    /// Gravity.
    Gravity,
    /// Springs without their dampers.
    Springs,
    /// Drag, dampers, applied forces, forces of the user's.
    User,
    /// Springs of the penalty model's joints.
    Joints,
    /// Contact forces along normals.
    Contacts,
    /// Contact forces along surfaces.
    Friction,
}

const LINES: usize = 6;

/// What the ledger of a step is computed from.
#[derive(Resource, Clone, Debug)]
pub struct Books<D: Geometry> {
    energy: f64,
    potential: f64,
    /// Kinetic energy when it was last looked at [J].
    kinetic: f64,
    /// Sum of all forces when it was last looked at, by rank.
    known: Vec<Wrench<D>>,
    lines: [Vec<Wrench<D>>; LINES],
    /// Velocities before the forces act.
    before: Vec<Wrench<D>>,
    ledger: Ledger,
}

impl<D: Geometry> Default for Books<D> {
    fn default() -> Self {
        Self {
            energy: 0.0,
            potential: 0.0,
            kinetic: 0.0,
            known: Vec::new(),
            lines: Default::default(),
            before: Vec::new(),
            ledger: Ledger::default(),
        }
    }
}

const NOTHING: &str = "bodies keep their ranks within a step";

impl<D: Geometry> Books<D> {
    /// Moves a force from the line that it would be counted under to another: dampers are no springs, friction is no normal force.
    pub(crate) fn move_to(
        &mut self,
        line: ForceLine,
        from: ForceLine,
        body: usize,
        force: D::Vector,
        torque: D::Angular,
    ) {
        for (line, sign) in [(line, 1.0), (from, -1.0)] {
            let entry = self.lines[line as usize].get_mut(body).expect(NOTHING);
            entry.0 += force * sign;
            entry.1 += torque * sign;
        }
    }

    /// Counts the work of impulses on contact rows and joints that took bodies from one set of velocities to another.
    pub(crate) fn count_impulses(
        &mut self,
        rows: &[ContactRow<D>],
        impulses: impl Iterator<Item = D::Vector>,
        joints: &[JointRow<D>],
        before: &[SolverBody<D>],
        after: &[SolverBody<D>],
    ) {
        let mean = |body: u32| {
            let (before, after) = (&before[body as usize], &after[body as usize]);
            SolverBody::<D> {
                velocity: (before.velocity + after.velocity) * 0.5,
                angular_velocity: (before.angular_velocity + after.angular_velocity) * 0.5,
                ..*after
            }
        };
        // The side of a body that nothing moves does no work on the books: it is not part of the energy.
        let moves =
            |body: &SolverBody<D>| body.inverse_mass != D::Vector::ZERO || body.inverse_inertia != D::Inertia::ZERO;
        for (row, impulse) in rows.iter().zip(impulses) {
            let along = |impulse: D::Vector| {
                let world = tumble_math::Matrix::apply(&row.frame, impulse);
                let mut work = 0.0;
                for (body, arm, sign) in [(row.a, row.arm_a, -1.0), (row.b, row.arm_b, 1.0)] {
                    let body = mean(body);
                    if moves(&body) {
                        work += sign * world.dot(body.point_velocity(arm));
                    }
                }
                work
            };
            let friction = along(tangential(impulse));
            self.ledger.work_friction += friction;
            self.ledger.work_impacts += along(impulse) - friction;
        }
        for row in joints {
            for (body, angular, sign) in [(row.a, row.angular_a, -1.0), (row.b, row.angular_b, 1.0)] {
                let body = mean(body);
                if moves(&body) {
                    let rate = row.linear.dot(body.velocity) + angular.dot(body.angular_velocity);
                    self.ledger.work_joints += sign * row.impulse * rate;
                }
            }
        }
    }
}

impl<D: Geometry> Books<D> {
    /// Counts what turning a body did to its kinetic energy, though L is kept: the rotation of a step is of second order.
    pub(crate) fn count_turn(&mut self, gained: f64) {
        self.ledger.integrator_defect += gained;
    }

    /// Counts the work of what stands sticking points still after resting forces, as friction's.
    pub(crate) fn count_leftovers(&mut self, rows: &[JointRow<D>], before: &[SolverBody<D>], after: &[SolverBody<D>]) {
        let joints = self.ledger.work_joints;
        self.count_impulses(&[], std::iter::empty(), rows, before, after);
        self.ledger.work_friction += std::mem::replace(&mut self.ledger.work_joints, joints) - joints;
    }

    /// Counts the friction of a contact force, which is otherwise booked as a whole.
    pub(crate) fn count_friction(&mut self, row: &ContactRow<D>, force: D::Vector) {
        let world = tumble_math::Matrix::apply(&row.frame, tangential(force));
        for (body, arm, world) in [(row.a, row.arm_a, -world), (row.b, row.arm_b, world)] {
            self.move_to(ForceLine::Friction, ForceLine::Contacts, body as usize, world, D::torque(arm, world));
        }
    }
}

type StateQuery<'w, 's, D> = Query<
    'w,
    's,
    (
        &'static BodyIndex,
        &'static BodyKind,
        &'static Position<<D as Dim>::Vector>,
        &'static Orientation<<D as Dim>::Rotation>,
        &'static LinearVelocity<<D as Dim>::Vector>,
        &'static AngularVelocity<<D as Dim>::Angular>,
        &'static Mass,
        &'static BodyInertia<<D as Dim>::Inertia>,
        Option<&'static GravityScale>,
    ),
>;

/// ½ m v² + ½ ω · I ω of the bodies that forces move [J].
fn kinetic<D: Geometry>(bodies: &StateQuery<D>) -> f64 {
    let mut sum = 0.0;
    for (_, kind, _, orientation, v, w, mass, inertia, _) in bodies {
        if *kind == BodyKind::Dynamic {
            sum += 0.5 * (mass.0 * v.0.dot(v.0) + w.0.dot(inertia.0.in_world(&orientation.0).apply(w.0)));
        }
    }
    sum
}

/// Potential of gravity and springs, each body displaced by what `back` says [J].
fn potential<D: Geometry>(
    gravity: D::Vector,
    bodies: &StateQuery<D>,
    springs: &Query<&Spring<D::Vector>>,
    back: impl Fn(u32) -> Option<(D::Vector, D::Angular)>,
) -> f64 {
    let pose = |index: u32, x: D::Vector, rotation: D::Rotation| {
        let (shift, turn) = back(index).unwrap_or((D::Vector::ZERO, D::Angular::ZERO));
        Pose::<D> { position: x - shift, rotation: rotation.turned(-turn) }
    };
    let mut sum = 0.0;
    for (index, kind, x, orientation, _, _, mass, _, scale) in bodies {
        if *kind == BodyKind::Dynamic {
            let scale = scale.map_or(1.0, |scale| scale.0);
            sum -= mass.0 * scale * gravity.dot(pose(index.0, x.0, orientation.0).position);
        }
    }
    let point = |anchor: &Anchor<D::Vector>| match *anchor {
        Anchor::World(point) => Some(point),
        Anchor::Body(entity, point) => bodies
            .get(entity)
            .ok()
            .map(|(index, _, x, orientation, ..)| pose(index.0, x.0, orientation.0).transform_point(point)),
    };
    for spring in springs {
        if let (Some(a), Some(b)) = (point(&spring.a), point(&spring.b)) {
            sum += spring_potential(spring.stiffness, spring.rest_length, a, b);
        }
    }
    sum
}

/// Opens the books: the energy before anything happens.
pub(crate) fn open<D: Geometry>(
    settings: Res<Settings<D>>,
    table: Res<BodyTable>,
    mut books: ResMut<Books<D>>,
    bodies: StateQuery<D>,
    springs: Query<&Spring<D::Vector>>,
) {
    let books = &mut *books;
    books.ledger = Ledger::default();
    books.kinetic = kinetic::<D>(&bodies);
    books.potential = potential::<D>(settings.gravity, &bodies, &springs, |_| None);
    books.energy = books.kinetic + books.potential;
    let nothing = (D::Vector::ZERO, D::Angular::ZERO);
    for list in books.lines.iter_mut().chain([&mut books.known, &mut books.before]) {
        list.clear();
        list.resize(table.entries().len(), nothing);
    }
}

/// Books what forces have been added since the last look under a line.
pub(crate) fn book_forces<D: Dim<Vector: InDim> + Geometry, const LINE: usize>(
    mut books: ResMut<Books<D>>,
    forces: Query<(&BodyIndex, &Force<D::Vector>, &Torque<D::Angular>)>,
) {
    let books = &mut *books;
    for (index, force, torque) in &forces {
        let rank = index.0 as usize;
        let known = &mut books.known[rank];
        let added = (force.0 - known.0, torque.0 - known.1);
        *known = (force.0, torque.0);
        let entry = &mut books.lines[LINE][rank];
        entry.0 += added.0;
        entry.1 += added.1;
    }
}

/// Looks at the velocities before forces act: what the scheme did to them first is its own.
pub(crate) fn before_forces<D: Geometry>(mut books: ResMut<Books<D>>, bodies: StateQuery<D>) {
    let books = &mut *books;
    let now = kinetic::<D>(&bodies);
    books.ledger.integrator_defect += now - books.kinetic;
    for (index, _, _, _, v, w, ..) in &bodies {
        books.before[index.0 as usize] = (v.0, w.0);
    }
}

/// Looks at the kinetic energy before joints act on their own.
pub(crate) fn before_joints<D: Geometry>(mut books: ResMut<Books<D>>, bodies: StateQuery<D>) {
    books.kinetic = kinetic::<D>(&bodies);
}

/// Counts what joints have done since.
pub(crate) fn after_joints<D: Geometry>(mut books: ResMut<Books<D>>, bodies: StateQuery<D>) {
    let books = &mut *books;
    books.ledger.work_joints += kinetic::<D>(&bodies) - books.kinetic;
}

/// Counts the work of the forces, now that velocities have taken them in.
pub(crate) fn after_forces<D: Geometry>(clock: Res<Clock>, mut books: ResMut<Books<D>>, bodies: StateQuery<D>) {
    let books = &mut *books;
    let mut work = [0.0; LINES];
    for (index, kind, _, _, v, w, ..) in &bodies {
        if *kind != BodyKind::Dynamic {
            continue;
        }
        let rank = index.0 as usize;
        let (v0, w0) = books.before[rank];
        let (v, w) = ((v0 + v.0) * 0.5, (w0 + w.0) * 0.5);
        for (work, line) in work.iter_mut().zip(&books.lines) {
            *work += (line[rank].0.dot(v) + line[rank].1.dot(w)) * clock.part();
        }
    }
    let [gravity, springs, user, joints, contacts, friction] = work;
    let ledger = &mut books.ledger;
    (ledger.work_gravity, ledger.work_springs, ledger.work_user) = (gravity, springs, user);
    ledger.work_joints += joints;
    ledger.work_impacts += contacts;
    ledger.work_friction += friction;
}

/// Looks at how contacts keep their conditions, once velocities are filtered.
pub(crate) fn look_at_contacts<D: Geometry>(
    settings: Res<Settings<D>>,
    mut books: ResMut<Books<D>>,
    mut problem: ResMut<ContactProblem<D>>,
    table: Res<BodyTable>,
    bodies: BodyQuery<D>,
) {
    let ledger = &mut books.ledger;
    let (rows, held) = problem.gathered(&bodies, table.entries().len());
    let still = settings.touch_tolerance();
    for row in rows {
        let velocity = row.relative_velocity(held);
        ledger.normal_violation = ledger.normal_violation.max(-velocity[0] - row.allowance);
        if row.impulse[0] <= 0.0 {
            continue;
        }
        // A point that stuck so far and slips though it pushes with all of μ_s breaks away in this step.
        let slip = tangential(velocity).length();
        let bound = row.surface.static_friction * row.impulse[0];
        let breaks_away = slip > still && tangential(row.impulse).length() >= bound * (1.0 - 1e-9);
        if row.slip == Slip::Sliding || breaks_away {
            ledger.sliding += 1;
        } else {
            ledger.sticking += 1;
            ledger.tangent_violation = ledger.tangent_violation.max(slip);
        }
    }
}

/// Counts what the moves did to the potential.
pub(crate) fn after_moves<D: Geometry>(
    settings: Res<Settings<D>>,
    corrections: Res<PositionCorrections<D>>,
    mut books: ResMut<Books<D>>,
    bodies: StateQuery<D>,
    springs: Query<&Spring<D::Vector>>,
) {
    let books = &mut *books;
    let moved = potential::<D>(settings.gravity, &bodies, &springs, |_| None);
    let without = potential::<D>(settings.gravity, &bodies, &springs, |index| corrections.of(index));
    let ledger = &mut books.ledger;
    ledger.work_position_correction = moved - without;
    ledger.integrator_defect += without - books.potential + ledger.work_gravity + ledger.work_springs;
    books.potential = moved;
}

/// Closes the books of a part of the step.
pub(crate) fn close<D: Geometry>(
    clock: Res<Clock>,
    report: Res<ContactReport>,
    mut books: ResMut<Books<D>>,
    mut ledger: ResMut<Ledger>,
    bodies: StateQuery<D>,
) {
    let gained = kinetic::<D>(&bodies) + books.potential - books.energy;
    let before = if clock.at_start_of_step() { Ledger::default() } else { *ledger };
    let lines = &mut books.ledger;
    let booked = lines.work_user + lines.work_friction + lines.work_impacts + lines.work_joints;
    lines.error = gained - booked - lines.work_position_correction - lines.integrator_defect;
    lines.solver_end = report.solved.map(|solved| solved.ending);
    *ledger = before.joined(lines);
}
