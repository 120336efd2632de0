//! Rod: a straight line between two points.

use glam::DVec2;
use tumble_math::{Planar, Pose};

use crate::{MassProperties, ShapeError};

/// A straight line from one point to another, as thin as its radius says; radius 0 is a line without thickness.
///
/// Its mass lies on the line: the radius shapes the surface and adds no mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    ends: [DVec2; 2],
    normals: [DVec2; 2],
    radius: f64,
}

impl Rod {
    /// A rod between two points [m], with a radius of its round surface [m].
    pub fn try_new(from: DVec2, to: DVec2, radius: f64) -> Result<Self, ShapeError> {
        if !(from.is_finite() && to.is_finite() && radius.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        if radius < 0.0 {
            return Err(ShapeError::NegativeRadius { radius });
        }
        Self::between(from, to, radius).ok_or(ShapeError::CoincidentEnds { x: from.x, y: from.y })
    }

    fn between(from: DVec2, to: DVec2, radius: f64) -> Option<Self> {
        let along = (to - from).try_normalize()?;
        let right = DVec2::new(along.y, -along.x);
        Some(Self { ends: [from, to], normals: [right, -right], radius })
    }

    /// Where it starts [m].
    #[inline]
    pub fn from(&self) -> DVec2 {
        self.ends[0]
    }

    /// Where it ends [m].
    #[inline]
    pub fn to(&self) -> DVec2 {
        self.ends[1]
    }

    /// Both ends, `from` first [m].
    #[inline]
    pub fn ends(&self) -> &[DVec2; 2] {
        &self.ends
    }

    /// Unit normals of its two sides: to the right of from → to, then to the left.
    #[inline]
    pub fn normals(&self) -> &[DVec2; 2] {
        &self.normals
    }

    /// Distance of its surface from its line [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance between its ends [m].
    pub fn length(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }

    /// The rod turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Planar>) -> Self {
        let [from, to] = self.ends.map(|end| pose.transform_point(end));
        // Moving far away may round both ends to one point; the normals at least stay good.
        Self::between(from, to, self.radius).unwrap_or_else(|| Self {
            ends: [from, to],
            normals: self.normals.map(|normal| super::turned_unit(&pose.rotation, normal)),
            radius: self.radius,
        })
    }

    /// Mass properties at a line density [kg/m].
    ///
    /// ```text
    /// m = ρ L,   c = (from + to)/2,   I = ∫ ρ s² ds over (−L/2, L/2) = m L²/12
    /// ```
    pub fn mass_properties(&self, line_density: f64) -> MassProperties<Planar> {
        let [from, to] = self.ends;
        let mass = line_density * self.length();
        MassProperties { mass, centre: (from + to) * 0.5, inertia: mass * from.distance_squared(to) / 12.0 }
    }
}
