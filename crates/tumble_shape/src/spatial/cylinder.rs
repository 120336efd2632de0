//! Cylinder: filled, with flat ends.

use std::f64::consts::PI;

use glam::DVec3;
use tumble_math::{Pose, Spatial};

use super::SpatialShapeError;
use super::axis::Axis;
use super::error::positive_radius;
use crate::MassProperties;

/// A filled round cylinder with flat ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    axis: Axis,
    radius: f64,
}

impl Cylinder {
    /// A cylinder whose flat ends are centred at two points [m], with a radius [m].
    pub fn try_new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, SpatialShapeError> {
        let radius = positive_radius(radius, "cylinder")?;
        Ok(Self { axis: Axis::try_new(from, to, "cylinder")?, radius })
    }

    /// Centres of its flat ends, the first one given first [m].
    #[inline]
    pub fn ends(&self) -> &[DVec3; 2] {
        &self.axis.ends
    }

    /// Unit vector from the first end to the second.
    #[inline]
    pub fn direction(&self) -> DVec3 {
        self.axis.direction
    }

    /// Its radius [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance between its flat ends [m].
    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// The cylinder turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { axis: self.axis.posed(pose), radius: self.radius }
    }

    /// Mass properties at a density [kg/m³].
    ///
    /// ```text
    /// m = ρ π r² L,   I along = m r²/2,   I across = m (3 r² + L²)/12
    /// ```
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        let (r, length) = (self.radius, self.length());
        let mass = density * PI * r * r * length;
        let inertia = self.axis.tensor(0.5 * mass * r * r, mass * (3.0 * r * r + length * length) / 12.0);
        MassProperties { mass, centre: self.axis.middle(), inertia }
    }
}
