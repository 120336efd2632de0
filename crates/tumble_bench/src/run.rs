//! Running an engine over a plan: time, memory, and what became of the bodies.

use std::time::Instant;

use tumble_math::{Dim, Linear, Pose};
use xxhash_rust::xxh3::Xxh3;

use crate::judge::judge;
use crate::line::Line;
use crate::plan::{Kind, Plan, PlanDim};

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState<D: Dim> {
    /// Centre of mass and rotation.
    pub pose: Pose<D>,
    /// Velocity of the centre of mass [m/s].
    pub velocity: D::Vector,
    /// Rate of turn [rad/s].
    pub angular_velocity: D::Angular,
}

/// What can be run: a world of some engine, built from a plan.
pub trait Engine<D: Dim> {
    /// Why a step can fail.
    type Error;

    /// Takes one step.
    ///
    /// # Errors
    ///
    /// When the engine gives up.
    fn step(&mut self) -> Result<(), Self::Error>;

    /// The bodies, in the order of the plan.
    fn states(&self) -> Vec<BodyState<D>>;
}

/// Who runs, and how.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// Name of the engine.
    pub engine: &'a str,
    /// Its version, and settings that are not its default.
    pub version: &'a str,
    /// Threads that it may use.
    pub threads: u32,
    /// Steps to take; the plan's own number where not given.
    pub steps: Option<u32>,
    /// Bytes that the program holds at present.
    pub held_bytes: fn() -> usize,
}

/// From this many steps on, a thousand are timed together, because one of them takes little longer than reading the clock.
const MANY_STEPS: u32 = 100_000;

/// Builds, runs and judges.
///
/// # Errors
///
/// When the engine cannot be built, or gives up in a step.
pub fn run<D: PlanDim, E: Engine<D>>(
    plan: &Plan<D>,
    run: &Run<'_>,
    build: impl FnOnce(&Plan<D>) -> Result<E, E::Error>,
) -> Result<Line, E::Error> {
    let steps = run.steps.unwrap_or(plan.steps).max(1);
    let mut times = Times::with_room_for(steps);
    let empty = (run.held_bytes)();
    let mut engine = build(plan)?;
    let built = (run.held_bytes)();
    let first = engine.states();
    let begun = (run.held_bytes)();
    times.of_steps(steps, || engine.step())?;
    let ended = (run.held_bytes)();
    let last = engine.states();

    let poses: Vec<Pose<D>> = last.iter().map(|state| state.pose).collect();
    let verdict = judge(plan, &poses);
    Ok(Line {
        engine: run.engine.to_owned(),
        version: run.version.to_owned(),
        scene: plan.name.clone(),
        bodies: plan.bodies.len(),
        threads: run.threads,
        steps,
        ms_mean: times.mean(),
        ms_median: times.quantile(0.5),
        ms_p95: times.quantile(0.95),
        contacts: verdict.touching,
        max_overlap: verdict.max_overlap,
        mean_overlap: verdict.mean_overlap,
        top_drift: top_drift(plan, &first, &last),
        kinetic_energy: kinetic_energy(plan, &last),
        bytes_per_body: built.saturating_sub(empty) as f64 / plan.bodies.len() as f64,
        bytes_per_contact: (verdict.touching > 0).then(|| ended.saturating_sub(begun) as f64 / verdict.touching as f64),
        fingerprint: fingerprint(steps, &last),
    })
}

/// Times of steps [ms].
struct Times {
    total: f64,
    steps: u32,
    /// Of each block of steps, per step; sorted at the end.
    blocks: Vec<f64>,
}

impl Times {
    fn with_room_for(steps: u32) -> Self {
        Self { total: 0.0, steps, blocks: Vec::with_capacity(steps.div_ceil(block(steps)) as usize) }
    }

    fn of_steps<E>(&mut self, steps: u32, mut step: impl FnMut() -> Result<(), E>) -> Result<(), E> {
        let begun = Instant::now();
        let mut last = begun;
        let mut left = steps;
        while left > 0 {
            let count = block(steps).min(left);
            for _ in 0..count {
                step()?;
            }
            left -= count;
            let now = Instant::now();
            self.blocks.push((now - last).as_secs_f64() * 1e3 / f64::from(count));
            last = now;
        }
        self.total = (last - begun).as_secs_f64() * 1e3;
        self.blocks.sort_by(f64::total_cmp);
        Ok(())
    }

    fn mean(&self) -> f64 {
        self.total / f64::from(self.steps)
    }

    fn quantile(&self, part: f64) -> f64 {
        let rank = (self.blocks.len() as f64 * part) as usize;
        self.blocks[rank.min(self.blocks.len() - 1)]
    }
}

/// How many steps are timed together.
fn block(steps: u32) -> u32 {
    if steps >= MANY_STEPS { 1000 } else { 1 }
}

/// How far the dynamic body that was highest has moved; the last one of several [m].
fn top_drift<D: PlanDim>(plan: &Plan<D>, first: &[BodyState<D>], last: &[BodyState<D>]) -> f64 {
    let moving = (0..plan.bodies.len()).filter(|body| plan.bodies[*body].kind == Kind::Dynamic);
    let height = |body: &usize| first[*body].pose.position[1];
    let top = moving.max_by(|one, other| height(one).total_cmp(&height(other)));
    top.map_or(0.0, |top| (last[top].pose.position - first[top].pose.position).length())
}

/// Kinetic energy of the centres of mass of dynamic bodies [J].
fn kinetic_energy<D: PlanDim>(plan: &Plan<D>, states: &[BodyState<D>]) -> f64 {
    let moving = plan.bodies.iter().zip(states).filter(|(body, _)| body.kind == Kind::Dynamic);
    moving.map(|(body, state)| 0.5 * plan.mass(body) * state.velocity.dot(state.velocity)).sum()
}

/// Digest of all bits of a state, made as the fingerprints of recordings are: the step, then for each body its number, pose and velocity.
fn fingerprint<D: PlanDim>(steps: u32, states: &[BodyState<D>]) -> u128 {
    let mut hasher = Xxh3::new();
    hasher.update(&u64::from(steps).to_le_bytes());
    let mut numbers = Vec::new();
    for (body, state) in states.iter().enumerate() {
        numbers.clear();
        D::write_numbers(&state.pose, state.velocity, state.angular_velocity, &mut numbers);
        hasher.update(&(body as u64).to_le_bytes());
        for number in &numbers {
            // Both zeros move alike.
            let number = if *number == 0.0 { 0.0 } else { *number };
            hasher.update(&number.to_bits().to_le_bytes());
        }
    }
    hasher.digest128()
}
