//! Pairs packed by eights: what the kernels read, number by number.

use tumble_math::{Dim, Inertia, Linear, Matrix};

use super::dim::{Axes, Components, Frame, SoftDim, Tangents, Tensor};
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

/// What a step did at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftOutcome<D: Dim> {
    /// Impulse of the last substep, in the contact frame [N·s].
    pub impulse: D::Vector,
    /// Impulse of the whole step, in the contact frame [N·s].
    pub total: D::Vector,
    /// Whether the point slides.
    pub slip: Slip,
}

/// Eight pairs with up to `N` points each. Lanes without a pair yield to nothing.
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
    pub static_friction: Wide,
    pub kinetic_friction: Wide,
    /// 1 where one of the two cannot move, otherwise 0.
    pub firm: Wide,
    pub points: [PackedPoint<D>; N],
}

/// One point of eight pairs.
#[derive(Clone, Copy)]
pub struct PackedPoint<D: SoftDim> {
    pub arm_a: Axes<D, Wide>,
    pub arm_b: Axes<D, Wide>,
    pub separation: Wide,
    pub normal_mass: Wide,
    pub tangent_mass: Wide,
    /// The coefficient that bounds friction at present.
    pub friction: Wide,
    pub impulse: Wide,
    pub tangents: Tangents<D, Wide>,
    /// Impulses of the step so far.
    pub total: Wide,
    pub total_tangents: Tangents<D, Wide>,
    /// Separating speed to reach after an impact; 0 for a point that does not rebound.
    pub rebound: Wide,
}

/// A gap that never closes [m].
const FAR: f32 = 1e30;

fn zero<C: Components>() -> C::Of<Wide> {
    C::splat(Wide::default())
}

impl<D: SoftDim> PackedPoint<D> {
    fn unused() -> Self {
        let none = Wide::default();
        Self {
            arm_a: zero::<D::Axes>(),
            arm_b: zero::<D::Axes>(),
            separation: Wide([FAR; WIDTH]),
            normal_mass: none,
            tangent_mass: none,
            friction: none,
            impulse: none,
            tangents: zero::<D::Tangents>(),
            total: none,
            total_tangents: zero::<D::Tangents>(),
            rebound: none,
        }
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
            static_friction: Wide::default(),
            kinetic_friction: Wide::default(),
            firm: Wide::default(),
            points: [PackedPoint::unused(); N],
        }
    }

    /// Puts a pair into a lane; `bodies` have the velocities of the step's start. Returns whether a point of it rebounds.
    pub fn fill(&mut self, lane: usize, pair: &SoftPair<'_, D>, bodies: &[SolverBody<D>]) -> bool {
        let (a, b) = (&bodies[pair.a as usize], &bodies[pair.b as usize]);
        let frame = D::contact_frame(pair.normal);
        (self.a[lane], self.b[lane]) = (pair.a, pair.b);
        D::Axes::put(D::axes(pair.normal), lane, &mut self.normal);
        D::Frame::put(D::frame(&frame), lane, &mut self.frame);
        D::Axes::put(D::axes(a.inverse_mass), lane, &mut self.mass_a);
        D::Axes::put(D::axes(b.inverse_mass), lane, &mut self.mass_b);
        D::Tensor::put(D::tensor(a.inverse_inertia), lane, &mut self.inertia_a);
        D::Tensor::put(D::tensor(b.inverse_inertia), lane, &mut self.inertia_b);
        let surface = &pair.surface;
        self.static_friction.0[lane] = surface.static_friction as f32;
        self.kinetic_friction.0[lane] = surface.kinetic_friction as f32;
        self.firm.0[lane] = if moves(a) && moves(b) { 0.0 } else { 1.0 };
        let mut rebounds = false;
        for (place, point) in self.points.iter_mut().zip(pair.points) {
            let compliance = D::Matrix::from_columns(|axis| {
                let impulse = frame.column(axis);
                frame.apply_transposed(b.yield_at(point.arm_b, impulse) + a.yield_at(point.arm_a, impulse))
            });
            let along = compliance.column(0)[0];
            let approach = pair.normal.dot(a.point_velocity(point.arm_a) - b.point_velocity(point.arm_b));
            let rebound = if approach > pair.rest_speed { surface.restitution * approach } else { 0.0 };
            rebounds |= rebound > 0.0;
            D::Axes::put(D::axes(point.arm_a), lane, &mut place.arm_a);
            D::Axes::put(D::axes(point.arm_b), lane, &mut place.arm_b);
            place.separation.0[lane] = point.separation as f32;
            place.normal_mass.0[lane] = if along > 0.0 { (1.0 / along) as f32 } else { 0.0 };
            place.tangent_mass.0[lane] = D::tangent_mass(&compliance) as f32;
            place.friction.0[lane] = match point.slip {
                Slip::Sticking => surface.static_friction as f32,
                Slip::Sliding => surface.kinetic_friction as f32,
            };
            place.impulse.0[lane] = point.impulse[0] as f32;
            D::Tangents::put(D::tangents(point.impulse), lane, &mut place.tangents);
            place.rebound.0[lane] = rebound as f32;
        }
        rebounds
    }

    /// What the step did at a point of a lane.
    pub fn outcome(&self, lane: usize, point: usize) -> SoftOutcome<D> {
        let point = &self.points[point];
        let sticks = point.friction.0[lane] >= self.static_friction.0[lane];
        SoftOutcome {
            impulse: D::in_frame(point.impulse.0[lane], D::Tangents::take(&point.tangents, lane)),
            total: D::in_frame(point.total.0[lane], D::Tangents::take(&point.total_tangents, lane)),
            slip: if sticks { Slip::Sticking } else { Slip::Sliding },
        }
    }
}

/// Whether impulses move a body.
pub fn moves<D: Dim>(body: &SolverBody<D>) -> bool {
    body.inverse_mass != D::Vector::ZERO || body.inverse_inertia != D::Inertia::ZERO
}
