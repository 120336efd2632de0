//! Rotational inertia: a number in the plane, a symmetric tensor in space.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::{Angular, PlanarRotation, Rotation, SpatialRotation, trig};

/// Inertia about the centre of mass, or its inverse, as a linear map between rates of turn and angular momenta.
pub trait Inertia<W: Angular, R>: Copy + std::fmt::Debug + Default + PartialEq + Send + Sync + 'static {
    /// The map that sends everything to zero: inverse inertia of a body that cannot turn.
    const ZERO: Self;

    /// The image of a rate of turn (or of an angular momentum, for an inverse).
    fn apply(&self, angular: W) -> W;

    /// The inverse map; `None` unless positive definite and finite.
    fn try_inverse(&self) -> Option<Self>;

    /// The same map seen from world axes: R I Rᵀ (L13).
    fn in_world(&self, rotation: &R) -> Self;

    /// The map scaled by a factor.
    fn scaled(&self, factor: f64) -> Self;

    /// Whether it looks the same after any rotation, to the last bit.
    fn is_spherical(&self) -> bool;
}

impl Inertia<f64, PlanarRotation> for f64 {
    const ZERO: Self = 0.0;

    #[inline]
    fn apply(&self, angular: f64) -> f64 {
        self * angular
    }

    fn try_inverse(&self) -> Option<Self> {
        (self.is_finite() && *self > 0.0).then(|| 1.0 / self)
    }

    #[inline]
    fn in_world(&self, _rotation: &PlanarRotation) -> Self {
        *self
    }

    #[inline]
    fn scaled(&self, factor: f64) -> Self {
        self * factor
    }

    #[inline]
    fn is_spherical(&self) -> bool {
        true
    }
}

/// A symmetric 3 × 3 tensor: inertia in body or world axes [kg·m²], or its inverse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SymmetricTensor {
    /// Entries (1,1), (2,2), (3,3).
    pub diagonal: DVec3,
    /// Entries (2,3), (1,3), (1,2): off-diagonal entries, minus the products of inertia.
    pub off_diagonal: DVec3,
}

impl SymmetricTensor {
    /// A tensor whose principal axes are the coordinate axes.
    pub const fn from_diagonal(diagonal: DVec3) -> Self {
        Self { diagonal, off_diagonal: DVec3::ZERO }
    }

    /// The symmetric part of a matrix.
    pub fn from_matrix(m: DMat3) -> Self {
        Self {
            diagonal: DVec3::new(m.x_axis.x, m.y_axis.y, m.z_axis.z),
            off_diagonal: 0.5 * DVec3::new(m.y_axis.z + m.z_axis.y, m.x_axis.z + m.z_axis.x, m.x_axis.y + m.y_axis.x),
        }
    }

    /// The full matrix.
    pub fn to_matrix(self) -> DMat3 {
        let (d, o) = (self.diagonal, self.off_diagonal);
        DMat3::from_cols(DVec3::new(d.x, o.z, o.y), DVec3::new(o.z, d.y, o.x), DVec3::new(o.y, o.x, d.z))
    }
}

impl Inertia<DVec3, SpatialRotation> for SymmetricTensor {
    const ZERO: Self = Self { diagonal: DVec3::ZERO, off_diagonal: DVec3::ZERO };

    #[inline]
    fn apply(&self, w: DVec3) -> DVec3 {
        let (d, o) = (self.diagonal, self.off_diagonal);
        DVec3::new(
            d.x * w.x + o.z * w.y + o.y * w.z,
            o.z * w.x + d.y * w.y + o.x * w.z,
            o.y * w.x + o.x * w.y + d.z * w.z,
        )
    }

    fn try_inverse(&self) -> Option<Self> {
        // Sylvester's criterion: all leading minors positive.
        let (d, o) = (self.diagonal, self.off_diagonal);
        let matrix = self.to_matrix();
        let determinant = matrix.determinant();
        let definite = d.x > 0.0 && d.x * d.y - o.z * o.z > 0.0 && determinant > 0.0 && determinant.is_finite();
        definite.then(|| Self::from_matrix(matrix.inverse()))
    }

    fn in_world(&self, rotation: &SpatialRotation) -> Self {
        if self.is_spherical() {
            return *self;
        }
        let r = rotation.to_matrix();
        Self::from_matrix(r * self.to_matrix() * r.transpose())
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { diagonal: self.diagonal * factor, off_diagonal: self.off_diagonal * factor }
    }

    #[inline]
    fn is_spherical(&self) -> bool {
        let d = self.diagonal;
        d.x == d.y && d.y == d.z && self.off_diagonal == DVec3::ZERO
    }
}

/// Advances a rotation by one step under constant angular momentum, and returns it with the rate of turn at its end.
///
/// ```text
/// R⁺ = exp(Δt ω½) R,   ω⁺ = I⁻¹(R⁺) L                    ω½ the [midpoint rate](midpoint_rate)
/// ```
///
/// The implicit midpoint rule: second order, symmetric in time (so that the energy of free rotation does not drift), and L is kept to
/// round-off because ω⁺ is computed from it. `inertia` and `inverse` are in the body frame.
pub(crate) fn turn_freely(
    rotation: SpatialRotation,
    inertia: &SymmetricTensor,
    inverse: &SymmetricTensor,
    angular_velocity: DVec3,
    dt: f64,
) -> (SpatialRotation, DVec3) {
    if inertia.is_spherical() {
        return (rotation.turned(angular_velocity * dt), angular_velocity);
    }
    let axes = rotation.to_matrix();
    let momentum = inertia.apply(axes.transpose() * angular_velocity);
    let rate = midpoint_rate_in_body(momentum, inverse, axes.transpose() * angular_velocity, dt);
    let turned = rotation.turned(axes * rate * dt);
    let axes_then = turned.to_matrix();
    (turned, axes_then * inverse.apply(axes_then.transpose() * (axes * momentum)))
}

/// The constant rate of turn that takes a rotation through one step under constant angular momentum, by the implicit midpoint rule.
///
/// ```text
/// ω½ = I⁻¹(R½) L,   R½ = exp(½Δt ω½) R,   L = I(R) ω
/// ```
///
/// Inertia tensors that are given in world axes go with the rotation of identity.
pub(crate) fn midpoint_rate(
    rotation: SpatialRotation,
    inertia: &SymmetricTensor,
    inverse: &SymmetricTensor,
    angular_velocity: DVec3,
    dt: f64,
) -> DVec3 {
    if inertia.is_spherical() {
        return angular_velocity;
    }
    let axes = rotation.to_matrix();
    let rate = axes.transpose() * angular_velocity;
    axes * midpoint_rate_in_body(inertia.apply(rate), inverse, rate, dt)
}

/// The midpoint rate in the body frame: turning about itself leaves it as it is, so that there it solves
///
/// ```text
/// u = I⁻¹ exp(φ) L,   φ = −½Δt u        by Newton's method, with d(exp(φ) L) = ½Δt (exp(φ) L) × J(φ) du
/// ```
///
/// and J(φ) = 1 + B φ× + C φ×φ× the left Jacobian of the rotation vector (Solà et al. 2018, eq. 145).
fn midpoint_rate_in_body(momentum: DVec3, inverse: &SymmetricTensor, first_guess: DVec3, dt: f64) -> DVec3 {
    /// The error of a Newton step is about the square of its length: after one as short as this it is below round-off.
    const SHORT: f64 = 1e-9;
    let half_step = 0.5 * dt;
    let mut rate = first_guess;
    // The bound only matters for steps that turn by more than two radians.
    for _ in 0..50 {
        let angle = rate * -half_step;
        let squared = angle.dot(angle);
        let (a, b) = trig::sinc_and_versinc(squared);
        let c = if squared < 1e-4 { 1.0 / 6.0 } else { (1.0 - a) / squared };
        let across = angle.cross(momentum);
        let turned = momentum + across * a + angle.cross(across) * b;
        let derivative = |du: DVec3| {
            let across = angle.cross(du);
            let moved = du + across * b + angle.cross(across) * c;
            du - inverse.apply(turned.cross(moved) * half_step)
        };
        let jacobian = DMat3::from_cols(derivative(DVec3::X), derivative(DVec3::Y), derivative(DVec3::Z));
        // In steps of more than two radians Newton's method may run away; what u is to equal is never longer than I⁻¹ makes of L.
        let change = inverse.apply(turned) - rate;
        let newton = jacobian.inverse() * change;
        let reach = (rate + newton) * half_step;
        let step = if reach.dot(reach) <= 1.0 { newton } else { change };
        rate += step;
        if step.dot(step) <= SHORT * SHORT * rate.dot(rate) {
            break;
        }
    }
    rate
}
