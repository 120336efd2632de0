//! Cone: filled, with a flat round base and a tip above its middle.

use std::f64::consts::PI;

use glam::DVec3;
use tumble_math::{Pose, Spatial};

use super::SpatialShapeError;
use super::axis::Axis;
use super::error::positive_radius;
use crate::MassProperties;

/// A filled right circular cone.
#[derive(Clone, Debug, PartialEq)]
pub struct Cone {
    axis: Axis,
    radius: f64,
}

impl Cone {
    /// A cone whose base is centred at one point [m] and whose tip is another [m], with a radius of the base [m].
    pub fn try_new(base: DVec3, tip: DVec3, radius: f64) -> Result<Self, SpatialShapeError> {
        let radius = positive_radius(radius, "cone")?;
        Ok(Self { axis: Axis::try_new(base, tip, "cone")?, radius })
    }

    /// Middle of its base [m].
    #[inline]
    pub fn base(&self) -> DVec3 {
        self.axis.ends[0]
    }

    /// Its tip [m].
    #[inline]
    pub fn tip(&self) -> DVec3 {
        self.axis.ends[1]
    }

    /// Unit vector from the middle of the base to the tip.
    #[inline]
    pub fn direction(&self) -> DVec3 {
        self.axis.direction
    }

    /// Radius of its base [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance of the tip from the base [m].
    pub fn height(&self) -> f64 {
        self.axis.length()
    }

    /// The cone turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { axis: self.axis.posed(pose), radius: self.radius }
    }

    /// Mass properties at a density [kg/m³]; the centre of mass is a quarter of the height above the base.
    ///
    /// ```text
    /// m = ρ π r² h/3,   I along = 3 m r²/10,   I across = 3 m (4 r² + h²)/80
    /// ```
    ///
    /// (discs of radius r s at the height (1 − s) h: ∫ s² = 1/3, ∫ s⁴ = 1/5, and ∫ s² (s − 3/4)² = 1/80.)
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        let (r, h) = (self.radius, self.height());
        let mass = density * PI * r * r * h / 3.0;
        let inertia = self.axis.tensor(0.3 * mass * r * r, 3.0 * mass * (4.0 * r * r + h * h) / 80.0);
        let centre = self.base() + (self.tip() - self.base()) * 0.25;
        MassProperties { mass, centre, inertia }
    }
}
