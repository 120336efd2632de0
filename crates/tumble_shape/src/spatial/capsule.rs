//! Capsule: a filled cylinder with half a ball on each end.

use std::f64::consts::PI;

use glam::DVec3;
use tumble_math::{Pose, Spatial};

use super::SpatialShapeError;
use super::axis::Axis;
use super::error::positive_radius;
use crate::MassProperties;

/// All points within a radius of a straight line, filled.
#[derive(Clone, Debug, PartialEq)]
pub struct Capsule {
    axis: Axis,
    radius: f64,
}

impl Capsule {
    /// A capsule around the line between two points [m], with a radius [m]. It reaches beyond both points by its radius.
    pub fn try_new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, SpatialShapeError> {
        let radius = positive_radius(radius, "capsule")?;
        Ok(Self { axis: Axis::try_new(from, to, "capsule")?, radius })
    }

    /// Both ends of its line, the first one given first [m].
    #[inline]
    pub fn ends(&self) -> &[DVec3; 2] {
        &self.axis.ends
    }

    /// Distance of its surface from its line [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance between the ends of its line [m].
    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// The capsule turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { axis: self.axis.posed(pose), radius: self.radius }
    }

    /// Mass properties at a density [kg/m³].
    ///
    /// A cylinder of mass m_c and two half balls of mass m_h each. A half ball has its centre of mass 3r/8 from its flat side, and
    /// across its axis the inertia 2 m_h r²/5 about the middle of that side, so
    ///
    /// ```text
    /// m_c = ρ π r² L,   m_h = ρ 2π r³/3
    /// I along  = m_c r²/2 + 2 (2 m_h r²/5)
    /// I across = m_c (3 r² + L²)/12 + 2 m_h (2 r²/5 − (3r/8)² + (L/2 + 3r/8)²)
    /// ```
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        let (r, length) = (self.radius, self.length());
        let cylinder = density * PI * r * r * length;
        let half_ball = density * (2.0 / 3.0) * PI * r * r * r;
        let along = 0.5 * cylinder * r * r + 0.8 * half_ball * r * r;
        // −(3r/8)² + (L/2 + 3r/8)² multiplied out.
        let moved = 0.25 * length * length + 0.375 * r * length;
        let across = cylinder * (3.0 * r * r + length * length) / 12.0 + 2.0 * half_ball * (0.4 * r * r + moved);
        MassProperties {
            mass: cylinder + 2.0 * half_ball,
            centre: self.axis.middle(),
            inertia: self.axis.tensor(along, across),
        }
    }
}
