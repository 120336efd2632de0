//! Soft steps: a model for very many contacts, fast and stable rather than exact (R7, L5, L10).
//!
//! Idea: a step is cut into a few substeps (E. Catto, "Solver2D", 2024: *soft step*; M. Macklin et al., "Small Steps in Physics
//! Simulation", 2019). Contacts are found once, and each is kept as a linear function of how the bodies have moved since:
//!
//! ```text
//! each substep of h:  v += a h
//!                     impulses of the substep before                        (warm start)
//!                     one sweep: v_n → −b s for an overlap, softly          (biased)
//!                     x += v h
//!                     one sweep: v_n → 0, friction                          (relaxing)
//! at the end:         v_n → ε v_n,approach where a point was hit            (rebound)
//!
//! s = s₀ + n · (Δx_b + Δθ_b × r_b − Δx_a − Δθ_a × r_a)          a gap s > 0 may close within a substep: v_n ≥ −s/h
//! ```
//!
//! The biased sweep pushes overlaps apart like springs that are as stiff as h allows; the relaxing sweep takes the speed that
//! they added out again, so that pushing adds no energy. Overlaps carry: a pile sinks a little into itself.
//!
//! Pairs are coloured so that those of one colour share no moving body, and go through the kernels eight at a time in single precision. What
//! is computed is the *change* that contacts make: it is added to states of double precision, and a body without contacts is not touched at all.
//! Every instruction set, and the plain version one lane at a time, give the same bits.
//!
//! Good at: large piles, towers, drums, mass ratios up to about 10. Bad at: exact forces, exact sticking, large mass ratios.

mod colours;
mod dim;
mod kernel;
mod lanes;
mod pack;

use fearless_simd::{Level, Simd};

use crate::joint::Joints;
use crate::{Ending, Report, SolverBody};
use colours::{COLOURS, Colours, OVERFLOW};
use kernel::{BIASED, RELAXING, Softness, Sweep};
use lanes::{All, Block, Lanes, Number, One, WIDTH, Wide};
use pack::{Pack, moves};

pub use dim::SoftDim;
pub use pack::{SoftOutcome, SoftPair, SoftPoint};

/// How contacts are softened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftSettings {
    /// Substeps of a step [1]. Default 4.
    pub substeps: u32,
    /// Frequency of the contact springs, at most a quarter of the substeps' own [Hz]. Default 30. Twice as much against bodies that cannot move.
    pub frequency: f64,
    /// Their damping ratio [1]. Default 10.
    pub damping_ratio: f64,
    /// Fastest push out of an overlap [m/s]. Default 3.
    pub push_speed: f64,
}

impl Default for SoftSettings {
    fn default() -> Self {
        Self { substeps: 4, frequency: 30.0, damping_ratio: 10.0, push_speed: 3.0 }
    }
}

/// How the kernels run. All ways give the same bits.
#[derive(Clone, Copy, Debug, Default)]
pub enum Width {
    /// Eight lanes at a time, with the widest registers that this machine has.
    #[default]
    Widest,
    /// Eight lanes at a time, at a given level.
    Level(Level),
    /// One lane after the other: the oracle.
    Plain,
}

/// Slower than this many times what gravity adds in a substep, a point does not slide yet [1]: so much slips before its friction is known.
const SLOW_SLIP: f64 = 1.0;

/// How many points the packs of a class have room for.
const ROOM: [usize; 3] = [1, 2, 4];

/// Where a pair went.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    colour: u8,
    class: u8,
    lane: u8,
    pack: u32,
}

/// The packs of a class in the order of colours, and where each colour begins.
#[derive(Clone)]
struct Class<D: SoftDim, const P: usize> {
    packs: Vec<Pack<D, P>>,
    starts: [u32; COLOURS + 1],
}

impl<D: SoftDim, const P: usize> Default for Class<D, P> {
    fn default() -> Self {
        Self { packs: Vec::new(), starts: [0; COLOURS + 1] }
    }
}

impl<D: SoftDim, const P: usize> Class<D, P> {
    /// Makes room for so many pairs of each colour.
    fn lay_out(&mut self, counts: &[u32; COLOURS], world: u32) {
        let mut packs = 0;
        for (colour, count) in counts.iter().enumerate() {
            self.starts[colour] = packs;
            packs += if colour == OVERFLOW { *count } else { count.div_ceil(WIDTH as u32) };
        }
        self.starts[COLOURS] = packs;
        self.packs.clear();
        self.packs.resize(packs as usize, Pack::unused(world));
    }

    fn of_colour(&mut self, colour: usize) -> &mut [Pack<D, P>] {
        &mut self.packs[self.starts[colour] as usize..self.starts[colour + 1] as usize]
    }
}

/// What a pass over all packs does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pass {
    WarmStart,
    Biased,
    Relaxing,
    Rebound,
}

/// The model with its scratch space.
pub struct SoftStep<D: SoftDim> {
    /// How the kernels run.
    pub width: Width,
    /// Velocities: `BLOCKS` blocks for each body; the world, which nothing moves, is the last.
    motions: Vec<Block>,
    /// Displacements within the step.
    shifts: Vec<Block>,
    /// What accelerations add to velocities in a substep.
    gains: Vec<Block>,
    /// Velocities before the step.
    starts: Vec<Block>,
    colours: Colours,
    places: Vec<Place>,
    counts: [[u32; COLOURS]; ROOM.len()],
    one: Class<D, 1>,
    two: Class<D, 2>,
    four: Class<D, 4>,
    /// Colours that some pair has, in order.
    used: Vec<usize>,
    rebounds: bool,
    /// Bodies of joints, each once.
    jointed: Vec<u32>,
}

impl<D: SoftDim> Default for SoftStep<D> {
    fn default() -> Self {
        Self {
            width: Width::default(),
            motions: Vec::new(),
            shifts: Vec::new(),
            gains: Vec::new(),
            starts: Vec::new(),
            colours: Colours::default(),
            places: Vec::new(),
            counts: [[0; COLOURS]; ROOM.len()],
            one: Class::default(),
            two: Class::default(),
            four: Class::default(),
            used: Vec::new(),
            rebounds: false,
            jointed: Vec::new(),
        }
    }
}

impl<D: SoftDim> std::fmt::Debug for SoftStep<D> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("SoftStep").field("width", &self.width).field("pairs", &self.places.len()).finish()
    }
}

/// Velocity and rate of turn, acceleration and angular acceleration: the same two kinds of quantity.
type Motion<D> = (<D as tumble_math::Dim>::Vector, <D as tumble_math::Dim>::Angular);

impl<D: SoftDim> SoftStep<D> {
    /// Begins a step: `bodies` as they are before it, the world last.
    pub fn begin(&mut self, bodies: &[SolverBody<D>]) {
        let blocks = bodies.len() * D::BLOCKS;
        for list in [&mut self.motions, &mut self.shifts, &mut self.gains, &mut self.starts] {
            list.clear();
            list.resize(blocks, Block::default());
        }
        for (i, body) in bodies.iter().enumerate() {
            self.set(i, |soft| &mut soft.motions, (body.velocity, body.angular_velocity));
        }
        self.starts.copy_from_slice(&self.motions);
        self.colours.begin(bodies.len());
        self.places.clear();
        self.counts = [[0; COLOURS]; ROOM.len()];
        self.rebounds = false;
    }

    /// Tells what forces do to a body in a step of `dt` cut in `substeps` [m/s²].
    pub fn accelerate(&mut self, body: u32, acceleration: D::Vector, angular: D::Angular, substep: f64) {
        self.set(body as usize, |soft| &mut soft.gains, (acceleration * substep, angular * substep));
    }

    fn set(&mut self, body: usize, list: impl Fn(&mut Self) -> &mut Vec<Block>, (linear, angular): Motion<D>) {
        let lane = One(0);
        let mut at = [0; WIDTH];
        at[0] = body as u32;
        D::pack(lane, (D::axes(linear), D::turns(angular)), list(self), &at);
    }

    fn get(&self, body: usize, list: &[Block]) -> Motion<D> {
        let mut at = [0; WIDTH];
        at[0] = body as u32;
        let (linear, angular) = D::unpack(One(0), list, &at);
        (D::vector(linear), D::angular(angular))
    }

    /// Announces the next pair, before [`lay_out`](Self::lay_out): its bodies and the number of its points, one to four.
    pub fn announce(&mut self, a: u32, b: u32, points: usize, bodies: &[SolverBody<D>]) {
        let class = ROOM.iter().position(|room| points <= *room).expect("no manifold has more than four points");
        let moving = [a, b].map(|body| moves(&bodies[body as usize]));
        let colour = self.colours.choose([a, b], moving);
        self.counts[class][colour] += 1;
        self.places.push(Place { colour: colour as u8, class: class as u8, ..Place::default() });
    }

    /// Finds the place of every announced pair.
    pub fn lay_out(&mut self) {
        let world = (self.motions.len() / D::BLOCKS) as u32 - 1;
        self.one.lay_out(&self.counts[0], world);
        self.two.lay_out(&self.counts[1], world);
        self.four.lay_out(&self.counts[2], world);
        self.used.clear();
        self.used.extend((0..COLOURS).filter(|colour| self.counts.iter().any(|counts| counts[*colour] > 0)));
        let mut next = [[0_u32; COLOURS]; ROOM.len()];
        let starts = [&self.one.starts, &self.two.starts, &self.four.starts];
        for place in &mut self.places {
            let (class, colour) = (place.class as usize, place.colour as usize);
            let number = next[class][colour];
            next[class][colour] += 1;
            let (pack, lane) =
                if colour == OVERFLOW { (number, 0) } else { (number / WIDTH as u32, number % WIDTH as u32) };
            place.pack = starts[class][colour] + pack;
            place.lane = lane as u8;
        }
    }

    /// Puts the pair announced as number `k` into its place.
    pub fn fill(&mut self, k: usize, pair: &SoftPair<'_, D>, bodies: &[SolverBody<D>]) {
        let Place { class, lane, pack, .. } = self.places[k];
        let (pack, lane) = (pack as usize, lane as usize);
        self.rebounds |= match class {
            0 => self.one.packs[pack].fill(lane, pair, bodies),
            1 => self.two.packs[pack].fill(lane, pair, bodies),
            _ => self.four.packs[pack].fill(lane, pair, bodies),
        };
    }

    /// Takes a step of `dt` under a `gravity` [m/s²]. Joints hold at the end of every sweep, in double precision; `bodies` lend their inverse masses.
    pub fn solve(
        &mut self,
        dt: f64,
        gravity: f64,
        settings: &SoftSettings,
        mut joints: Option<Joints<'_, D>>,
        bodies: &mut [SolverBody<D>],
    ) -> Report {
        let h = dt / f64::from(settings.substeps);
        let frequency = settings.frequency.min(0.25 / h);
        let how = Sweep {
            per_substep: (1.0 / h) as f32,
            soft: Softness::new(frequency, settings.damping_ratio, h),
            firm: Softness::new(2.0 * frequency, settings.damping_ratio, h),
            push_speed: settings.push_speed as f32,
            slow_slip: ((SLOW_SLIP * gravity * h) * (SLOW_SLIP * gravity * h)) as f32,
        };
        self.list_jointed(&joints, bodies.len());
        let mut changed = 0.0;
        for _ in 0..settings.substeps {
            add(&mut self.motions, &self.gains, 1.0);
            self.pass(Pass::WarmStart, &how);
            self.pass(Pass::Biased, &how);
            self.hold_joints(&mut joints, bodies);
            add(&mut self.shifts, &self.motions, h as f32);
            changed = self.pass(Pass::Relaxing, &how);
            self.hold_joints(&mut joints, bodies);
        }
        if self.rebounds {
            self.pass(Pass::Rebound, &how);
            self.hold_joints(&mut joints, bodies);
        }
        Report { iterations: 2 * settings.substeps, residual: f64::from(changed), ending: Ending::Converged }
    }

    /// What contacts and joints changed of the velocity of a body in this step, exactly nothing where there were none [m/s].
    pub fn change(&self, body: u32, settings: &SoftSettings) -> Motion<D> {
        let (free, _) = self.free(body, settings, 0.0);
        self.since(body, &self.motions, &free)
    }

    /// What they changed of its place [m] and turn [rad].
    pub fn displacement(&self, body: u32, dt: f64, settings: &SoftSettings) -> Motion<D> {
        let (_, free) = self.free(body, settings, (dt / f64::from(settings.substeps)) as f32);
        self.since(body, &self.shifts, &free)
    }

    /// What the step did at a point of pair number `k`.
    pub fn outcome(&self, k: usize, point: usize) -> SoftOutcome<D> {
        let Place { class, lane, pack, .. } = self.places[k];
        let (pack, lane) = (pack as usize, lane as usize);
        match class {
            0 => self.one.packs[pack].outcome(lane, point),
            1 => self.two.packs[pack].outcome(lane, point),
            _ => self.four.packs[pack].outcome(lane, point),
        }
    }

    /// Velocity and displacement of a body that nothing touches, in the very sums of [`solve`](Self::solve).
    fn free(&self, body: u32, settings: &SoftSettings, h: f32) -> ([Block; 2], [Block; 2]) {
        let (mut motion, mut shift) = ([Block::default(); 2], [Block::default(); 2]);
        let range = body as usize * D::BLOCKS..(body as usize + 1) * D::BLOCKS;
        motion[..D::BLOCKS].copy_from_slice(&self.starts[range.clone()]);
        for _ in 0..settings.substeps {
            add(&mut motion[..D::BLOCKS], &self.gains[range.clone()], 1.0);
            add(&mut shift[..D::BLOCKS], &motion[..D::BLOCKS], h);
        }
        (motion, shift)
    }

    fn since(&self, body: u32, list: &[Block], free: &[Block; 2]) -> Motion<D> {
        let (linear, angular) = self.get(body as usize, list);
        let (free_linear, free_angular) = self.get(0, free);
        (linear - free_linear, angular - free_angular)
    }

    fn list_jointed(&mut self, joints: &Option<Joints<'_, D>>, bodies: usize) {
        self.jointed.clear();
        if let Some(joints) = joints {
            let ends = joints.rows.iter().flat_map(|row| [row.a, row.b]);
            self.jointed.extend(ends.filter(|body| (*body as usize) < bodies));
            self.jointed.sort_unstable();
            self.jointed.dedup();
        }
    }

    fn hold_joints(&mut self, joints: &mut Option<Joints<'_, D>>, bodies: &mut [SolverBody<D>]) {
        let Some(joints) = joints else { return };
        for &body in &self.jointed {
            let (velocity, angular_velocity) = self.get(body as usize, &self.motions);
            let body = &mut bodies[body as usize];
            (body.velocity, body.angular_velocity) = (velocity, angular_velocity);
        }
        joints.block.stop(bodies, joints.rows);
        for k in 0..self.jointed.len() {
            let body = self.jointed[k] as usize;
            let after = (bodies[body].velocity, bodies[body].angular_velocity);
            self.set(body, |soft| &mut soft.motions, after);
        }
    }

    /// Passes over all packs, colour by colour; returns the largest change of a separating speed [m/s].
    fn pass(&mut self, pass: Pass, how: &Sweep) -> f32 {
        let level = match self.width {
            Width::Widest => Level::new(),
            Width::Level(level) => level,
            Width::Plain => return self.plain(pass, how),
        };
        let mut worst = Wide::default();
        self.run(level, pass, how, &mut worst);
        worst.0.into_iter().fold(0.0, f32::max)
    }

    /// Two levels are enough here, and each costs seconds of compiling: eight lanes in one register, or in two.
    #[cfg(target_arch = "x86_64")]
    fn run(&mut self, level: Level, pass: Pass, how: &Sweep, worst: &mut Wide) {
        if let Some(simd) = level.as_avx2() {
            simd.vectorize(
                #[inline(always)]
                || self.wide(simd, pass, how, worst),
            );
        } else if let Some(simd) = level.as_sse2() {
            simd.vectorize(
                #[inline(always)]
                || self.wide(simd, pass, how, worst),
            );
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn run(&mut self, level: Level, pass: Pass, how: &Sweep, worst: &mut Wide) {
        fearless_simd::dispatch!(level, simd => self.wide(simd, pass, how, worst));
    }

    #[inline(always)]
    fn wide<S: Simd>(&mut self, simd: S, pass: Pass, how: &Sweep, worst: &mut Wide) {
        let Self { motions, shifts, one, two, four, used, .. } = self;
        let lanes = All(simd);
        let mut changed = lanes.splat(0.0);
        for &colour in &*used {
            for pack in four.of_colour(colour) {
                changed = visit(lanes, pass, pack, motions, shifts, how, changed);
            }
            for pack in two.of_colour(colour) {
                changed = visit(lanes, pass, pack, motions, shifts, how, changed);
            }
            for pack in one.of_colour(colour) {
                changed = visit(lanes, pass, pack, motions, shifts, how, changed);
            }
        }
        lanes.store(changed, worst);
    }

    /// The oracle: the same, one lane after the other.
    fn plain(&mut self, pass: Pass, how: &Sweep) -> f32 {
        let Self { motions, shifts, one, two, four, used, .. } = self;
        let mut changed = 0.0;
        for &colour in &*used {
            for pack in four.of_colour(colour) {
                changed = (0..WIDTH).fold(changed, |most, k| visit(One(k), pass, pack, motions, shifts, how, most));
            }
            for pack in two.of_colour(colour) {
                changed = (0..WIDTH).fold(changed, |most, k| visit(One(k), pass, pack, motions, shifts, how, most));
            }
            for pack in one.of_colour(colour) {
                changed = (0..WIDTH).fold(changed, |most, k| visit(One(k), pass, pack, motions, shifts, how, most));
            }
        }
        changed
    }
}

/// Does to a pack what the pass says; returns the largest change of a separating speed so far, by lane.
#[inline(always)]
fn visit<D: SoftDim, L: Lanes, const P: usize>(
    lanes: L,
    pass: Pass,
    pack: &mut Pack<D, P>,
    motions: &mut [Block],
    shifts: &[Block],
    how: &Sweep,
    changed: L::Number,
) -> L::Number {
    match pass {
        Pass::WarmStart => kernel::warm_start(lanes, pack, motions),
        Pass::Biased => {
            kernel::sweep::<D, L, P, BIASED>(lanes, pack, motions, shifts, how);
        }
        Pass::Relaxing => {
            return changed.larger(kernel::sweep::<D, L, P, RELAXING>(lanes, pack, motions, shifts, how));
        }
        Pass::Rebound => kernel::rebound(lanes, pack, motions),
    }
    changed
}

/// list += other · factor.
fn add(list: &mut [Block], other: &[Block], factor: f32) {
    for (block, other) in list.iter_mut().zip(other) {
        for (number, other) in block.0.iter_mut().zip(other.0) {
            *number += other * factor;
        }
    }
}
