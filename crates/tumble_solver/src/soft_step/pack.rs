//! Pairs packed by eights: what the kernels read, number by number.

use tumble_math::{Dim, Inertia, Linear};

use super::dim::{Axes, Components, Frame, SoftDim, Tangents, Tensor, Turns, Twist};
use super::lanes::{WIDTH, Wide};
use crate::{Slip, SolverBody, Surface};

/// Two parts that may touch within the step, everything in world axes.
#[derive(Clone, Copy, Debug)]
pub struct SoftPair<'a, D: Dim> {
    /// Index of the first body.
    pub a: u32,
    /// Index of the second body.
    pub b: u32,
    /// Unit vector from a to b.
    pub normal: D::Vector,
    /// Friction and restitution.
    pub surface: Surface,
    /// Approach slower than this does not rebound [m/s].
    pub rest_speed: f64,
    /// [Angular impulse about the normal](SoftOutcome::twist) of the last substep of the step before [N·m·s].
    pub twist: f32,
    /// One to four points.
    pub points: &'a [SoftPoint<D>],
}

/// A point of a pair.
#[derive(Clone, Copy, Debug)]
pub struct SoftPoint<D: Dim> {
    /// Centre of mass of a → point [m].
    pub arm_a: D::Vector,
    /// Centre of mass of b → point [m].
    pub arm_b: D::Vector,
    /// Gap, negative when overlapping [m].
    pub separation: f64,
    /// Impulse of the last substep of the step before, in the contact frame [N·s].
    pub impulse: D::Vector,
    /// Whether the point slides.
    pub slip: Slip,
}

impl<D: Dim> Default for SoftPoint<D> {
    fn default() -> Self {
        let zero = D::Vector::ZERO;
        Self { arm_a: zero, arm_b: zero, separation: 0.0, impulse: zero, slip: Slip::Sticking }
    }
}

/// What a step did to a pair.
#[derive(Clone, Copy)]
pub struct SoftOutcome<D: SoftDim> {
    /// Impulses along the normal in the last substep, and one over their sum.
    pushes: [f32; 4],
    per_push: f32,
    /// The same of the whole step.
    totals: [f32; 4],
    per_total: f32,
    frame: Frame<D, f32>,
    tangents: Tangents<D, f32>,
    total_tangents: Tangents<D, f32>,
    twist: Twist<D, f32>,
    total_twist: Twist<D, f32>,
    /// Whether the pair slides.
    pub slip: Slip,
}

/// 1 over a sum of pushes; nothing of nothing.
fn per(pushes: [f32; 4]) -> f32 {
    let sum: f32 = pushes.iter().sum();
    if sum > 0.0 { 1.0 / sum } else { 0.0 }
}

impl<D: SoftDim> SoftOutcome<D> {
    /// Impulse of the last substep at a point, in the contact frame: each has as much of the friction as it has of the push [N·s].
    #[inline]
    pub fn impulse(&self, point: usize) -> D::Vector {
        let push = self.pushes[point];
        D::in_frame(push, D::Tangents::times(self.tangents, push * self.per_push))
    }

    /// Impulse of the whole step at a point, in the contact frame, without what twisting adds [N·s].
    pub fn total(&self, point: usize) -> D::Vector {
        let push = self.totals[point];
        D::in_frame(push, D::Tangents::times(self.total_tangents, push * self.per_total))
    }

    /// The same on b, in world axes [N·s].
    #[inline]
    pub fn total_in_world(&self, point: usize, normal: D::Vector) -> D::Vector {
        let push = self.totals[point];
        let tangents = D::Tangents::times(self.total_tangents, push * self.per_total);
        normal * f64::from(push) + D::vector(D::of_tangents(D::axes(normal), self.frame, tangents))
    }

    /// Whether a point pushed in this step.
    #[inline]
    pub fn pushed(&self, point: usize) -> bool {
        self.totals[point] > 0.0
    }

    /// Angular impulse about the normal in the last substep, for [`SoftPair::twist`]; 0 in the plane [N·m·s].
    #[inline]
    pub fn twist(&self) -> f32 {
        D::twist(self.twist)
    }

    /// Whether the pair was turned about its normal.
    #[inline]
    pub fn twists(&self) -> bool {
        D::twist(self.total_twist) != 0.0
    }

    /// Part of a point in that turn, in world axes: `arm` from the mean of the points, whose arms `squared` sum up to so much [N·s].
    #[inline]
    pub fn twist_at(&self, normal: D::Vector, arm: D::Vector, squared: f64) -> D::Vector {
        if squared > 0.0 { D::twisted(normal, self.total_twist, arm) * (1.0 / squared) } else { D::Vector::ZERO }
    }
}

/// Eight pairs with up to `N` points each. Lanes without a pair yield to nothing.
///
/// The points of a pair push each for itself; they rub together, at their mean.
#[derive(Clone, Copy)]
pub struct Pack<D: SoftDim, const N: usize> {
    pub a: [u32; WIDTH],
    pub b: [u32; WIDTH],
    pub normal: Axes<D, Wide>,
    pub frame: Frame<D, Wide>,
    /// Inverse masses per axis, and inverse inertias.
    pub mass_a: Axes<D, Wide>,
    pub mass_b: Axes<D, Wide>,
    pub inertia_a: Tensor<D, Wide>,
    pub inertia_b: Tensor<D, Wide>,
    /// 1 where one of the two cannot move, otherwise 0.
    pub firm: Wide,
    pub points: [PackedPoint<D>; N],
    /// Mean of the points, seen from the two centres of mass.
    pub arm_a: Axes<D, Wide>,
    pub arm_b: Axes<D, Wide>,
    pub static_friction: Wide,
    pub kinetic_friction: Wide,
    /// The coefficient that bounds friction at present.
    pub friction: Wide,
    pub tangent_mass: Wide,
    pub tangents: Tangents<D, Wide>,
    pub twist_mass: Twist<D, Wide>,
    pub twist: Twist<D, Wide>,
    /// Impulses of the step so far.
    pub total_tangents: Tangents<D, Wide>,
    pub total_twist: Twist<D, Wide>,
    /// What only the start of the step reads.
    pub restitution: Wide,
    pub rest_speed: Wide,
    /// Lanes beyond have no pair.
    pub lanes: usize,
}

/// One point of eight pairs.
#[derive(Clone, Copy)]
pub struct PackedPoint<D: SoftDim> {
    /// r × n for each body: rate of turn to separating speed, and push to angular impulse.
    pub turn_a: Turns<D, Wide>,
    pub turn_b: Turns<D, Wide>,
    pub separation: Wide,
    pub normal_mass: Wide,
    pub impulse: Wide,
    /// Impulse of the step so far.
    pub total: Wide,
    /// Separating speed to reach after an impact; 0 for a point that does not rebound.
    pub rebound: Wide,
    /// Distance from the mean of the points.
    pub radius: Twist<D, Wide>,
}

/// A gap that never closes [m].
const FAR: f32 = 1e30;

fn zero<C: Components>() -> C::Of<Wide> {
    C::splat(Wide::default())
}

fn none<C: Components>() -> C::Of<f32> {
    C::splat(0.0)
}

impl<D: SoftDim> PackedPoint<D> {
    fn unused() -> Self {
        Self {
            turn_a: zero::<D::Turns>(),
            turn_b: zero::<D::Turns>(),
            separation: Wide([FAR; WIDTH]),
            normal_mass: Wide::default(),
            impulse: Wide::default(),
            total: Wide::default(),
            rebound: Wide::default(),
            radius: zero::<D::Twist>(),
        }
    }

    /// A point that never pushes.
    fn clear(&mut self, lane: usize) {
        D::Turns::put(none::<D::Turns>(), lane, &mut self.turn_a);
        D::Turns::put(none::<D::Turns>(), lane, &mut self.turn_b);
        self.separation.0[lane] = FAR;
        self.impulse.0[lane] = 0.0;
        self.total.0[lane] = 0.0;
        D::Twist::put(none::<D::Twist>(), lane, &mut self.radius);
    }
}

impl<D: SoftDim, const N: usize> Pack<D, N> {
    /// A pack without pairs: all its lanes are the world's, which nothing moves.
    pub fn unused(world: u32) -> Self {
        Self {
            a: [world; WIDTH],
            b: [world; WIDTH],
            normal: zero::<D::Axes>(),
            frame: zero::<D::Frame>(),
            mass_a: zero::<D::Axes>(),
            mass_b: zero::<D::Axes>(),
            inertia_a: zero::<D::Tensor>(),
            inertia_b: zero::<D::Tensor>(),
            firm: Wide::default(),
            points: [PackedPoint::unused(); N],
            arm_a: zero::<D::Axes>(),
            arm_b: zero::<D::Axes>(),
            static_friction: Wide::default(),
            kinetic_friction: Wide::default(),
            friction: Wide::default(),
            tangent_mass: Wide::default(),
            tangents: zero::<D::Tangents>(),
            twist_mass: zero::<D::Twist>(),
            twist: zero::<D::Twist>(),
            total_tangents: zero::<D::Tangents>(),
            total_twist: zero::<D::Twist>(),
            restitution: Wide::default(),
            rest_speed: Wide::default(),
            lanes: 0,
        }
    }

    /// Puts a pair into a lane.
    pub fn fill(&mut self, lane: usize, pair: &SoftPair<'_, D>) {
        let (normal, surface) = (pair.normal, &pair.surface);
        (self.a[lane], self.b[lane]) = (pair.a, pair.b);
        self.lanes = self.lanes.max(lane + 1);
        D::Axes::put(D::axes(normal), lane, &mut self.normal);
        D::Frame::put(D::frame(normal), lane, &mut self.frame);
        let (used, unused) = self.points.split_at_mut(pair.points.len());
        let mut mean = [D::Vector::ZERO; 2];
        let mut tangents = D::Vector::ZERO;
        for (place, point) in used.iter_mut().zip(pair.points) {
            D::Turns::put(D::turns(D::torque(point.arm_a, normal)), lane, &mut place.turn_a);
            D::Turns::put(D::turns(D::torque(point.arm_b, normal)), lane, &mut place.turn_b);
            place.separation.0[lane] = point.separation as f32;
            place.impulse.0[lane] = point.impulse[0] as f32;
            place.total.0[lane] = 0.0;
            mean = [mean[0] + point.arm_a, mean[1] + point.arm_b];
            tangents += point.impulse;
        }
        for place in unused {
            place.clear(lane);
        }
        let share = 1.0 / pair.points.len() as f64;
        let mean = mean.map(|sum| sum * share);
        for (place, point) in self.points.iter_mut().zip(pair.points) {
            D::Twist::put(D::Twist::splat((point.arm_a - mean[0]).length() as f32), lane, &mut place.radius);
        }
        D::Axes::put(D::axes(mean[0]), lane, &mut self.arm_a);
        D::Axes::put(D::axes(mean[1]), lane, &mut self.arm_b);
        let slides = pair.points.iter().any(|point| point.slip == Slip::Sliding);
        let friction = if slides { surface.kinetic_friction } else { surface.static_friction };
        self.static_friction.0[lane] = surface.static_friction as f32;
        self.kinetic_friction.0[lane] = surface.kinetic_friction as f32;
        self.friction.0[lane] = friction as f32;
        D::Tangents::put(D::tangents(tangents), lane, &mut self.tangents);
        D::Twist::put(D::Twist::splat(pair.twist), lane, &mut self.twist);
        D::Tangents::put(none::<D::Tangents>(), lane, &mut self.total_tangents);
        D::Twist::put(none::<D::Twist>(), lane, &mut self.total_twist);
        self.restitution.0[lane] = surface.restitution as f32;
        self.rest_speed.0[lane] = pair.rest_speed as f32;
    }

    /// Leaves a lane without a pair: `world` is a body that nothing moves.
    pub fn clear(&mut self, lane: usize, world: u32) {
        (self.a[lane], self.b[lane]) = (world, world);
        self.lanes = self.lanes.min(lane);
        for point in &mut self.points {
            point.clear(lane);
        }
        D::Tangents::put(none::<D::Tangents>(), lane, &mut self.tangents);
        D::Twist::put(none::<D::Twist>(), lane, &mut self.twist);
        self.restitution.0[lane] = 0.0;
    }

    /// What the step did to the pair in a lane.
    #[inline]
    pub fn outcome(&self, lane: usize) -> SoftOutcome<D> {
        let sticks = self.friction.0[lane] >= self.static_friction.0[lane];
        let (mut pushes, mut totals) = ([0.0; 4], [0.0; 4]);
        for ((push, total), point) in pushes.iter_mut().zip(&mut totals).zip(&self.points) {
            (*push, *total) = (point.impulse.0[lane], point.total.0[lane]);
        }
        SoftOutcome {
            pushes,
            per_push: per(pushes),
            totals,
            per_total: per(totals),
            frame: D::Frame::take(&self.frame, lane),
            tangents: D::Tangents::take(&self.tangents, lane),
            total_tangents: D::Tangents::take(&self.total_tangents, lane),
            twist: D::Twist::take(&self.twist, lane),
            total_twist: D::Twist::take(&self.total_twist, lane),
            slip: if sticks { Slip::Sticking } else { Slip::Sliding },
        }
    }
}

/// Whether impulses move a body.
pub fn moves<D: Dim>(body: &SolverBody<D>) -> bool {
    body.inverse_mass != D::Vector::ZERO || body.inverse_inertia != D::Inertia::ZERO
}
