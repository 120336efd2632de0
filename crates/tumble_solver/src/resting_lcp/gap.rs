//! How a gap accelerates without contact forces: every term of b.
//!
//! The gap of a point is measured between two *features*: a corner or a point of a side itself, or the centre of a round. With p_a, p_b
//! the features, ρ n = p_b − p_a (ρ the sum of radii, plus the gap),
//!
//! ```text
//! d = n · (p_b − p_a) − radii
//! ḋ = n · (ṗ_b − ṗ_a)                                    since n · ṅ = 0
//! d̈ = n · (p̈_b − p̈_a) + 2 ṅ · (ṗ_b − ṗ_a) − ρ |ṅ|²       since ṅ · (p_b − p_a) = 0,  n · n̈ = −|ṅ|²
//! p̈ = a + α × f + ω × (ω × f)                            f: centre of mass → feature
//! ```
//!
//! ṅ = ω × n of the body that carries the normal (its side lies against the other's corner or round), or ṅ = (ṗ_b − ṗ_a)_t / ρ where the
//! normal is the line between two centres (Baraff and Witkin, part D, with the curvature of rounds added).
//!
//! The slip of a point at rest changes by the acceleration of the two material points there, whose arms r = f + o n follow the normal:
//!
//! ```text
//! d/dt (v + ω × r) = a + α × r + ω × (ω × f + o ṅ)
//! ```
//!
//! so a disc that rolls on a straight floor has none of it from turning.

use tumble_math::{Dim, Linear, Matrix};

use crate::contact::tangential;
use crate::{ContactRow, SolverBody};

/// What turns the normal of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalCarrier {
    /// A side of body a.
    #[default]
    A,
    /// A side of body b.
    B,
    /// The line between the two features: two rounds, or a corner and a round.
    Line,
}

/// What the gap of a contact is measured between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap<D: Dim> {
    /// Centre of mass of a → its feature, world axes [m].
    pub feature_a: D::Vector,
    /// Centre of mass of b → its feature, world axes [m].
    pub feature_b: D::Vector,
    /// What turns the normal.
    pub carrier: NormalCarrier,
}

impl<D: Dim> Gap<D> {
    /// A corner against a side: the features are the contact point itself.
    pub fn corner(row: &ContactRow<D>, carrier: NormalCarrier) -> Self {
        Self { feature_a: row.arm_a, feature_b: row.arm_b, carrier }
    }

    /// What velocities add to the acceleration of the gap and of the slip, in the contact frame [m/s²].
    pub fn drift(&self, row: &ContactRow<D>, bodies: &[SolverBody<D>]) -> D::Vector {
        let (a, b) = (&bodies[row.a as usize], &bodies[row.b as usize]);
        let normal = row.normal();
        let (offset_a, offset_b) = (row.arm_a - self.feature_a, row.arm_b - self.feature_b);
        let distance = normal.dot(offset_a - offset_b) + row.separation;
        let velocity = b.point_velocity(self.feature_b) - a.point_velocity(self.feature_a);
        let normal_rate = match self.carrier {
            NormalCarrier::A => D::spin(a.angular_velocity, normal),
            NormalCarrier::B => D::spin(b.angular_velocity, normal),
            NormalCarrier::Line if distance > 0.0 => (velocity - normal * normal.dot(velocity)) * (1.0 / distance),
            NormalCarrier::Line => D::Vector::ZERO,
        };
        let turning = |body: &SolverBody<D>, rate: D::Vector| D::spin(body.angular_velocity, rate);
        let feature_rate = |body: &SolverBody<D>, feature| D::spin(body.angular_velocity, feature);
        let (rate_a, rate_b) = (feature_rate(a, self.feature_a), feature_rate(b, self.feature_b));

        let features = turning(b, rate_b) - turning(a, rate_a);
        let opening = normal.dot(features) + 2.0 * normal_rate.dot(velocity) - distance * normal_rate.dot(normal_rate);
        let material = turning(b, rate_b + normal_rate * normal.dot(offset_b))
            - turning(a, rate_a + normal_rate * normal.dot(offset_a));
        let mut drift = tangential(row.frame.apply_transposed(material));
        drift[0] = opening;
        drift
    }
}
