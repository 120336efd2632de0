//! Contact points of two shapes of space.
//!
//! Every shape but the half-space, the cylinder and the cone is a core (point, segment or polyhedron) grown by a radius. Cylinders and
//! cones are hulls of two circles, and have a search of their own, exact like the others (`rims.rs`).
//!
//! # The two generic cases (L2)
//!
//! ```text
//!   vertex on face                    edge across edge
//!
//!        \ | /                             |  e_b
//!         \|/        n: the face's         |           n: e_a × e_b, made unit,
//!     _____v______                    _____|_____ e_a     from a to b
//!    /___________/                         |
//! ```
//!
//! 1. Every face, and every pair of edges that make a face of the Minkowski difference, is tried as a separating axis (`search.rs`, and
//!    `boxes.rs` for two boxes). The one with the largest separation decides. Edges must be better than faces, and b's faces better
//!    than a's, by a tenth of the flush tolerance: so that near ties do not change from step to step.
//! 2. A face axis makes that face the *reference* face. The face of the other shape that faces it most squarely is cut to the prism
//!    above it (`cut.rs`), and of more than four points those that span the most are kept (`reduce.rs`).
//! 3. A pair of edges makes one point, where they pass each other.
//! 4. Shapes that are apart may be closest elsewhere: the separation along an axis is a lower bound of the distance, and a point that
//!    is no farther proves it. Where none is, the closest points are found by `gjk.rs`, and the normal joins them.
//!
//! Radii are subtracted last. For separated shapes the smallest separation is the true distance.
//!
//! # Degenerate pairs: the rule
//!
//! | What meets | Normal | Points | Kind |
//! |---|---|---|---|
//! | face, face | the reference face's | the cut | corners vertex–face, places where outlines cross edge–edge |
//! | face, edge | the face's | ends of the edge, or where it leaves the face | the same |
//! | parallel edges | joins them, square to both | two, at the ends of the common stretch, if one is a rod or capsule; else one | vertex–face |
//! | vertex, edge | joins them | one | vertex–face: the face is the plane through the edge square to the normal |
//! | vertex, vertex | joins them | one | vertex–vertex |
//!
//! Overlapping polyhedra are never a vertex–vertex, vertex–edge or parallel pair: a face is at least as good an axis.
//! What has a radius is `round-…` instead: on a face, on a vertex or edge, or on something round.
//!
//! # Ground of triangles
//!
//! A facet of a mesh collides as the prism below its triangle. A normal that leans over one of its sides further than the neighbour's
//! does is that of an inner edge, and nothing touches along it: what lies above the triangle itself touches its face instead, and
//! the rest is left to the neighbours (`facet.rs`).
//!
//! # Rules shared with the plane
//!
//! The rule against ghost bumps is the one of [`planar`](super::planar#no-ghost-bumps): when a face across the best
//! axis (60° to 90°) is within ± the flush tolerance, sharp shapes pass each other along an edge at no more than that depth, and there
//! is no contact. Two segments that cross keep the side they were on, by the normal of the manifold before.
//!
//! # Memory
//!
//! A manifold without points keeps the direction along which the shapes were apart. The next query tries it first; as long as it
//! separates them, nothing else is looked at. A manifold of polyhedra keeps its axis, and the search is left out as long as the
//! axis is bound to be as good as the best, to the preference of step 1 (`memory.rs`). Beyond that, and the side of crossing segments,
//! nothing depends on the step before.

mod axis;
mod boxes;
mod closest;
mod core;
mod cut;
mod draft;
mod face;
mod facet;
mod gjk;
mod half_space;
mod hulls;
mod memory;
mod place;
mod reduce;
mod rims;
mod round;
mod search;
mod segment;
mod segments;
mod simplex;

pub use self::memory::AxisMemory;

use glam::DVec3;
use tumble_math::{Pose, Spatial};
use tumble_shape::SpatialShape;

use self::core::Solid;
use self::place::Place;
use crate::manifold::SpatialManifold;
use crate::narrow::SpatialQuery;

/// Share of the flush tolerance by which another axis must be better to be taken [1].
const PREFERENCE: f64 = 0.1;

/// Rounding of places, relative to the size of the pair [1].
const ROUND_OFF: f64 = 1e-14;

/// How much of the flush tolerance still counts, so that an overlap equal to it is flush whatever rounding does [1].
const FLUSH_SLACK: f64 = 1.0 + 1e-6;

/// Contact points of shapes a and b in the given poses, the normal running from a to b.
///
/// Without points when the shapes are further apart than the margin, for two half-spaces, and for a pose that is not finite.
pub fn collide(
    a: &SpatialShape,
    pose_a: &Pose<Spatial>,
    b: &SpatialShape,
    pose_b: &Pose<Spatial>,
    query: &SpatialQuery,
) -> SpatialManifold {
    if rank(a) <= rank(b) {
        return ordered(a, pose_a, b, pose_b, query);
    }
    let previous = query.previous.map(SpatialManifold::flipped);
    let query = SpatialQuery { previous: previous.as_ref(), ..*query };
    ordered(b, pose_b, a, pose_a, &query).flipped()
}

/// Pairs are looked at with the shape of the smaller rank as a.
fn rank(shape: &SpatialShape) -> u8 {
    match shape {
        SpatialShape::HalfSpace(_) => 0,
        SpatialShape::Facet(_) => 1,
        SpatialShape::Cuboid(_) | SpatialShape::ConvexHull(_) => 2,
        SpatialShape::SpatialRod(_) | SpatialShape::Capsule(_) => 3,
        SpatialShape::Sphere(_) => 4,
        SpatialShape::Cylinder(_) | SpatialShape::Cone(_) => 5,
    }
}

fn ordered(
    a: &SpatialShape,
    pose_a: &Pose<Spatial>,
    b: &SpatialShape,
    pose_b: &Pose<Spatial>,
    query: &SpatialQuery,
) -> SpatialManifold {
    let Some(solid_b) = Solid::of(b) else { return SpatialManifold::EMPTY };
    let solid_a = Solid::of(a);
    let reach = solid_a.map_or(0.0, |solid| solid.reach()) + solid_b.reach();
    let pair = Pair::new(pose_a, pose_b, reach, query);
    if !pair.size.is_finite() {
        return SpatialManifold::EMPTY;
    }
    if let SpatialShape::HalfSpace(plane) = a {
        return half_space::collide(&pair, plane, &solid_b);
    }
    let Some(solid_a) = solid_a else { return SpatialManifold::EMPTY };
    match (solid_a, solid_b) {
        // The sides of its prism are no sides of anything: the rule against ghost bumps is not for them.
        (Solid::Facet(facet), other) => facet::collide(&Pair { flush: 0.0, ..pair }, facet, &other),
        (Solid::Hull(a, box_a), Solid::Hull(b, box_b)) => hulls::collide(&pair, a, b, box_a.zip(box_b)),
        (Solid::Hull(hull, _), Solid::Segment(ends, radius)) => round::collide(&pair, hull, ends, radius),
        (Solid::Hull(hull, _), Solid::Point(centre, radius)) => round::collide(&pair, hull, &[centre], radius),
        (Solid::Segment(a, radius_a), Solid::Segment(b, radius_b)) => {
            segments::collide(&pair, a, b, [radius_a, radius_b])
        }
        (Solid::Segment(a, radius_a), Solid::Point(b, radius_b)) => {
            segments::collide(&pair, a, &[b], [radius_a, radius_b])
        }
        (Solid::Point(a, radius_a), Solid::Point(b, radius_b)) => {
            segments::collide(&pair, &[a], &[b], [radius_a, radius_b])
        }
        (other, Solid::Rims(ends, radii)) => rims::collide(&pair, &other, ends, radii),
        // Ranks rule these out.
        _ => SpatialManifold::EMPTY,
    }
}

/// Two bodies' frames, and what is asked about them.
struct Pair<'a> {
    a_in_world: Place,
    b_in_world: Place,
    b_in_a: Place,
    /// Distance of the two origins and the reach of both shapes, for tolerances of rounding [m].
    size: f64,
    flush: f64,
    query: &'a SpatialQuery<'a>,
}

impl<'a> Pair<'a> {
    fn new(pose_a: &Pose<Spatial>, pose_b: &Pose<Spatial>, reach: f64, query: &'a SpatialQuery<'a>) -> Self {
        let a_in_world = Place::of(pose_a, DVec3::ZERO);
        let b_in_world = Place::of(pose_b, DVec3::ZERO);
        let b_in_a = b_in_world.seen_from(&a_in_world);
        Self {
            a_in_world,
            b_in_world,
            b_in_a,
            size: b_in_a.origin.length() + reach,
            flush: query.flush_tolerance * FLUSH_SLACK,
            query,
        }
    }

    /// By how much another axis must be better to be taken [m].
    fn preference(&self) -> f64 {
        PREFERENCE * self.query.flush_tolerance + self.rounding()
    }

    fn rounding(&self) -> f64 {
        ROUND_OFF * self.size
    }

    /// Overlap that counts as flush [m].
    fn flush(&self) -> f64 {
        self.flush
    }

    /// A direction along which the pair was apart the last time, in the frame of a.
    fn remembered_gap(&self) -> Option<DVec3> {
        let previous = self.query.previous.filter(|previous| previous.is_empty() && previous.normal != DVec3::ZERO)?;
        Some(self.a_in_world.unturned(previous.normal))
    }

    /// The normal of the manifold before, in the frame of a.
    fn remembered_normal(&self) -> Option<DVec3> {
        let previous = self.query.previous.filter(|previous| previous.normal != DVec3::ZERO)?;
        Some(self.a_in_world.unturned(previous.normal))
    }

    /// A manifold without points, of shapes that are apart along a direction (in the frame of a).
    fn apart(&self, normal: DVec3) -> SpatialManifold {
        SpatialManifold::along(self.a_in_world.vector(normal))
    }
}
