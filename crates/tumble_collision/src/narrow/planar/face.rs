//! A reference side, and the side that faces it cut to its length.
//!
//! ```text
//!            other core
//!     q₀ ____________________ q₁
//!        |   incident side   |         heights h of q₀, q₁ above the reference side,
//!        :   x           x   :         places u along it; x: where they are cut
//!            |___________|
//!            p₀  owner   p₁   ↑ normal
//! ```

use glam::DVec2;

use super::core::{Axis, Core, Owner};
use crate::manifold::{ContactKind, ContactPoint, FeatureId, PlanarManifold};

/// Share of the reference side's length by which a corner may lie beyond its end and still count as on it [1].
///
/// Boxes of one width stacked exactly have corners at the very end; rounding must not change which corner makes the point.
const END_SNAP: f64 = 1e-9;

/// A corner, or the place where a side was cut.
#[derive(Clone, Copy)]
struct CutPoint {
    place: DVec2,
    height: f64,
    feature: FeatureId,
    round: bool,
}

/// The incident side cut to the reference side: no, one or two points.
pub(super) struct Cut {
    normal: DVec2,
    incident_radius: f64,
    radii: f64,
    normal_a_to_b: DVec2,
    points: [Option<CutPoint>; 2],
}

impl Cut {
    /// Cuts what faces the axis' side.
    pub(super) fn new(axis: &Axis, a: &Core, b: &Core) -> Self {
        let (reference, incident) = match axis.owner {
            Owner::A => (a, b),
            Owner::B => (b, a),
        };
        let normal = axis.normal;
        let (start, end) = (axis.side, reference.next(axis.side));
        let (p0, p1) = (reference.vertex(start), reference.vertex(end));
        let tangent = normal.perp();
        let length = tangent.dot(p1 - p0);
        let snap = END_SNAP * length;

        let feature_of = |of_incident: bool, i: usize| {
            let of_b = of_incident == (axis.owner == Owner::A);
            if of_b { FeatureId::vertex_of_b(i) } else { FeatureId::vertex_of_a(i) }
        };
        let corner = |i: usize| {
            let place = incident.vertex(i);
            let from_start = place - p0;
            let (along, height) = (tangent.dot(from_start), normal.dot(from_start));
            (along, CutPoint { place, height, feature: feature_of(true, i), round: incident.radius > 0.0 })
        };

        let points = if incident.side_count() == 0 {
            let (along, point) = corner(0);
            [(-snap <= along && along <= length + snap).then_some(point), None]
        } else {
            let side = facing_side(incident, normal, axis.support);
            let (one, other) = (corner(side), corner(incident.next(side)));
            let (high, low) = if one.0 >= other.0 { (one, other) } else { (other, one) };
            if high.0 < -snap || low.0 > length + snap {
                [None, None]
            } else {
                // Where the incident side runs over the end of the reference side, at `along`.
                let cut_at = |along: f64, vertex: usize| {
                    let share = (along - low.0) / (high.0 - low.0);
                    CutPoint {
                        place: low.1.place + (high.1.place - low.1.place) * share,
                        height: low.1.height + (high.1.height - low.1.height) * share,
                        feature: feature_of(false, vertex),
                        round: reference.radius > 0.0,
                    }
                };
                let low_point = if low.0 < -snap { cut_at(0.0, start) } else { low.1 };
                let high_point = if high.0 > length + snap { cut_at(length, end) } else { high.1 };
                [Some(low_point), Some(high_point)]
            }
        };
        Self {
            normal,
            incident_radius: incident.radius,
            radii: a.radius + b.radius,
            normal_a_to_b: axis.normal_a_to_b(),
            points,
        }
    }

    /// Smallest height of the points above the reference side; infinite if there is none [m].
    pub(super) fn lowest(&self) -> f64 {
        self.points.iter().flatten().map(|point| point.height).fold(f64::INFINITY, f64::min)
    }

    /// The points within the margin, as a manifold.
    pub(super) fn manifold(&self, origin: DVec2, margin: f64) -> PlanarManifold {
        let mut manifold = PlanarManifold::along(self.normal_a_to_b);
        for point in self.points.iter().flatten() {
            let separation = point.height - self.radii;
            if separation <= margin {
                manifold.insert(ContactPoint {
                    point: point.place - self.normal * (self.incident_radius + 0.5 * separation) + origin,
                    separation,
                    feature: point.feature,
                    kind: if point.round { ContactKind::RoundFace } else { ContactKind::VertexFace },
                });
            }
        }
        if manifold.is_empty() { PlanarManifold::EMPTY } else { manifold }
    }
}

/// Of the two sides at a corner, the one that faces a direction most squarely.
fn facing_side(core: &Core, direction: DVec2, corner: usize) -> usize {
    let before = core.previous(corner);
    if direction.dot(core.normal(before)) < direction.dot(core.normal(corner)) { before } else { corner }
}
