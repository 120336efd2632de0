//! Files ↔ worlds: the scene format, its mistakes, and what a scene promises.
//!
//! - [`format`]: what a scene file can say, as plain types;
//! - [`Scene::load`](format::Scene::load) and [`Scene::parse`](format::Scene::parse): from a file to a scene, or to all of its mistakes
//!   at once ([`diagnostics`]);
//! - [`Scene::expand`](format::Scene::expand): repeats unrolled and part lists filled in;
//! - [`materials`]: friction and restitution of a pair;
//! - [`Scene::to_ron`](format::Scene::to_ron) and [`schema()`]: scenes and the format itself as text.
//!
//! ```
//! use tumble_scene::format::Scene;
//!
//! let text = r#"(
//!     format: 1, duration: 1.0,
//!     bodies: [(name: "stick", parts: [Rod(from: (0, 0), to: (1, 0), densty: 2.0)])],
//! )"#;
//! let mistakes = Scene::parse(text, "stick.ron").unwrap_err();
//! assert!(mistakes.to_string().contains("did you mean `density`?"));
//! ```

mod batch;
mod build;
mod check;
pub mod diagnostics;
pub mod dim;
mod engine;
mod exact;
pub mod expand;
pub mod expect;
pub mod format;
mod load;
pub mod materials;
mod meetings;
mod overlap;
mod path;
mod salvage;
mod schema;
pub mod shapes;
pub mod shipped;
mod surface;
mod text;
mod to_scene;
mod validate;
mod write;

pub use batch::{Batch, BatchEnd, BatchError, BatchRun, RunFailure, Variation};
pub use build::{BuildError, FromScene};
pub use check::{Check, RunError};
pub use dim::{PartError, SceneDim};
pub use engine::SceneEngine;
pub use load::{AnyLoaded, Loaded, load_table};
pub use meetings::{Meeting, meetings};
pub use overlap::initial_overlaps;
pub use path::ScenePath;
pub use schema::schema;
pub use surface::{Surface, SurfaceError};
pub use to_scene::{ToScene, UnwritableError};
pub use validate::validate;
