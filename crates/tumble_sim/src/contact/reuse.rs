//! Contact points of pairs that hardly moved against each other: carried along instead of found anew.
//!
//! In a pile at rest nearly all pairs keep their points for as long as it rests, and those of a moving heap for some steps. Each point is kept
//! as two anchors, one on each body, and the normal in the frame of the body whose face it belongs to; where the bodies are now says where the anchors are, and how far
//! apart. A corner thus keeps its true height above a face, and so does a ball that rolls on it, whose anchor is its centre. The pair
//! is looked at anew as soon as the smaller body's centre or its tips, seen from the other one, are farther than a tolerance from where they
//! were: errors never add up.
//!
//! Points are looked for a little farther than a step can reach, so that none is missed until then. While all of them are out of reach, the
//! pair does not act.
//!
//! Only models that soften contacts reuse points: the exact ones find them in every step.

use bevy_ecs::prelude::*;
use tumble_collision::{ContactKind, ContactPoint, CornerOf};
use tumble_math::{Linear, Matrix, Rotation};

use super::detect::BodyMotion;
use crate::geometry::Geometry;

/// How far the smaller body of a pair and its tips may move before the points are found anew, in length scales: four times the default
/// slop. What a point on a face is off by is of second order in it.
const TOLERANCE: f64 = 0.02;
/// The same for round corners on corners, whose normal turns as they move, and for what rolls off its points: the default slop.
const TOLERANCE_OF_ROUND: f64 = 0.005;
/// The same as a share of the smaller body's reach, for bodies that are small against the length scale [1].
const SHARE: f64 = 0.1;

/// What soft steps remember of a pair besides its points.
#[derive(Component, Clone, Copy, Debug)]
pub struct ContactReuse<D: Geometry> {
    /// Centre of the smaller body, seen from the other one, when points were last found [m].
    centre: D::Vector,
    /// Its rotation, seen from the other one, at the same time.
    turn: D::Rotation,
    /// How far it reaches from its centre [m].
    reach: f64,
    /// Square of how far it may move [m²].
    tolerance_squared: f64,
    /// Points were looked for up to this separation [m].
    margin: f64,
    /// Normal in the frame of the body that it belongs to.
    normal: D::Vector,
    /// Each point on a in a's frame, and on b in b's frame, without what the shapes are rounded by [m].
    anchors: D::PerPoint<[D::Vector; 2]>,
    /// By what the shapes are rounded [m].
    radii: [f64; 2],
    /// Whether a is the smaller body.
    a_is_smaller: bool,
    /// Whether the normal is that of a face of b.
    normal_of_b: bool,
    /// The points that are corners of a, and of b, on a face of the other, a bit for each: they stay with the corner.
    corners: [u8; 2],
}

impl<D: Geometry> Default for ContactReuse<D> {
    fn default() -> Self {
        Self {
            centre: D::Vector::ZERO,
            turn: D::Rotation::default(),
            reach: 0.0,
            tolerance_squared: 0.0,
            margin: f64::NEG_INFINITY,
            normal: D::Vector::ZERO,
            anchors: D::PerPoint::default(),
            radii: [0.0; 2],
            a_is_smaller: false,
            normal_of_b: false,
            corners: [0; 2],
        }
    }
}

/// What carrying the points of a pair depends on.
#[derive(Clone, Copy, Debug)]
pub struct CarriedParts {
    /// How far the parts reach from their bodies' centres of mass; infinite for what has no bounds [m].
    pub reaches: [f64; 2],
    /// By what they are rounded [m].
    pub radii: [f64; 2],
    /// Whether one of them rolls off the points that it touches with: a cylinder or cone, which has no centre to carry.
    pub roll: bool,
    /// Unit of the tolerances [m].
    pub length_scale: f64,
}

impl CarriedParts {
    /// How far the smaller part reaches [m].
    fn reach(&self) -> f64 {
        self.reaches[0].min(self.reaches[1])
    }

    /// How far it may move before points are found anew [m].
    pub fn tolerance(&self) -> f64 {
        (TOLERANCE * self.length_scale).min(SHARE * self.reach())
    }

    /// The same for round corners on corners [m].
    fn tolerance_of_round(&self) -> f64 {
        self.tolerance().min(TOLERANCE_OF_ROUND * self.length_scale)
    }
}

impl<D: Geometry> ContactReuse<D> {
    /// Remembers points found where the bodies are, up to a margin [m].
    pub fn remember(&mut self, found: &D::Manifold, [a, b]: [&BodyMotion<D>; 2], parts: &CarriedParts, margin: f64) {
        let (points, normal) = (D::points(found), D::normal(found));
        for (anchors, point) in self.anchors.as_mut().iter_mut().zip(points) {
            let [to_a, to_b] = parts.radii.map(|radius| normal * (0.5 * point.separation + radius));
            *anchors = [a.in_body(point.point - to_a), b.in_body(point.point + to_b)];
        }
        let is_round = |kind: ContactKind| matches!(kind, ContactKind::RoundVertex | ContactKind::RoundRound);
        let round = parts.roll || points.iter().any(|point| is_round(point.kind));
        let tolerance = if round { parts.tolerance_of_round() } else { parts.tolerance() };
        let a_is_smaller = parts.reaches[0] < parts.reaches[1];
        let [other, smaller] = if a_is_smaller { [b, a] } else { [a, b] };
        let corners = [CornerOf::A, CornerOf::B].map(|owner| {
            let is_its = |point: &ContactPoint<D::Vector>| u8::from(point.feature.corner() == owner);
            points.iter().rev().fold(0, |bits, point| bits << 1 | is_its(point))
        });
        let normal_of_b = !points.is_empty() && corners[0].count_ones() as usize == points.len();
        *self = Self {
            centre: other.in_body(smaller.pose.position),
            turn: smaller.pose.rotation.seen_from(&other.pose.rotation),
            reach: parts.reach(),
            tolerance_squared: tolerance * tolerance,
            margin,
            normal: if normal_of_b { b } else { a }.axes.apply_transposed(normal),
            anchors: self.anchors,
            radii: parts.radii,
            a_is_smaller,
            normal_of_b,
            corners,
        };
    }

    /// Whether they are still good: the bodies have hardly moved against each other, and nobody looks farther.
    #[inline]
    pub fn holds(&self, [a, b]: [&BodyMotion<D>; 2], margin: f64) -> bool {
        let [other, smaller] = if self.a_is_smaller { [b, a] } else { [a, b] };
        let moved = other.in_body(smaller.pose.position) - self.centre;
        let strayed = smaller.pose.rotation.strayed(&other.pose.rotation, &self.turn);
        let squared = self.tolerance_squared;
        margin <= self.margin && moved.dot(moved) <= squared && self.reach * self.reach * strayed <= squared
    }

    /// Carries the points to where the bodies are now.
    #[inline]
    pub fn carry(&self, manifold: &mut D::Manifold, [a, b]: [&BodyMotion<D>; 2]) {
        let normal = if self.normal_of_b { b } else { a }.axes.apply(self.normal);
        let [rounded_a, rounded_b] = self.radii.map(|radius| normal * radius);
        D::carry(manifold, normal, |number| {
            let [on_a, on_b] = self.anchors.as_ref()[number];
            let (on_a, on_b) = (a.in_world(on_a) + rounded_a, b.in_world(on_b) - rounded_b);
            let separation = normal.dot(on_b - on_a);
            let [of_a, of_b] = self.corners.map(|corners| corners >> number & 1 == 1);
            let point = match (of_a, of_b) {
                (true, _) => on_a + normal * (0.5 * separation),
                (_, true) => on_b - normal * (0.5 * separation),
                _ => (on_a + on_b) * 0.5,
            };
            (point, separation)
        });
    }
}
