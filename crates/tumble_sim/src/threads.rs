//! The threads that share the work of a step.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use tumble_team::{Team, TeamError};

/// Pairs that a thread takes at a time.
pub(crate) const PAIRS_OF_A_TASK: usize = 256;
/// Fewer pairs than this are not worth waking a thread for.
const WORTH_SHARING: usize = 1000;

/// The threads that share the work of a step. However many they are, the bits are the same.
#[derive(Resource, Clone, Debug, Default)]
pub struct Threads {
    team: Arc<Team>,
    /// What small steps are left to.
    alone: Arc<Team>,
    used: Used,
}

/// Whether the team works on the present step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Used {
    Team,
    #[default]
    Alone,
}

impl Threads {
    /// So many threads; 0 counts as 1.
    pub(crate) fn new(threads: usize) -> Result<Self, TeamError> {
        Ok(Self { team: Arc::new(Team::new(threads)?), ..Self::default() })
    }

    /// Number of threads.
    pub fn count(&self) -> usize {
        self.team.size()
    }

    /// Decides whether a step with so many pairs is shared, and returns who takes it.
    pub(crate) fn choose(&mut self, pairs: usize) -> &Arc<Team> {
        self.used = if pairs >= WORTH_SHARING { Used::Team } else { Used::Alone };
        self.team()
    }

    /// Who works on the present step.
    pub(crate) fn team(&self) -> &Arc<Team> {
        match self.used {
            Used::Team => &self.team,
            Used::Alone => &self.alone,
        }
    }
}
