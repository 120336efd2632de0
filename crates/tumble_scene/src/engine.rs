//! The large functions of a dimension as one static table.
//!
//! Reading, building and judging scenes is generic over the dimension. Were those functions named directly, every program and test that
//! uses a scene would compile them again, with all of `serde` that they need. A table in a static is compiled where it stands: once.

use std::fmt;
use std::path::Path;

use tumble_record::Recording;
use tumble_sim::Simulation;

use crate::build::{self, BuildError};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dim::SceneDim;
use crate::expect::{self, Verdict};
use crate::format::{ContactModel, Scene};
use crate::load::{self, Loaded};
use crate::materials::MaterialLibrary;
use crate::overlap;
use crate::to_scene::{self, UnwritableError};
use crate::{validate, write};

/// The large functions of a dimension, compiled once.
pub struct SceneEngine<D: SceneDim> {
    pub(crate) read: fn(&str, &Path, Option<&Path>) -> Result<Loaded<D>, Diagnostics>,
    pub(crate) write: fn(&Scene<D>) -> String,
    pub(crate) to_plain: fn(&Scene<D>) -> Result<String, String>,
    pub(crate) of_plain: fn(&str) -> Result<Scene<D>, String>,
    pub(crate) validate: fn(&Scene<D>, &MaterialLibrary) -> Vec<Diagnostic>,
    pub(crate) build: fn(&Scene<D>, &MaterialLibrary) -> Result<Simulation<D>, BuildError>,
    pub(crate) overlaps: fn(&Scene<D>, &MaterialLibrary) -> Result<Vec<Diagnostic>, BuildError>,
    pub(crate) write_down: fn(&mut Simulation<D>) -> Result<Scene<D>, UnwritableError>,
    pub(crate) evaluate: fn(&Scene<D>, ContactModel, &Recording<D>) -> Verdict,
}

impl<D: SceneDim> fmt::Debug for SceneEngine<D> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("SceneEngine").finish_non_exhaustive()
    }
}

impl<D: SceneDim> SceneEngine<D> {
    /// The table of a dimension; belongs into a static.
    #[expect(clippy::new_without_default, reason = "a default could not be the value of a static")]
    pub const fn new() -> Self {
        Self {
            read: load::read_scene::<D>,
            write: write::written::<D>,
            to_plain: write::plain::<D>,
            of_plain: write::of_plain::<D>,
            validate: validate::findings::<D>,
            build: build::simulation::<D>,
            overlaps: overlap::overlaps_at_start::<D>,
            write_down: to_scene::written_down::<D>,
            evaluate: expect::verdict_of::<D>,
        }
    }
}
