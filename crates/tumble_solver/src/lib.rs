//! Contact models on plain slices of bodies and contact points.
//!
//! A model is told which points touch and answers with forces or impulses; it never searches for contacts and has not heard of an
//! entity. All of them read the same two records, [`SolverBody`] and [`ContactRow`], so that one scene can run under each:
//!
//! | Model | forces | velocity filter | impacts |
//! |---|---|---|---|
//! | [`penalty`] | spring and damper per point | – | – |
//! | one-by-one impulse | – | [`filter`]: touching contacts, accumulated impulses | [`impact`]: colliding contacts, worst first, repeatedly |
//! | [`resting_lcp`] | normal acceleration ≥ 0, after all other forces | leftover velocity of points at rest | one by one |
//! | [`velocity_lcp`] | – | all contacts of an island at once | all at once, by Poisson's or Newton's law |
//! | [`soft_step`] | – | substeps of soft contacts, eight at a time | at the end of the substeps |
//!
//! [`joint`] holds joints beside them, as rows that are solved in one block. [`island`] finds what has to be solved together.
//! [`position`] is the position filter of the impulse model: no gap closes beyond touch within a step.

pub mod body;
pub mod contact;
mod coupling;
pub mod filter;
pub mod impact;
pub mod island;
pub mod joint;
mod least_norm;
pub mod penalty;
pub mod position;
mod report;
pub mod resting_lcp;
mod skyline;
pub mod soft_step;
pub mod velocity_lcp;

pub use body::SolverBody;
pub use contact::{ContactRow, Slip, Surface};
pub use report::{Ending, Report};
