//! The problem: find z between its bounds whose residual velocity w = M z + q pushes only against them.

use crate::matrix::{Matrix, largest};
use crate::operator::{Operator, affine};

/// What a row allows its z, and with it the sign of its w.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Bound {
    /// 0 ≤ z ⟂ w ≥ 0: a contact that pushes and never pulls.
    #[default]
    Nonnegative,
    /// z is free and w = 0: a joint.
    Free,
    /// l ≤ z ≤ u; w ≥ 0 at l, w ≤ 0 at u, w = 0 between: a motor with limited force. Either side may be infinite.
    Box {
        /// Least z.
        lower: f64,
        /// Largest z.
        upper: f64,
    },
    /// |z| ≤ μ · z of the row `normal`; w = 0 while it sticks, and opposes z at the limit: planar Coulomb friction.
    Friction {
        /// The row whose z limits this one; it must be [`Bound::Nonnegative`].
        normal: usize,
        /// μ ≥ 0 \[1\].
        coefficient: f64,
    },
}

/// A linear complementarity problem: w = M z + q with 0 ≤ z ⟂ w ≥ 0, or the [`Bound`] of each row instead.
///
/// M is a dense [`Matrix`] by default. The iterative solvers take any [`Operator`].
#[derive(Clone, Debug, PartialEq)]
pub struct Lcp<A = Matrix> {
    matrix: A,
    q: Vec<f64>,
    bounds: Vec<Bound>,
}

/// Why a problem is not one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// The parts do not fit together.
    #[error("{quantity} has size {found} where {expected} is needed")]
    WrongSize {
        /// The part.
        quantity: &'static str,
        /// Its size.
        found: usize,
        /// The size that would fit.
        expected: usize,
    },
    /// A number is infinite or NaN.
    #[error("{quantity} is not finite in row {row}")]
    NotFinite {
        /// The part.
        quantity: &'static str,
        /// The row it is in.
        row: usize,
    },
    /// A bound allows nothing, or couples to a row that cannot be a normal.
    #[error("the bound of row {row} {mistake}")]
    BadBound {
        /// The row.
        row: usize,
        /// What is wrong with it.
        mistake: &'static str,
    },
}

impl Lcp<Matrix> {
    /// The problem w = M z + q, 0 ≤ z ⟂ w ≥ 0.
    pub fn new(matrix: Matrix, q: Vec<f64>) -> Result<Self, ProblemError> {
        let expected = q.len();
        for (quantity, found) in [("M (rows)", matrix.rows()), ("M (columns)", matrix.columns())] {
            if found != expected {
                return Err(ProblemError::WrongSize { quantity, found, expected });
            }
        }
        if let Some(row) = (0..expected).find(|&i| matrix.row(i).iter().any(|m| !m.is_finite())) {
            return Err(ProblemError::NotFinite { quantity: "M", row });
        }
        Self::from_operator(matrix, q)
    }
}

impl<A: Operator> Lcp<A> {
    /// The same for a matrix that is never built. Whether its entries are finite shows only when it is applied.
    pub fn from_operator(operator: A, q: Vec<f64>) -> Result<Self, ProblemError> {
        if operator.dimension() != q.len() {
            let (found, expected) = (operator.dimension(), q.len());
            return Err(ProblemError::WrongSize { quantity: "M", found, expected });
        }
        if let Some(row) = q.iter().position(|q| !q.is_finite()) {
            return Err(ProblemError::NotFinite { quantity: "q", row });
        }
        let bounds = vec![Bound::Nonnegative; q.len()];
        Ok(Self { matrix: operator, q, bounds })
    }

    /// The problem with a bound per row in place of z ≥ 0.
    pub fn with_bounds(self, bounds: Vec<Bound>) -> Result<Self, ProblemError> {
        let expected = self.dimension();
        if bounds.len() != expected {
            return Err(ProblemError::WrongSize { quantity: "bounds", found: bounds.len(), expected });
        }
        for (row, bound) in bounds.iter().enumerate() {
            if let Some(mistake) = mistake(&bounds, bound) {
                return Err(ProblemError::BadBound { row, mistake });
            }
        }
        Ok(Self { bounds, ..self })
    }

    /// Number of rows.
    pub fn dimension(&self) -> usize {
        self.q.len()
    }

    /// M.
    pub fn matrix(&self) -> &A {
        &self.matrix
    }

    /// q.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// What each row allows.
    pub fn bounds(&self) -> &[Bound] {
        &self.bounds
    }

    /// True when every row is 0 ≤ z ⟂ w ≥ 0.
    pub fn is_standard(&self) -> bool {
        self.bounds.iter().all(|bound| *bound == Bound::Nonnegative)
    }

    /// True when some row is coupled to another by friction.
    pub fn has_friction(&self) -> bool {
        self.bounds.iter().any(|bound| matches!(bound, Bound::Friction { .. }))
    }

    /// w = M z + q.
    pub fn w(&self, z: &[f64]) -> Vec<f64> {
        affine(&self.matrix, &self.q, z)
    }

    /// Least and largest z allowed in row `i`, given the others.
    pub fn limits(&self, i: usize, z: &[f64]) -> (f64, f64) {
        match self.bounds[i] {
            Bound::Nonnegative => (0.0, f64::INFINITY),
            Bound::Free => (f64::NEG_INFINITY, f64::INFINITY),
            Bound::Box { lower, upper } => (lower, upper),
            Bound::Friction { normal, coefficient } => {
                let limit = coefficient * z[normal].max(0.0);
                (-limit, limit)
            }
        }
    }

    /// The natural map z − clamp(z − w, l, u) of every row; min(z, w) where the bound is z ≥ 0. Zero exactly at solutions.
    pub fn natural_map(&self, z: &[f64], w: &[f64]) -> Vec<f64> {
        (0..z.len())
            .map(|i| {
                let (lower, upper) = self.limits(i, z);
                natural_map_entry(z[i], w[i], lower, upper)
            })
            .collect()
    }

    /// The residual of z: largest magnitude of the natural map. NaN when z or M z is not finite.
    pub fn residual(&self, z: &[f64]) -> f64 {
        residual_with(self, z, &self.w(z))
    }

    /// Moves z to the nearest point that its bounds allow.
    pub fn clamp(&self, z: &mut [f64]) {
        for pass in [false, true] {
            for i in 0..z.len() {
                // Friction rows after the normals that limit them.
                if matches!(self.bounds[i], Bound::Friction { .. }) == pass {
                    let (lower, upper) = self.limits(i, z);
                    z[i] = z[i].max(lower).min(upper);
                }
            }
        }
    }
}

impl Lcp<Matrix> {
    /// The size that rounding errors of the residual are measured against: max(1, ‖q‖∞, ‖M‖∞ ‖z‖∞).
    pub fn scale(&self, z: &[f64]) -> f64 {
        largest(&self.q).max(1.0).max(self.matrix.norm() * largest(z))
    }

    /// Tells whether y proves that no z within its bounds has a w of the required signs (Farkas' lemma).
    ///
    /// For z ≥ 0 this is y ≥ 0, Mᵀ y ≤ 0, qᵀ y < 0: then yᵀ(M z + q) < 0 for every z ≥ 0, yet w ≥ 0 would need yᵀ w ≥ 0.
    /// In general y has the sign of w allowed by the bound, and the sup of yᵀ(M z + q) over the bounds is negative. Signs of Mᵀ y
    /// are judged to 1e-9 of their terms' size; the test is therefore meaningful for well-scaled problems.
    pub fn is_infeasibility_certificate(&self, y: &[f64]) -> bool {
        if y.len() != self.dimension() || y.iter().any(|y| !y.is_finite()) || self.has_friction() {
            return false;
        }
        let image = self.matrix.transpose_multiply(y);
        let size = largest(y);
        let noise = |row_scale: f64| 1e-9 * row_scale * size;
        let transpose_scale: Vec<f64> = column_scales(&self.matrix);
        let mut supremum: f64 = y.iter().zip(&self.q).map(|(y, q)| y * q).sum();
        for i in 0..y.len() {
            let (lower, upper) = self.limits(i, &[]);
            let sign_is_allowed = match (lower.is_finite(), upper.is_finite()) {
                (true, true) => y[i] == 0.0,
                (true, false) => y[i] >= 0.0,
                (false, true) => y[i] <= 0.0,
                (false, false) => true,
            };
            let m = if image[i].abs() <= noise(transpose_scale[i]) { 0.0 } else { image[i] };
            // The product is 0 · ∞ where M^T y vanishes against an infinite bound.
            let worst = if m > 0.0 {
                m * upper
            } else if m < 0.0 {
                m * lower
            } else {
                0.0
            };
            supremum += worst;
            if !sign_is_allowed {
                return false;
            }
        }
        supremum < -1e-9 * size * largest(&self.q)
    }
}

/// Largest magnitude in each column.
fn column_scales(matrix: &Matrix) -> Vec<f64> {
    let mut scales = vec![0.0; matrix.columns()];
    for i in 0..matrix.rows() {
        scales.iter_mut().zip(matrix.row(i)).for_each(|(scale, m): (&mut f64, _)| *scale = scale.max(m.abs()));
    }
    scales
}

/// z − clamp(z − w, l, u), computed without the cancellation in z − (z − w).
pub(crate) fn natural_map_entry(z: f64, w: f64, lower: f64, upper: f64) -> f64 {
    let above = z - lower;
    let below = z - upper;
    w.min(above).max(below)
}

/// The residual, when w is known already.
pub(crate) fn residual_with<A: Operator>(problem: &Lcp<A>, z: &[f64], w: &[f64]) -> f64 {
    if z.iter().chain(w).any(|value| !value.is_finite()) { f64::NAN } else { largest(&problem.natural_map(z, w)) }
}

/// What is wrong with a bound, if anything.
fn mistake(bounds: &[Bound], bound: &Bound) -> Option<&'static str> {
    match *bound {
        Bound::Nonnegative | Bound::Free => None,
        Bound::Box { lower, upper } if lower.is_nan() || upper.is_nan() => Some("is NaN"),
        Bound::Box { lower, upper } if lower > upper => Some("has its lower side above its upper side"),
        Bound::Box { lower, upper } if lower == f64::INFINITY || upper == f64::NEG_INFINITY => Some("allows no number"),
        Bound::Box { .. } => None,
        Bound::Friction { coefficient, .. } if coefficient.is_nan() || coefficient.is_infinite() => {
            Some("has a friction coefficient that is not finite")
        }
        Bound::Friction { coefficient, .. } if coefficient < 0.0 => Some("has a negative friction coefficient"),
        Bound::Friction { normal, .. } => {
            (bounds.get(normal) != Some(&Bound::Nonnegative)).then_some("is coupled to a row that is no normal")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn natural_map_is_the_minimum_for_plain_rows() {
        for (z, w) in [(2.0, 3.0), (0.0, 5.0), (4.0, 0.0), (-1.0, 2.0), (3.0, -2.0)] {
            assert_eq!(natural_map_entry(z, w, 0.0, f64::INFINITY), f64::min(z, w));
        }
        // At the upper side w may be negative; between the sides it may not.
        assert_eq!(natural_map_entry(1.0, -3.0, -1.0, 1.0), 0.0);
        assert_eq!(natural_map_entry(0.5, -3.0, -1.0, 1.0), -0.5);
        assert_eq!(natural_map_entry(7.0, 0.25, f64::NEG_INFINITY, f64::INFINITY), 0.25);
    }

    #[test]
    fn bad_problems_are_refused_with_the_culprit() {
        let m = Matrix::from_rows([[1.0, f64::NAN], [0.0, 1.0]]);
        assert_eq!(Lcp::new(m, vec![0.0; 2]), Err(ProblemError::NotFinite { quantity: "M", row: 0 }));
        let m = Matrix::identity(2);
        assert_eq!(
            Lcp::new(m.clone(), vec![0.0, f64::INFINITY]),
            Err(ProblemError::NotFinite { quantity: "q", row: 1 })
        );
        assert!(matches!(Lcp::new(m.clone(), vec![0.0; 3]), Err(ProblemError::WrongSize { .. })));
        let problem = Lcp::new(m, vec![0.0; 2]).unwrap();
        for bad in [
            Bound::Box { lower: 1.0, upper: 0.0 },
            Bound::Box { lower: f64::NAN, upper: 0.0 },
            Bound::Friction { normal: 0, coefficient: -0.1 },
            Bound::Friction { normal: 5, coefficient: 0.1 },
            Bound::Friction { normal: 1, coefficient: 0.1 },
        ] {
            let outcome = problem.clone().with_bounds(vec![Bound::Nonnegative, bad]);
            assert!(matches!(outcome, Err(ProblemError::BadBound { row: 1, .. })), "{bad:?}: {outcome:?}");
        }
    }

    #[test]
    fn certificate_is_checked_against_both_of_its_conditions() {
        let problem = Lcp::new(Matrix::from_rows([[0.0, 1.0], [-1.0, 0.0]]), vec![-1.0, -1.0]).unwrap();
        assert!(problem.is_infeasibility_certificate(&[0.0, 1.0]));
        assert!(!problem.is_infeasibility_certificate(&[1.0, 0.0]));
        assert!(!problem.is_infeasibility_certificate(&[0.0, -1.0]));
    }
}
