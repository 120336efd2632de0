//! Contact points of pairs that hardly moved against each other: carried along instead of found anew.
//!
//! In a pile at rest nearly all pairs keep their points for as long as it rests. Each point is kept as two anchors, one on each body,
//! and the normal in a's frame; where the bodies are now says where the anchors are, and how far apart. The pair is looked at anew
//! as soon as a marker of b, seen from a, is farther than a tolerance from where it was: errors never add up.
//!
//! Only models that soften contacts reuse points: the exact ones find them in every step.

use bevy_ecs::prelude::*;
use tumble_math::{Linear, Pose, Rotation, Vector};

use crate::geometry::Geometry;

/// How far a marker may move before the points are found anew [length scales]: the default slop.
pub(super) const REUSE_TOLERANCE: f64 = 0.005;

/// The last contact points that were found, in the frames of the two bodies.
#[derive(Component, Clone, Copy, Debug)]
pub struct ContactReuse<D: Geometry> {
    /// b's centre and the ends of its axes, seen from a [m].
    markers: [D::Vector; 3],
    /// Length of those axes [m].
    reach: f64,
    /// Points were looked for up to this separation [m].
    margin: f64,
    /// Normal in a's frame.
    normal: D::Vector,
    /// Each point on a in a's frame, and on b in b's frame [m].
    anchors: D::PerPoint<[D::Vector; 2]>,
}

impl<D: Geometry> Default for ContactReuse<D> {
    fn default() -> Self {
        Self {
            markers: [D::Vector::ZERO; 3],
            reach: 0.0,
            margin: f64::NEG_INFINITY,
            normal: D::Vector::ZERO,
            anchors: D::PerPoint::default(),
        }
    }
}

impl<D: Geometry> ContactReuse<D> {
    /// Remembers points found at these poses, up to a margin; `reach` is the size of the larger part [m].
    pub(super) fn of(found: &D::Manifold, [a, b]: [&Pose<D>; 2], reach: f64, margin: f64) -> Self {
        let normal = D::normal(found);
        let mut anchors = D::PerPoint::<[D::Vector; 2]>::default();
        for (anchors, point) in anchors.as_mut().iter_mut().zip(D::points(found)) {
            let half = normal * (0.5 * point.separation);
            *anchors = [a.inverse_transform_point(point.point - half), b.inverse_transform_point(point.point + half)];
        }
        Self { markers: markers(a, b, reach), reach, margin, normal: a.rotation.unrotate(normal), anchors }
    }

    /// Whether they are still good: the bodies have hardly moved against each other, and nobody looks farther.
    pub(super) fn holds(&self, [a, b]: [&Pose<D>; 2], margin: f64, tolerance: f64) -> bool {
        let near = |(now, then): (D::Vector, &D::Vector)| {
            let moved = now - *then;
            moved.dot(moved) <= tolerance * tolerance
        };
        margin <= self.margin && markers(a, b, self.reach).into_iter().zip(&self.markers).all(near)
    }

    /// The points where the bodies are now.
    pub(super) fn carried(&self, before: &D::Manifold, [a, b]: [&Pose<D>; 2]) -> D::Manifold {
        let normal = a.rotation.rotate(self.normal);
        D::placed(before, normal, |number| {
            let [on_a, on_b] = self.anchors.as_ref()[number];
            let (on_a, on_b) = (a.transform_point(on_a), b.transform_point(on_b));
            ((on_a + on_b) * 0.5, normal.dot(on_b - on_a))
        })
    }
}

/// b's centre and the ends of all its axes but the last, seen from a: where they are, b is [m].
fn markers<D: Geometry>(a: &Pose<D>, b: &Pose<D>, reach: f64) -> [D::Vector; 3] {
    let centre = a.inverse_transform_point(b.position);
    let mut markers = [centre; 3];
    for (axis, marker) in markers[1..D::Vector::AXES].iter_mut().enumerate() {
        let arm = b.rotation.rotate(D::Vector::unit(axis) * reach);
        *marker += a.rotation.unrotate(arm);
    }
    markers
}
