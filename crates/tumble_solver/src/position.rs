//! Position filter: no gap closes beyond touch within a step, and overlaps beyond the slop are pushed apart (R7).
//!
//! Idea: with the velocities as they are, point i would end the step with separation s_i + Δt v_n,i. Where that is less than allowed, a
//! displacement Δx along the contact normals makes up for it:
//!
//! ```text
//! 0 ≤ λ_i ⟂ s_i + Δt v_n,i + J_i Δx − t_i ≥ 0,   Δx = M⁻¹ Jᵀ λ          λ [kg·m]
//! t_i = 0                          for a gap (s_i > 0): it may close, no more
//! t_i = −slop                      for a touching point within the slop
//! t_i = s_i + β (−slop − s_i)      for a deeper overlap: part of it goes in each step
//! ```
//!
//! Velocities are untouched, so no energy enters them: a body that arrives within the step is set down exactly on the surface with its
//! approach speed intact, and the impact that follows answers that speed. This is also what keeps thin rods from passing through each
//! other: contacts are made before surfaces meet (the speculative margin), for any gap that could close within the step.

use tumble_math::{Dim, Linear};

use crate::{ContactRow, SolverBody};

/// How positions are kept apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionSettings {
    /// Most sweeps over all points [1].
    pub iterations: u32,
    /// A sweep that moves no point by more than this is the last [m].
    pub tolerance: f64,
    /// Overlap that is left alone [m].
    pub slop: f64,
    /// Part of a deeper overlap that is taken out per step [1].
    pub recovery: f64,
}

/// Gaps up to this many times the largest displacement that is asked for take part from the start [1].
const REACH: f64 = 4.0;

/// Displacements to be added to this step's motion: one per body, as velocities of a step of one second.
#[derive(Clone, Debug)]
pub struct Displacements<D: Dim> {
    /// One record per body; `velocity` holds the displacement [m] and `angular_velocity` the turn [rad].
    pub bodies: Vec<SolverBody<D>>,
    targets: Vec<f64>,
    sums: Vec<f64>,
    /// Rows that displacements may reach, in order.
    active: Vec<u32>,
    /// K_nn of each row, 0 while it has not been asked for.
    compliances: Vec<f64>,
}

impl<D: Dim> Default for Displacements<D> {
    fn default() -> Self {
        Self { bodies: Vec::new(), targets: Vec::new(), sums: Vec::new(), active: Vec::new(), compliances: Vec::new() }
    }
}

impl<D: Dim> Displacements<D> {
    /// Finds the displacements for a step of `dt`; `bodies` carry the velocities with which they are going to move.
    ///
    /// Leaves `self.bodies` empty when nothing needs to be displaced, and returns whether something does.
    pub fn find(
        &mut self,
        bodies: &[SolverBody<D>],
        rows: &[ContactRow<D>],
        dt: f64,
        settings: &PositionSettings,
    ) -> bool {
        self.bodies.clear();
        self.sums.clear();
        self.targets.clear();
        // What J Δx has to reach at least, for each point.
        self.targets.extend(
            rows.iter()
                .map(|row| allowed(row.separation, settings) - row.separation - dt * row.separating_speed(bodies)),
        );
        let worst = self.targets.iter().copied().fold(0.0, f64::max);
        if worst == 0.0 {
            return false;
        }

        self.bodies.extend_from_slice(bodies);
        for body in &mut self.bodies {
            body.velocity = D::Vector::ZERO;
            body.angular_velocity = D::Angular::ZERO;
        }
        self.sums.resize(rows.len(), 0.0);
        self.compliances.clear();
        self.compliances.resize(rows.len(), 0.0);
        // Most gaps are wider than any displacement: they are left out until one of them turns out to be in the way.
        let reach = REACH * worst;
        self.active.clear();
        self.active.extend((0..rows.len() as u32).filter(|i| self.targets[*i as usize] > -reach));
        let mut sweeps_left = settings.iterations;
        self.sweep(rows, &mut sweeps_left, settings.tolerance);
        if self.active.len() < rows.len() && self.any_in_the_way(rows) {
            self.active.clear();
            self.active.extend(0..rows.len() as u32);
            self.sweep(rows, &mut sweeps_left, settings.tolerance);
        }
        true
    }

    /// Sweeps over the active rows until they are still.
    fn sweep(&mut self, rows: &[ContactRow<D>], sweeps_left: &mut u32, tolerance: f64) {
        let active = std::mem::take(&mut self.active);
        while *sweeps_left > 0 {
            *sweeps_left -= 1;
            let mut moved: f64 = 0.0;
            for k in 0..active.len() {
                let k = if *sweeps_left % 2 == 1 { active.len() - 1 - k } else { k };
                let i = active[k] as usize;
                moved = moved.max(self.push_apart(&rows[i], i));
            }
            if moved <= tolerance {
                break;
            }
        }
        self.active = active;
    }

    /// Whether some row goes too far as things are.
    fn any_in_the_way(&self, rows: &[ContactRow<D>]) -> bool {
        rows.iter().zip(&self.targets).any(|(row, target)| *target > row.separating_speed(&self.bodies))
    }

    /// Whether point i was held in the last call of [`find`](Self::find): without its push it would have gone too far.
    pub fn holds(&self, i: usize) -> bool {
        self.sums.get(i).is_some_and(|sum| *sum > 0.0)
    }

    /// Solves one point with all others as they are; returns how far it moved [m].
    #[inline]
    fn push_apart(&mut self, row: &ContactRow<D>, i: usize) -> f64 {
        let missing = self.targets[i] - row.separating_speed(&self.bodies);
        if missing <= 0.0 && self.sums[i] == 0.0 {
            return 0.0;
        }
        if self.compliances[i] == 0.0 {
            self.compliances[i] = row.normal_compliance(&self.bodies);
        }
        let compliance = self.compliances[i];
        if compliance <= 0.0 {
            return 0.0;
        }
        let sum = (self.sums[i] + missing / compliance).max(0.0);
        let change = sum - self.sums[i];
        self.sums[i] = sum;
        let push = row.normal() * change;
        self.bodies[row.b as usize].apply_impulse(row.arm_b, push);
        self.bodies[row.a as usize].apply_impulse(row.arm_a, -push);
        change.abs() * compliance
    }
}

/// The smallest separation that a point may end the step with [m].
fn allowed(separation: f64, settings: &PositionSettings) -> f64 {
    if separation > 0.0 {
        0.0
    } else if separation >= -settings.slop {
        -settings.slop
    } else {
        separation + settings.recovery * (-settings.slop - separation)
    }
}
