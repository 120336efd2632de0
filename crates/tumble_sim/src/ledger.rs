//! The books of a step: what each part of it did to the energy, and how well its contacts keep their conditions.
//!
//! Energy is E = K + V, with V of gravity and springs. A step changes it by
//!
//! ```text
//! ΔE = user + friction + impacts + joints + position correction + integrator defect + ledger error
//! ```
//!
//! where the work of gravity and of springs is on the books as well, but only moves energy between K and V. Every impulse λ on a row does the work
//! λ · ½ (u_before + u_after), with u the velocity of the row, exactly; every force f that acts for Δt does f · ½ (v_before + v_after) Δt.
//! The *integrator defect* is the difference between the work that gravity and springs did to the velocities and what the potential lost by the moves: symplectic
//! Euler moves with v₁ and not with ½ (v₀ + v₁). What is left is the ledger error: round-off.

use bevy_ecs::prelude::*;
use tumble_solver::Ending;

/// Work and violations of the last step. Filled where [`Simulation::keep_ledger`](crate::Simulation::keep_ledger) was called.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Largest speed at which a contact that touches still closes after the step [m/s].
    pub normal_violation: f64,
    /// Largest slip of a point that sticks after the step [m/s].
    pub tangent_violation: f64,
    /// Work of gravity [J].
    pub work_gravity: f64,
    /// Work of springs, their dampers included [J].
    pub work_springs: f64,
    /// Work of drag, applied forces and the user's forces [J].
    pub work_user: f64,
    /// Work of friction at contacts [J].
    pub work_friction: f64,
    /// Work along the normals of contacts: impacts, penalty springs [J].
    pub work_impacts: f64,
    /// Work of joints [J].
    pub work_joints: f64,
    /// Potential energy that displacements of the position filter gave [J].
    pub work_position_correction: f64,
    /// What moving with the velocities of the scheme gives besides [J].
    pub integrator_defect: f64,
    /// What no line of the books explains [J].
    pub error: f64,
    /// Contact points that push and stick.
    pub sticking: u32,
    /// Contact points that push and slide.
    pub sliding: u32,
    /// How the contact solver ended; `None` where nothing was solved.
    pub solver_end: Option<Ending>,
}
