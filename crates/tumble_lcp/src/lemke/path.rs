//! The path of almost complementary bases that Lemke's method follows.

use super::Covering;
use crate::factor::UpdatedInverse;
use crate::matrix::{Matrix, dot, largest};

/// How a path ends.
pub(super) enum PathEnd {
    /// z₀ is gone.
    Solution,
    /// Nothing blocks in this direction of z.
    Ray(Vec<f64>),
    /// A basis is singular to rounding.
    Singular,
    /// Numbers overflowed.
    NotFinite,
    /// The cap was reached.
    OutOfPivots,
}

/// A variable of the extended problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    W(usize),
    Z(usize),
    Artificial,
}

impl Variable {
    fn complement(self) -> Self {
        match self {
            Self::W(i) => Self::Z(i),
            Self::Z(i) => Self::W(i),
            Self::Artificial => Self::Artificial,
        }
    }
}

/// The state of one run.
pub(super) struct Path<'a> {
    matrix: &'a Matrix,
    /// Mᵀ, whose rows are the columns that enter.
    columns: Matrix,
    q: &'a [f64],
    /// The column of z₀ in the system, −d.
    artificial: Vec<f64>,
    basis: Vec<Variable>,
    inverse: UpdatedInverse,
    /// Values of the basic variables.
    x: Vec<f64>,
    /// Pivots so far.
    pub pivots: usize,
}

impl<'a> Path<'a> {
    /// Starts from the basis in which z is basic where `warm` says so, or from all w when that basis is singular.
    pub fn new(matrix: &'a Matrix, q: &'a [f64], warm: Vec<bool>) -> Self {
        let n = q.len();
        let mut path = Self {
            matrix,
            columns: matrix.transpose(),
            q,
            artificial: vec![-1.0; n],
            basis: (0..n).map(Variable::W).collect(),
            inverse: UpdatedInverse::identity(n),
            x: q.to_vec(),
            pivots: 0,
        };
        if warm.contains(&true) {
            path.basis = (0..n).map(|i| if warm[i] { Variable::Z(i) } else { Variable::W(i) }).collect();
            if !path.rebuild() {
                path.basis = (0..n).map(Variable::W).collect();
                path.inverse = UpdatedInverse::identity(n);
                path.x = q.to_vec();
            }
        }
        path
    }

    /// The column of a variable.
    fn column(&self, variable: Variable) -> Vec<f64> {
        match variable {
            Variable::W(i) => (0..self.q.len()).map(|k| f64::from(u8::from(k == i))).collect(),
            Variable::Z(i) => self.columns.row(i).iter().map(|m| -m).collect(),
            Variable::Artificial => self.artificial.clone(),
        }
    }

    /// B⁻¹ a for the column a of a variable.
    fn image(&self, variable: Variable) -> Vec<f64> {
        match variable {
            Variable::W(i) => (0..self.q.len()).map(|k| self.inverse.row(k)[i]).collect(),
            _ => self.inverse.multiply(&self.column(variable)),
        }
    }

    /// z of the plain problem.
    pub fn z(&self) -> Vec<f64> {
        let mut z = vec![0.0; self.q.len()];
        for (variable, &x) in self.basis.iter().zip(&self.x) {
            if let Variable::Z(i) = variable {
                z[*i] = x;
            }
        }
        z
    }

    /// Pivots until z₀ leaves, a ray opens, or `cap` is reached.
    pub fn follow(&mut self, covering: Covering, cap: usize) -> PathEnd {
        let n = self.q.len();
        if self.x.iter().all(|&x| x >= 0.0) {
            return PathEnd::Solution;
        }
        let d: Vec<f64> = (0..n).map(|i| covering_entry(covering, i)).collect();
        // In terms of the starting basis, so that z₀ covers every negative basic variable.
        self.artificial = (0..n)
            .map(|i| {
                let in_row = |(k, variable): (usize, &Variable)| match *variable {
                    Variable::W(j) => {
                        if i == j {
                            d[k]
                        } else {
                            0.0
                        }
                    }
                    Variable::Z(j) => -self.matrix[(i, j)] * d[k],
                    Variable::Artificial => 0.0,
                };
                -self.basis.iter().enumerate().map(in_row).sum::<f64>()
            })
            .collect();
        let mut entering = Variable::Artificial;
        // The first step makes z₀ just large enough: the same ratio test with all denominators positive.
        let mut image: Vec<f64> = d;
        loop {
            let mut leaving_row = self.leaving_row(&image);
            // A ray, or a pivot much smaller than its column, may be rounding: look again with a fresh inverse.
            let doubtful = leaving_row.is_none_or(|row| image[row] < 1e-5 * largest(&image));
            if doubtful && entering != Variable::Artificial && self.inverse.updates() > 0 && self.rebuild() {
                image = self.image(entering);
                leaving_row = self.leaving_row(&image);
            }
            let Some(row) = leaving_row else { return PathEnd::Ray(self.ray(entering, &image)) };
            if entering == Variable::Artificial {
                image.iter_mut().for_each(|a| *a = -*a);
            }
            let leaving = self.basis[row];
            if !self.pivot(row, entering, &image) {
                return if self.x.iter().all(|x| x.is_finite()) { PathEnd::Singular } else { PathEnd::NotFinite };
            }
            if leaving == Variable::Artificial {
                return PathEnd::Solution;
            }
            if self.pivots >= cap {
                return PathEnd::OutOfPivots;
            }
            entering = leaving.complement();
            image = self.image(entering);
            if !largest(&image).is_finite() {
                return PathEnd::NotFinite;
            }
        }
    }

    /// The row that the ratio test picks, z₀ first among ties and the lexicographic order after it.
    fn leaving_row(&self, image: &[f64]) -> Option<usize> {
        let threshold = 1e-10 * largest(image);
        let mut best: Option<usize> = None;
        for i in (0..image.len()).filter(|&i| image[i] > threshold) {
            best = match best {
                Some(b) if !self.comes_before(i, b, image) => Some(b),
                _ => Some(i),
            };
        }
        best
    }

    /// Compares rows of [x, B⁻¹] / α in lexicographic order.
    fn comes_before(&self, i: usize, j: usize, image: &[f64]) -> bool {
        let differs = |a: f64, b: f64| (a - b).abs() > 1e-12 * (a.abs() + b.abs());
        let (a, b) = (self.x[i] / image[i], self.x[j] / image[j]);
        if differs(a, b) {
            return a < b;
        }
        if self.basis[i] == Variable::Artificial || self.basis[j] == Variable::Artificial {
            return self.basis[i] == Variable::Artificial;
        }
        let (row, other) = (self.inverse.row(i), self.inverse.row(j));
        // Entries that ought to be zero are as large as rounding in the largest of their row.
        let noise = 1e-13 * (largest(row) / image[i] + largest(other) / image[j]);
        for (a, b) in row.iter().zip(other) {
            let (a, b) = (a / image[i], b / image[j]);
            if differs(a, b) && (a - b).abs() > noise {
                return a < b;
            }
        }
        false
    }

    /// Exchanges the basic variable of a row for another; false when the basis becomes singular.
    fn pivot(&mut self, row: usize, entering: Variable, image: &[f64]) -> bool {
        let step = self.x[row] / image[row];
        self.pivots += 1;
        self.basis[row] = entering;
        // Rebuilding costs about as much as n updates, so that it is rare enough not to show.
        let updated = self.inverse.replace_column(row, image).is_ok();
        if !updated || self.inverse.updates() > self.q.len().max(50) {
            return self.rebuild();
        }
        let noise = 1e-14 * largest(&self.x);
        for (i, x) in self.x.iter_mut().enumerate() {
            *x = if i == row { step } else { *x - step * image[i] };
            if x.abs() <= noise {
                *x = 0.0;
            }
        }
        self.x.iter().all(|x| x.is_finite())
    }

    /// Computes B⁻¹ and x afresh; false when B is singular.
    fn rebuild(&mut self) -> bool {
        let columns: Vec<Vec<f64>> = self.basis.iter().map(|&variable| self.column(variable)).collect();
        let n = columns.len();
        if self.inverse.rebuild(Matrix::from_fn(n, n, |i, j| columns[j][i])).is_err() {
            return false;
        }
        self.x = (0..n).map(|i| dot(self.inverse.row(i), self.q)).collect();
        let noise = 1e-14 * largest(&self.x);
        self.x.iter_mut().filter(|x| x.abs() <= noise).for_each(|x| *x = 0.0);
        self.x.iter().all(|x| x.is_finite())
    }

    /// Direction in z along which nothing blocks.
    fn ray(&self, entering: Variable, image: &[f64]) -> Vec<f64> {
        let mut ray = vec![0.0; self.q.len()];
        for (variable, &a) in self.basis.iter().zip(image) {
            if let Variable::Z(i) = variable {
                ray[*i] = (-a).max(0.0);
            }
        }
        if let Variable::Z(i) = entering {
            ray[i] = 1.0;
        }
        ray
    }
}

/// One entry of the covering vector.
fn covering_entry(covering: Covering, i: usize) -> f64 {
    match covering {
        Covering::Ones => 1.0,
        Covering::Spread(seed) => {
            // Multiples of the golden ratio, modulo one, are spread evenly and never repeat.
            let turn = 0.618_033_988_749_894_9 * (i as f64 + 1.0) * f64::from(seed.wrapping_add(1));
            1.0 + turn - turn.floor()
        }
    }
}
