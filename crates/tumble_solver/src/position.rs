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

use tumble_math::{Dim, Inertia, Linear};

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

/// Sweeps after which points are looked for that have come in the way of those that take part [1].
///
/// A look goes over all rows, most of which never take part, and costs as much as a few sweeps.
const SWEEPS_BETWEEN_LOOKS: u32 = 10;

/// Displacements to be added to this step's motion: one per body, as velocities of a step of one second.
#[derive(Clone, Debug)]
pub struct Displacements<D: Dim> {
    /// One record per body; `velocity` holds the displacement [m] and `angular_velocity` the turn [rad].
    pub bodies: Vec<SolverBody<D>>,
    /// What J Δx has to reach at least, for each row [m].
    targets: Vec<f64>,
    /// λ of each row [kg·m].
    sums: Vec<f64>,
    /// The rows that take part, in order.
    pushes: Vec<Push<D>>,
    /// Whether a row takes part.
    takes_part: Vec<bool>,
    /// No point is farther from the centre of its body [m].
    longest_arm: f64,
}

/// What a sweep needs of a row, and no more.
#[derive(Clone, Copy, Debug)]
struct Push<D: Dim> {
    row: u32,
    a: u32,
    b: u32,
    normal: D::Vector,
    /// r × n: turn of each body that opens the gap.
    turns: [D::Angular; 2],
    target: f64,
    sum: f64,
    /// 1 / (n · K n) [kg].
    mass: f64,
}

impl<D: Dim> Default for Displacements<D> {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            targets: Vec::new(),
            sums: Vec::new(),
            pushes: Vec::new(),
            takes_part: Vec::new(),
            longest_arm: 0.0,
        }
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
        self.targets.extend(
            rows.iter()
                .map(|row| allowed(row.separation, settings) - row.separation - dt * row.separating_speed(bodies)),
        );
        if self.targets.iter().all(|target| *target <= 0.0) {
            return false;
        }

        let arms = rows.iter().flat_map(|row| [row.arm_a.dot(row.arm_a), row.arm_b.dot(row.arm_b)]);
        self.longest_arm = arms.fold(0.0, f64::max).sqrt();
        self.begin(bodies);
        self.sums.resize(rows.len(), 0.0);
        self.takes_part.clear();
        self.takes_part.resize(rows.len(), false);
        self.pushes.clear();
        let mut sweeps_left = settings.iterations;
        // Most points are nowhere near being displaced: only those take part that go too far, once they do.
        while self.admit(rows) | self.sweep(&mut sweeps_left, settings.tolerance) && sweeps_left > 0 {}
        for push in &self.pushes {
            self.sums[push.row as usize] = push.sum;
        }
        true
    }

    /// Displaces nothing, for bodies with these masses.
    pub fn begin(&mut self, bodies: &[SolverBody<D>]) {
        let still = |body: &SolverBody<D>| SolverBody {
            velocity: D::Vector::ZERO,
            angular_velocity: D::Angular::ZERO,
            ..*body
        };
        self.bodies.clear();
        self.bodies.extend(bodies.iter().map(still));
    }

    /// Lets rows take part that go too far as things are; returns whether there were any.
    fn admit(&mut self, rows: &[ContactRow<D>]) -> bool {
        let known = self.pushes.len();
        let farthest = self.farthest();
        for (i, row) in rows.iter().enumerate() {
            if self.targets[i] >= -farthest
                && !self.takes_part[i]
                && self.targets[i] > row.separating_speed(&self.bodies)
            {
                let compliance = row.normal_compliance(&self.bodies);
                // A gap between two bodies that cannot move stays as it is.
                if compliance > 0.0 {
                    self.takes_part[i] = true;
                    self.pushes.push(Push::of(i as u32, row, self.targets[i], compliance));
                }
            }
        }
        let grew = self.pushes.len() > known;
        if grew && known > 0 {
            // Two sorted runs: a merge.
            self.pushes.sort_by_key(|push| push.row);
        }
        grew
    }

    /// No gap closes by more than this through the displacements so far [m].
    fn farthest(&self) -> f64 {
        let moved = |body: &SolverBody<D>| body.velocity.length() + body.angular_velocity.length() * self.longest_arm;
        // Both bodies of a pair, and the rounding of all this.
        2.0 * (1.0 + 1e-9) * self.bodies.iter().map(moved).fold(0.0, f64::max)
    }

    /// Sweeps a few times over the rows that take part; returns whether they still move.
    fn sweep(&mut self, sweeps_left: &mut u32, tolerance: f64) -> bool {
        for _ in 0..SWEEPS_BETWEEN_LOOKS.min(*sweeps_left) {
            *sweeps_left -= 1;
            let backwards = *sweeps_left % 2 == 1;
            let mut moved: f64 = 0.0;
            for k in 0..self.pushes.len() {
                let k = if backwards { self.pushes.len() - 1 - k } else { k };
                moved = moved.max(self.pushes[k].apart(&mut self.bodies));
            }
            if moved <= tolerance {
                return false;
            }
        }
        true
    }

    /// Whether point i was held in the last call of [`find`](Self::find): without its push it would have gone too far.
    pub fn holds(&self, i: usize) -> bool {
        self.sums.get(i).is_some_and(|sum| *sum > 0.0)
    }
}

impl<D: Dim> Push<D> {
    fn of(index: u32, row: &ContactRow<D>, target: f64, compliance: f64) -> Self {
        let normal = row.normal();
        let turns = [D::torque(row.arm_a, normal), D::torque(row.arm_b, normal)];
        Self { row: index, a: row.a, b: row.b, normal, turns, target, sum: 0.0, mass: 1.0 / compliance }
    }

    /// Solves one point with all others as they are; returns how far it moved [m].
    #[inline]
    fn apart(&mut self, bodies: &mut [SolverBody<D>]) -> f64 {
        let (a, b) = (&bodies[self.a as usize], &bodies[self.b as usize]);
        let shifted = self.normal.dot(b.velocity - a.velocity);
        let turned = self.turns[1].dot(b.angular_velocity) - self.turns[0].dot(a.angular_velocity);
        let sum = (self.sum + (self.target - shifted - turned) * self.mass).max(0.0);
        let change = sum - self.sum;
        if change == 0.0 {
            return 0.0;
        }
        self.sum = sum;
        let push = self.normal * change;
        let b = &mut bodies[self.b as usize];
        b.velocity += push.scale_by(b.inverse_mass);
        b.angular_velocity += b.inverse_inertia.apply(self.turns[1] * change);
        let a = &mut bodies[self.a as usize];
        a.velocity -= push.scale_by(a.inverse_mass);
        a.angular_velocity -= a.inverse_inertia.apply(self.turns[0] * change);
        change.abs() / self.mass
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
