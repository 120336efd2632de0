//! Half-plane: everything on one side of a line.

use glam::DVec2;
use tumble_math::{Planar, Pose};

use crate::ShapeError;

/// Everything on one side of a line: solid where normal · p ≤ offset.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfPlane {
    normal: DVec2,
    offset: f64,
}

impl HalfPlane {
    /// A half-plane whose surface faces along `normal` (any length but zero), at `offset` from the origin along it [m].
    pub fn try_new(normal: DVec2, offset: f64) -> Result<Self, ShapeError> {
        if !(normal.is_finite() && offset.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        let normal = normal.try_normalize().ok_or(ShapeError::ZeroNormal)?;
        Ok(Self { normal, offset })
    }

    /// Unit vector out of the solid.
    #[inline]
    pub fn normal(&self) -> DVec2 {
        self.normal
    }

    /// Signed distance of the surface from the origin along the normal [m].
    #[inline]
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The half-plane turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Planar>) -> Self {
        let normal = super::turned_unit(&pose.rotation, self.normal);
        Self { normal, offset: self.offset + normal.dot(pose.position) }
    }
}
