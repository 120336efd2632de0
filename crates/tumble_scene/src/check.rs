//! Simulations that know what they promise: run, record, and compare.
//!
//! ```
//! use tumble_scene::format::Scene;
//! use tumble_scene::{Check, FromScene};
//! use tumble_sim::Simulation;
//!
//! let text = r#"(
//!     format: 1, duration: 1,
//!     bodies: [(name: "ball", at: (0, 5), parts: [Disc(radius: 0.1)])],
//!     expect: [VelocityY(of: "ball", at: 1, is: -9.81, within: 1e-12, because: "g t")],
//! )"#;
//! let mut simulation = Simulation::from_loaded(&Scene::parse(text, "drop.ron")?)?;
//! simulation.run_scene()?;
//! assert!(simulation.check().passed());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::collections::BTreeSet;

use bevy_ecs::prelude::Resource;
use thiserror::Error;
use tumble_math::Planar;
use tumble_record::{Record, Recording};
use tumble_sim::{BodyTable, GravityScale, Simulation, StepError};

use crate::dim::SceneDim;
use crate::expand::copies;
use crate::expect::{NotMeasured, Status, Verdict, evaluate};
use crate::format::{BodyEntry, ContactModel, Expectation, Scene};

/// A simulation that is held to what was promised of it.
pub trait Check<D: SceneDim = Planar> {
    /// The scene it was built from; `None` for one built in code.
    fn scene(&self) -> Option<&Scene<D>>;

    /// Runs to the end of the scene's duration, recording as often as the scene says unless a recording is under way.
    ///
    /// # Errors
    ///
    /// When there is no scene, or a step fails.
    fn run_scene(&mut self) -> Result<(), RunError>;

    /// Adds an expectation to those of the scene, or makes the first one of a simulation built in code.
    fn expect(&mut self, expectation: Expectation<D>);

    /// Compares the recording with every expectation.
    ///
    /// A simulation built in code has run its whole duration, whatever that is. Without a recording every expectation has
    /// [failed](NotMeasured::NothingRecorded): call [`run_scene`](Self::run_scene), or [`record`](Record::record) before the
    /// first step.
    fn check(&mut self) -> Verdict;
}

/// Why a scene did not run to its end.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RunError {
    /// The simulation was not built from a scene, so nothing says how long it runs.
    #[error("this simulation was not built from a scene: call `record` and `run_for` instead")]
    NoScene,
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// What was promised of a simulation.
#[derive(Resource, Clone, Debug)]
pub(crate) struct Promises<D: SceneDim> {
    /// The scene it was built from.
    pub scene: Option<Scene<D>>,
    /// Expectations that were added in code.
    pub added: Vec<Expectation<D>>,
}

impl<D: SceneDim> Default for Promises<D> {
    fn default() -> Self {
        Self { scene: None, added: Vec::new() }
    }
}

/// Lets a simulation remember its scene.
pub(crate) fn remember<D: SceneDim>(simulation: &mut Simulation<D>, scene: &Scene<D>) {
    simulation.world_mut().insert_resource(Promises { scene: Some(scene.clone()), added: Vec::new() });
}

impl<D: SceneDim> Check<D> for Simulation<D> {
    fn scene(&self) -> Option<&Scene<D>> {
        self.world().get_resource::<Promises<D>>()?.scene.as_ref()
    }

    fn run_scene(&mut self) -> Result<(), RunError> {
        let scene = self.scene().ok_or(RunError::NoScene)?;
        let (duration, every) = (scene.duration, scene.every);
        if self.recording().is_none() {
            self.record(every)?;
        }
        self.run_for(duration - self.time())?;
        Ok(())
    }

    fn expect(&mut self, expectation: Expectation<D>) {
        self.world_mut().get_resource_or_init::<Promises<D>>().added.push(expectation);
    }

    fn check(&mut self) -> Verdict {
        let scene = promised(self);
        let model = ContactModel::from(self.settings().contact);
        let nothing = Recording { dt: self.clock().dt, ..Recording::default() };
        let recording = self.recording().unwrap_or(&nothing);
        let mut verdict = evaluate(&scene, model, recording);
        if recording.samples.is_empty() {
            // Whatever else is missing, this is what to mend first.
            for failure in verdict.outcomes.iter_mut().filter(|outcome| outcome.status == Status::Failed) {
                failure.obstacle = Some(NotMeasured::NothingRecorded);
            }
        }
        verdict
    }
}

/// The scene with all expectations, and with an entry for each body that was added in code.
fn promised<D: SceneDim>(simulation: &Simulation<D>) -> Scene<D> {
    let Promises { scene, added } = simulation.world().get_resource::<Promises<D>>().cloned().unwrap_or_default();
    let settings = simulation.settings();
    let in_code = || Scene { gravity: settings.gravity, duration: simulation.time(), ..Scene::empty() };
    let mut scene = scene.unwrap_or_else(in_code);
    scene.expect.extend(added);
    let known: BTreeSet<String> = scene.bodies.iter().flat_map(copies).map(|copy| copy.name).collect();
    for entry in simulation.world().resource::<BodyTable>().entries().iter().filter(|e| !known.contains(&e.name)) {
        let scale = simulation.world().get::<GravityScale>(entry.entity).map_or(1.0, |scale| scale.0);
        scene.bodies.push(BodyEntry { name: entry.name.clone(), gravity_scale: scale, ..BodyEntry::default() });
    }
    scene
}
