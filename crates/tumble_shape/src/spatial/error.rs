//! Why a shape of space was refused.

use thiserror::Error;

/// Why geometry does not make a shape of space. Points are counted from 0, in the order given.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SpatialShapeError {
    /// A coordinate or length is infinite or NaN.
    #[error("a coordinate or length is infinite or not a number")]
    NotFinite,
    /// Both ends of an axis are at one place, so it has no direction.
    #[error("both ends of the {shape} are at ({x}, {y}, {z}), so it has no length")]
    CoincidentEnds {
        /// What was to be made.
        shape: &'static str,
        /// Where both ends are [m].
        x: f64,
        /// Where both ends are [m].
        y: f64,
        /// Where both ends are [m].
        z: f64,
    },
    /// A rod's radius is below zero.
    #[error("the radius of a rod is {radius} m, but must not be negative")]
    NegativeRadius {
        /// The radius given [m].
        radius: f64,
    },
    /// A radius is zero or below.
    #[error("the radius of a {shape} is {radius} m, but must be positive")]
    RadiusNotPositive {
        /// What was to be made.
        shape: &'static str,
        /// The radius given [m].
        radius: f64,
    },
    /// A box is flat.
    #[error("the half extents of a box are {x} m, {y} m and {z} m, but all must be positive")]
    HalfExtentNotPositive {
        /// Half the length along the first side [m].
        x: f64,
        /// Half the length along the second side [m].
        y: f64,
        /// Half the length along the third side [m].
        z: f64,
    },
    /// A hull needs four points.
    #[error("a convex hull needs at least four points, but has {count}")]
    TooFewPoints {
        /// Number of points given.
        count: usize,
    },
    /// All points are at one place.
    #[error("all points of the hull are at one place, to a tolerance of {tolerance} m")]
    OnePlace {
        /// Distance below which places count as one [m].
        tolerance: f64,
    },
    /// All points lie on one line.
    #[error("all points of the hull lie on one line, to a tolerance of {tolerance} m, so it has no volume")]
    OneLine {
        /// Distance from the line that counts as none [m].
        tolerance: f64,
    },
    /// All points lie in one plane.
    #[error("all points of the hull lie in one plane, to a tolerance of {tolerance} m, so it has no volume")]
    OnePlane {
        /// Distance from the plane that counts as none [m].
        tolerance: f64,
    },
    /// The hull has more corners than contact ids can tell apart.
    #[error("the convex hull has {count} corners, but at most {limit} are possible; use fewer points")]
    TooManyCorners {
        /// Number of corners of the hull.
        count: usize,
        /// Largest number possible.
        limit: usize,
    },
    /// A half-space's normal has no direction.
    #[error("the normal of a half-space is zero, so it has no direction")]
    ZeroNormal,
    /// A tolerance is negative, or so large that nothing would be left.
    #[error("the relative tolerance of a hull is {tolerance}, but must be from 1e-11 to 1e-2")]
    Tolerance {
        /// The tolerance given [1].
        tolerance: f64,
    },
}

/// Passes on a radius [m] that is positive; `shape` is named by the refusal.
pub(super) fn positive_radius(radius: f64, shape: &'static str) -> Result<f64, SpatialShapeError> {
    match radius {
        _ if !radius.is_finite() => Err(SpatialShapeError::NotFinite),
        _ if radius <= 0.0 => Err(SpatialShapeError::RadiusNotPositive { shape, radius }),
        _ => Ok(radius),
    }
}
