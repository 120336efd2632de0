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
//! The points of a pair push each for itself, but rub together: one friction impulse at their mean, bounded by all that they push, and in
//! space a twist about the normal. Along a straight side of the plane that is the same; in space it is what a stiff, flat contact does.
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
mod plan;
mod run;

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use fearless_simd::Level;
use tumble_team::Team;

use crate::joint::Joints;
use crate::{Ending, Report, SolverBody};
use colours::COLOURS;
use kernel::{Softness, Sweep};
use lanes::{Block, One, WIDTH};
use pack::moves;
use plan::{Class, Colour, MEMBERS, NOBODY, Place, ROOM, Share};
use run::{Held, Member, Shared};

pub use colours::{Colours, PairColour};
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

/// So few packs are sooner done lane by lane: most of their lanes have no pair [1].
const FEW_PACKS: usize = 1;
/// Fewer packs of a colour than this for each thread, on average, are not worth the barrier behind it [1].
const PACKS_FOR_A_THREAD: usize = 8;

/// The model with its scratch space.
pub struct SoftStep<D: SoftDim> {
    /// How the kernels run.
    pub width: Width,
    /// Of each body, side by side: velocity and rate of turn, then displacement and turn within the step. The world, which nothing moves, is the last.
    records: Vec<Block>,
    /// What accelerations add to velocities in a substep.
    gains: Vec<Block>,
    /// Velocities before the step.
    starts: Vec<Block>,
    /// Inverse masses and inertias: `MASS_BLOCKS` blocks for each body.
    masses: Vec<Block>,
    colours: Colours,
    places: Vec<Place>,
    counts: [[u32; COLOURS]; ROOM.len()],
    one: Class<D, 1>,
    two: Class<D, 2>,
    four: Class<D, 4>,
    /// How many threads share the packs.
    members: usize,
    /// Colours that some pair has, as bits, and the place of each among them.
    used: u64,
    ranks: [u8; COLOURS],
    rebounds: bool,
    /// Bodies of joints, each once.
    jointed: Vec<u32>,
}

impl<D: SoftDim> Default for SoftStep<D> {
    fn default() -> Self {
        Self {
            width: Width::default(),
            records: Vec::new(),
            gains: Vec::new(),
            starts: Vec::new(),
            masses: Vec::new(),
            colours: Colours::default(),
            places: Vec::new(),
            counts: [[0; COLOURS]; ROOM.len()],
            one: Class::default(),
            two: Class::default(),
            four: Class::default(),
            members: 1,
            used: 0,
            ranks: [0; COLOURS],
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

/// Sets velocity and rate of turn of a body.
fn set<D: SoftDim>(records: &[Block], body: u32, (linear, angular): Motion<D>) {
    D::pack(One(0), (D::axes(linear), D::turns(angular)), records, &[body; WIDTH]);
}

/// Velocity and rate of turn of a body (0), or displacement and turn (1).
fn get<D: SoftDim>(records: &[Block], body: u32, which: usize) -> Motion<D> {
    let (linear, angular) = D::unpack_both(One(0), records, &[body; WIDTH])[which];
    (D::vector(linear), D::angular(angular))
}

/// The places of one thread, to be filled.
pub struct Places<'a, D: SoftDim> {
    member: u8,
    places: &'a [Place],
    one: Share<'a, D, 1>,
    two: Share<'a, D, 2>,
    four: Share<'a, D, 4>,
    rebounds: bool,
}

impl<D: SoftDim> Places<'_, D> {
    /// Whether the pair announced as number `k` belongs to this thread.
    #[inline]
    pub fn want(&self, k: usize) -> bool {
        self.places[k].member == self.member
    }

    /// Puts it into its place.
    pub fn fill(&mut self, k: usize, pair: &SoftPair<'_, D>) {
        let Place { class, lane, pack, .. } = self.places[k];
        let lane = lane as usize;
        self.rebounds |= pair.surface.restitution > 0.0;
        match class {
            0 => self.one.pack(pack).fill(lane, pair),
            1 => self.two.pack(pack).fill(lane, pair),
            _ => self.four.pack(pack).fill(lane, pair),
        }
    }
}

impl<D: SoftDim> SoftStep<D> {
    /// Begins a step: `bodies` as they are before it, the world last.
    pub fn begin(&mut self, bodies: &[SolverBody<D>]) {
        let blocks = bodies.len() * D::BLOCKS;
        self.records.resize_with(2 * blocks, Block::default);
        self.gains.resize_with(blocks, Block::default);
        self.starts.resize_with(blocks, Block::default);
        self.masses.resize_with(bodies.len() * D::MASS_BLOCKS, Block::default);
        self.records.iter().chain(&self.gains).for_each(|block| block.set([0.0; 4]));
        for (i, body) in bodies.iter().enumerate() {
            set::<D>(&self.records, i as u32, (body.velocity, body.angular_velocity));
            D::pack_masses(body.inverse_mass, body.inverse_inertia, &mut self.masses, i);
        }
        let records = self.records.chunks_exact(2 * D::BLOCKS);
        for (record, starts) in records.zip(self.starts.chunks_exact(D::BLOCKS)) {
            record.iter().zip(starts).for_each(|(motion, start)| start.set(motion.get()));
        }
        self.colours.begin(bodies.iter().map(moves));
        self.counts = [[0; COLOURS]; ROOM.len()];
        self.used = 0;
        self.rebounds = false;
    }

    /// Tells what forces do to a body in a step of `dt` cut in `substeps` [m/s²].
    pub fn accelerate(&mut self, body: u32, acceleration: D::Vector, angular: D::Angular, substep: f64) {
        D::put_gain((acceleration * substep, angular * substep), &self.gains, body as usize);
    }

    /// The colours of pairs.
    pub fn colours(&mut self) -> &mut Colours {
        &mut self.colours
    }

    /// Tells how many pairs there are, of which none is announced yet.
    pub fn expect(&mut self, pairs: usize) {
        self.places.clear();
        self.places.resize(pairs, Place { member: NOBODY, ..Place::default() });
    }

    /// Announces pair number `k` with a number of points, one to four, before [`lay_out`](Self::lay_out). Pairs whose colour says that they share
    /// bodies are solved in the order of these calls.
    pub fn announce(&mut self, k: usize, points: usize, colour: PairColour) {
        let class = ROOM.iter().position(|room| points <= *room).expect("no manifold has more than four points");
        let number = colour.number();
        let pack = self.counts[class][number];
        self.counts[class][number] += 1;
        self.used |= 1 << number;
        self.places[k] = Place { colour: number as u8, class: class as u8, lane: 0, member: 0, pack };
    }

    /// Finds the place of every announced pair, for a team that will share them.
    pub fn lay_out(&mut self, team: &Team) {
        let Self { used, counts, ranks, .. } = self;
        let colours = |class: usize| {
            let counts: &[u32; COLOURS] = &counts[class];
            let mut left = *used;
            std::iter::from_fn(move || {
                let number = left.trailing_zeros() as usize;
                left &= left.wrapping_sub(1);
                counts.get(number).map(|pairs| Colour { number, pairs: *pairs })
            })
        };
        for (rank, colour) in colours(0).enumerate() {
            ranks[colour.number] = rank as u8;
        }
        let pairs: u32 = (0..ROOM.len()).flat_map(colours).map(|colour| colour.pairs).sum();
        let worth = pairs as usize / (WIDTH * PACKS_FOR_A_THREAD * used.count_ones().max(1) as usize);
        self.members = team.size().min(worth).clamp(1, MEMBERS);
        let world = (self.starts.len() / D::BLOCKS) as u32 - 1;
        self.one.lay_out(colours(0), self.members, world);
        self.two.lay_out(colours(1), self.members, world);
        self.four.lay_out(colours(2), self.members, world);
        for place in self.places.iter_mut().filter(|place| place.member != NOBODY) {
            let at = self.ranks[place.colour as usize] as usize;
            (place.pack, place.lane, place.member) = match place.class {
                0 => self.one.place(at, place.pack),
                1 => self.two.place(at, place.pack),
                _ => self.four.place(at, place.pack),
            };
        }
    }

    /// Puts every announced pair into its place: each thread calls `walk`, which offers all pairs, and takes those that it wants.
    pub fn fill(&mut self, team: &Team, walk: impl Fn(&mut Places<'_, D>) + Sync) {
        let Self { one, two, four, places, members, .. } = self;
        let rebounds = AtomicBool::new(false);
        let (mut one, mut two, mut four) = (one.shares(), two.shares(), four.shares());
        let shares = (0..*members).map(|member| Places {
            member: member as u8,
            places,
            one: one.next().expect("every member has a share"),
            two: two.next().expect("every member has a share"),
            four: four.next().expect("every member has a share"),
            rebounds: false,
        });
        team.together(shares, |mut share, _| {
            walk(&mut share);
            rebounds.fetch_or(share.rebounds, Ordering::Relaxed);
        });
        self.rebounds = rebounds.into_inner();
    }

    /// Takes a step of `dt` under a `gravity` [m/s²]. Joints hold at the end of every sweep, in double precision; `bodies` lend their inverse masses.
    pub fn solve(
        &mut self,
        team: &Team,
        dt: f64,
        gravity: f64,
        settings: &SoftSettings,
        joints: Option<Joints<'_, D>>,
        bodies: &mut [SolverBody<D>],
    ) -> Report {
        let h = dt / f64::from(settings.substeps);
        let frequency = settings.frequency.min(0.25 / h);
        self.list_jointed(&joints, bodies.len());
        let Self { records, gains, starts, masses, jointed, .. } = self;
        let shared = Shared {
            records,
            gains,
            starts,
            masses,
            colours: self.used.count_ones() as usize,
            rebounds: self.rebounds,
            joints: joints.is_some(),
            substeps: settings.substeps,
            substep: h as f32,
            how: Sweep {
                per_substep: (1.0 / h) as f32,
                soft: Softness::new(frequency, settings.damping_ratio, h),
                firm: Softness::new(2.0 * frequency, settings.damping_ratio, h),
                push_speed: settings.push_speed as f32,
                slow_slip: ((SLOW_SLIP * gravity * h) * (SLOW_SLIP * gravity * h)) as f32,
            },
            changed: AtomicU32::new(0),
        };
        let few = self.one.len() + self.two.len() + self.four.len() <= FEW_PACKS;
        let width = if few && matches!(self.width, Width::Widest) { Width::Plain } else { self.width };
        let (members, count) = (self.members, shared.starts.len() / D::BLOCKS);
        let mut held = joints.map(|joints| Held { joints, jointed, bodies });
        let (mut one, mut two, mut four) = (self.one.shares(), self.two.shares(), self.four.shares());
        let shares = (0..members).map(|member| Member {
            one: one.next().expect("every member has a share"),
            two: two.next().expect("every member has a share"),
            four: four.next().expect("every member has a share"),
            bodies: count * member / members..count * (member + 1) / members,
            held: held.take(),
        });
        team.together(shares, |member, barrier| run::run(width, member, &shared, barrier));
        let residual = f64::from(f32::from_bits(shared.changed.into_inner()));
        Report { iterations: 2 * settings.substeps, residual, ending: Ending::Converged }
    }

    /// What contacts and joints changed of the velocity of a body in this step, exactly nothing where there were none [m/s].
    pub fn change(&self, body: u32) -> Motion<D> {
        get::<D>(&self.records, body, 0)
    }

    /// What they changed of its place [m] and turn [rad].
    pub fn displacement(&self, body: u32) -> Motion<D> {
        get::<D>(&self.records, body, 1)
    }

    /// Whether pair number `k` was announced.
    #[inline]
    pub fn acts(&self, k: usize) -> bool {
        self.places[k].member != NOBODY
    }

    /// The colour of pair number `k`.
    pub fn colour(&self, k: usize) -> PairColour {
        self.colours.of(self.places[k].colour)
    }

    /// What the step did to pair number `k`.
    #[inline]
    pub fn outcome(&self, k: usize) -> SoftOutcome<D> {
        let Place { class, lane, pack, .. } = self.places[k];
        let lane = lane as usize;
        match class {
            0 => self.one.pack(pack).outcome(lane),
            1 => self.two.pack(pack).outcome(lane),
            _ => self.four.pack(pack).outcome(lane),
        }
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
}
