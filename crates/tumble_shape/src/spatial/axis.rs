//! A straight axis between two points: what rods, capsules, cylinders and cones are built around.

use glam::DVec3;
use tumble_math::{Pose, Rotation, Spatial, SymmetricTensor};

use super::SpatialShapeError;

/// Two ends and the unit vector from the first to the second.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) ends: [DVec3; 2],
    pub(super) direction: DVec3,
}

impl Axis {
    /// An axis between two points [m]; `shape` is named by the refusal.
    pub(super) fn try_new(from: DVec3, to: DVec3, shape: &'static str) -> Result<Self, SpatialShapeError> {
        if !(from.is_finite() && to.is_finite()) {
            return Err(SpatialShapeError::NotFinite);
        }
        let direction = (to - from).try_normalize();
        let DVec3 { x, y, z } = from;
        let direction = direction.ok_or(SpatialShapeError::CoincidentEnds { shape, x, y, z })?;
        Ok(Self { ends: [from, to], direction })
    }

    /// Distance between the ends [m].
    pub(super) fn length(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }

    /// Middle of the ends [m].
    pub(super) fn middle(&self) -> DVec3 {
        (self.ends[0] + self.ends[1]) * 0.5
    }

    /// The axis turned and then moved by a pose.
    pub(super) fn posed(&self, pose: &Pose<Spatial>) -> Self {
        let turned = pose.rotation.rotate(self.direction);
        Self { ends: self.ends.map(|end| pose.transform_point(end)), direction: turned * (1.0 / turned.length()) }
    }

    /// The tensor with one moment about the axis and another about every line across it [kg·m²]:
    /// `across` 1 + (`along` − `across`) u uᵀ.
    pub(super) fn tensor(&self, along: f64, across: f64) -> SymmetricTensor {
        let (u, more) = (self.direction, along - across);
        SymmetricTensor {
            diagonal: DVec3::splat(across) + u * u * more,
            off_diagonal: DVec3::new(u.y * u.z, u.x * u.z, u.x * u.y) * more,
        }
    }
}
