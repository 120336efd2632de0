//! Contact points of two shapes of the plane.

use tumble_math::{Planar, Pose};
use tumble_shape::PlanarShape;

use crate::manifold::PlanarManifold;
use crate::narrow::PlanarQuery;

/// Contact points of shapes a and b in the given poses, the normal running from a to b.
pub fn collide(
    _a: &PlanarShape,
    _pose_a: &Pose<Planar>,
    _b: &PlanarShape,
    _pose_b: &Pose<Planar>,
    _query: &PlanarQuery,
) -> PlanarManifold {
    PlanarManifold::EMPTY
}
