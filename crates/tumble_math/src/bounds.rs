//! Axis-aligned bounding boxes.

use crate::Vector;

/// An axis-aligned box in world axes [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<V> {
    /// Corner with the smallest coordinates [m].
    pub min: V,
    /// Corner with the largest coordinates [m].
    pub max: V,
}

impl<V: Vector> Bounds<V> {
    /// The box that holds nothing: joining it with another gives the other.
    pub fn empty() -> Self {
        Self { min: V::splat(f64::INFINITY), max: V::splat(f64::NEG_INFINITY) }
    }

    /// The smallest box around points [m].
    pub fn around(points: impl IntoIterator<Item = V>) -> Self {
        points.into_iter().fold(Self::empty(), |bounds, point| bounds.join(Self { min: point, max: point }))
    }

    /// The smallest box that holds both.
    #[inline]
    pub fn join(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box grown by `margin` on every side [m].
    #[inline]
    pub fn grown(self, margin: f64) -> Self {
        Self { min: self.min - V::splat(margin), max: self.max + V::splat(margin) }
    }

    /// Whether the two boxes share a point; touching counts.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..V::AXES).all(|axis| self.min[axis] <= other.max[axis] && other.min[axis] <= self.max[axis])
    }

    /// Whether `other` lies inside; touching counts.
    #[inline]
    pub fn contains(&self, other: &Self) -> bool {
        (0..V::AXES).all(|axis| self.min[axis] <= other.min[axis] && other.max[axis] <= self.max[axis])
    }

    /// Length of each side [m].
    #[inline]
    pub fn size(&self) -> V {
        self.max - self.min
    }

    /// Middle point [m].
    #[inline]
    pub fn centre(&self) -> V {
        (self.min + self.max) * 0.5
    }

    /// Sum of the side lengths, the cost measure of trees of boxes [m].
    #[inline]
    pub fn half_perimeter(&self) -> f64 {
        self.size().dot(V::splat(1.0))
    }
}
