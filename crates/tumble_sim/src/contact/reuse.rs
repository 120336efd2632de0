//! Contact points of pairs that hardly moved against each other: carried along instead of found anew.
//!
//! In a pile at rest nearly all pairs keep their points for as long as it rests. Each point is kept as two anchors, one on each body,
//! and the normal in a's frame; where the bodies are now says where the anchors are, and how far apart. The pair is looked at anew
//! as soon as b's centre or the tips of its axes, seen from a, are farther than a tolerance from where they were: errors never add up.
//!
//! Only models that soften contacts reuse points: the exact ones find them in every step.

use bevy_ecs::prelude::*;
use tumble_math::{Linear, Matrix, Rotation};

use super::detect::BodyMotion;
use crate::geometry::Geometry;

/// How far centre and tips may move before the points are found anew [length scales]: the default slop.
pub(super) const REUSE_TOLERANCE: f64 = 0.005;

/// What soft steps remember of a pair besides its points.
#[derive(Component, Clone, Copy, Debug)]
pub struct ContactReuse<D: Geometry> {
    /// b's centre, seen from a, when points were last found [m].
    centre: D::Vector,
    /// b's rotation, seen from a, at the same time.
    turn: D::Rotation,
    /// Size of the larger part [m].
    reach: f64,
    /// Points were looked for up to this separation [m].
    margin: f64,
    /// Normal in a's frame.
    normal: D::Vector,
    /// Each point on a in a's frame, and on b in b's frame [m].
    anchors: D::PerPoint<[D::Vector; 2]>,
    /// Angular impulse about the normal with which the next step begins [N·m·s].
    pub(super) twist: f32,
}

impl<D: Geometry> Default for ContactReuse<D> {
    fn default() -> Self {
        Self {
            centre: D::Vector::ZERO,
            turn: D::Rotation::default(),
            reach: 0.0,
            margin: f64::NEG_INFINITY,
            normal: D::Vector::ZERO,
            anchors: D::PerPoint::default(),
            twist: 0.0,
        }
    }
}

impl<D: Geometry> ContactReuse<D> {
    /// Remembers points found where the bodies are, up to a margin; `reach` is the size of the larger part [m].
    pub(super) fn remember(&mut self, found: &D::Manifold, [a, b]: [&BodyMotion<D>; 2], reach: f64, margin: f64) {
        let normal = D::normal(found);
        for (anchors, point) in self.anchors.as_mut().iter_mut().zip(D::points(found)) {
            let half = normal * (0.5 * point.separation);
            *anchors = [a.in_body(point.point - half), b.in_body(point.point + half)];
        }
        let twist = if D::points(found).is_empty() { 0.0 } else { self.twist };
        *self = Self {
            centre: a.in_body(b.pose.position),
            turn: b.pose.rotation.seen_from(&a.pose.rotation),
            reach,
            margin,
            normal: a.axes.apply_transposed(normal),
            anchors: self.anchors,
            twist,
        };
    }

    /// Whether they are still good: the bodies have hardly moved against each other, and nobody looks farther.
    #[inline]
    pub(super) fn holds(&self, [a, b]: [&BodyMotion<D>; 2], margin: f64, tolerance: f64) -> bool {
        let moved = a.in_body(b.pose.position) - self.centre;
        let strayed = b.pose.rotation.strayed(&a.pose.rotation, &self.turn);
        let squared = tolerance * tolerance;
        margin <= self.margin && moved.dot(moved) <= squared && self.reach * self.reach * strayed <= squared
    }

    /// Carries the points to where the bodies are now.
    #[inline]
    pub(super) fn carry(&self, manifold: &mut D::Manifold, [a, b]: [&BodyMotion<D>; 2]) {
        let normal = a.axes.apply(self.normal);
        D::carry(manifold, normal, |number| {
            let [on_a, on_b] = self.anchors.as_ref()[number];
            let (on_a, on_b) = (a.in_world(on_a), b.in_world(on_b));
            ((on_a + on_b) * 0.5, normal.dot(on_b - on_a))
        });
    }
}
