//! Where one frame is in another.

use glam::{DMat3, DVec3};
use tumble_math::{Pose, Spatial};

/// A frame seen from another: its axes and its origin. Matrices, because many points go through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) axes: DMat3,
    pub(super) origin: DVec3,
}

impl Place {
    /// A body's frame, seen from axes along the world's with another origin [m].
    pub(super) fn of(pose: &Pose<Spatial>, origin: DVec3) -> Self {
        Self { axes: pose.rotation.to_matrix(), origin: pose.position - origin }
    }

    /// This frame seen from another that stands in the same third one.
    pub(super) fn seen_from(&self, other: &Self) -> Self {
        let back = other.axes.transpose();
        Self { axes: back * self.axes, origin: back * (self.origin - other.origin) }
    }

    /// The other frame seen from this one.
    pub(super) fn inverse(&self) -> Self {
        let back = self.axes.transpose();
        Self { axes: back, origin: -(back * self.origin) }
    }

    /// A point of this frame, in the other [m].
    #[inline]
    pub(super) fn point(&self, point: DVec3) -> DVec3 {
        self.axes * point + self.origin
    }

    /// A direction of this frame, in the other.
    #[inline]
    pub(super) fn vector(&self, vector: DVec3) -> DVec3 {
        self.axes * vector
    }

    /// A direction of the other frame, in this one.
    #[inline]
    pub(super) fn unturned(&self, vector: DVec3) -> DVec3 {
        DVec3::new(self.axes.x_axis.dot(vector), self.axes.y_axis.dot(vector), self.axes.z_axis.dot(vector))
    }
}
