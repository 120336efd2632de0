//! The top of a scene file.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::{Planar, Vector};

use super::{
    BodyEntry, ContactModel, Dialect, Dimension, Expectation, ForceEntry, JointEntry, MaterialEntry, ModelEntries,
    PairEntry, SpringEntry, Surface, Take,
};

/// A scene of the plane or of space: what is there, how it is simulated, and what it promises.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct Scene<D: Dialect = Planar> {
    /// Version of this format; 1 is the only one so far.
    pub format: u32,
    /// Whether the scene is of the plane, with x to the right and y up, or of space, with right-handed axes x, y and z. Default Planar.
    #[serde(default)]
    pub dimension: Dimension<D>,
    /// What the scene shows, in a sentence or two. Default empty.
    #[serde(default)]
    pub about: String,
    /// Time step [s]. Default 0.01. Smaller is more accurate and takes longer.
    #[serde(default = "default_dt")]
    pub dt: f64,
    /// Simulated time [s].
    pub duration: f64,
    /// Acceleration of free fall [m/s²]. Default 9.81 against y: (0, −9.81) in the plane, (0, −9.81, 0) in space.
    #[serde(default = "default_gravity::<D>")]
    #[schemars(with = "D::VectorText")]
    pub gravity: D::Vector,
    /// Typical size of a body [m]; tolerances are multiples of it. Default 1.
    #[serde(default = "one")]
    pub length_scale: f64,
    /// Overlap that is left alone, so that resting contacts do not flicker [m]. Default 0.005 of the length scale.
    #[serde(default)]
    pub slop: Option<f64>,
    /// How velocity and position advance. Default SymplecticEuler.
    #[serde(default)]
    pub integrator: Integrator,
    /// Whether steps are cut at impacts, so that bounces happen at their times; bodies then move as with Ballistic. The penalty
    /// model ignores it. Default false.
    #[serde(default)]
    pub time_of_impact: bool,
    /// The contact model that runs, unless the command line chooses another. Default Impulse.
    #[serde(default)]
    pub contact: ContactModel,
    /// Settings of every contact model, the chosen one and the others. Absent ones take the model's defaults.
    #[serde(default)]
    pub models: ModelEntries,
    /// Steps between two samples of the recording [1]. Default 1: every step.
    #[serde(default = "default_every")]
    pub every: u32,
    /// Seed of everything random, which is the jitter of repeated bodies. Default 0.
    #[serde(default)]
    pub seed: u64,
    /// Whether bodies may overlap by more than the slop at the start. Default false: that is a mistake.
    #[serde(default)]
    pub allow_overlap: bool,
    /// Files of further material tables, relative to this file; later ones override earlier ones. Default none.
    #[serde(default)]
    pub materials_from: Vec<String>,
    /// Materials by name; they override those of tables. A body without a material is made of "default".
    #[serde(default)]
    pub materials: BTreeMap<String, MaterialEntry>,
    /// Pairs of materials; they override those of tables, in either order of the two names.
    #[serde(default)]
    pub pairs: Vec<PairEntry>,
    /// Surface state looked up in material pairs. Default Dry.
    #[serde(default)]
    pub surface: Surface,
    /// Which figure of a range is taken. Default Midpoint.
    #[serde(default)]
    pub take: Take,
    /// Lists of parts by name, for bodies that share a shape: `parts: [List("hammer")]`.
    #[serde(default)]
    pub part_lists: BTreeMap<String, Vec<D::Part>>,
    /// The bodies. Their order means nothing: ids are the ranks of their names.
    #[serde(default)]
    pub bodies: Vec<BodyEntry<D>>,
    /// Springs with damping between points of bodies or of the world.
    #[serde(default)]
    pub springs: Vec<SpringEntry<D>>,
    /// Joints between points of bodies or of the world. Bodies held together do not collide with each other. Their order means nothing.
    #[serde(default)]
    pub joints: Vec<JointEntry<D>>,
    /// Applied forces and torques.
    #[serde(default)]
    pub forces: Vec<ForceEntry<D>>,
    /// What a run must show, each with a tolerance and a reason.
    #[serde(default)]
    pub expect: Vec<Expectation<D>>,
}

/// How velocity and position advance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Integrator {
    /// v += a Δt, then x += v Δt with the new velocity: first order, no energy drift.
    #[default]
    SymplecticEuler,
    /// x += v Δt + ½ a Δt², then v += a Δt: exact under a constant force, second order otherwise.
    Ballistic,
}

impl<D: Dialect> Scene<D> {
    /// The version of the format that this library reads and writes.
    pub const FORMAT: u32 = 1;

    /// Default slop in length scales [1].
    const SLOP_PER_LENGTH_SCALE: f64 = 0.005;

    /// Overlap that is left alone, the default filled in [m].
    pub fn slop_or_default(&self) -> f64 {
        self.slop.unwrap_or(Self::SLOP_PER_LENGTH_SCALE * self.length_scale)
    }
}

/// An empty planar scene of one second.
impl Default for Scene {
    fn default() -> Self {
        Self::empty()
    }
}

impl<D: Dialect> Scene<D> {
    /// An empty scene of one second.
    pub fn empty() -> Self {
        Self {
            format: Self::FORMAT,
            dimension: Dimension::default(),
            about: String::new(),
            dt: default_dt(),
            duration: 1.0,
            gravity: default_gravity::<D>(),
            length_scale: one(),
            slop: None,
            integrator: Integrator::default(),
            time_of_impact: false,
            contact: ContactModel::default(),
            models: ModelEntries::default(),
            every: default_every(),
            seed: 0,
            allow_overlap: false,
            materials_from: Vec::new(),
            materials: BTreeMap::new(),
            pairs: Vec::new(),
            surface: Surface::default(),
            take: Take::default(),
            part_lists: BTreeMap::new(),
            bodies: Vec::new(),
            springs: Vec::new(),
            joints: Vec::new(),
            forces: Vec::new(),
            expect: Vec::new(),
        }
    }
}

fn default_dt() -> f64 {
    0.01
}

fn default_gravity<D: Dialect>() -> D::Vector {
    D::Vector::unit(1) * -9.81
}

fn default_every() -> u32 {
    1
}

pub(super) fn one() -> f64 {
    1.0
}
