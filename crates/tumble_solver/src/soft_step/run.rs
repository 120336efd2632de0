//! The substeps, as each member of a team takes them.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, f32x4};
use tumble_team::Barrier;

use super::Width;
use super::dim::SoftDim;
use super::kernel::{self, BIASED, RELAXING, Sweep};
use super::lanes::{All, Block, Lanes, Number, One, Wide};
use super::pack::Pack;
use super::plan::Share;
use crate::SolverBody;
use crate::joint::Joints;

/// What all members see.
pub struct Shared<'a> {
    /// Of each body: velocity and rate of turn, then displacement and turn within the step.
    pub records: &'a [Block],
    /// What accelerations add to velocities in a substep.
    pub gains: &'a [Block],
    /// Velocities before the step.
    pub starts: &'a [Block],
    /// Inverse masses and inertias.
    pub masses: &'a [Block],
    /// How many colours there are.
    pub colours: usize,
    /// Whether some point rebounds.
    pub rebounds: bool,
    /// Whether there are joints: all wait for the member that holds them.
    pub joints: bool,
    pub substeps: u32,
    /// Length of a substep [s].
    pub substep: f32,
    pub how: Sweep,
    /// The largest change of a separating speed in the last sweep, as bits [m/s].
    pub changed: AtomicU32,
}

/// What one member works on.
pub struct Member<'a, D: SoftDim> {
    pub one: Share<'a, D, 1>,
    pub two: Share<'a, D, 2>,
    pub four: Share<'a, D, 4>,
    /// Bodies that it integrates.
    pub bodies: Range<usize>,
    /// The joints, which one member holds for all.
    pub held: Option<Held<'a, D>>,
}

/// The joints of a scene and the bodies that they join.
pub struct Held<'a, D: SoftDim> {
    pub joints: Joints<'a, D>,
    /// Bodies of joints, each once.
    pub jointed: &'a [u32],
    pub bodies: &'a mut [SolverBody<D>],
}

impl<D: SoftDim> Held<'_, D> {
    /// Stops every joint, in double precision.
    fn stop(&mut self, records: &[Block]) {
        for &body in self.jointed {
            let (linear, angular) = super::get::<D>(records, body, 0);
            let body = &mut self.bodies[body as usize];
            (body.velocity, body.angular_velocity) = (linear, angular);
        }
        self.joints.block.stop(self.bodies, self.joints.rows);
        for &body in self.jointed {
            let after = &self.bodies[body as usize];
            super::set::<D>(records, body, (after.velocity, after.angular_velocity));
        }
    }
}

/// What a pass over all packs does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pass {
    Prepare,
    WarmStart,
    Biased,
    Relaxing,
    Rebound,
}

/// Takes the substeps on the lanes that the width asks for.
pub fn run<D: SoftDim>(width: Width, member: Member<'_, D>, shared: &Shared<'_>, barrier: &Barrier) {
    let level = match width {
        Width::Widest => Level::new(),
        Width::Level(level) => level,
        Width::Plain => return substeps(LaneByLane, member, shared, barrier),
    };
    dispatch(level, member, shared, barrier);
}

/// Two levels are enough here, and each costs seconds of compiling: eight lanes in one register, or in two.
#[cfg(target_arch = "x86_64")]
fn dispatch<D: SoftDim>(level: Level, member: Member<'_, D>, shared: &Shared<'_>, barrier: &Barrier) {
    if let Some(simd) = level.as_avx2() {
        simd.vectorize(
            #[inline(always)]
            || substeps(EightAtOnce(simd), member, shared, barrier),
        );
    } else if let Some(simd) = level.as_sse2() {
        simd.vectorize(
            #[inline(always)]
            || substeps(EightAtOnce(simd), member, shared, barrier),
        );
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn dispatch<D: SoftDim>(level: Level, member: Member<'_, D>, shared: &Shared<'_>, barrier: &Barrier) {
    fearless_simd::dispatch!(level, simd => substeps(EightAtOnce(simd), member, shared, barrier));
}

/// How lanes are worked on: all ways give the same bits.
trait Way: Copy {
    /// Does to a pack what the pass says; `changed` keeps the largest change of a separating speed, by lane.
    fn visit<D: SoftDim, const P: usize>(
        self,
        pass: Pass,
        pack: &mut Pack<D, P>,
        shared: &Shared<'_>,
        changed: &mut Wide,
    );

    /// list += other · factor.
    fn add(self, list: &Block, other: &Block, factor: f32);
}

/// Eight lanes together.
#[derive(Clone, Copy)]
struct EightAtOnce<S>(S);

impl<S: Simd> Way for EightAtOnce<S> {
    #[inline(always)]
    fn visit<D: SoftDim, const P: usize>(
        self,
        pass: Pass,
        pack: &mut Pack<D, P>,
        shared: &Shared<'_>,
        changed: &mut Wide,
    ) {
        visit(All(self.0), pass, pack, shared, changed);
    }

    #[inline(always)]
    fn add(self, list: &Block, other: &Block, factor: f32) {
        list.store(list.load(self.0) + other.load(self.0) * f32x4::splat(self.0, factor));
    }
}

/// The oracle: one lane after the other.
#[derive(Clone, Copy)]
struct LaneByLane;

impl Way for LaneByLane {
    #[inline(always)]
    fn visit<D: SoftDim, const P: usize>(
        self,
        pass: Pass,
        pack: &mut Pack<D, P>,
        shared: &Shared<'_>,
        changed: &mut Wide,
    ) {
        for lane in 0..pack.lanes {
            visit(One(lane), pass, pack, shared, changed);
        }
    }

    #[inline(always)]
    fn add(self, list: &Block, other: &Block, factor: f32) {
        let (mut numbers, other) = (list.get(), other.get());
        for (number, other) in numbers.iter_mut().zip(other) {
            *number += other * factor;
        }
        list.set(numbers);
    }
}

#[inline(always)]
fn visit<D: SoftDim, L: Lanes, const P: usize>(
    lanes: L,
    pass: Pass,
    pack: &mut Pack<D, P>,
    shared: &Shared<'_>,
    changed: &mut Wide,
) {
    let Shared { records, how, .. } = shared;
    match pass {
        Pass::Prepare => kernel::prepare(lanes, pack, shared.masses, records),
        Pass::WarmStart => kernel::warm_start(lanes, pack, records),
        Pass::Biased => {
            kernel::sweep::<D, L, P, BIASED>(lanes, pack, records, how);
        }
        Pass::Relaxing => {
            let change = kernel::sweep::<D, L, P, RELAXING>(lanes, pack, records, how);
            lanes.store(lanes.load(changed).larger(change), changed);
        }
        Pass::Rebound => kernel::rebound(lanes, pack, records),
    }
}

/// A record's velocity and displacement blocks, with those that belong to it in other lists.
#[inline(always)]
fn records<'a, D: SoftDim>(
    shared: &Shared<'a>,
    bodies: Range<usize>,
) -> impl Iterator<Item = (&'a Block, &'a Block, &'a Block, &'a Block)> {
    let n = D::BLOCKS;
    let records = shared.records[2 * n * bodies.start..2 * n * bodies.end].chunks_exact(2 * n);
    let others = n * bodies.start..n * bodies.end;
    let others = shared.gains[others.clone()].chunks_exact(n).zip(shared.starts[others].chunks_exact(n));
    records.zip(others).flat_map(move |(record, (gains, starts))| {
        let (motions, shifts) = record.split_at(n);
        motions
            .iter()
            .zip(shifts)
            .zip(gains)
            .zip(starts)
            .map(|(((motion, shift), gain), start)| (motion, shift, gain, start))
    })
}

#[inline(always)]
fn substeps<D: SoftDim, W: Way>(way: W, mut member: Member<'_, D>, shared: &Shared<'_>, barrier: &Barrier) {
    let bodies = member.bodies.clone();
    let mut changed = Wide::default();
    packs(way, Pass::Prepare, &mut member, shared, &mut changed, || {});
    barrier.wait();
    for _ in 0..shared.substeps {
        for (motion, _, gain, _) in records::<D>(shared, bodies.clone()) {
            way.add(motion, gain, 1.0);
        }
        barrier.wait();
        colours(way, Pass::WarmStart, &mut member, shared, barrier, &mut changed);
        colours(way, Pass::Biased, &mut member, shared, barrier, &mut changed);
        hold(&mut member, shared, barrier);
        for (motion, shift, ..) in records::<D>(shared, bodies.clone()) {
            way.add(shift, motion, shared.substep);
        }
        barrier.wait();
        changed = Wide::default();
        colours(way, Pass::Relaxing, &mut member, shared, barrier, &mut changed);
        hold(&mut member, shared, barrier);
    }
    if shared.rebounds {
        colours(way, Pass::Rebound, &mut member, shared, barrier, &mut changed);
        hold(&mut member, shared, barrier);
    }
    let most = changed.0.into_iter().fold(0.0, f32::max);
    // Numbers that are not negative are in the order of their bits.
    shared.changed.fetch_max(most.to_bits(), Ordering::Relaxed);
    // What remains is what contacts and joints changed: the same sums without them are taken away.
    for (motion, shift, gain, start) in records::<D>(shared, bodies) {
        let (free_motion, free_shift) = (Block::default(), Block::default());
        free_motion.set(start.get());
        for _ in 0..shared.substeps {
            way.add(&free_motion, gain, 1.0);
            way.add(&free_shift, &free_motion, shared.substep);
        }
        way.add(motion, &free_motion, -1.0);
        way.add(shift, &free_shift, -1.0);
    }
}

/// Passes over all packs, all members in the same colour.
#[inline(always)]
fn colours<D: SoftDim, W: Way>(
    way: W,
    pass: Pass,
    member: &mut Member<'_, D>,
    shared: &Shared<'_>,
    barrier: &Barrier,
    changed: &mut Wide,
) {
    packs(way, pass, member, shared, changed, || barrier.wait());
}

/// Passes over all packs of a member, colour by colour.
#[inline(always)]
fn packs<D: SoftDim, W: Way>(
    way: W,
    pass: Pass,
    member: &mut Member<'_, D>,
    shared: &Shared<'_>,
    changed: &mut Wide,
    after_colour: impl Fn(),
) {
    for colour in 0..shared.colours {
        for pack in member.four.of_colour(colour) {
            way.visit(pass, pack, shared, changed);
        }
        for pack in member.two.of_colour(colour) {
            way.visit(pass, pack, shared, changed);
        }
        for pack in member.one.of_colour(colour) {
            way.visit(pass, pack, shared, changed);
        }
        after_colour();
    }
}

#[inline(always)]
fn hold<D: SoftDim>(member: &mut Member<'_, D>, shared: &Shared<'_>, barrier: &Barrier) {
    if let Some(held) = &mut member.held {
        held.stop(shared.records);
    }
    if shared.joints {
        barrier.wait();
    }
}
