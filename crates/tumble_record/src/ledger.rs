//! The books of a step as plain data.

use serde::{Deserialize, Serialize};
use tumble_sim::Ledger;
use tumble_solver::Ending;

/// What each part of a step did to the energy, and how well its contacts keep their conditions; see [`tumble_sim::ledger`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LedgerRecord {
    /// Largest speed at which a contact that touches still closes [m/s].
    pub normal_violation: f64,
    /// Largest slip of a point that sticks [m/s].
    pub tangent_violation: f64,
    /// Work of gravity [J].
    pub work_gravity: f64,
    /// Work of springs, without their dampers [J].
    pub work_springs: f64,
    /// Work of drag, dampers of springs, applied forces and the user's forces [J].
    pub work_user: f64,
    /// Work of friction [J].
    pub work_friction: f64,
    /// Work along the normals of contacts [J].
    pub work_impacts: f64,
    /// Work of joints [J].
    pub work_joints: f64,
    /// Potential energy given by displacements that take out overlap [J].
    pub work_position_correction: f64,
    /// What moving with the velocities of the scheme gives besides [J].
    pub integrator_defect: f64,
    /// What no line of the books explains [J].
    pub ledger_error: f64,
    /// Contact points that push and stick.
    pub sticking: u64,
    /// Contact points that push and slide.
    pub sliding: u64,
    /// How the contact solver ended; none where nothing was solved.
    pub solver_end: Option<SolverEnd>,
}

/// How a contact solver ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverEnd {
    /// Its tolerance was met.
    Converged,
    /// The cap on the work came first.
    NotConverged,
}

impl From<&Ledger> for LedgerRecord {
    fn from(ledger: &Ledger) -> Self {
        Self {
            normal_violation: ledger.normal_violation,
            tangent_violation: ledger.tangent_violation,
            work_gravity: ledger.work_gravity,
            work_springs: ledger.work_springs,
            work_user: ledger.work_user,
            work_friction: ledger.work_friction,
            work_impacts: ledger.work_impacts,
            work_joints: ledger.work_joints,
            work_position_correction: ledger.work_position_correction,
            integrator_defect: ledger.integrator_defect,
            ledger_error: ledger.error,
            sticking: ledger.sticking.into(),
            sliding: ledger.sliding.into(),
            solver_end: ledger.solver_end.map(|ending| match ending {
                Ending::Converged => SolverEnd::Converged,
                Ending::NotConverged => SolverEnd::NotConverged,
            }),
        }
    }
}
