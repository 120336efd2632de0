//! Mass and inertia given outright, and what makes them possible.

use glam::DVec3;
use thiserror::Error;
use tumble_math::{Spatial, SymmetricTensor};

use crate::MassProperties;

/// Share of the largest moment by which the triangle inequality may be missed, as given figures are rounded [1].
const ROUNDED: f64 = 1e-9;

/// Why no matter can have a mass and inertia.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum MassError {
    /// A number is infinite or NaN.
    #[error("the mass, its centre or its inertia is infinite or not a number")]
    NotFinite,
    /// The mass is zero or below.
    #[error("the mass is {mass} kg, but must be positive")]
    MassNotPositive {
        /// The mass given [kg].
        mass: f64,
    },
    /// A principal moment is zero or below.
    #[error("the inertia has the principal moment {moment} kg·m², but all three must be positive")]
    MomentNotPositive {
        /// The smallest principal moment [kg·m²].
        moment: f64,
    },
    /// One principal moment is more than the other two together.
    #[error(
        "the principal moments {small}, {middle} and {large} kg·m² belong to no body: the largest is more than the \
         other two together"
    )]
    TriangleInequality {
        /// Smallest moment [kg·m²].
        small: f64,
        /// The one between [kg·m²].
        middle: f64,
        /// Largest moment [kg·m²].
        large: f64,
    },
}

impl MassProperties<Spatial> {
    /// Mass properties given outright: mass [kg], centre [m], inertia about it [kg·m²].
    ///
    /// The moments about the principal axes are ∫ ρ (y² + z²), ∫ ρ (z² + x²) and ∫ ρ (x² + y²), so each is at most the sum of the
    /// other two; equal to it for a flat body.
    pub fn try_given(mass: f64, centre: DVec3, inertia: SymmetricTensor) -> Result<Self, MassError> {
        let finite = [centre, inertia.diagonal, inertia.off_diagonal].iter().all(|part| part.is_finite());
        if !(mass.is_finite() && finite) {
            return Err(MassError::NotFinite);
        }
        if mass <= 0.0 {
            return Err(MassError::MassNotPositive { mass });
        }
        let [small, middle, large] = inertia.principal_moments();
        if small <= 0.0 {
            return Err(MassError::MomentNotPositive { moment: small });
        }
        if small + middle < large * (1.0 - ROUNDED) {
            return Err(MassError::TriangleInequality { small, middle, large });
        }
        Ok(Self { mass, centre, inertia })
    }
}
