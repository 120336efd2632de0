//! A dense row-major matrix, and the few operations the solvers need.

use std::ops::{Index, IndexMut};

/// A dense matrix, stored row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![0.0; rows * columns] }
    }

    /// The identity of size `n`.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { 1.0 } else { 0.0 })
    }

    /// A matrix from a function of row and column.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut matrix = Self::zeros(rows, columns);
        for i in 0..rows {
            for j in 0..columns {
                matrix[(i, j)] = entry(i, j);
            }
        }
        matrix
    }

    /// A matrix from its rows, written out.
    pub fn from_rows<const R: usize, const C: usize>(rows: [[f64; C]; R]) -> Self {
        Self { rows: R, columns: C, entries: rows.into_iter().flatten().collect() }
    }

    /// A matrix from its entries, row by row; `None` when their number is not `rows` · `columns`.
    pub fn from_row_major(rows: usize, columns: usize, entries: Vec<f64>) -> Option<Self> {
        (rows.checked_mul(columns) == Some(entries.len())).then_some(Self { rows, columns, entries })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One row.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// One row, to be changed.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// All entries, row by row.
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// `out` = A x.
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        for (i, value) in out.iter_mut().enumerate() {
            *value = dot(self.row(i), x);
        }
    }

    /// Aᵀ y.
    pub fn transpose_multiply(&self, y: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.columns];
        for (i, &factor) in y.iter().enumerate() {
            if factor != 0.0 {
                add_scaled(&mut out, factor, self.row(i));
            }
        }
        out
    }

    /// Aᵀ.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self[(j, i)])
    }

    /// A B.
    pub fn product(&self, other: &Self) -> Self {
        let mut product = Self::zeros(self.rows, other.columns);
        for i in 0..self.rows {
            for k in 0..self.columns {
                let factor = self[(i, k)];
                if factor != 0.0 {
                    add_scaled(product.row_mut(i), factor, other.row(k));
                }
            }
        }
        product
    }

    /// ‖A‖∞, the largest sum of magnitudes over a row.
    pub fn norm(&self) -> f64 {
        (0..self.rows).map(|i| self.row(i).iter().map(|a| a.abs()).sum()).fold(0.0, f64::max)
    }

    /// Swaps two rows.
    pub(crate) fn swap_rows(&mut self, i: usize, j: usize) {
        if i != j {
            let (low, high) = (i.min(j), i.max(j));
            let (head, tail) = self.entries.split_at_mut(high * self.columns);
            head[low * self.columns..(low + 1) * self.columns].swap_with_slice(&mut tail[..self.columns]);
        }
    }

    /// Two different rows, the first to be read and the second to be changed.
    pub(crate) fn row_and_row_mut(&mut self, read: usize, write: usize) -> (&[f64], &mut [f64]) {
        let columns = self.columns;
        if read < write {
            let (head, tail) = self.entries.split_at_mut(write * columns);
            (&head[read * columns..(read + 1) * columns], &mut tail[..columns])
        } else {
            let (head, tail) = self.entries.split_at_mut(read * columns);
            (&tail[..columns], &mut head[write * columns..(write + 1) * columns])
        }
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.entries[i * self.columns + j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.entries[i * self.columns + j]
    }
}

/// a · b, summed in four fixed lanes, so that it is quick and always the same bits.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 4];
    let (a_chunks, b_chunks) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a_chunks.zip(b_chunks) {
        for lane in 0..4 {
            lanes[lane] += x[lane] * y[lane];
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}

/// `out` += factor · x.
pub(crate) fn add_scaled(out: &mut [f64], factor: f64, x: &[f64]) {
    for (value, x) in out.iter_mut().zip(x) {
        *value += factor * x;
    }
}

/// ‖x‖∞; NaN when an entry is NaN.
pub(crate) fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most, &value| if value.is_nan() || value.abs() > most { value.abs() } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_with_the_transpose_is_symmetric_and_norm_is_the_row_sum() {
        let a = Matrix::from_rows([[1.0, -2.0, 3.0], [0.5, 4.0, -1.0]]);
        let gram = a.product(&a.transpose());
        assert_eq!(gram, Matrix::from_rows([[14.0, -10.5], [-10.5, 17.25]]));
        assert_eq!(a.norm(), 6.0);
        assert_eq!(a.transpose_multiply(&[2.0, 2.0]), vec![3.0, 4.0, 4.0]);
    }

    #[test]
    fn dot_matches_the_plain_sum_for_every_remainder() {
        // Small integers are exact, so the order of summation cannot show.
        for n in 0..13 {
            let a: Vec<f64> = (0..n).map(|i| f64::from(i) - 4.0).collect();
            let plain: f64 = a.iter().map(|x| x * x).sum();
            assert_eq!(dot(&a, &a), plain);
        }
    }

    #[test]
    fn largest_does_not_hide_a_nan() {
        assert!(largest(&[1.0, f64::NAN, 2.0]).is_nan());
        assert_eq!(largest(&[1.0, -3.0, 2.0]), 3.0);
    }
}
