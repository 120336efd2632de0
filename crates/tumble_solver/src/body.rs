//! A body as a contact model sees it: what it does now, and how it yields.

use tumble_math::{Dim, Inertia, Linear};

/// Velocity and inverse mass of one body, in world axes.
///
/// Sweeps jump from body to body, so each begins with a cache line of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub struct SolverBody<D: Dim> {
    /// Velocity of the centre of mass [m/s].
    pub velocity: D::Vector,
    /// Rate of turn [rad/s].
    pub angular_velocity: D::Angular,
    /// 1 / m per axis; 0 where the body cannot be moved [1/kg].
    pub inverse_mass: D::Vector,
    /// I⁻¹ in world axes; 0 where it cannot be turned [1/(kg·m²)].
    pub inverse_inertia: D::Inertia,
}

impl<D: Dim> SolverBody<D> {
    /// ṗ = v + ω × r: velocity of a point at an arm from the centre of mass (L3) [m/s].
    #[inline]
    pub fn point_velocity(&self, arm: D::Vector) -> D::Vector {
        self.velocity + D::spin(self.angular_velocity, arm)
    }

    /// Applies an impulse at an arm: P += J, L += r × J (L4) [N·s].
    #[inline]
    pub fn apply_impulse(&mut self, arm: D::Vector, impulse: D::Vector) {
        self.velocity += impulse.scale_by(self.inverse_mass);
        self.angular_velocity += self.inverse_inertia.apply(D::torque(arm, impulse));
    }

    /// Velocity that an impulse at an arm gives to the point where it acts [m/s].
    #[inline]
    pub fn yield_at(&self, arm: D::Vector, impulse: D::Vector) -> D::Vector {
        impulse.scale_by(self.inverse_mass) + D::spin(self.inverse_inertia.apply(D::torque(arm, impulse)), arm)
    }
}
