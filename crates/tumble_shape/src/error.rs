//! Why a shape was refused.

use thiserror::Error;

/// Why geometry does not make a shape. Points and sides are counted from 0, in the order given.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ShapeError {
    /// A coordinate or length is infinite or NaN.
    #[error("a coordinate or length is infinite or not a number")]
    NotFinite,
    /// A rod has no length, so no direction.
    #[error("both ends of the rod are at ({x}, {y}), so it has no length")]
    CoincidentEnds {
        /// Where both ends are [m].
        x: f64,
        /// Where both ends are [m].
        y: f64,
    },
    /// A rod's radius is below zero.
    #[error("the radius of a rod is {radius} m, but must not be negative")]
    NegativeRadius {
        /// The radius given [m].
        radius: f64,
    },
    /// A disc's radius is zero or below.
    #[error("the radius of a disc is {radius} m, but must be positive")]
    RadiusNotPositive {
        /// The radius given [m].
        radius: f64,
    },
    /// A rectangle has no width or no height.
    #[error("the half extents of a box are {x} m and {y} m, but both must be positive")]
    HalfExtentNotPositive {
        /// Half the width given [m].
        x: f64,
        /// Half the height given [m].
        y: f64,
    },
    /// A polygon needs three points.
    #[error("a polygon needs at least three points, but has {count}")]
    TooFewPoints {
        /// Number of points given.
        count: usize,
    },
    /// The same point stands in the list twice.
    #[error("points {first} and {second} of the polygon are the same")]
    RepeatedPoint {
        /// Index of the one.
        first: usize,
        /// Index of the other.
        second: usize,
    },
    /// All points lie on one line.
    #[error("all points of the polygon lie on one line, so it has no area")]
    NoArea,
    /// Two sides meet elsewhere than at their shared corner.
    #[error("the polygon crosses itself: the side after point {first} meets the side after point {second}")]
    SelfCrossing {
        /// Index of the point where the one side starts.
        first: usize,
        /// Index of the point where the other side starts.
        second: usize,
    },
    /// A corner points inwards.
    #[error("the polygon is not convex: its corner {corner} points inwards; split it into convex parts")]
    NotConvex {
        /// Index of the corner.
        corner: usize,
    },
    /// A half-plane's normal has no direction.
    #[error("the normal of a half-plane is zero, so it has no direction")]
    ZeroNormal,
}
