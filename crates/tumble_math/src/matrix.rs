//! Square matrices of the size of a [`Vector`]: the compliance of a contact in its own frame.

use std::fmt::Debug;

use glam::{DMat2, DMat3, DVec2, DVec3};

use crate::Vector;

/// A square matrix whose columns are vectors `V`.
pub trait Matrix<V: Vector>: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// Matrix with these columns; `column(i)` gives the i-th.
    fn from_columns(column: impl Fn(usize) -> V) -> Self;

    /// The i-th column.
    fn column(&self, i: usize) -> V;

    /// Matrix times vector.
    fn apply(&self, vector: V) -> V;

    /// Transposed matrix times vector: for a frame, the coordinates of a world vector in it.
    fn apply_transposed(&self, vector: V) -> V;

    /// The inverse; `None` when singular or not finite.
    fn try_inverse(&self) -> Option<Self>;
}

macro_rules! matrix {
    ($matrix:ty, $vector:ty, $($axis:literal),+) => {
        impl Matrix<$vector> for $matrix {
            #[inline]
            fn from_columns(column: impl Fn(usize) -> $vector) -> Self {
                Self::from_cols($(column($axis)),+)
            }

            #[inline]
            fn column(&self, i: usize) -> $vector {
                self.col(i)
            }

            #[inline]
            fn apply(&self, vector: $vector) -> $vector {
                *self * vector
            }

            #[inline]
            fn apply_transposed(&self, vector: $vector) -> $vector {
                self.transpose() * vector
            }

            fn try_inverse(&self) -> Option<Self> {
                let determinant = self.determinant();
                (determinant != 0.0 && determinant.is_finite()).then(|| self.inverse())
            }
        }
    };
}

matrix!(DMat2, DVec2, 0, 1);
matrix!(DMat3, DVec3, 0, 1, 2);
