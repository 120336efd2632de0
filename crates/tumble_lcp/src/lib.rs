//! Linear complementarity problems, and exact Coulomb friction, solved.
//!
//! Find z ≥ 0 with w = M z + q ≥ 0 and zᵢ wᵢ = 0 in every row: either it does not push, or it does not open. Contacts, motors,
//! joints, quadratic programs and matrix games all have this form. This crate knows nothing of any of them: numbers in, numbers out.
//!
//! ```
//! use tumble_lcp::{Lcp, Matrix, Method, solve};
//!
//! let m = Matrix::from_rows([[2.0, 1.0], [1.0, 2.0]]);
//! let problem = Lcp::new(m, vec![-5.0, -6.0])?;
//! let solved = solve(&problem)?;
//! assert!((solved.solution.z[0] - 4.0 / 3.0).abs() < 1e-15);
//! assert!((solved.solution.z[1] - 7.0 / 3.0).abs() < 1e-15);
//! assert_eq!(solved.solution.report.method, Method::PrincipalPivoting);
//! assert!(solved.solution.report.residual <= 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The parts
//!
//! - [`Lcp`]: M, q and a [`Bound`] per row (z ≥ 0, free, box, or friction coupled to a normal). M is a dense [`Matrix`], or any
//!   [`Operator`] that never builds it, such as [`WeightedGram`] (J W Jᵀ).
//! - One residual for all: the natural map, max |min(zᵢ, wᵢ)| ([`Lcp::residual`]).
//! - One report ([`Report`]) with each [`Solution`]; a reason ([`SolveError`]) where there is none, with a Farkas certificate where
//!   the problem is infeasible.
//! - [`solve()`] chooses a method and says which. The methods are siblings, and their pages have the same headings:
//!
//! | Method | Page | For |
//! |---|---|---|
//! | [`Lemke`] | [`lemke`] | any M in its many classes, certainty |
//! | [`PrincipalPivoting`] | [`principal`] | symmetric M, friction rows, warm starts |
//! | [`Newton`] | [`newton`] | nonsymmetric M, warm starts |
//! | [`InteriorPoint`] | [`interior_point`] | large dense semidefinite M |
//! | [`GaussSeidel`] | [`gauss_seidel`] | large, rough, quick |
//! | [`ProjectedGradient`] | [`projected_gradient`] | large, symmetric, never built |
//! | [`enumerate()`] | [`mod@enumerate`] | all solutions of the smallest problems |
//!
//! - [`cone`]: contacts with the exact friction disc in space, and its polyhedral form for the methods above.
//! - [`families`]: random problems with known answers, to test and to measure with.
//!
//! # Accuracy
//!
//! A pivoting method and Newton's return a solution only if its residual is at most 1e-12 · max(1, ‖q‖∞, ‖M‖∞ ‖z‖∞); the interior
//! point 1e-9 of the same; the iterative ones their `tolerance` · max(1, ‖q‖∞). No finite input makes any of them panic or run for
//! ever, and equal input gives equal bits: all sums have a fixed order and nothing is fused.

mod active_set;
pub mod cone;
pub mod enumerate;
mod factor;
pub mod families;
pub mod gauss_seidel;
pub mod interior_point;
pub mod lemke;
mod matrix;
pub mod newton;
mod operator;
mod outcome;
pub mod principal;
mod problem;
pub mod projected_gradient;
mod proximal;
mod solve;
mod standard;

pub use enumerate::enumerate;
pub use gauss_seidel::GaussSeidel;
pub use interior_point::InteriorPoint;
pub use lemke::{Covering, Lemke, Scaling};
pub use matrix::Matrix;
pub use newton::Newton;
pub use operator::{Operator, RowOperator, WeightedGram};
pub use outcome::{Method, PIVOTING_TOLERANCE, Report, Solution, SolveError};
pub use principal::{Indeterminate, PrincipalPivoting};
pub use problem::{Bound, Lcp, ProblemError};
pub use projected_gradient::ProjectedGradient;
pub use solve::{Definiteness, MatrixClass, Solved, solve, solve_from};
