//! What a user should know about a run that went through: counted, with the worst case kept.

use bevy_ecs::prelude::*;
use tumble_solver::resting_lcp::RestingSettings;

use crate::body::BodyTable;
use crate::contact::MOST_PARTS;

/// Things noticed during a run.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Notices {
    moved_too_far: Option<MovedTooFar>,
    unstable_step: Option<f64>,
    not_converged: Option<NotConverged>,
    no_solution: Option<Counted>,
    not_unique: Option<Counted>,
    too_large: Option<Counted>,
    too_many_impacts: Option<Counted>,
}

/// Steps in which something happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counted {
    /// How many.
    pub steps: u64,
    /// The first, counted from 1.
    pub first_step: u64,
    last_step: u64,
}

impl Counted {
    /// Counts a step, once: one that is cut at impacts is prepared several times.
    fn count(counted: &mut Option<Self>, step: u64) {
        let counted = counted.get_or_insert(Self { steps: 0, first_step: step, last_step: 0 });
        if counted.last_step != step {
            counted.steps += 1;
            counted.last_step = step;
        }
    }
}

/// Bodies that moved further within a step than contacts are made beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovedTooFar {
    /// How many body-steps.
    pub count: u64,
    /// Rank of the body that moved farthest.
    pub body: u32,
    /// How far it may have moved [m].
    pub distance: f64,
    /// In which step, counted from 1.
    pub step: u64,
}

/// Steps whose contact solver ended before its tolerance was met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// How many steps.
    pub steps: u64,
    /// Largest speed error that was left [m/s].
    pub worst_residual: f64,
    /// In which step, counted from 1.
    pub worst_step: u64,
}

impl Notices {
    pub(crate) fn moved_too_far(&mut self, body: u32, distance: f64, steps_done: u64) {
        let worst = self.moved_too_far.get_or_insert(MovedTooFar { count: 0, body, distance, step: steps_done + 1 });
        worst.count += 1;
        if distance > worst.distance {
            (worst.body, worst.distance, worst.step) = (body, distance, steps_done + 1);
        }
    }

    pub(crate) fn unstable_step(&mut self, stable_dt: f64) {
        self.unstable_step = Some(self.unstable_step.map_or(stable_dt, |known| known.min(stable_dt)));
    }

    pub(crate) fn not_converged(&mut self, residual: f64, step: u64) {
        let worst =
            self.not_converged.get_or_insert(NotConverged { steps: 0, worst_residual: residual, worst_step: step });
        worst.steps += 1;
        if residual > worst.worst_residual {
            (worst.worst_residual, worst.worst_step) = (residual, step);
        }
    }

    pub(crate) fn no_solution(&mut self, step: u64) {
        Counted::count(&mut self.no_solution, step);
    }

    pub(crate) fn not_unique(&mut self, step: u64) {
        Counted::count(&mut self.not_unique, step);
    }

    pub(crate) fn too_many_impacts(&mut self, step: u64) {
        Counted::count(&mut self.too_many_impacts, step);
    }

    /// Steps in which impacts followed each other too closely to cut the step at each.
    pub fn steps_with_too_many_impacts(&self) -> Option<Counted> {
        self.too_many_impacts
    }

    pub(crate) fn too_large(&mut self, step: u64) {
        Counted::count(&mut self.too_large, step);
    }

    /// Steps in which contacts that hang together were too many for the resting model, so that impulses resolved them.
    pub fn steps_too_large(&self) -> Option<Counted> {
        self.too_large
    }

    /// Steps in which no resting forces satisfied all conditions (Painlevé), so that impulses resolved the contacts.
    pub fn steps_without_solution(&self) -> Option<Counted> {
        self.no_solution
    }

    /// Steps in which more than one set of accelerations satisfied all conditions.
    pub fn ambiguous_steps(&self) -> Option<Counted> {
        self.not_unique
    }

    /// Bodies that moved further within a step than contacts are made beforehand.
    pub fn fast_bodies(&self) -> Option<MovedTooFar> {
        self.moved_too_far
    }

    /// The largest stable Δt of the stiffest penalty contact, when the Δt in use is larger [s].
    pub fn stable_dt(&self) -> Option<f64> {
        self.unstable_step
    }

    /// Steps whose contact solver ended before its tolerance was met.
    pub fn unconverged_steps(&self) -> Option<NotConverged> {
        self.not_converged
    }

    /// One sentence per notice.
    pub fn sentences(&self, table: &BodyTable, dt: f64) -> Vec<String> {
        let mut sentences = Vec::new();
        if let Some(stable) = self.unstable_step {
            sentences.push(format!(
                "dt {dt} s is beyond the stability bound of the penalty contacts: choose dt below {stable:.3e} s, or a smaller stiffness"
            ));
        }
        if let Some(fast) = self.moved_too_far {
            sentences.push(format!(
                "body \"{}\" may have moved {:.3} m in step {} ({} such body-steps): further than contacts are made beforehand, so it may have passed through something; choose a smaller dt or a larger speculative_limit",
                table.entry(fast.body).name, fast.distance, fast.step, fast.count
            ));
        }
        if let Some(Counted { steps, first_step, .. }) = self.no_solution {
            sentences.push(format!(
                "no contact forces satisfy all conditions in {steps} steps, first in step {first_step} (a Painlevé configuration): impulses resolved them"
            ));
        }
        if let Some(Counted { steps, first_step, .. }) = self.not_unique {
            sentences.push(format!(
                "more than one outcome satisfies all contact conditions in {steps} steps, first in step {first_step}: the smallest forces were taken"
            ));
        }
        if let Some(Counted { steps, first_step, .. }) = self.too_large {
            let most = RestingSettings::default().largest_island;
            sentences.push(format!(
                "more than {most} contacts hang together in {steps} steps, first in step {first_step}: too many for resting forces, so impulses resolved them"
            ));
        }
        if let Some(Counted { steps, first_step, .. }) = self.too_many_impacts {
            sentences.push(format!(
                "{steps} steps had more than {MOST_PARTS} impacts, first step {first_step}: the rest were answered at the end of the step"
            ));
        }
        if let Some(worst) = self.not_converged {
            sentences.push(format!(
                "contacts were not solved to the tolerance in {} steps; the largest speed error left was {:.3e} m/s, in step {}",
                worst.steps, worst.worst_residual, worst.worst_step
            ));
        }
        sentences
    }
}
