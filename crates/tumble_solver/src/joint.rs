//! Joints as rows: each keeps one number at zero, with an impulse of either sign.
//!
//! A joint is one to three rows in the plane, one to six in space. One row is
//!
//! ```text
//! C = 0                                                            [m] or [rad]
//! Ċ = J v = l · (v_b − v_a) + γ_b · ω_b − γ_a · ω_a                [m/s] or [rad/s]
//! C̈ = J v̇ + J̇ v
//! K = J M⁻¹ Jᵀ = l · (m_a⁻¹ + m_b⁻¹) l + γ_a · I_a⁻¹ γ_a + γ_b · I_b⁻¹ γ_b
//! ```
//!
//! An impulse λ in the row is +l λ, +γ_b λ on b and −l λ, −γ_a λ on a. The kinds differ only in how they make their rows: [`revolute`] and
//! [`distance`] in both dimensions, [`fixed`] and [`prismatic`] in the plane, and their siblings of space in [`spatial`]. The world is a
//! body that cannot be moved, with an index like any other.
//!
//! [`JointBlock`] solves all rows of a scene at once and exactly.

mod block;
pub mod distance;
pub mod fixed;
pub mod prismatic;
pub mod revolute;
pub mod spatial;

pub use block::{JointBlock, JointReport};

use tumble_math::{Dim, Inertia, Linear};

use crate::SolverBody;

/// One scalar equality between two bodies, everything in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRow<D: Dim> {
    /// Index of the first body.
    pub a: u32,
    /// Index of the second body.
    pub b: u32,
    /// l: direction in which the row pushes b; 0 for a row that only turns [1].
    pub linear: D::Vector,
    /// γ_a: angular impulse that the row takes from a, per impulse [m] or [1].
    pub angular_a: D::Angular,
    /// γ_b: angular impulse that the row gives to b, per impulse [m] or [1].
    pub angular_b: D::Angular,
    /// C, what the row wants to be zero [m] or [rad].
    pub error: f64,
    /// J̇ v, the part of C̈ that velocities make [m/s²] or [rad/s²].
    pub drift: f64,
    /// Sum of impulses so far, of either sign [N·s] or [N·m·s].
    pub impulse: f64,
}

impl<D: Dim> JointRow<D> {
    /// Ċ = J v [m/s] or [rad/s].
    #[inline]
    pub fn speed(&self, bodies: &[SolverBody<D>]) -> f64 {
        let (a, b) = (&bodies[self.a as usize], &bodies[self.b as usize]);
        self.linear.dot(b.velocity - a.velocity) + self.angular_b.dot(b.angular_velocity)
            - self.angular_a.dot(a.angular_velocity)
    }

    /// Applies an impulse of the row to its bodies; does not count it in [`JointRow::impulse`] [N·s] or [N·m·s].
    #[inline]
    pub fn apply(&self, bodies: &mut [SolverBody<D>], impulse: f64) {
        let b = &mut bodies[self.b as usize];
        b.velocity += (self.linear * impulse).scale_by(b.inverse_mass);
        b.angular_velocity += b.inverse_inertia.apply(self.angular_b * impulse);
        let a = &mut bodies[self.a as usize];
        a.velocity += (self.linear * -impulse).scale_by(a.inverse_mass);
        a.angular_velocity += a.inverse_inertia.apply(self.angular_a * -impulse);
    }

    /// K = J M⁻¹ Jᵀ: speed of the row per impulse [1/kg] and alike.
    pub fn compliance(&self, bodies: &[SolverBody<D>]) -> f64 {
        self.coupling(self, bodies)
    }

    /// J_i M⁻¹ J_jᵀ: speed of this row per impulse of another, through the bodies that they share [1/kg] and alike.
    fn coupling(&self, other: &Self, bodies: &[SolverBody<D>]) -> f64 {
        let end =
            |row: &Self, at_b: bool| if at_b { (row.linear, row.angular_b) } else { (-row.linear, -row.angular_a) };
        let mut sum = 0.0;
        for (own, own_at_b) in [(self.a, false), (self.b, true)] {
            for (its, its_at_b) in [(other.a, false), (other.b, true)] {
                if own == its {
                    let body = &bodies[own as usize];
                    let ((l, g), (m, h)) = (end(self, own_at_b), end(other, its_at_b));
                    sum += l.dot(m.scale_by(body.inverse_mass)) + g.dot(body.inverse_inertia.apply(h));
                }
            }
        }
        sum
    }
}

/// The joints of a scene, as contact models take them along.
#[derive(Debug)]
pub struct Joints<'a, D: Dim> {
    /// The block, prepared for the same bodies and rows.
    pub block: &'a mut JointBlock<D>,
    /// All rows.
    pub rows: &'a mut [JointRow<D>],
}

/// Where a joint holds its two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointEnds<D: Dim> {
    /// Index of the first body.
    pub a: u32,
    /// Index of the second body.
    pub b: u32,
    /// Centre of mass of a → its anchor, world axes [m].
    pub arm_a: D::Vector,
    /// Centre of mass of b → its anchor, world axes [m].
    pub arm_b: D::Vector,
    /// Anchor of a → anchor of b [m].
    pub gap: D::Vector,
}

impl<D: Dim> JointEnds<D> {
    /// The ends of a joint between anchors given by their arms, for bodies whose centres of mass are at these points [m].
    pub fn at(a: (u32, D::Vector, D::Vector), b: (u32, D::Vector, D::Vector)) -> Self {
        let ((a, centre_a, arm_a), (b, centre_b, arm_b)) = (a, b);
        Self { a, b, arm_a, arm_b, gap: centre_b + arm_b - centre_a - arm_a }
    }

    /// Velocity of b's anchor relative to a's [m/s].
    fn velocity(&self, bodies: &[SolverBody<D>]) -> D::Vector {
        bodies[self.b as usize].point_velocity(self.arm_b) - bodies[self.a as usize].point_velocity(self.arm_a)
    }

    /// What turning alone adds to the acceleration of b's anchor relative to a's: ω × (ω × r) of b, less that of a [m/s²].
    fn centripetal(&self, bodies: &[SolverBody<D>]) -> D::Vector {
        let of = |body: u32, arm| {
            let turning = bodies[body as usize].angular_velocity;
            D::spin(turning, D::spin(turning, arm))
        };
        of(self.b, self.arm_b) - of(self.a, self.arm_a)
    }

    /// The row that keeps the anchors together along a direction at rest.
    fn along(&self, direction: D::Vector, bodies: &[SolverBody<D>]) -> JointRow<D> {
        JointRow {
            a: self.a,
            b: self.b,
            linear: direction,
            angular_a: D::torque(self.arm_a, direction),
            angular_b: D::torque(self.arm_b, direction),
            error: direction.dot(self.gap),
            drift: direction.dot(self.centripetal(bodies)),
            impulse: 0.0,
        }
    }
}

/// Why a joint has no rows.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum JointError {
    /// The anchors of a distance joint coincide, so that it has no direction to push in.
    #[error("the anchors on bodies {a} and {b} coincide, so that the distance between them has no direction")]
    NoDirection {
        /// Index of the first body.
        a: u32,
        /// Index of the second body.
        b: u32,
    },
    /// A length or an axis of the joint cannot be used.
    #[error("the joint between bodies {a} and {b} has a {quantity} that is not finite and positive")]
    BadParameter {
        /// Index of the first body.
        a: u32,
        /// Index of the second body.
        b: u32,
        /// The parameter.
        quantity: &'static str,
    },
}
