//! Block Gauss–Seidel: contact after contact, each solved exactly with its own friction, forwards and backwards in turn.

use tumble_math::{Dim, Matrix, Vector};

use super::problem::Problem;

/// Sweeps until no contact's speed changes by more than `tolerance`; returns the number of sweeps.
pub(super) fn sweep<D: Dim>(problem: &mut Problem<D>, contacts: &[u32], tolerance: f64, most: u32) -> u32 {
    for sweep in 1..=most {
        let mut changed: f64 = 0.0;
        for k in 0..contacts.len() {
            let k = if sweep % 2 == 0 { contacts.len() - 1 - k } else { k };
            let contact = contacts[k] as usize;
            let impulse = problem.solve_alone(contact);
            let change = impulse - problem.impulses[contact];
            problem.impulses[contact] = impulse;
            let own = problem.coupling.own(contact);
            for axis in 0..D::Vector::AXES {
                changed = changed.max(change[axis].abs() * own.column(axis)[axis]);
            }
        }
        if changed <= tolerance || contacts.len() == 1 {
            return sweep;
        }
    }
    most
}
