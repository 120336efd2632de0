//! Contact entities and their components.

use bevy_ecs::prelude::*;
use tumble_collision::FeatureId;
use tumble_math::Linear;
use tumble_solver::soft_step::PairColour;
use tumble_solver::{Slip, Surface};

use crate::body::BodyId;
use crate::geometry::Geometry;
use crate::part::Response;

/// Identity of a pair of parts; its order is the order of everything done with contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PairKey {
    /// Body with the smaller id.
    pub a: BodyId,
    /// The other body.
    pub b: BodyId,
    /// Number of a's part.
    pub part_a: u32,
    /// Number of b's part.
    pub part_b: u32,
}

/// Two parts that are near each other: one entity from the first step in which they might touch until their fat bounds part.
#[derive(Component, Clone, Copy, Debug)]
pub struct ContactPair {
    /// Which parts.
    pub key: PairKey,
    /// Ranks of the two bodies.
    pub bodies: [u32; 2],
    /// Ranks of the two parts in [`Colliders`](super::Colliders).
    pub colliders: [u32; 2],
    /// Friction and restitution of the pair.
    pub surface: Surface,
    /// Whether the parts push each other.
    pub response: Response,
    /// Whether some point touches.
    pub touching: bool,
    /// Number of its contact points.
    pub(crate) points: u8,
    /// Whether the next step may reach one of them.
    pub(crate) acts: bool,
    /// When soft steps solve the pair.
    pub(crate) colour: PairColour,
    /// Angular impulse about the normal with which the next soft step begins [N·m·s].
    pub(crate) twist: f32,
}

/// Where the two parts touch or nearly do.
#[derive(Component, Clone, Debug)]
pub struct ContactManifold<D: Geometry>(pub D::Manifold);

/// What is remembered of each point of the manifold, in the same order.
#[derive(Component, Clone, Copy, Debug)]
pub struct ContactMemory<D: Geometry>(pub D::PerPoint<PointMemory<D::Vector>>);

/// What is remembered of a contact point from step to step.
#[derive(Clone, Copy, Debug)]
pub struct PointMemory<V> {
    /// Which features made the point.
    pub feature: FeatureId,
    /// Impulse with which the velocity filter begins, in the contact frame [N·s].
    pub impulse: V,
    /// Whether the point slides.
    pub slip: Slip,
    /// Sum of the impulses of this step, on b in world axes [N·s].
    pub given: V,
    /// Impulses of phases 1 to 3 of the part of the step being taken, which detection adds to `given` [N·s].
    pub pending: V,
    /// Whether the velocity filter, or a resting force, pushed the point in the part of the step that led here.
    pub held_back: bool,
    /// Separation found by the detection before; `None` for a new point [m].
    pub separation_before: Option<f64>,
    /// Whether the position filter held the point in this step: it met the surface, whatever gap its turning leaves.
    pub held: bool,
    /// Whether the point touches.
    pub touches: bool,
    /// Whether the point is on its way to its next impact, however small its gap; only where steps are cut at impacts.
    pub flies: bool,
    /// Whether the point left at the start of this part of the step and arrived again at its end.
    pub hopped: bool,
}

impl<V: Linear> Default for PointMemory<V> {
    fn default() -> Self {
        Self {
            feature: FeatureId(0),
            impulse: V::ZERO,
            slip: Slip::default(),
            given: V::ZERO,
            pending: V::ZERO,
            held_back: false,
            separation_before: None,
            held: false,
            touches: false,
            flies: false,
            hopped: false,
        }
    }
}
