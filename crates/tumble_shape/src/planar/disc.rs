//! Disc: a filled circle.

use std::f64::consts::PI;

use glam::DVec2;
use tumble_math::{Planar, Pose};

use crate::{MassProperties, ShapeError};

/// A filled circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    centre: DVec2,
    radius: f64,
}

impl Disc {
    /// A disc around a point [m] with a radius [m].
    pub fn try_new(centre: DVec2, radius: f64) -> Result<Self, ShapeError> {
        if !(centre.is_finite() && radius.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        if radius <= 0.0 {
            return Err(ShapeError::RadiusNotPositive { radius });
        }
        Ok(Self { centre, radius })
    }

    /// Its middle [m].
    #[inline]
    pub fn centre(&self) -> DVec2 {
        self.centre
    }

    /// Its radius [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn centre_slice(&self) -> &[DVec2] {
        std::slice::from_ref(&self.centre)
    }

    /// The disc turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Planar>) -> Self {
        Self { centre: pose.transform_point(self.centre), radius: self.radius }
    }

    /// Mass properties at an area density [kg/m²].
    ///
    /// ```text
    /// m = ρ π r²,   I = ∫ ρ s² (2π s) ds over (0, r) = m r²/2
    /// ```
    pub fn mass_properties(&self, area_density: f64) -> MassProperties<Planar> {
        let squared = self.radius * self.radius;
        let mass = area_density * PI * squared;
        MassProperties { mass, centre: self.centre, inertia: 0.5 * mass * squared }
    }
}
