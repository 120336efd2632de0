//! Revolute joint: keeps two anchors together and lets the bodies turn about them (a pin).
//!
//! ```text
//! C = x_b + r_b − x_a − r_a                                   [m], one row per axis of the world
//! Ċ = v_b + ω_b × r_b − v_a − ω_a × r_a                       [m/s]
//! J̇ v = ω_b × (ω_b × r_b) − ω_a × (ω_a × r_a)                 [m/s²]
//! K = (m_a⁻¹ + m_b⁻¹) 1 + (terms of r_a, r_b)                 as a contact's, in world axes [1/kg]
//! ```
//!
//! In space the same rows make a spherical joint.

use tumble_math::{Dim, Vector};

use super::{JointEnds, JointRow};
use crate::SolverBody;

/// Appends the rows of a revolute joint: one per axis.
pub fn push_rows<D: Dim>(ends: &JointEnds<D>, bodies: &[SolverBody<D>], rows: &mut Vec<JointRow<D>>) {
    rows.extend((0..D::Vector::AXES).map(|axis| ends.along(D::Vector::unit(axis), bodies)));
}
