//! What is done to a pack: warm start, sweep, rebound. Each is a function of the pack and its bodies alone.

use super::dim::{Axes, Components, SoftDim, Tensor, Turns};
use super::lanes::{Block, Lanes, Number};
use super::pack::Pack;

/// How a soft contact pushes: v_n → −b s, with mass and impulse scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softness {
    /// b: overlap taken out per second [1/s].
    pub bias_rate: f32,
    /// Factor of the mass [1].
    pub mass_scale: f32,
    /// Part of the accumulated impulse that is given up [1].
    pub impulse_scale: f32,
}

impl Softness {
    /// Spring and damper of a frequency [Hz] and damping ratio, implicit over a substep of h (E. Catto, "Soft Constraints", 2011).
    ///
    /// ```text
    /// a₁ = 2 ζ + h ω,   a₂ = h ω a₁,   b = ω/a₁,   mass a₂/(1 + a₂),   impulse 1/(1 + a₂)          ω = 2π f
    /// ```
    pub fn new(frequency: f64, damping_ratio: f64, h: f64) -> Self {
        let omega = 2.0 * std::f64::consts::PI * frequency;
        let first = 2.0 * damping_ratio + h * omega;
        let second = h * omega * first;
        let third = 1.0 / (1.0 + second);
        Self { bias_rate: (omega / first) as f32, mass_scale: (second * third) as f32, impulse_scale: third as f32 }
    }
}

/// What is the same for all packs of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// 1/h [1/s].
    pub per_substep: f32,
    /// Between bodies that move.
    pub soft: Softness,
    /// Against what cannot move.
    pub firm: Softness,
    /// Fastest push out of an overlap [m/s].
    pub push_speed: f32,
    /// Slip below which friction may use its static coefficient, squared [m²/s²].
    pub slow_slip: f32,
}

/// Velocities or displacements of the two bodies of a pair.
struct Two<D: SoftDim, N: Number> {
    a: (Axes<D, N>, Turns<D, N>),
    b: (Axes<D, N>, Turns<D, N>),
}

impl<D: SoftDim, N: Number> Two<D, N> {
    #[inline(always)]
    fn gather<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>, blocks: &[Block]) -> Self {
        Self { a: D::unpack(lanes, blocks, &pack.a), b: D::unpack(lanes, blocks, &pack.b) }
    }

    #[inline(always)]
    fn scatter<L: Lanes<Number = N>, const P: usize>(self, lanes: L, pack: &Pack<D, P>, blocks: &mut [Block]) {
        D::pack(lanes, self.a, blocks, &pack.a);
        D::pack(lanes, self.b, blocks, &pack.b);
    }

    /// That of b's point relative to a's.
    #[inline(always)]
    fn at(&self, arm_a: Axes<D, N>, arm_b: Axes<D, N>) -> Axes<D, N> {
        let b = D::Axes::plus(self.b.0, D::swing(self.b.1, arm_b));
        let a = D::Axes::plus(self.a.0, D::swing(self.a.1, arm_a));
        D::Axes::minus(b, a)
    }

    /// Applies an impulse: +J to b, −J to a.
    #[inline(always)]
    fn push(&mut self, masses: &Masses<D, N>, arm_a: Axes<D, N>, arm_b: Axes<D, N>, impulse: Axes<D, N>) {
        self.b.0 = D::Axes::plus(self.b.0, D::Axes::each(impulse, masses.b.0));
        self.b.1 = D::Turns::plus(self.b.1, D::yields(masses.b.1, D::lever(arm_b, impulse)));
        self.a.0 = D::Axes::minus(self.a.0, D::Axes::each(impulse, masses.a.0));
        self.a.1 = D::Turns::minus(self.a.1, D::yields(masses.a.1, D::lever(arm_a, impulse)));
    }
}

/// Inverse masses of the two bodies.
struct Masses<D: SoftDim, N: Number> {
    a: (Axes<D, N>, Tensor<D, N>),
    b: (Axes<D, N>, Tensor<D, N>),
}

impl<D: SoftDim, N: Number> Masses<D, N> {
    #[inline(always)]
    fn load<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>) -> Self {
        Self {
            a: (D::Axes::load(lanes, &pack.mass_a), D::Tensor::load(lanes, &pack.inertia_a)),
            b: (D::Axes::load(lanes, &pack.mass_b), D::Tensor::load(lanes, &pack.inertia_b)),
        }
    }
}

/// Applies the impulses that the points have.
#[inline(always)]
pub fn warm_start<D: SoftDim, L: Lanes, const P: usize>(lanes: L, pack: &Pack<D, P>, motions: &mut [Block]) {
    let masses = Masses::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let frame = D::Frame::load(lanes, &pack.frame);
    let mut velocities = Two::<D, L::Number>::gather(lanes, pack, motions);
    for point in &pack.points {
        let arm_a = D::Axes::load(lanes, &point.arm_a);
        let arm_b = D::Axes::load(lanes, &point.arm_b);
        let along = D::Axes::times(normal, lanes.load(&point.impulse));
        let across = D::of_tangents(normal, frame, D::Tangents::load(lanes, &point.tangents));
        velocities.push(&masses, arm_a, arm_b, D::Axes::plus(along, across));
    }
    velocities.scatter(lanes, pack, motions);
}

/// Which of the two sweeps of a substep.
pub const BIASED: bool = true;
/// Takes out of the velocities what the biased sweep added to push overlaps apart; friction acts here.
pub const RELAXING: bool = false;

/// Solves the points of each pair one after the other; returns the largest change of a separating speed, by lane [m/s].
#[inline(always)]
pub fn sweep<D: SoftDim, L: Lanes, const P: usize, const WHICH: bool>(
    lanes: L,
    pack: &mut Pack<D, P>,
    motions: &mut [Block],
    shifts: &[Block],
    how: &Sweep,
) -> L::Number {
    let zero = lanes.splat(0.0);
    let masses = Masses::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let mut velocities = Two::<D, L::Number>::gather(lanes, pack, motions);
    let moved = Two::<D, L::Number>::gather(lanes, pack, shifts);
    let mut changed = zero;

    let per_substep = lanes.splat(how.per_substep);
    let firm = lanes.load(&pack.firm);
    let bias_rate = firm_or_soft(lanes, firm, how.firm.bias_rate, how.soft.bias_rate);
    let soft_mass = firm_or_soft(lanes, firm, how.firm.mass_scale, how.soft.mass_scale);
    let soft_impulse = firm_or_soft(lanes, firm, how.firm.impulse_scale, how.soft.impulse_scale);
    let slowest = lanes.splat(-how.push_speed);
    for point in &mut pack.points {
        let arm_a = D::Axes::load(lanes, &point.arm_a);
        let arm_b = D::Axes::load(lanes, &point.arm_b);
        let gap = lanes.load(&point.separation) + D::Axes::dot(normal, moved.at(arm_a, arm_b));
        let speed = D::Axes::dot(normal, velocities.at(arm_a, arm_b));
        let mass = lanes.load(&point.normal_mass);
        let before = lanes.load(&point.impulse);
        // A gap may close within the substep, and no more; an overlap is pushed apart like a stiff, strongly damped spring.
        let closing = gap * per_substep;
        let (bias, scaled_mass, given_up) = if WHICH == BIASED {
            let pushed = (gap * bias_rate).larger(slowest);
            (
                Number::if_greater(gap, zero, closing, pushed),
                Number::if_greater(gap, zero, mass, mass * soft_mass),
                Number::if_greater(gap, zero, zero, before * soft_impulse),
            )
        } else {
            (Number::if_greater(gap, zero, closing, zero), mass, zero)
        };
        let after = (before - scaled_mass * (speed + bias) - given_up).larger(zero);
        let change = after - before;
        lanes.store(after, &mut point.impulse);
        if WHICH == RELAXING {
            lanes.store(lanes.load(&point.total) + after, &mut point.total);
            let size = change.larger(-change);
            // Where nothing yields there is no mass, and no change either.
            changed = changed.larger(size.over(mass.larger(lanes.splat(f32::MIN_POSITIVE))));
        }
        velocities.push(&masses, arm_a, arm_b, D::Axes::times(normal, change));
    }

    // After the normals: what the biased sweep leaves of an impulse is too little to bound friction by.
    if WHICH == RELAXING {
        let frame = D::Frame::load(lanes, &pack.frame);
        let static_friction = lanes.load(&pack.static_friction);
        let kinetic_friction = lanes.load(&pack.kinetic_friction);
        let slow_slip = lanes.splat(how.slow_slip);
        for point in &mut pack.points {
            let arm_a = D::Axes::load(lanes, &point.arm_a);
            let arm_b = D::Axes::load(lanes, &point.arm_b);
            let slip = D::along_tangents(normal, frame, velocities.at(arm_a, arm_b));
            let before = D::Tangents::load(lanes, &point.tangents);
            let stop = D::Tangents::minus(before, D::Tangents::times(slip, lanes.load(&point.tangent_mass)));
            let bound = lanes.load(&point.friction) * lanes.load(&point.impulse);
            let (after, beyond) = D::within_bound(lanes, stop, bound);
            // What slips, and friction cannot stop, slides from now on; all else sticks.
            let fast = Number::if_greater(D::Tangents::dot(slip, slip), slow_slip, kinetic_friction, static_friction);
            let friction = Number::if_greater(beyond, zero, fast, static_friction);
            lanes.store(friction, &mut point.friction);
            D::Tangents::store(lanes, after, &mut point.tangents);
            let sum = D::Tangents::load(lanes, &point.total_tangents);
            D::Tangents::store(lanes, D::Tangents::plus(sum, after), &mut point.total_tangents);
            let impulse = D::of_tangents(normal, frame, D::Tangents::minus(after, before));
            velocities.push(&masses, arm_a, arm_b, impulse);
        }
    }
    velocities.scatter(lanes, pack, motions);
    changed
}

#[inline(always)]
fn firm_or_soft<L: Lanes>(lanes: L, firm: L::Number, if_firm: f32, if_soft: f32) -> L::Number {
    Number::if_greater(firm, lanes.splat(0.0), lanes.splat(if_firm), lanes.splat(if_soft))
}

/// Gives back the approach speed of points that were hit in this step (L5, Newton's law).
#[inline(always)]
pub fn rebound<D: SoftDim, L: Lanes, const P: usize>(lanes: L, pack: &mut Pack<D, P>, motions: &mut [Block]) {
    let zero = lanes.splat(0.0);
    let masses = Masses::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let mut velocities = Two::<D, L::Number>::gather(lanes, pack, motions);
    for point in &mut pack.points {
        let arm_a = D::Axes::load(lanes, &point.arm_a);
        let arm_b = D::Axes::load(lanes, &point.arm_b);
        let (before, total) = (lanes.load(&point.impulse), lanes.load(&point.total));
        let wanted = lanes.load(&point.rebound);
        let speed = D::Axes::dot(normal, velocities.at(arm_a, arm_b));
        let after = (before + lanes.load(&point.normal_mass) * (wanted - speed)).larger(zero);
        let hit = Number::if_greater(total, zero, wanted, zero);
        let after = Number::if_greater(hit, zero, after, before);
        let change = after - before;
        // It does not come again in the next step: only the sum knows of it.
        lanes.store(total + change, &mut point.total);
        velocities.push(&masses, arm_a, arm_b, D::Axes::times(normal, change));
    }
    velocities.scatter(lanes, pack, motions);
}
