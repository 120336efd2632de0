//! Friction for methods that know only an [`Lcp`]: an interval in the plane, which is exact, and a polygon for the disc in space.

use super::problem::{ContactSpace, FrictionProblem};
use crate::matrix::Matrix;
use crate::outcome::Solution;
use crate::problem::{Bound, Lcp, ProblemError};

/// The polyhedral form, and the way back.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedralLcp {
    /// The plain problem. Per contact: r_n, then β for each direction, then the slip speed λ.
    pub problem: Lcp,
    /// Directions around each contact.
    directions: Vec<[f64; 2]>,
    rows: usize,
}

impl FrictionProblem {
    /// The planar problem as an LCP with friction rows: the same z, w and residual. `None` in space.
    pub fn to_planar_lcp(&self) -> Option<Lcp> {
        if self.space() == ContactSpace::Spatial {
            return None;
        }
        let bounds = self
            .coefficients()
            .iter()
            .enumerate()
            .flat_map(|(contact, &coefficient)| {
                [Bound::Nonnegative, Bound::Friction { normal: 2 * contact, coefficient }]
            })
            .collect();
        Lcp::new(self.matrix().clone(), self.q().to_vec()).and_then(|problem| problem.with_bounds(bounds)).ok()
    }

    /// The problem with the disc replaced by the polygon of `sides` directions (Stewart and Trinkle 1996; Anitescu and Potra 1997):
    ///
    /// ```text
    /// r_t = Σ β_k d_k,   0 ≤ β_k ⟂ d_k · u_t + λ ≥ 0,   0 ≤ λ ⟂ μ r_n − Σ β_k ≥ 0
    /// ```
    ///
    /// The polygon lies inside the disc: friction is short by a factor of at worst cos(π / sides). In the plane there are always two
    /// directions, and the form is exact. Fewer than three sides in space are refused.
    pub fn to_polyhedral_lcp(&self, sides: usize) -> Result<PolyhedralLcp, ProblemError> {
        let directions: Vec<[f64; 2]> = match self.space() {
            ContactSpace::Planar => vec![[1.0, 0.0], [-1.0, 0.0]],
            ContactSpace::Spatial if sides < 3 => {
                return Err(ProblemError::WrongSize { quantity: "polygon (sides)", found: sides, expected: 3 });
            }
            ContactSpace::Spatial => (0..sides)
                .map(|k| {
                    let (sine, cosine) = libm::sincos(std::f64::consts::TAU * k as f64 / sides as f64);
                    [cosine, sine]
                })
                .collect(),
        };
        let rows = self.space().rows();
        let (contacts, size) = (self.contacts(), directions.len() + 2);
        // Columns of B turn plain unknowns into impulses: r = B x.
        let mut spread = Matrix::zeros(contacts * rows, contacts * size);
        for contact in 0..contacts {
            spread[(contact * rows, contact * size)] = 1.0;
            for (k, direction) in directions.iter().enumerate() {
                for (tangent, &component) in direction.iter().enumerate().take(rows - 1) {
                    spread[(contact * rows + 1 + tangent, contact * size + 1 + k)] = component;
                }
            }
        }
        let mut matrix = spread.transpose().product(&self.matrix().product(&spread));
        let q = spread.transpose_multiply(self.q());
        for (contact, &mu) in self.coefficients().iter().enumerate() {
            let (first, slip) = (contact * size, (contact + 1) * size - 1);
            matrix[(slip, first)] = mu;
            for k in 1..slip - first {
                matrix[(first + k, slip)] = 1.0;
                matrix[(slip, first + k)] = -1.0;
            }
        }
        Ok(PolyhedralLcp { problem: Lcp::new(matrix, q)?, directions, rows })
    }
}

impl PolyhedralLcp {
    /// The impulses of a solution.
    pub fn impulses(&self, solution: &Solution) -> Vec<f64> {
        let size = self.directions.len() + 2;
        let mut impulses = Vec::with_capacity(solution.z.len() / size * self.rows);
        for x in solution.z.chunks_exact(size) {
            impulses.push(x[0]);
            for tangent in 0..self.rows - 1 {
                impulses.push(self.directions.iter().zip(&x[1..]).map(|(d, beta)| d[tangent] * beta).sum());
            }
        }
        impulses
    }
}
