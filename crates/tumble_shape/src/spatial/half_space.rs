//! Half-space: everything on one side of a plane.

use glam::DVec3;
use tumble_math::{Pose, Spatial};

use super::SpatialShapeError;

/// Everything on one side of a plane: solid where normal · p ≤ offset.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfSpace {
    normal: DVec3,
    offset: f64,
}

impl HalfSpace {
    /// A half-space whose surface faces along `normal` (any length but zero), at `offset` from the origin along it [m].
    pub fn try_new(normal: DVec3, offset: f64) -> Result<Self, SpatialShapeError> {
        if !(normal.is_finite() && offset.is_finite()) {
            return Err(SpatialShapeError::NotFinite);
        }
        let normal = normal.try_normalize().ok_or(SpatialShapeError::ZeroNormal)?;
        Ok(Self { normal, offset })
    }

    /// Unit vector out of the solid.
    #[inline]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Signed distance of the surface from the origin along the normal [m].
    #[inline]
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The half-space turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        let normal = super::turned_unit(&pose.rotation, self.normal);
        Self { normal, offset: self.offset + normal.dot(pose.position) }
    }
}
