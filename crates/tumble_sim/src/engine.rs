//! The large functions of a dimension as one static table.
//!
//! All systems are generic over the dimension. Were they named by [`Simulation`](crate::Simulation) directly, every program, test
//! and example that steps one would compile all of them again, which took more than a minute each. A table in a static is compiled
//! where it stands: once.

use std::collections::BTreeSet;

use bevy_ecs::prelude::*;

use crate::error::StepError;
use crate::geometry::Geometry;
use crate::needs::{Need, needs};
use crate::schedule::{add_systems, look_schedule, step_schedule};
use crate::settings::Settings;
use crate::simulation;

/// The large functions of a dimension, compiled once.
#[derive(Debug)]
pub struct Engine<D: Geometry> {
    pub(crate) world: fn(Settings<D>) -> World,
    pub(crate) step_schedule: fn() -> Schedule,
    pub(crate) look_schedule: fn() -> Schedule,
    pub(crate) add_systems: fn(Need, &mut Schedule, &mut Schedule),
    pub(crate) needs: fn(&mut World) -> BTreeSet<Need>,
    pub(crate) rebuild: fn(&mut World) -> Result<(), StepError>,
}

impl<D: Geometry> Engine<D> {
    /// The table of a dimension; belongs into a static.
    #[expect(clippy::new_without_default, reason = "a default could not be the value of a static")]
    pub const fn new() -> Self {
        Self {
            world: simulation::new_world::<D>,
            step_schedule: step_schedule::<D>,
            look_schedule: look_schedule::<D>,
            add_systems: add_systems::<D>,
            needs: needs::<D>,
            rebuild: simulation::rebuild::<D>,
        }
    }
}
