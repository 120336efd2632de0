//! Sphere: a filled ball.

use std::f64::consts::PI;

use glam::DVec3;
use tumble_math::{Pose, Spatial, SymmetricTensor};

use super::SpatialShapeError;
use super::error::positive_radius;
use crate::MassProperties;

/// A filled ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    centre: DVec3,
    radius: f64,
}

impl Sphere {
    /// A ball around a point [m] with a radius [m].
    pub fn try_new(centre: DVec3, radius: f64) -> Result<Self, SpatialShapeError> {
        if !centre.is_finite() {
            return Err(SpatialShapeError::NotFinite);
        }
        Ok(Self { centre, radius: positive_radius(radius, "sphere")? })
    }

    /// Its middle [m].
    #[inline]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Its radius [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn centre_slice(&self) -> &[DVec3] {
        std::slice::from_ref(&self.centre)
    }

    /// The ball turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { centre: pose.transform_point(self.centre), radius: self.radius }
    }

    /// Mass properties at a density [kg/m³].
    ///
    /// ```text
    /// m = ρ 4π r³/3,   I = (2/3) ∫ ρ s² (4π s²) ds over (0, r) = 2 m r²/5
    /// ```
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        let squared = self.radius * self.radius;
        let mass = density * (4.0 / 3.0) * PI * squared * self.radius;
        let inertia = SymmetricTensor::from_diagonal(DVec3::splat(0.4 * mass * squared));
        MassProperties { mass, centre: self.centre, inertia }
    }
}
