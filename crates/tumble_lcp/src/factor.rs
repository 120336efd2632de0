//! Factorizations: LU and Cholesky from scratch, and an inverse that is updated instead of recomputed.

use crate::matrix::{Matrix, add_scaled, dot, largest};

/// A = Pᵀ L U by Gaussian elimination with partial pivoting.
pub(crate) struct Lu {
    factors: Matrix,
    permutation: Vec<usize>,
}

impl Lu {
    /// Factors a square matrix; `None` when a pivot is lost in rounding.
    pub fn factor(mut a: Matrix) -> Option<Self> {
        let n = a.rows();
        // A pivot that is pure cancellation has the size of rounding in the largest entry it was made from.
        let threshold = 1e-14 * largest(a.entries());
        if threshold.is_nan() {
            return None;
        }
        let mut permutation: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot_row = (k..n).fold(k, |best, i| if a[(i, k)].abs() > a[(best, k)].abs() { i } else { best });
            let pivot = a[(pivot_row, k)];
            if pivot.is_nan() || pivot.abs() <= threshold {
                return None;
            }
            a.swap_rows(k, pivot_row);
            permutation.swap(k, pivot_row);
            for i in k + 1..n {
                let (above, row) = a.row_and_row_mut(k, i);
                let factor = row[k] / pivot;
                row[k] = factor;
                if factor != 0.0 {
                    add_scaled(&mut row[k + 1..], -factor, &above[k + 1..]);
                }
            }
        }
        Some(Self { factors: a, permutation })
    }

    /// Solves A x = b.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = self.permutation.iter().map(|&i| b[i]).collect();
        for i in 0..x.len() {
            x[i] -= dot(&self.factors.row(i)[..i], &x[..i]);
        }
        for i in (0..x.len()).rev() {
            let row = self.factors.row(i);
            x[i] = (x[i] - dot(&row[i + 1..], &x[i + 1..])) / row[i];
        }
        x
    }

    /// Solves A x = b and takes out the rounding of the first answer by up to three rounds of iterative refinement.
    pub fn solve_refined(&self, a: &Matrix, b: &[f64]) -> Vec<f64> {
        let defect_of = |x: &[f64]| -> Vec<f64> { (0..b.len()).map(|i| precise_defect(a.row(i), x, b[i])).collect() };
        let mut x = self.solve(b);
        let mut defect = defect_of(&x);
        for _ in 0..3 {
            let correction = self.solve(&defect);
            let better: Vec<f64> = x.iter().zip(&correction).map(|(x, c)| x + c).collect();
            let better_defect = defect_of(&better);
            // The comparison is false for NaN, which keeps the last good answer.
            if largest(&better_defect) < largest(&defect) {
                (x, defect) = (better, better_defect);
            } else {
                break;
            }
        }
        x
    }
}

/// b − a · x, with the rounding of every product and sum carried along (Ogita, Rump, Oishi 2005, Dot2).
pub(crate) fn precise_defect(a: &[f64], x: &[f64], b: f64) -> f64 {
    let (mut sum, mut carried) = (b, 0.0);
    for (&a, &x) in a.iter().zip(x) {
        let (product, product_error) = two_product(-a, x);
        let (total, sum_error) = two_sum(sum, product);
        sum = total;
        carried += product_error + sum_error;
    }
    let precise = sum + carried;
    // Splitting overflows for entries beyond 1e300; the plain sum is then the best there is.
    if precise.is_finite() { precise } else { b - dot(a, x) }
}

/// a + b and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// a · b and its rounding error (Dekker, with Veltkamp's splitting).
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        let shifted = 134_217_729.0 * x;
        let high = shifted - (shifted - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// What a Cholesky factorization says about a symmetric matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// Every pivot is clearly positive.
    Positive,
    /// No pivot is clearly negative, some are zero to rounding.
    Semidefinite,
    /// Some pivot is negative, or a zero pivot has something beside it.
    Indefinite,
}

/// Tells the definiteness of the symmetric part of A by Cholesky's method with diagonal pivoting.
pub(crate) fn definiteness(a: &Matrix) -> Definiteness {
    let n = a.rows();
    let mut s = Matrix::from_fn(n, n, |i, j| 0.5 * a[(i, j)] + 0.5 * a[(j, i)]);
    let scale = (0..n).map(|i| s[(i, i)].abs()).fold(0.0, f64::max);
    // Rounding in n eliminations of entries of this size; beyond it a sign means something.
    let noise = 1e-14 * n as f64 * scale;
    let mut left: Vec<usize> = (0..n).collect();
    while !left.is_empty() {
        let best = (0..left.len()).fold(0, |b, i| if s[(left[i], left[i])] > s[(left[b], left[b])] { i } else { b });
        let pivot = s[(left[best], left[best])];
        if pivot.is_nan() || pivot <= noise {
            let rest = left.iter().flat_map(|&i| left.iter().map(move |&j| (i, j))).map(|at| s[at].abs());
            return if rest.fold(0.0, f64::max) <= noise {
                Definiteness::Semidefinite
            } else {
                Definiteness::Indefinite
            };
        }
        let k = left.swap_remove(best);
        for &i in &left {
            let factor = s[(i, k)] / pivot;
            let (above, row) = s.row_and_row_mut(k, i);
            if factor != 0.0 {
                for &j in &left {
                    row[j] -= factor * above[j];
                }
            }
        }
    }
    Definiteness::Positive
}

/// The inverse of a square matrix that grows, shrinks and changes by one row and column at a time.
///
/// Each change costs O(k²) for size k; the owner rebuilds it by [`UpdatedInverse::rebuild`] now and then, because every update
/// adds a little rounding.
#[derive(Clone, Debug)]
pub(crate) struct UpdatedInverse {
    size: usize,
    stride: usize,
    entries: Vec<f64>,
    updates: usize,
}

/// An update would divide by a number lost in rounding: the changed matrix is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SingularUpdate;

impl UpdatedInverse {
    /// The inverse of the empty matrix, with room for size `capacity`.
    pub fn empty(capacity: usize) -> Self {
        Self { size: 0, stride: capacity, entries: vec![0.0; capacity * capacity], updates: 0 }
    }

    /// The inverse of the identity of size `n`.
    pub fn identity(n: usize) -> Self {
        let mut inverse = Self::empty(n);
        inverse.size = n;
        (0..n).for_each(|i| inverse.entries[i * n + i] = 1.0);
        inverse
    }

    /// Updates since the last rebuilding.
    pub fn updates(&self) -> usize {
        self.updates
    }

    /// One row of the inverse.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.stride..i * self.stride + self.size]
    }

    fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.entries[i * self.stride..i * self.stride + self.size]
    }

    /// A⁻¹ x.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.size).map(|i| dot(self.row(i), x)).collect()
    }

    /// xᵀ A⁻¹.
    fn multiply_left(&self, x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.size];
        for (i, &factor) in x.iter().enumerate() {
            if factor != 0.0 {
                add_scaled(&mut out, factor, self.row(i));
            }
        }
        out
    }

    /// Borders A with a last row, column and corner entry.
    ///
    /// ```text
    /// s = corner − row A⁻¹ column   (Schur complement)
    /// [A c; r d]⁻¹ = [A⁻¹ + A⁻¹c rA⁻¹/s, −A⁻¹c/s; −rA⁻¹/s, 1/s]
    /// ```
    pub fn append(&mut self, row: &[f64], column: &[f64], corner: f64) -> Result<(), SingularUpdate> {
        let right = self.multiply(column);
        let left = self.multiply_left(row);
        let schur = corner - dot(row, &right);
        let size_of_terms = row.iter().zip(&right).map(|(r, x)| (r * x).abs()).fold(corner.abs(), f64::max);
        if !schur.is_finite() || schur.abs() <= 1e-11 * size_of_terms {
            return Err(SingularUpdate);
        }
        for (i, &value) in right.iter().enumerate() {
            add_scaled(self.row_mut(i), value / schur, &left);
        }
        let k = self.size;
        self.size += 1;
        for i in 0..k {
            self.entries[i * self.stride + k] = -right[i] / schur;
            self.entries[k * self.stride + i] = -left[i] / schur;
        }
        self.entries[k * self.stride + k] = 1.0 / schur;
        self.updates += 1;
        Ok(())
    }

    /// Takes row and column `at` out of A; the last row and column take its place.
    pub fn swap_remove(&mut self, at: usize) -> Result<(), SingularUpdate> {
        let last = self.size - 1;
        for i in 0..=last {
            self.entries.swap(i * self.stride + at, i * self.stride + last);
        }
        for j in 0..=last {
            self.entries.swap(at * self.stride + j, last * self.stride + j);
        }
        let corner = self.row(last)[last];
        let final_row: Vec<f64> = self.row(last)[..last].to_vec();
        if !corner.is_finite() || corner == 0.0 {
            return Err(SingularUpdate);
        }
        for i in 0..last {
            let factor = self.row(i)[last] / corner;
            add_scaled(&mut self.row_mut(i)[..last], -factor, &final_row);
        }
        self.size = last;
        self.updates += 1;
        Ok(())
    }

    /// Adds `change` to column `at` of A (Sherman and Morrison).
    pub fn add_to_column(&mut self, at: usize, change: &[f64]) -> Result<(), SingularUpdate> {
        let mut image = self.multiply(change);
        image[at] += 1.0;
        self.replace_column(at, &image)
    }

    /// Replaces column `at` of A by a new one, given as `image` = A⁻¹ · new column.
    pub fn replace_column(&mut self, at: usize, image: &[f64]) -> Result<(), SingularUpdate> {
        let pivot = image[at];
        if !pivot.is_finite() || pivot.abs() <= 1e-13 * largest(image) {
            return Err(SingularUpdate);
        }
        let mut pivot_row = self.row(at).to_vec();
        pivot_row.iter_mut().for_each(|value| *value /= pivot);
        for (i, &factor) in image.iter().enumerate() {
            if i != at && factor != 0.0 {
                add_scaled(self.row_mut(i), -factor, &pivot_row);
            }
        }
        self.row_mut(at).copy_from_slice(&pivot_row);
        self.updates += 1;
        Ok(())
    }

    /// Starts over from A itself.
    pub fn rebuild(&mut self, a: Matrix) -> Result<(), SingularUpdate> {
        let n = a.rows();
        let lu = Lu::factor(a).ok_or(SingularUpdate)?;
        self.size = n;
        let mut unit = vec![0.0; n];
        for j in 0..n {
            unit[j] = 1.0;
            for (i, value) in lu.solve(&unit).into_iter().enumerate() {
                self.entries[i * self.stride + j] = value;
            }
            unit[j] = 0.0;
        }
        self.updates = 0;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(n: usize) -> Matrix {
        Matrix::from_fn(n, n, |i, j| 1.0 / (1.0 + (i as f64 - 1.3 * j as f64).abs()) + if i == j { 2.0 } else { 0.0 })
    }

    fn distance_from_identity(inverse: &UpdatedInverse, a: &Matrix) -> f64 {
        let n = a.rows();
        let columns: Vec<Vec<f64>> =
            (0..n).map(|j| inverse.multiply(&(0..n).map(|i| a[(i, j)]).collect::<Vec<_>>())).collect();
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| (columns[j][i] - f64::from(u8::from(i == j))).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn bordering_removing_and_replacing_agree_with_a_fresh_inverse() {
        let a = sample(7);
        let mut inverse = UpdatedInverse::empty(7);
        for k in 0..7 {
            let row = a.row(k)[..k].to_vec();
            let column: Vec<f64> = (0..k).map(|i| a[(i, k)]).collect();
            inverse.append(&row, &column, a[(k, k)]).unwrap();
        }
        // Well conditioned and small: a few hundred roundings at most.
        assert!(distance_from_identity(&inverse, &a) < 1e-13);

        let change = [0.3, -0.2, 0.1, 0.5, 0.0, -0.4, 0.25];
        inverse.add_to_column(3, &change).unwrap();
        let mut changed = a.clone();
        (0..7).for_each(|i| changed[(i, 3)] += change[i]);
        assert!(distance_from_identity(&inverse, &changed) < 1e-13);

        inverse.swap_remove(2).unwrap();
        let order = [0, 1, 6, 3, 4, 5];
        let smaller = Matrix::from_fn(6, 6, |i, j| changed[(order[i], order[j])]);
        assert!(distance_from_identity(&inverse, &smaller) < 1e-13);

        inverse.rebuild(smaller.clone()).unwrap();
        assert!(distance_from_identity(&inverse, &smaller) < 1e-14);
    }

    #[test]
    fn singular_matrices_are_refused() {
        assert!(Lu::factor(Matrix::from_rows([[1.0, 2.0], [2.0, 4.0]])).is_none());
        let mut inverse = UpdatedInverse::empty(2);
        inverse.append(&[], &[], 1.0).unwrap();
        assert_eq!(inverse.append(&[2.0], &[2.0], 4.0), Err(SingularUpdate));
    }

    #[test]
    fn refinement_reaches_the_last_bits_of_an_ill_conditioned_system() {
        // Hilbert matrix of size 8, condition 1.5e10; x = 1 for b = its row sums.
        let a = Matrix::from_fn(8, 8, |i, j| 1.0 / (i + j + 1) as f64);
        let b: Vec<f64> = (0..8).map(|i| a.row(i).iter().sum()).collect();
        let x = Lu::factor(a.clone()).unwrap().solve_refined(&a, &b);
        // Without refinement the error is 1e-6; b itself is rounded, which leaves 1.5e10 · 1e-16.
        assert!(x.iter().all(|x| (x - 1.0).abs() < 2e-5));
        let defect: f64 = (0..8).map(|i| precise_defect(a.row(i), &x, b[i]).abs()).fold(0.0, f64::max);
        assert!(defect < 5e-16, "{defect:e}");
    }

    #[test]
    fn definiteness_of_three_textbook_matrices() {
        assert_eq!(definiteness(&Matrix::from_rows([[2.0, 1.0], [1.0, 2.0]])), Definiteness::Positive);
        assert_eq!(definiteness(&Matrix::from_rows([[1.0, 1.0], [1.0, 1.0]])), Definiteness::Semidefinite);
        assert_eq!(definiteness(&Matrix::from_rows([[1.0, 2.0], [2.0, 1.0]])), Definiteness::Indefinite);
        // Skew: the symmetric part is zero, and zᵀ M z = 0 for every z.
        assert_eq!(definiteness(&Matrix::from_rows([[0.0, 1.0], [-1.0, 0.0]])), Definiteness::Semidefinite);
    }
}
