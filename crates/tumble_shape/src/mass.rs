//! Mass, centre of mass and inertia, and how those of parts add up.
//!
//! ```text
//! m = Σ mᵢ          c = Σ mᵢ cᵢ / m          I = Σ (Iᵢ + J(mᵢ, cᵢ − c))
//! ```
//!
//! J(m, d) is the inertia about the origin of a point mass m at d: the parallel-axis (Huygens–Steiner) term, m |d|² in the plane
//! and m (|d|² 1 − d dᵀ) in space.

use glam::DVec3;
use tumble_math::{Dim, Inertia, Linear, Planar, Spatial, SymmetricTensor};

/// What adding up inertia asks of a dimension.
pub trait MassDim: Dim {
    /// Inertia about the origin of a point mass [kg] at an arm [m].
    fn point_mass_inertia(mass: f64, arm: Self::Vector) -> Self::Inertia;

    /// Sum of two inertias about the same point.
    fn add_inertia(one: Self::Inertia, other: Self::Inertia) -> Self::Inertia;
}

impl MassDim for Planar {
    fn point_mass_inertia(mass: f64, arm: Self::Vector) -> f64 {
        mass * arm.dot(arm)
    }

    fn add_inertia(one: f64, other: f64) -> f64 {
        one + other
    }
}

impl MassDim for Spatial {
    fn point_mass_inertia(mass: f64, d: DVec3) -> SymmetricTensor {
        SymmetricTensor {
            diagonal: DVec3::new(d.y * d.y + d.z * d.z, d.z * d.z + d.x * d.x, d.x * d.x + d.y * d.y) * mass,
            off_diagonal: DVec3::new(-d.y * d.z, -d.x * d.z, -d.x * d.y) * mass,
        }
    }

    fn add_inertia(one: SymmetricTensor, other: SymmetricTensor) -> SymmetricTensor {
        SymmetricTensor { diagonal: one.diagonal + other.diagonal, off_diagonal: one.off_diagonal + other.off_diagonal }
    }
}

/// How much matter there is, where its middle is, and how hard it is to turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties<D: Dim> {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass, in the frame the shape is given in [m].
    pub centre: D::Vector,
    /// Inertia about the centre of mass, along the axes of that frame [kg·m²].
    pub inertia: D::Inertia,
}

impl<D: MassDim> MassProperties<D> {
    /// The same matter moved without turning [m].
    pub fn translated(self, by: D::Vector) -> Self {
        Self { centre: self.centre + by, ..self }
    }

    /// The same shape with all densities multiplied by a factor [1].
    pub fn scaled(self, factor: f64) -> Self {
        Self { mass: self.mass * factor, inertia: self.inertia.scaled(factor), ..self }
    }

    /// Properties of all parts together; `None` unless their total mass is positive and finite.
    pub fn combine<I>(parts: I) -> Option<Self>
    where
        I: IntoIterator<Item = Self, IntoIter: Clone>,
    {
        let parts = parts.into_iter();
        let mass: f64 = parts.clone().map(|part| part.mass).sum();
        if !(mass > 0.0 && mass.is_finite()) {
            return None;
        }
        let mut first_moment = D::Vector::ZERO;
        for part in parts.clone() {
            first_moment += part.centre * part.mass;
        }
        let centre = first_moment * (1.0 / mass);
        let inertia = parts.fold(D::Inertia::ZERO, |sum, part| {
            let shifted = D::add_inertia(part.inertia, D::point_mass_inertia(part.mass, part.centre - centre));
            D::add_inertia(sum, shifted)
        });
        Some(Self { mass, centre, inertia })
    }
}
