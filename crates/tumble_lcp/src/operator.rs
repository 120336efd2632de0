//! Matrices that are never built: what a solver asks of M.

use crate::matrix::{Matrix, add_scaled, dot};

/// A square matrix M, known by what it does to a vector.
pub trait Operator {
    /// Number of rows, and of columns.
    fn dimension(&self) -> usize;

    /// `out` = M z.
    fn apply(&self, z: &[f64], out: &mut [f64]);

    /// M's diagonal entry in row `i`.
    fn diagonal(&self, i: usize) -> f64;
}

/// An operator that a sweep over the rows can use: it keeps something up to date while single entries of z change.
///
/// A dense matrix keeps z itself. J W Jᵀ keeps W Jᵀ z (for contacts: the velocities of the bodies), which makes a row as cheap
/// as its own few nonzeros.
pub trait RowOperator: Operator {
    /// What is kept up to date for this z.
    fn track(&self, z: &[f64]) -> Vec<f64>;

    /// (M z) in row `i`.
    fn row(&self, i: usize, tracked: &[f64]) -> f64;

    /// Tells that z changed by `change` in entry `i`.
    fn change(&self, i: usize, change: f64, tracked: &mut [f64]);

    /// One entry of M; block methods ask for those on their diagonal blocks.
    fn entry(&self, i: usize, j: usize) -> f64;
}

impl Operator for Matrix {
    fn dimension(&self) -> usize {
        self.rows()
    }

    fn apply(&self, z: &[f64], out: &mut [f64]) {
        self.multiply(z, out);
    }

    fn diagonal(&self, i: usize) -> f64 {
        self[(i, i)]
    }
}

impl RowOperator for Matrix {
    fn track(&self, z: &[f64]) -> Vec<f64> {
        z.to_vec()
    }

    fn row(&self, i: usize, tracked: &[f64]) -> f64 {
        dot(self.row(i), tracked)
    }

    fn change(&self, i: usize, change: f64, tracked: &mut [f64]) {
        tracked[i] += change;
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self[(i, j)]
    }
}

/// M = J W Jᵀ + diag(r), from the sparse rows of J, a diagonal weight W and an optional regularisation r.
///
/// Contacts and joints have this form: a row of J per constraint, W the inverse masses.
#[derive(Clone, Debug, PartialEq)]
pub struct WeightedGram {
    rows: Vec<Vec<(usize, f64)>>,
    weights: Vec<f64>,
    regularisation: Vec<f64>,
}

impl WeightedGram {
    /// From the nonzeros (column, value) of each row of J and the diagonal of W; `None` when a column is beyond the weights.
    pub fn new(rows: Vec<Vec<(usize, f64)>>, weights: Vec<f64>) -> Option<Self> {
        let fits = rows.iter().flatten().all(|&(column, _)| column < weights.len());
        let regularisation = vec![0.0; rows.len()];
        fits.then_some(Self { rows, weights, regularisation })
    }

    /// With diag(r) added; `None` when r has the wrong length.
    pub fn with_regularisation(self, regularisation: Vec<f64>) -> Option<Self> {
        (regularisation.len() == self.rows.len()).then_some(Self { regularisation, ..self })
    }

    /// The matrix, written out.
    pub fn to_matrix(&self) -> Matrix {
        let n = self.rows.len();
        let mut matrix = Matrix::zeros(n, n);
        let mut unit = vec![0.0; n];
        let mut column = vec![0.0; n];
        for j in 0..n {
            unit[j] = 1.0;
            self.apply(&unit, &mut column);
            (0..n).for_each(|i| matrix[(i, j)] = column[i]);
            unit[j] = 0.0;
        }
        matrix
    }

    /// W Jᵀ z.
    fn spread(&self, z: &[f64]) -> Vec<f64> {
        let mut spread = vec![0.0; self.weights.len()];
        for (row, &z) in self.rows.iter().zip(z) {
            for &(column, value) in row {
                spread[column] += value * z;
            }
        }
        spread.iter_mut().zip(&self.weights).for_each(|(s, w)| *s *= w);
        spread
    }

    /// Row `i` of J times a vector.
    fn gather(&self, i: usize, spread: &[f64]) -> f64 {
        self.rows[i].iter().map(|&(column, value)| value * spread[column]).sum()
    }
}

impl Operator for WeightedGram {
    fn dimension(&self) -> usize {
        self.rows.len()
    }

    fn apply(&self, z: &[f64], out: &mut [f64]) {
        let spread = self.spread(z);
        for (i, value) in out.iter_mut().enumerate() {
            *value = self.gather(i, &spread) + self.regularisation[i] * z[i];
        }
    }

    fn diagonal(&self, i: usize) -> f64 {
        let own: f64 = self.rows[i].iter().map(|&(column, value)| value * value * self.weights[column]).sum();
        own + self.regularisation[i]
    }
}

impl RowOperator for WeightedGram {
    fn track(&self, z: &[f64]) -> Vec<f64> {
        let mut tracked = self.spread(z);
        tracked.extend(z.iter().zip(&self.regularisation).map(|(z, r)| z * r));
        tracked
    }

    fn row(&self, i: usize, tracked: &[f64]) -> f64 {
        self.gather(i, tracked) + tracked[self.weights.len() + i]
    }

    fn change(&self, i: usize, change: f64, tracked: &mut [f64]) {
        for &(column, value) in &self.rows[i] {
            tracked[column] += self.weights[column] * value * change;
        }
        tracked[self.weights.len() + i] += self.regularisation[i] * change;
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        let value_in = |column| self.rows[j].iter().filter(move |&&(c, _)| c == column).map(|&(_, value)| value);
        let products = self.rows[i]
            .iter()
            .flat_map(|&(column, value)| value_in(column).map(move |other| value * self.weights[column] * other));
        products.sum::<f64>() + if i == j { self.regularisation[i] } else { 0.0 }
    }
}

/// D M D for a positive diagonal D: the same problem in better units.
pub(crate) struct Scaled<'a, A> {
    pub operator: &'a A,
    pub scale: &'a [f64],
}

impl<A: Operator> Scaled<'_, A> {
    /// `out` = D M D x.
    pub fn apply(&self, x: &[f64], out: &mut [f64]) {
        let mut z = vec![0.0; x.len()];
        z.iter_mut().zip(x.iter().zip(self.scale)).for_each(|(z, (x, d))| *z = x * d);
        self.operator.apply(&z, out);
        out.iter_mut().zip(self.scale).for_each(|(w, d)| *w *= d);
    }
}

/// `out` = M z + q.
pub(crate) fn affine<A: Operator>(operator: &A, q: &[f64], z: &[f64]) -> Vec<f64> {
    let mut w = vec![0.0; q.len()];
    operator.apply(z, &mut w);
    add_scaled(&mut w, 1.0, q);
    w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weighted_gram_does_what_its_matrix_does() {
        let rows = vec![vec![(0, 1.0), (2, -2.0)], vec![(1, 3.0)], vec![(0, 0.5), (1, -1.0), (2, 1.0)]];
        let gram = WeightedGram::new(rows, vec![2.0, 0.5, 4.0]).unwrap();
        let gram = gram.with_regularisation(vec![0.25, 0.0, 1.0]).unwrap();
        // Every number here is a small binary fraction, so equality is exact.
        let expected = Matrix::from_rows([[18.25, 0.0, -7.0], [0.0, 4.5, -1.5], [-7.0, -1.5, 6.0]]);
        assert_eq!(gram.to_matrix(), expected);

        let mut z = vec![1.0, -2.0, 0.5];
        let mut tracked = gram.track(&z);
        gram.change(2, 1.5, &mut tracked);
        z[2] += 1.5;
        let mut direct = vec![0.0; 3];
        expected.apply(&z, &mut direct);
        for i in 0..3 {
            assert_eq!(gram.row(i, &tracked), direct[i]);
            assert_eq!(gram.diagonal(i), expected[(i, i)]);
            assert!((0..3).all(|j| gram.entry(i, j) == expected[(i, j)]));
        }
    }

    #[test]
    fn weighted_gram_refuses_columns_beyond_its_weights() {
        assert!(WeightedGram::new(vec![vec![(3, 1.0)]], vec![1.0; 3]).is_none());
    }
}
