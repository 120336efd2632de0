//! The system of the soft-step model; see [`tumble_solver::soft_step`].

use std::sync::atomic::{AtomicBool, Ordering};

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Matrix};
use tumble_solver::soft_step::{Colours, PairColour, Places, SoftOutcome, SoftPair, SoftPoint, SoftStep, Width};
use tumble_solver::{ContactRow, SolverBody};
use tumble_team::Team;

use super::problem::{BodyQuery, ContactProblem, ContactReport, RowSource};
use super::{ContactManifold, ContactMemory, ContactPair, Detection, IN_TABLES, PositionCorrections};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, InverseInertia, InverseMass,
    LinearVelocity, Orientation, Position,
};
use crate::fault::{Fault, Quantity};
use crate::geometry::Geometry;
use crate::joint::{JointProblem, JointTable, joint_tolerance};
use crate::ledger::Books;
use crate::part::Response;
use crate::rest::Awake;
use crate::schedule::StepSystems;
use crate::threads::{PAIRS_OF_A_TASK, Threads};
use crate::{Clock, Settings};

/// The soft-step model with its scratch space.
#[derive(Resource, Debug)]
pub struct SoftModel<D: Geometry> {
    model: SoftStep<D>,
    /// Pairs that act, or begin to: in the order of their rows.
    acting: Vec<Acting>,
    /// Those of them that begin to act, and those that are solved one by one, in the order of their parts.
    beginning: Vec<u32>,
    /// Whether a contact pushed a body in this step, by rank.
    pushed: Vec<AtomicBool>,
}

impl<D: Geometry> Default for SoftModel<D> {
    fn default() -> Self {
        Self { model: SoftStep::default(), acting: Vec::new(), beginning: Vec::new(), pushed: Vec::new() }
    }
}

impl<D: Geometry> SoftModel<D> {
    /// Chooses how the kernels run: all ways give the same bits.
    pub fn set_width(&mut self, width: Width) {
        self.model.width = width;
    }

    /// The colours of pairs.
    pub(super) fn colours(&mut self) -> &mut Colours {
        self.model.colours()
    }
}

/// A pair that acts.
#[derive(Clone, Copy, Debug)]
struct Acting {
    /// Its place among all pairs.
    row: u32,
    parts: [u32; 2],
    bodies: [u32; 2],
    points: u8,
    colour: PairColour,
}

/// Slower approaches than gravity makes in this many steps do not rebound: they are rest [1].
const REST_STEPS: f64 = 2.0;

type SoftPairs<'w, 's, D> = Query<
    'w,
    's,
    (Entity, &'static mut ContactPair, &'static ContactManifold<D>, &'static mut ContactMemory<D>),
    Awake,
>;

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
    Awake,
>;

/// Takes the substeps: contacts and joints change the velocities, and what else they displace is left for the move.
pub fn take_soft_steps<D: Geometry>(
    (clock, settings, threads): (Res<Clock>, Res<Settings<D>>, Res<Threads>),
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
    mut pairs: SoftPairs<D>,
    mut bodies: SoftBodies<D>,
) {
    if !fault.is_none() {
        return;
    }
    let (dt, team) = (clock.part(), threads.team());
    let (how, substep) = (&settings.soft_step, dt / f64::from(settings.soft_step.substeps));
    let SoftModel { model, acting, beginning, pushed } = &mut *soft;
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

    acting.clear();
    let mut row = 0;
    for (_, pairs, ..) in pairs.contiguous_iter_mut().expect(IN_TABLES) {
        for pair in ContiguousMut::split(pairs).0 {
            if pair.acts && pair.response == Response::Solid {
                let ContactPair { colliders, bodies, points, colour, .. } = *pair;
                acting.push(Acting { row, parts: colliders, bodies, points, colour });
            } else if model.colours().know(pair.colour) {
                model.colours().release(pair.bodies, pair.colour);
                pair.colour = PairColour::NONE;
            }
            row += 1;
        }
    }
    colour_pairs(model, acting, beginning, row as usize);
    let acts = !acting.is_empty();
    model.lay_out(team);
    model.fill(team, |places| fill_places(places, &pairs, &detection, &settings));
    joints.build(
        &joint_table,
        bodies.iter().map(|(index, .., orientation, position)| {
            (index.0, tumble_math::Pose { position: position.0, rotation: orientation.0 })
        }),
        &problem.bodies,
    );
    problem.forget_rows();
    corrections.0.bodies.clear();
    if !acts && joints.is_empty() {
        return;
    }
    report.add(model.solve(team, dt, settings.gravity.length(), how, joints.as_joints(), &mut problem.bodies));

    pushed.resize_with(problem.bodies.len(), AtomicBool::default);
    pushed.iter_mut().for_each(|pushed| *pushed.get_mut() = false);
    let pushed = &*pushed;
    remember_outcomes(model, team, &mut pairs, pushed);
    if books.is_some() {
        note_rows(problem, model, &detection, &pairs, substep);
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
        let (dv, dw) = model.change(index.0);
        velocity.bypass_change_detection().0 += dv;
        spin.bypass_change_detection().0 += dw;
        let mut finite = dv.is_finite() && dw.is_finite();
        if pushed[index.0 as usize].load(Ordering::Relaxed) {
            let (dx, turn) = model.displacement(index.0);
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

/// Gives a colour to every pair that begins to act, in the order of their parts, and announces all of them.
fn colour_pairs<D: Geometry>(model: &mut SoftStep<D>, acting: &mut [Acting], beginning: &mut Vec<u32>, rows: usize) {
    beginning.clear();
    beginning.extend((0..acting.len() as u32).filter(|k| !model.colours().know(acting[*k as usize].colour)));
    beginning.sort_unstable_by_key(|k| acting[*k as usize].parts);
    for k in &*beginning {
        let pair = &mut acting[*k as usize];
        pair.colour = model.colours().choose(pair.bodies);
    }
    model.expect(rows);
    beginning.clear();
    for (k, pair) in acting.iter().enumerate() {
        if pair.colour.shares_bodies() {
            beginning.push(k as u32);
        } else {
            model.announce(pair.row as usize, pair.points as usize, pair.colour);
        }
    }
    beginning.sort_unstable_by_key(|k| acting[*k as usize].parts);
    for pair in beginning.iter().map(|k| &acting[*k as usize]) {
        model.announce(pair.row as usize, pair.points as usize, pair.colour);
    }
}

/// Fills those places of a thread that have a pair.
fn fill_places<D: Geometry>(
    places: &mut Places<D>,
    pairs: &SoftPairs<D>,
    detection: &Detection<D>,
    settings: &Settings<D>,
) {
    let tables = pairs.contiguous_iter().expect(IN_TABLES);
    let all = tables.flat_map(|(_, pairs, manifolds, memory)| pairs.iter().zip(manifolds).zip(memory));
    for (number, ((pair, manifold), memory)) in all.enumerate() {
        if !places.want(number) {
            continue;
        }
        let [a, b] = pair.bodies;
        let [at_a, at_b] = pair.bodies.map(|body| detection.motions()[body as usize].pose.position);
        let found = D::points(&manifold.0);
        let mut points = D::PerPoint::<SoftPoint<D>>::default();
        for ((soft, point), memory) in points.as_mut().iter_mut().zip(found).zip(memory.0.as_ref()) {
            *soft = SoftPoint {
                arm_a: point.point - at_a,
                arm_b: point.point - at_b,
                separation: point.separation,
                impulse: memory.impulse,
                slip: memory.slip,
            };
        }
        let (normal, surface, points) = (D::normal(&manifold.0), pair.surface, &points.as_ref()[..found.len()]);
        let rest_speed = 2.0 * REST_STEPS * settings.rest_speed(normal);
        places.fill(number, &SoftPair { a, b, normal, surface, rest_speed, twist: pair.twist, points });
    }
}

/// Hands what the step did to its contacts back to them, and notes which bodies were pushed.
fn remember_outcomes<D: Geometry>(solved: &SoftStep<D>, team: &Team, pairs: &mut SoftPairs<D>, pushed: &[AtomicBool]) {
    let mut first = 0;
    for (_, pairs, manifolds, memories) in pairs.contiguous_iter_mut().expect(IN_TABLES) {
        let (pairs, _) = ContiguousMut::split(pairs);
        let (memories, _) = ContiguousMut::split(memories);
        let count = pairs.len();
        let chunks = pairs.chunks_mut(PAIRS_OF_A_TASK).zip(manifolds.chunks(PAIRS_OF_A_TASK));
        let chunks = chunks.zip(memories.chunks_mut(PAIRS_OF_A_TASK));
        team.share(chunks.enumerate(), |(chunk, ((pairs, manifolds), memories))| {
            let pairs = pairs.iter_mut().zip(manifolds).zip(memories);
            for (k, ((pair, manifold), memory)) in pairs.enumerate() {
                let number = first + chunk * PAIRS_OF_A_TASK + k;
                if !solved.acts(number) {
                    continue;
                }
                let outcome = solved.outcome(number);
                pair.colour = solved.colour(number);
                pair.twist = outcome.twist();
                let normal = D::normal(&manifold.0);
                let twist = Twisting::of(&outcome, manifold);
                let mut touched = false;
                for ((k, point), memory) in D::points(&manifold.0).iter().enumerate().zip(memory.0.as_mut()) {
                    (memory.impulse, memory.slip) = (outcome.impulse(k), outcome.slip);
                    memory.given = outcome.total_in_world(k, normal) + twist.at(point.point);
                    // It met the surface in this step, wherever the rest of the step took it.
                    memory.held = outcome.pushed(k);
                    touched |= memory.held;
                }
                if touched {
                    for body in pair.bodies {
                        pushed[body as usize].store(true, Ordering::Relaxed);
                    }
                }
            }
        });
        first += count;
    }
}

/// What a twist of a pair does at its points.
struct Twisting<'a, D: Geometry> {
    outcome: &'a SoftOutcome<D>,
    normal: D::Vector,
    /// Mean of the points, and the sum of their squared distances from it.
    mean: D::Vector,
    squared: f64,
}

impl<'a, D: Geometry> Twisting<'a, D> {
    #[inline]
    fn of(outcome: &'a SoftOutcome<D>, manifold: &ContactManifold<D>) -> Self {
        let (mut mean, mut squared) = (D::Vector::ZERO, 0.0);
        if outcome.twists() {
            let points = D::points(&manifold.0);
            mean = points.iter().fold(mean, |sum, point| sum + point.point) * (1.0 / points.len() as f64);
            squared = points.iter().map(|point| (point.point - mean).dot(point.point - mean)).sum();
        }
        Self { outcome, normal: D::normal(&manifold.0), mean, squared }
    }

    /// On b, in world axes [N·s].
    #[inline]
    fn at(&self, point: D::Vector) -> D::Vector {
        self.outcome.twist_at(self.normal, point - self.mean, self.squared)
    }
}

/// Notes every point that pushed or could have, for the books.
fn note_rows<D: Geometry>(
    problem: &mut ContactProblem<D>,
    solved: &SoftStep<D>,
    detection: &Detection<D>,
    pairs: &SoftPairs<D>,
    substep: f64,
) {
    for (number, (entity, pair, manifold, memory)) in pairs.iter().enumerate() {
        if !solved.acts(number) {
            continue;
        }
        let frame = D::contact_frame(D::normal(&manifold.0));
        let outcome = solved.outcome(number);
        let twist = Twisting::of(&outcome, manifold);
        for (k, (point, memory)) in D::points(&manifold.0).iter().zip(memory.0.as_ref()).enumerate() {
            if point.separation > 0.0 && !outcome.pushed(k) {
                continue;
            }
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
                impulse: outcome.total(k) + frame.apply_transposed(twist.at(point.point)),
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
