//! How fast a contact point really met the surface, read from velocities at the end of a step.

use tumble_math::Linear;
use tumble_solver::ContactRow;
use tumble_solver::impact::Approach;

use super::Detection;
use super::problem::RowSource;
use crate::geometry::Geometry;
use crate::settings::Integrator;

/// How to read the approach speed of a point at the end of a step.
pub(super) struct Reading {
    /// Δt [s].
    pub dt: f64,
    /// How positions follow velocities.
    pub integrator: Integrator,
    /// Points nearer than this touch [m].
    pub touch_tolerance: f64,
}

impl Reading {
    /// Corrects the approach speed of a point for the acceleration that its velocity contains.
    ///
    /// A point whose gap s closed within the step met the surface before the step ended, so its velocity has gained too much.
    /// Its speed at the surface follows from energy, with a_n the acceleration of the gap and v the velocity at the end:
    ///
    /// ```text
    /// w² = v₀² − 2 a_n s        v₀ = v − a_n Δt      ballistic
    ///                           v₀ = v − ½ a_n Δt    symplectic Euler, whose velocities run half a step ahead
    /// ```
    ///
    /// With it, ε = 1 keeps the (discrete) energy exactly. A point that touched before the step, or that the velocity filter held
    /// back in it, approaches by what solver and round-off left, which restitution does not answer.
    pub fn approach<D: Geometry>(
        &self,
        row: &ContactRow<D>,
        approach: f64,
        source: &RowSource,
        detection: &Detection<D>,
    ) -> Approach {
        let touched_before = source.separation_before.is_some_and(|separation| separation <= self.touch_tolerance);
        // A point with a gap that the velocity filter held back in this step rests too: its velocity has lost what forces added.
        if touched_before || source.held_back {
            let ignored = approach.max(0.0);
            return Approach { correction: -ignored, ignored, ..Approach::default() };
        }
        let gained = self.acceleration(row, detection) * self.dt;
        let (ahead, half_step) = match self.integrator {
            Integrator::SymplecticEuler => (0.5 * gained, (-0.5 * gained).max(0.0)),
            Integrator::Ballistic => (gained, 0.0),
        };
        let before = -approach - ahead;
        let at_surface = match source.separation_before {
            Some(gap) => (before * before - 2.0 * gained / self.dt * gap).max(0.0).sqrt(),
            // Nothing is known of the way here: it took the whole step.
            None => (-approach + gained - ahead).abs(),
        };
        Approach {
            correction: at_surface - approach,
            half_step,
            rest_below: (-0.5 * gained).max(0.0),
            ..Approach::default()
        }
    }

    /// Acceleration of the gap by the forces of the step [m/s²].
    fn acceleration<D: Geometry>(&self, row: &ContactRow<D>, detection: &Detection<D>) -> f64 {
        let of = |body: u32, arm: D::Vector| {
            let motion = &detection.motions()[body as usize];
            motion.acceleration + D::spin(motion.angular_acceleration, arm)
        };
        row.normal().dot(of(row.b, row.arm_b) - of(row.a, row.arm_a))
    }
}

/// The reading of a point where the step ends at the impact itself: its speed is what it is.
pub(super) fn at_impact(approach: f64, source: &RowSource, rest_below: f64) -> Approach {
    let ignored = if source.held_back { approach.max(0.0) } else { 0.0 };
    Approach { correction: -ignored, ignored, rest_below, ..Approach::default() }
}
