//! The frictional contact problem and its residuals.

use crate::matrix::{Matrix, largest};
use crate::operator::{Operator, affine};
use crate::outcome::{Method, Report, SolveError};
use crate::problem::ProblemError;

/// How many numbers a contact has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactSpace {
    /// Normal and one tangent; the friction disc is an interval.
    Planar,
    /// Normal and two tangents.
    Spatial,
}

impl ContactSpace {
    /// Rows per contact.
    pub fn rows(self) -> usize {
        match self {
            Self::Planar => 2,
            Self::Spatial => 3,
        }
    }
}

/// Contacts with Coulomb friction: u = W r + q. Rows go contact by contact, the normal first.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionProblem<A = Matrix> {
    matrix: A,
    q: Vec<f64>,
    coefficients: Vec<f64>,
    space: ContactSpace,
}

/// Impulses, velocities, and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionSolution {
    /// r.
    pub impulses: Vec<f64>,
    /// u = W r + q.
    pub velocities: Vec<f64>,
    /// Iterations and residual.
    pub report: Report,
}

impl FrictionProblem<Matrix> {
    /// A problem with one friction coefficient μ per contact \[1\].
    pub fn new(matrix: Matrix, q: Vec<f64>, coefficients: Vec<f64>, space: ContactSpace) -> Result<Self, ProblemError> {
        if matrix.columns() != matrix.rows() {
            let (found, expected) = (matrix.columns(), matrix.rows());
            return Err(ProblemError::WrongSize { quantity: "W (columns)", found, expected });
        }
        if let Some(row) = (0..matrix.rows()).find(|&i| matrix.row(i).iter().any(|m| !m.is_finite())) {
            return Err(ProblemError::NotFinite { quantity: "W", row });
        }
        Self::from_operator(matrix, q, coefficients, space)
    }

    /// The size that rounding errors of the residual are measured against: max(1, ‖q‖∞, ‖W‖∞ ‖r‖∞).
    pub fn scale(&self, impulses: &[f64]) -> f64 {
        largest(&self.q).max(1.0).max(self.matrix.norm() * largest(impulses))
    }
}

impl<A: Operator> FrictionProblem<A> {
    /// The same for a W that is never built.
    pub fn from_operator(
        matrix: A,
        q: Vec<f64>,
        coefficients: Vec<f64>,
        space: ContactSpace,
    ) -> Result<Self, ProblemError> {
        let expected = coefficients.len() * space.rows();
        for (quantity, found) in [("W", matrix.dimension()), ("q", q.len())] {
            if found != expected {
                return Err(ProblemError::WrongSize { quantity, found, expected });
            }
        }
        if let Some(row) = q.iter().position(|q| !q.is_finite()) {
            return Err(ProblemError::NotFinite { quantity: "q", row });
        }
        if let Some(row) = coefficients.iter().position(|mu| !mu.is_finite()) {
            return Err(ProblemError::NotFinite { quantity: "friction coefficient", row });
        }
        if let Some(row) = coefficients.iter().position(|&mu| mu < 0.0) {
            return Err(ProblemError::BadBound { row, mistake: "has a negative friction coefficient" });
        }
        Ok(Self { matrix, q, coefficients, space })
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.coefficients.len()
    }

    /// W.
    pub fn matrix(&self) -> &A {
        &self.matrix
    }

    /// q.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// μ per contact.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// Plane or space.
    pub fn space(&self) -> ContactSpace {
        self.space
    }

    /// u = W r + q.
    pub fn velocities(&self, impulses: &[f64]) -> Vec<f64> {
        affine(&self.matrix, &self.q, impulses)
    }

    /// The residual of r: largest magnitude of the natural map
    ///
    /// ```text
    /// min(r_n, u_n)   and   r_t − P(r_t − u_t),   P the projection onto the disc of radius μ max(r_n, 0)
    /// ```
    ///
    /// In the plane it is [`Lcp::residual`](crate::Lcp::residual) of the planar form. NaN when r or u is not finite.
    pub fn residual(&self, impulses: &[f64]) -> f64 {
        residual_with(self, impulses, &self.velocities(impulses))
    }

    /// The residual in terms of cones, as FCLIB reports it: largest magnitude of r − P_K(r − ũ), ũ = u + μ |u_t| n.
    pub fn cone_residual(&self, impulses: &[f64]) -> f64 {
        let velocities = self.velocities(impulses);
        let rows = self.space.rows();
        let mut residual = 0.0_f64;
        for (contact, &mu) in self.coefficients.iter().enumerate() {
            let (r, u) = (block(impulses, contact, rows), block(&velocities, contact, rows));
            let slip = length(u[1], u[2]);
            let target = [r[0] - u[0] - mu * slip, r[1] - u[1], r[2] - u[2]];
            let projected = project_on_cone(target, mu);
            for k in 0..3 {
                residual = residual.max((r[k] - projected[k]).abs());
            }
        }
        if velocities.iter().chain(impulses).all(|x| x.is_finite()) { residual } else { f64::NAN }
    }
}

/// One contact's numbers; the second tangent is zero in the plane.
pub(super) fn block(all: &[f64], contact: usize, rows: usize) -> [f64; 3] {
    let mut block = [0.0; 3];
    block[..rows].copy_from_slice(&all[contact * rows..(contact + 1) * rows]);
    block
}

/// √(x² + y²) without overflow.
pub(super) fn length(x: f64, y: f64) -> f64 {
    let size = x.abs().max(y.abs());
    if size == 0.0 || !size.is_finite() {
        size
    } else {
        size * ((x / size) * (x / size) + (y / size) * (y / size)).sqrt()
    }
}

/// The point of the disc nearest to (x, y).
pub(super) fn project_on_disc(x: f64, y: f64, radius: f64) -> (f64, f64) {
    let distance = length(x, y);
    if distance <= radius { (x, y) } else { (x / distance * radius, y / distance * radius) }
}

/// The point of K = { |t| ≤ μ n } nearest to x.
fn project_on_cone(x: [f64; 3], mu: f64) -> [f64; 3] {
    let tangent = length(x[1], x[2]);
    if tangent <= mu * x[0] {
        x
    } else if mu * tangent <= -x[0] {
        [0.0; 3]
    } else {
        let normal = (x[0] + mu * tangent) / (1.0 + mu * mu);
        [normal, mu * normal * x[1] / tangent, mu * normal * x[2] / tangent]
    }
}

/// One contact's natural map.
pub(super) fn natural_map(r: [f64; 3], u: [f64; 3], mu: f64) -> [f64; 3] {
    let (x, y) = project_on_disc(r[1] - u[1], r[2] - u[2], mu * r[0].max(0.0));
    [r[0].min(u[0]), r[1] - x, r[2] - y]
}

/// The residual, when u is known already.
pub(super) fn residual_with<A: Operator>(problem: &FrictionProblem<A>, impulses: &[f64], velocities: &[f64]) -> f64 {
    if impulses.iter().chain(velocities).any(|x| !x.is_finite()) {
        return f64::NAN;
    }
    let rows = problem.space.rows();
    (0..problem.contacts())
        .map(|c| natural_map(block(impulses, c, rows), block(velocities, c, rows), problem.coefficients[c]))
        .fold(0.0, |most, map| most.max(largest(&map)))
}

/// Accepts r if its residual is within the bar, and says what it is otherwise.
pub(super) fn judge<A: Operator>(
    problem: &FrictionProblem<A>,
    impulses: Vec<f64>,
    method: Method,
    iterations: usize,
    bar: f64,
) -> Result<FrictionSolution, SolveError> {
    let velocities = problem.velocities(&impulses);
    let report = Report { method, iterations, residual: residual_with(problem, &impulses, &velocities) };
    if !report.residual.is_finite() {
        Err(SolveError::NotFinite)
    } else if report.residual <= bar {
        Ok(FrictionSolution { impulses, velocities, report })
    } else {
        Err(SolveError::NotConverged { z: impulses, report })
    }
}
