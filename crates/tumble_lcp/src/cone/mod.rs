//! Contacts with the exact friction disc.
//!
//! Each contact has a normal impulse and a tangential one, which in the plane is a number and in space a vector. W maps impulses
//! to velocities, q is the velocity without impulses, and
//!
//! ```text
//! u = W r + q
//! 0 ≤ r_n ⟂ u_n ≥ 0                               (Signorini)
//! |r_t| ≤ μ r_n,   r_t = −μ r_n u_t / |u_t|  where u_t ≠ 0    (Coulomb)
//! ```
//!
//! With ũ = u + μ |u_t| n this is one statement about cones: K* ∋ ũ ⟂ r ∈ K = { |r_t| ≤ μ r_n } (De Saxcé and Feng 1998).
//!
//! - [`FrictionProblem`] is the problem; [`FrictionProblem::residual`] its natural map.
//! - [`BlockGaussSeidel`] solves contact after contact exactly, and repeats.
//! - [`ConeNewton`] solves all of them at once.
//! - [`FrictionProblem::to_planar_lcp`] and [`FrictionProblem::to_polyhedral_lcp`] hand it to the methods for an [`Lcp`](crate::Lcp).

mod gauss_seidel;
mod local;
mod newton;
mod polyhedral;
mod problem;

pub use gauss_seidel::BlockGaussSeidel;
pub use newton::ConeNewton;
pub use polyhedral::PolyhedralLcp;
pub use problem::{ContactSpace, FrictionProblem, FrictionSolution};
