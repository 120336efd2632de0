//! Rod in space: a straight line between two points.

use glam::DVec3;
use tumble_math::{Pose, Spatial};

use super::SpatialShapeError;
use super::axis::Axis;
use crate::MassProperties;

/// A straight line from one point to another, as thin as its radius says; radius 0 is a line without thickness.
///
/// Its mass lies on the line: the radius shapes the surface and adds no mass. So nothing resists a spin about the line itself, and
/// the inertia of a single rod has no inverse. A [`Capsule`](super::Capsule) has the same surface and is filled.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialRod {
    axis: Axis,
    radius: f64,
}

impl SpatialRod {
    /// A rod between two points [m], with a radius of its round surface [m].
    pub fn try_new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, SpatialShapeError> {
        if !radius.is_finite() {
            return Err(SpatialShapeError::NotFinite);
        }
        if radius < 0.0 {
            return Err(SpatialShapeError::NegativeRadius { radius });
        }
        Ok(Self { axis: Axis::try_new(from, to, "rod")?, radius })
    }

    /// Both ends, the first one given first [m].
    #[inline]
    pub fn ends(&self) -> &[DVec3; 2] {
        &self.axis.ends
    }

    /// Distance of its surface from its line [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance between its ends [m].
    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// The rod turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { axis: self.axis.posed(pose), radius: self.radius }
    }

    /// Mass properties at a line density [kg/m].
    ///
    /// ```text
    /// m = ρ L,   I across = m L²/12,   I along = 0
    /// ```
    pub fn mass_properties(&self, line_density: f64) -> MassProperties<Spatial> {
        let length = self.length();
        let mass = line_density * length;
        let inertia = self.axis.tensor(0.0, mass * length * length / 12.0);
        MassProperties { mass, centre: self.axis.middle(), inertia }
    }
}
