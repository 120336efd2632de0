//! Parts: the shapes that are rigidly attached to a body (R1), each an entity of its own.
//!
//! ```
//! # use tumble_sim::*;
//! # use glam::dvec2;
//! # use tumble_shape::Rod;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let mut simulation = Simulation::new(Settings::default());
//! let hammer = simulation.spawn(Position(dvec2(0.0, 1.0)));
//! let handle = Part::new(Rod::try_new(dvec2(0.0, 0.0), dvec2(1.0, 0.0), 0.0)?, Amount::Density(2.0));
//! simulation.attach(hammer, handle);
//! # Ok(()) }
//! ```

use bevy_ecs::prelude::*;

use crate::geometry::Geometry;
use crate::structure::mark_changed;

/// How much of a part there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Mass per measure: of a rod per length [kg/m], of a disc or polygon per area [kg/m²].
    Density(f64),
    /// Mass outright [kg].
    Mass(f64),
}

/// Whether touching a part has an effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Response {
    /// It pushes back.
    #[default]
    Solid,
    /// It only tells: messages, no forces.
    Sensor,
}

/// Which parts can touch: both must accept a group of the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups {
    /// Groups that the part belongs to, one bit each.
    pub member_of: u32,
    /// Groups that it accepts, one bit each.
    pub accepts: u32,
}

impl Default for Groups {
    fn default() -> Self {
        Self { member_of: 1, accepts: u32::MAX }
    }
}

impl Groups {
    /// Whether two parts accept each other.
    pub fn admit(self, other: Self) -> bool {
        self.member_of & other.accepts != 0 && other.member_of & self.accepts != 0
    }
}

/// Index into [`Materials`](crate::Materials).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct MaterialId(pub u16);

/// A shape attached to a body, in the frame in which the body's parts are written.
#[derive(Component, Clone, Debug, PartialEq)]
#[component(on_insert = mark_changed, on_remove = mark_changed)]
pub struct Part<D: Geometry> {
    /// The shape.
    pub shape: D::Shape,
    /// Its mass.
    pub amount: Amount,
    /// Its surface.
    pub material: MaterialId,
    /// Whether it pushes back.
    pub response: Response,
    /// What it can touch.
    pub groups: Groups,
}

impl<D: Geometry> Part<D> {
    /// A solid part of the default material.
    pub fn new(shape: impl Into<D::Shape>, amount: Amount) -> Self {
        Self {
            shape: shape.into(),
            amount,
            material: MaterialId::default(),
            response: Response::Solid,
            groups: Groups::default(),
        }
    }

    /// The same part of another material.
    pub fn material(mut self, material: MaterialId) -> Self {
        self.material = material;
        self
    }

    /// The same part with another response.
    pub fn response(mut self, response: Response) -> Self {
        self.response = response;
        self
    }

    /// The same part in other groups.
    pub fn groups(mut self, groups: Groups) -> Self {
        self.groups = groups;
        self
    }
}

/// The body that a part belongs to.
#[derive(Component, Clone, Copy, Debug)]
#[relationship(relationship_target = Parts)]
pub struct PartOf(pub Entity);

/// The parts of a body, in the order in which they were attached.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = PartOf, linked_spawn)]
pub struct Parts(Vec<Entity>);
