//! The first thing that went wrong within a step.

use bevy_ecs::prelude::*;

use crate::schedule::StepSystems;

/// A quantity of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Acceleration, and so the forces.
    Acceleration,
    /// Velocity.
    Velocity,
    /// Position or angle.
    Position,
}

impl Quantity {
    /// Its name.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Velocity => "velocity",
            Self::Position => "position",
        }
    }
}

/// What went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A quantity is not finite.
    NotFinite(Quantity),
    /// So many bodies are in one place that their pairs do not fit into any memory.
    Crowded,
}

/// The first thing that went wrong in this step; of several bodies in the same phase, the one with the smallest id.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fault(Option<FaultAt>);

/// Where a fault happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultAt {
    /// Rank of the body.
    pub body: u32,
    /// What went wrong.
    pub cause: Cause,
    /// The phase that produced it.
    pub phase: StepSystems,
}

impl Fault {
    /// Notes a fault unless `is_finite`.
    #[inline]
    pub fn check(&mut self, is_finite: bool, body: u32, quantity: Quantity, phase: StepSystems) {
        if !is_finite {
            self.note(FaultAt { body, cause: Cause::NotFinite(quantity), phase });
        }
    }

    /// Notes a fault.
    #[cold]
    pub(crate) fn note(&mut self, fault: FaultAt) {
        let first = self.0.is_none_or(|known| known.phase == fault.phase && fault.body < known.body);
        if first {
            self.0 = Some(fault);
        }
    }

    /// The fault, if there is one.
    pub fn get(&self) -> Option<FaultAt> {
        self.0
    }

    /// Whether nothing has gone wrong so far.
    pub fn is_none(&self) -> bool {
        self.0.is_none()
    }
}
