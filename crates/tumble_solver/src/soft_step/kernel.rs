//! What is done to a pack: preparation, warm start, sweep, rebound. Each is a function of the pack and its bodies alone.

use super::dim::{Axes, Components, Masses, SoftDim, Tangents, Turns, Twist, inverse};
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
    fn gather<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>, records: &[Block]) -> Self {
        Self { a: D::unpack(lanes, records, &pack.a), b: D::unpack(lanes, records, &pack.b) }
    }

    /// Velocities, and displacements.
    #[inline(always)]
    fn gather_both<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>, records: &[Block]) -> [Self; 2] {
        let [velocity_a, moved_a] = D::unpack_both(lanes, records, &pack.a);
        let [velocity_b, moved_b] = D::unpack_both(lanes, records, &pack.b);
        [Self { a: velocity_a, b: velocity_b }, Self { a: moved_a, b: moved_b }]
    }

    #[inline(always)]
    fn scatter<L: Lanes<Number = N>, const P: usize>(self, lanes: L, pack: &Pack<D, P>, records: &[Block]) {
        D::pack(lanes, self.a, records, &pack.a);
        D::pack(lanes, self.b, records, &pack.b);
    }

    /// That of b's point relative to a's along the normal: n · (v_b − v_a) + (r_b × n) · ω_b − (r_a × n) · ω_a.
    #[inline(always)]
    fn along(&self, normal: Axes<D, N>, turn_a: Turns<D, N>, turn_b: Turns<D, N>) -> N {
        D::Axes::dot(normal, D::Axes::minus(self.b.0, self.a.0)) + D::Turns::dot(turn_b, self.b.1)
            - D::Turns::dot(turn_a, self.a.1)
    }

    /// That of b's point relative to a's.
    #[inline(always)]
    fn at(&self, arm_a: Axes<D, N>, arm_b: Axes<D, N>) -> Axes<D, N> {
        let b = D::Axes::plus(self.b.0, D::swing(self.b.1, arm_b));
        let a = D::Axes::plus(self.a.0, D::swing(self.a.1, arm_a));
        D::Axes::minus(b, a)
    }

    /// Applies an impulse and the angular impulses that it makes: + to b, − to a.
    #[inline(always)]
    fn push(&mut self, masses: &Pair<D, N>, impulse: Axes<D, N>, turn_a: Turns<D, N>, turn_b: Turns<D, N>) {
        self.b.0 = D::Axes::plus(self.b.0, D::Axes::each(impulse, masses.b.0));
        self.b.1 = D::Turns::plus(self.b.1, D::yields(masses.b.1, turn_b));
        self.a.0 = D::Axes::minus(self.a.0, D::Axes::each(impulse, masses.a.0));
        self.a.1 = D::Turns::minus(self.a.1, D::yields(masses.a.1, turn_a));
    }
}

/// Inverse masses of the two bodies.
struct Pair<D: SoftDim, N: Number> {
    a: Masses<D, N>,
    b: Masses<D, N>,
}

impl<D: SoftDim, N: Number> Pair<D, N> {
    #[inline(always)]
    fn load<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>) -> Self {
        Self {
            a: (D::Axes::load(lanes, &pack.mass_a), D::Tensor::load(lanes, &pack.inertia_a)),
            b: (D::Axes::load(lanes, &pack.mass_b), D::Tensor::load(lanes, &pack.inertia_b)),
        }
    }
}

/// Whether a body moves: a positive number if it does.
#[inline(always)]
fn moves<D: SoftDim, L: Lanes>(lanes: L, (mass, inertia): Masses<D, L::Number>) -> L::Number {
    let one = lanes.splat(1.0);
    let inertia = D::yields(inertia, D::Turns::splat(one));
    D::Axes::dot(mass, D::Axes::splat(one)) + D::Turns::dot(inertia, D::Turns::splat(one))
}

/// Fetches the masses of the bodies, and works out how the points yield and which of them rebound from the velocities before the step.
#[inline(always)]
pub fn prepare<D: SoftDim, L: Lanes, const P: usize>(
    lanes: L,
    pack: &mut Pack<D, P>,
    masses: &[Block],
    records: &[Block],
) {
    let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
    let pair = Pair::<D, L::Number> {
        a: D::unpack_masses(lanes, masses, &pack.a),
        b: D::unpack_masses(lanes, masses, &pack.b),
    };
    D::Axes::store(lanes, pair.a.0, &mut pack.mass_a);
    D::Axes::store(lanes, pair.b.0, &mut pack.mass_b);
    D::Tensor::store(lanes, pair.a.1, &mut pack.inertia_a);
    D::Tensor::store(lanes, pair.b.1, &mut pack.inertia_b);
    let both = moves::<D, L>(lanes, pair.a).smaller(moves::<D, L>(lanes, pair.b));
    lanes.store(Number::if_greater(both, zero, zero, one), &mut pack.firm);

    let normal = D::Axes::load(lanes, &pack.normal);
    let linear = D::Axes::dot(normal, D::Axes::each(normal, D::Axes::plus(pair.a.0, pair.b.0)));
    let velocities = Two::<D, L::Number>::gather(lanes, pack, records);
    let (restitution, rest_speed) = (lanes.load(&pack.restitution), lanes.load(&pack.rest_speed));
    for point in &mut pack.points {
        let turn_a = D::Turns::load(lanes, &point.turn_a);
        let turn_b = D::Turns::load(lanes, &point.turn_b);
        let angular =
            D::Turns::dot(turn_a, D::yields(pair.a.1, turn_a)) + D::Turns::dot(turn_b, D::yields(pair.b.1, turn_b));
        lanes.store(inverse(lanes, linear + angular), &mut point.normal_mass);
        let approach = -velocities.along(normal, turn_a, turn_b);
        lanes.store(Number::if_greater(approach, rest_speed, restitution * approach, zero), &mut point.rebound);
    }
    let frame = D::Frame::load(lanes, &pack.frame);
    let arms = [D::Axes::load(lanes, &pack.arm_a), D::Axes::load(lanes, &pack.arm_b)];
    let tangent = D::tangent_compliance(normal, frame, [(arms[0], pair.a), (arms[1], pair.b)], lanes);
    lanes.store(inverse(lanes, tangent), &mut pack.tangent_mass);
    let about = D::of_twist(lanes, normal, D::Twist::splat(one));
    let turns = D::Turns::plus(D::yields(pair.a.1, about), D::yields(pair.b.1, about));
    D::Twist::store(lanes, D::Twist::inverse(lanes, D::about_normal(normal, turns)), &mut pack.twist_mass);
}

/// Applies the impulses that the points have.
#[inline(always)]
pub fn warm_start<D: SoftDim, L: Lanes, const P: usize>(lanes: L, pack: &Pack<D, P>, records: &[Block]) {
    let masses = Pair::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let friction = Friction::load(lanes, pack);
    let (mut turn_a, mut turn_b) =
        (friction.turn(lanes, normal, friction.arm_a), friction.turn(lanes, normal, friction.arm_b));
    let mut push = lanes.splat(0.0);
    for point in &pack.points {
        let impulse = lanes.load(&point.impulse);
        push = push + impulse;
        turn_a = D::Turns::plus(turn_a, D::Turns::times(D::Turns::load(lanes, &point.turn_a), impulse));
        turn_b = D::Turns::plus(turn_b, D::Turns::times(D::Turns::load(lanes, &point.turn_b), impulse));
    }
    let impulse = D::Axes::plus(D::Axes::times(normal, push), friction.impulse);
    let mut velocities = Two::<D, L::Number>::gather(lanes, pack, records);
    velocities.push(&masses, impulse, turn_a, turn_b);
    velocities.scatter(lanes, pack, records);
}

/// An impulse across the normal, at the mean of the points, and one about the normal.
struct Friction<D: SoftDim, N: Number> {
    arm_a: Axes<D, N>,
    arm_b: Axes<D, N>,
    impulse: Axes<D, N>,
    twist: Twist<D, N>,
}

impl<D: SoftDim, N: Number> Friction<D, N> {
    #[inline(always)]
    fn load<L: Lanes<Number = N>, const P: usize>(lanes: L, pack: &Pack<D, P>) -> Self {
        let normal = D::Axes::load(lanes, &pack.normal);
        let frame = D::Frame::load(lanes, &pack.frame);
        Self {
            arm_a: D::Axes::load(lanes, &pack.arm_a),
            arm_b: D::Axes::load(lanes, &pack.arm_b),
            impulse: D::of_tangents(normal, frame, D::Tangents::load(lanes, &pack.tangents)),
            twist: D::Twist::load(lanes, &pack.twist),
        }
    }

    /// Angular impulse about a centre of mass from which the mean of the points is `arm` away.
    #[inline(always)]
    fn turn<L: Lanes<Number = N>>(&self, lanes: L, normal: Axes<D, N>, arm: Axes<D, N>) -> Turns<D, N> {
        D::Turns::plus(D::lever(arm, self.impulse), D::of_twist(lanes, normal, self.twist))
    }
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
    records: &[Block],
    how: &Sweep,
) -> L::Number {
    let zero = lanes.splat(0.0);
    let masses = Pair::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let [mut velocities, moved] = Two::<D, L::Number>::gather_both(lanes, pack, records);
    let mut changed = zero;

    let per_substep = lanes.splat(how.per_substep);
    let firm = lanes.load(&pack.firm);
    let bias_rate = firm_or_soft(lanes, firm, how.firm.bias_rate, how.soft.bias_rate);
    let soft_mass = firm_or_soft(lanes, firm, how.firm.mass_scale, how.soft.mass_scale);
    let soft_impulse = firm_or_soft(lanes, firm, how.firm.impulse_scale, how.soft.impulse_scale);
    let slowest = lanes.splat(-how.push_speed);
    let mut push = zero;
    let mut twisting = D::Twist::splat(zero);
    for point in &mut pack.points {
        let turn_a = D::Turns::load(lanes, &point.turn_a);
        let turn_b = D::Turns::load(lanes, &point.turn_b);
        let gap = lanes.load(&point.separation) + moved.along(normal, turn_a, turn_b);
        let speed = velocities.along(normal, turn_a, turn_b);
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
            push = push + after;
            twisting = D::Twist::plus(twisting, D::Twist::times(D::Twist::load(lanes, &point.radius), after));
        }
        let turns = [D::Turns::times(turn_a, change), D::Turns::times(turn_b, change)];
        velocities.push(&masses, D::Axes::times(normal, change), turns[0], turns[1]);
    }

    // After the normals: what the biased sweep leaves of an impulse is too little to bound friction by.
    if WHICH == RELAXING {
        rub(lanes, pack, &mut velocities, &masses, push, twisting, how);
    }
    velocities.scatter(lanes, pack, records);
    changed
}

/// Friction of all points of a pair together: across the normal at their mean, bounded by all that they push, and about the normal.
#[inline(always)]
fn rub<D: SoftDim, L: Lanes, const P: usize>(
    lanes: L,
    pack: &mut Pack<D, P>,
    velocities: &mut Two<D, L::Number>,
    masses: &Pair<D, L::Number>,
    push: L::Number,
    twisting: Twist<D, L::Number>,
    how: &Sweep,
) {
    let zero = lanes.splat(0.0);
    let normal = D::Axes::load(lanes, &pack.normal);
    let frame = D::Frame::load(lanes, &pack.frame);
    let (arm_a, arm_b) = (D::Axes::load(lanes, &pack.arm_a), D::Axes::load(lanes, &pack.arm_b));
    let coefficient = lanes.load(&pack.friction);

    let spin = D::about_normal(normal, D::Turns::minus(velocities.b.1, velocities.a.1));
    let twist_before = D::Twist::load(lanes, &pack.twist);
    let stop = D::Twist::minus(twist_before, D::Twist::each(spin, D::Twist::load(lanes, &pack.twist_mass)));
    let twist = D::Twist::within(stop, D::Twist::times(twisting, coefficient));
    D::Twist::store(lanes, twist, &mut pack.twist);
    let sum = D::Twist::load(lanes, &pack.total_twist);
    D::Twist::store(lanes, D::Twist::plus(sum, twist), &mut pack.total_twist);
    let about = D::of_twist(lanes, normal, D::Twist::minus(twist, twist_before));

    let slip = D::along_tangents(normal, frame, velocities.at(arm_a, arm_b));
    let before = D::Tangents::load(lanes, &pack.tangents);
    let stop: Tangents<D, L::Number> =
        D::Tangents::minus(before, D::Tangents::times(slip, lanes.load(&pack.tangent_mass)));
    let (after, beyond) = D::within_bound(lanes, stop, coefficient * push);
    // What slips, and friction cannot stop, slides from now on; all else sticks.
    let (static_friction, kinetic_friction) = (lanes.load(&pack.static_friction), lanes.load(&pack.kinetic_friction));
    let slow_slip = lanes.splat(how.slow_slip);
    let fast = Number::if_greater(D::Tangents::dot(slip, slip), slow_slip, kinetic_friction, static_friction);
    lanes.store(Number::if_greater(beyond, zero, fast, static_friction), &mut pack.friction);
    D::Tangents::store(lanes, after, &mut pack.tangents);
    let sum = D::Tangents::load(lanes, &pack.total_tangents);
    D::Tangents::store(lanes, D::Tangents::plus(sum, after), &mut pack.total_tangents);
    let impulse = D::of_tangents(normal, frame, D::Tangents::minus(after, before));
    let turn_a = D::Turns::plus(D::lever(arm_a, impulse), about);
    let turn_b = D::Turns::plus(D::lever(arm_b, impulse), about);
    velocities.push(masses, impulse, turn_a, turn_b);
}

#[inline(always)]
fn firm_or_soft<L: Lanes>(lanes: L, firm: L::Number, if_firm: f32, if_soft: f32) -> L::Number {
    Number::if_greater(firm, lanes.splat(0.0), lanes.splat(if_firm), lanes.splat(if_soft))
}

/// Gives back the approach speed of points that were hit in this step (L5, Newton's law).
#[inline(always)]
pub fn rebound<D: SoftDim, L: Lanes, const P: usize>(lanes: L, pack: &mut Pack<D, P>, records: &[Block]) {
    let zero = lanes.splat(0.0);
    let masses = Pair::<D, L::Number>::load(lanes, pack);
    let normal = D::Axes::load(lanes, &pack.normal);
    let mut velocities = Two::<D, L::Number>::gather(lanes, pack, records);
    for point in &mut pack.points {
        let turn_a = D::Turns::load(lanes, &point.turn_a);
        let turn_b = D::Turns::load(lanes, &point.turn_b);
        let (before, total) = (lanes.load(&point.impulse), lanes.load(&point.total));
        let wanted = lanes.load(&point.rebound);
        let speed = velocities.along(normal, turn_a, turn_b);
        let after = (before + lanes.load(&point.normal_mass) * (wanted - speed)).larger(zero);
        let hit = Number::if_greater(total, zero, wanted, zero);
        let after = Number::if_greater(hit, zero, after, before);
        let change = after - before;
        // It does not come again in the next step: only the sum knows of it.
        lanes.store(total + change, &mut point.total);
        let turns = [D::Turns::times(turn_a, change), D::Turns::times(turn_b, change)];
        velocities.push(&masses, D::Axes::times(normal, change), turns[0], turns[1]);
    }
    velocities.scatter(lanes, pack, records);
}
