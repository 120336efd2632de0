//! Oriented boxes: a second, closer look at pairs whose volumes overlap.
//!
//! ```text
//!    ┌────────────┐         long thin shapes that lie askew fill little of their axis-aligned boxes;
//!    │ ╲╲     ╱╱  │         boxes that turn with them say much sooner that they are apart
//!    │   ╲╲ ╱╱    │
//!    └────────────┘
//! ```

use glam::DVec2;
use tumble_math::{Planar, Pose, Rotation};
use tumble_shape::PlanarShape;

/// A box that turns with a shape of the plane, in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    centre: DVec2,
    /// Unit vector along its first side.
    along: DVec2,
    /// Half the length of each side [m].
    half: DVec2,
}

impl OrientedBox {
    /// The box along the first side of a shape, grown by a margin on every side [m]; `None` for a half-plane, which has no end.
    pub fn around(shape: &PlanarShape, pose: &Pose<Planar>, margin: f64) -> Option<Self> {
        let first = shape.vertices().first()?;
        let along = shape.normals().first().map_or(DVec2::X, |normal| normal.perp());
        let coordinates = |vertex: &DVec2| DVec2::new(along.dot(*vertex), along.perp_dot(*vertex));
        let (mut low, mut high) = (coordinates(first), coordinates(first));
        for vertex in shape.vertices() {
            (low, high) = (low.min(coordinates(vertex)), high.max(coordinates(vertex)));
        }
        let middle = (low + high) * 0.5;
        Some(Self {
            centre: pose.transform_point(along * middle.x + along.perp() * middle.y),
            along: pose.rotation.rotate(along),
            half: (high - low) * 0.5 + DVec2::splat(shape.radius() + margin),
        })
    }

    /// Whether two boxes share a point; touching counts.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        let between = other.centre - self.centre;
        let cos = self.along.dot(other.along).abs();
        let sin = self.along.perp_dot(other.along).abs();
        // Half the extent of one box along the sides of another.
        let seen = |half: DVec2| DVec2::new(cos * half.x + sin * half.y, sin * half.x + cos * half.y);
        let apart =
            |along: DVec2, reach: DVec2| along.dot(between).abs() > reach.x || along.perp_dot(between).abs() > reach.y;
        !apart(self.along, self.half + seen(other.half)) && !apart(other.along, other.half + seen(self.half))
    }
}
