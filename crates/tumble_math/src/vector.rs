//! What mechanics asks of a vector, and of an angular quantity.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub, SubAssign};

use glam::{DVec2, DVec3};

/// A quantity that adds and scales: common to vectors and angular quantities.
pub trait Linear:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
{
    /// Nothing of it.
    const ZERO: Self;

    /// Inner product.
    fn dot(self, other: Self) -> f64;

    /// Component by component product.
    fn scale_by(self, factors: Self) -> Self;

    /// Whether no component is infinite or NaN.
    fn is_finite(self) -> bool;

    /// Euclidean length.
    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

/// A vector of the plane or of space.
pub trait Vector: Linear + Index<usize, Output = f64> + IndexMut<usize> {
    /// Number of components.
    const AXES: usize;

    /// All components alike.
    fn splat(value: f64) -> Self;

    /// Unit vector along an axis.
    fn unit(axis: usize) -> Self {
        let mut vector = Self::ZERO;
        vector[axis] = 1.0;
        vector
    }

    /// Smaller of each pair of components.
    fn min(self, other: Self) -> Self;

    /// Larger of each pair of components.
    fn max(self, other: Self) -> Self;

    /// Unit vector of the same direction; `None` for zero or not finite.
    fn try_normalize(self) -> Option<Self>;
}

/// A rate of turn, a torque or an angular momentum: a number in the plane, a vector in space.
pub trait Angular: Linear {}

macro_rules! linear_vector {
    ($vector:ty, $axes:literal) => {
        impl Linear for $vector {
            const ZERO: Self = <$vector>::ZERO;

            #[inline]
            fn dot(self, other: Self) -> f64 {
                <$vector>::dot(self, other)
            }

            #[inline]
            fn scale_by(self, factors: Self) -> Self {
                self * factors
            }

            #[inline]
            fn is_finite(self) -> bool {
                <$vector>::is_finite(self)
            }
        }

        impl Vector for $vector {
            const AXES: usize = $axes;

            #[inline]
            fn splat(value: f64) -> Self {
                <$vector>::splat(value)
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                <$vector>::min(self, other)
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                <$vector>::max(self, other)
            }

            #[inline]
            fn try_normalize(self) -> Option<Self> {
                <$vector>::try_normalize(self)
            }
        }
    };
}

linear_vector!(DVec2, 2);
linear_vector!(DVec3, 3);

impl Linear for f64 {
    const ZERO: Self = 0.0;

    #[inline]
    fn dot(self, other: Self) -> f64 {
        self * other
    }

    #[inline]
    fn scale_by(self, factors: Self) -> Self {
        self * factors
    }

    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Angular for f64 {}
impl Angular for DVec3 {}
