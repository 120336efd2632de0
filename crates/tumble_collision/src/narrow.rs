//! Narrow phase: the contact points of one pair of shapes.

use glam::{DVec2, DVec3};

use crate::manifold::Manifold;

pub mod planar;
pub mod spatial;

/// What is asked about a pair, besides its shapes and poses.
#[derive(Clone, Copy, Debug)]
pub struct Query<'a, V, const N: usize, M = ()> {
    /// Largest separation at which a point is reported [m]. More finds contacts earlier; 0 reports touching points only.
    pub margin: f64,
    /// Overlap that counts as lying flush, so that sliding over a seam meets no side of the next shape [m].
    ///
    /// Twice the slop is a good value: resting shapes sink in by the slop and sometimes a little more. It must stay well below the
    /// size of any sharp feature, because shapes that pass each other no deeper than this do not collide. Zero switches the rule
    /// off; see [`planar`].
    pub flush_tolerance: f64,
    /// The same pair's manifold of the step before. It decides on which side of a thin rod the other shape belongs, and in space
    /// tells where to look first.
    pub previous: Option<&'a Manifold<V, N, M>>,
}

/// A query about two shapes of the plane.
pub type PlanarQuery<'a> = Query<'a, DVec2, 2>;

/// A query about two shapes of space.
pub type SpatialQuery<'a> = Query<'a, DVec3, 4, spatial::AxisMemory>;
