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

/// A box with sides of its own directions.
pub trait TurningBox: Copy {
    /// A point.
    type Vector;

    /// Whether two boxes share a point; touching counts.
    fn overlaps(&self, other: &Self) -> bool;

    /// Whether another box lies inside.
    fn contains(&self, other: &Self) -> bool;

    /// The box grown by a margin on every side [m].
    fn grown(self, margin: f64) -> Self;

    /// A box with the same directions around all that this one passes through as it moves by `travel` [m].
    fn swept(self, travel: Self::Vector) -> Self;
}

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

    /// Half the extents of another box along the sides of this one [m].
    fn seen(&self, other: &Self) -> DVec2 {
        let cos = self.along.dot(other.along).abs();
        let sin = self.along.perp_dot(other.along).abs();
        DVec2::new(cos * other.half.x + sin * other.half.y, sin * other.half.x + cos * other.half.y)
    }

    /// The sizes of a vector along the sides.
    fn along_sides(&self, vector: DVec2) -> DVec2 {
        DVec2::new(self.along.dot(vector).abs(), self.along.perp_dot(vector).abs())
    }
}

impl TurningBox for OrientedBox {
    type Vector = DVec2;

    #[inline]
    fn overlaps(&self, other: &Self) -> bool {
        let between = other.centre - self.centre;
        let meets = |one: &Self, other: &Self| one.along_sides(between).cmple(one.half + one.seen(other)).all();
        meets(self, other) && meets(other, self)
    }

    #[inline]
    fn contains(&self, other: &Self) -> bool {
        (self.along_sides(other.centre - self.centre) + self.seen(other)).cmple(self.half).all()
    }

    fn grown(self, margin: f64) -> Self {
        Self { half: self.half + DVec2::splat(margin), ..self }
    }

    fn swept(self, travel: DVec2) -> Self {
        Self { centre: self.centre + travel * 0.5, half: self.half + self.along_sides(travel) * 0.5, ..self }
    }
}
