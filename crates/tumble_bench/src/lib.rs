//! Scenes to measure engines on, and how they are measured: what tumble and its peers share.
//!
//! A [`Plan`] says which bodies a scene has, and knows no engine. [`Scene`] is the list of them by name. An [`Engine`] made from a plan is
//! [`run`](run::run) and timed, a [judge](judge::judge) that looks only at poses says how well it kept bodies apart, and a [`Line`] tells
//! all of it in one line of CSV. The program `tumble_bench` does this with tumble.

pub mod judge;
pub mod line;
pub mod memory;
pub mod options;
pub mod plan;
pub mod run;
pub mod scatter;
pub mod scenes;

pub use judge::Verdict;
pub use line::Line;
pub use options::RunOptions;
pub use plan::{Body, Kind, Part, Plan, PlanDim, PlanarShape, SpatialShape};
pub use run::{BodyState, Engine};
pub use scenes::{AnyPlan, Scene, UnknownScene};
