//! Rotations from body to world axes.

use std::fmt::Debug;

use glam::{DMat2, DMat3, DQuat, DVec2, DVec3};

use crate::{Angular, Linear, trig};

/// A rotation from body to world axes, driven by an angular quantity `W`.
pub trait Rotation<W: Angular>: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// The vectors it turns.
    type Vector;

    /// Whether inertia looks the same after any rotation: true in the plane.
    const INERTIA_IS_CONSTANT: bool;

    /// Body axes to world axes.
    fn rotate(&self, vector: Self::Vector) -> Self::Vector;

    /// World axes to body axes.
    fn unrotate(&self, vector: Self::Vector) -> Self::Vector;

    /// This rotation followed by a turn about a fixed world axis: exp(angle) R [rad].
    fn turned(&self, angle: W) -> Self;

    /// The turn about a fixed world axis that makes another rotation of this one: `other = self.turned(angle)`. In space the shorter way,
    /// by at most π [rad].
    fn angle_to(&self, other: &Self) -> W;

    /// This rotation in the axes of a frame: frame⁻¹ R.
    fn seen_from(&self, frame: &Self) -> Self;

    /// How far the tips of unit axes are, at most, from where they were: seen from a frame, now and `then`, squared [1].
    fn strayed(&self, frame: &Self, then: &Self) -> f64;

    /// Whether no part of it is infinite or NaN.
    fn is_finite(&self) -> bool;
}

/// A rotation of the plane: its angle, accumulated over turns, with cosine and sine kept beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarRotation {
    angle: f64,
    cos: f64,
    sin: f64,
}

impl PlanarRotation {
    /// No rotation.
    pub const IDENTITY: Self = Self { angle: 0.0, cos: 1.0, sin: 0.0 };

    /// Rotation by an angle, counter-clockwise [rad].
    pub fn from_angle(angle: f64) -> Self {
        let (sin, cos) = trig::sin_cos(angle);
        Self { angle, cos, sin }
    }

    /// Rotation by an angle, counter-clockwise [°].
    pub fn from_degrees(degrees: f64) -> Self {
        Self::from_angle(degrees.to_radians())
    }

    /// The angle, accumulated over turns (R2) [rad].
    #[inline]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Cosine of the angle [1].
    #[inline]
    pub fn cos(&self) -> f64 {
        self.cos
    }

    /// Sine of the angle [1].
    #[inline]
    pub fn sin(&self) -> f64 {
        self.sin
    }

    /// The rotation matrix R(a), body to world (R3).
    #[inline]
    pub fn to_matrix(&self) -> DMat2 {
        DMat2::from_cols(DVec2::new(self.cos, self.sin), DVec2::new(-self.sin, self.cos))
    }
}

impl Default for PlanarRotation {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Rotation<f64> for PlanarRotation {
    type Vector = DVec2;

    const INERTIA_IS_CONSTANT: bool = true;

    #[inline]
    fn rotate(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    #[inline]
    fn unrotate(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }

    fn turned(&self, angle: f64) -> Self {
        // A body that does not turn keeps its bits, and costs no trigonometry.
        if angle == 0.0 { *self } else { Self::from_angle(self.angle + angle) }
    }

    fn angle_to(&self, other: &Self) -> f64 {
        other.angle - self.angle
    }

    fn seen_from(&self, frame: &Self) -> Self {
        Self::from_angle(self.angle - frame.angle)
    }

    #[inline]
    fn strayed(&self, frame: &Self, then: &Self) -> f64 {
        let cos = frame.cos * self.cos + frame.sin * self.sin - then.cos;
        let sin = frame.cos * self.sin - frame.sin * self.cos - then.sin;
        cos * cos + sin * sin
    }

    fn is_finite(&self) -> bool {
        self.angle.is_finite()
    }
}

/// A rotation of space, as a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialRotation {
    quaternion: DQuat,
}

impl SpatialRotation {
    /// No rotation.
    pub const IDENTITY: Self = Self { quaternion: DQuat::IDENTITY };

    /// The rotation of a quaternion, made unit; `None` for zero or not finite.
    pub fn try_from_quaternion(quaternion: DQuat) -> Option<Self> {
        let length = quaternion.length();
        (length.is_finite() && length > 0.0).then(|| Self { quaternion: quaternion * (1.0 / length) })
    }

    /// Rotation about an axis through the length of the vector [rad].
    pub fn from_rotation_vector(angle: DVec3) -> Self {
        Self::IDENTITY.turned(angle)
    }

    /// The vector along the axis of this rotation whose length is its angle, at most π [rad].
    pub fn rotation_vector(&self) -> DVec3 {
        // q and −q are the same rotation; the one with w ≥ 0 turns by at most half a turn.
        let q = if self.quaternion.w < 0.0 { -self.quaternion } else { self.quaternion };
        let v = q.xyz();
        let sin = Linear::length(v);
        // 2 atan(s/w)/s, by its series where the quotient would lose digits: the first term left out is below s⁴.
        let ratio = if sin < 1e-4 { 2.0 + sin * sin / 3.0 } else { 2.0 * trig::atan2(sin, q.w) / sin };
        v * ratio
    }

    /// The rotation that, after `self`, makes `other`: other = turn · self, in world axes.
    pub fn turn_to(&self, other: &Self) -> Self {
        let product = other.quaternion * self.quaternion.conjugate();
        Self { quaternion: product * (1.0 / product.length()) }
    }

    /// The unit quaternion, body to world.
    #[inline]
    pub fn quaternion(&self) -> DQuat {
        self.quaternion
    }

    /// The rotation matrix, body to world.
    #[inline]
    pub fn to_matrix(&self) -> DMat3 {
        DMat3::from_quat(self.quaternion)
    }
}

impl Default for SpatialRotation {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Rotation<DVec3> for SpatialRotation {
    type Vector = DVec3;

    const INERTIA_IS_CONSTANT: bool = false;

    #[inline]
    fn rotate(&self, v: DVec3) -> DVec3 {
        self.quaternion * v
    }

    #[inline]
    fn unrotate(&self, v: DVec3) -> DVec3 {
        self.quaternion.conjugate() * v
    }

    fn turned(&self, angle: DVec3) -> Self {
        let half = angle * 0.5;
        let squared = half.dot(half);
        let (sinc, versinc) = trig::sinc_and_versinc(squared);
        let (v, cos) = (half * sinc, 1.0 - squared * versinc);
        let product = DQuat::from_xyzw(v.x, v.y, v.z, cos) * self.quaternion;
        Self { quaternion: product * (1.0 / product.length()) }
    }

    fn angle_to(&self, other: &Self) -> DVec3 {
        self.turn_to(other).rotation_vector()
    }

    fn seen_from(&self, frame: &Self) -> Self {
        let product = frame.quaternion.conjugate() * self.quaternion;
        Self { quaternion: product * (1.0 / product.length()) }
    }

    #[inline]
    fn strayed(&self, frame: &Self, then: &Self) -> f64 {
        // A chord of angle a is 2 sin(½a) long, and the two quaternions are ½a apart.
        let cos = (frame.quaternion.conjugate() * self.quaternion).dot(then.quaternion);
        4.0 * (1.0 - cos * cos)
    }

    fn is_finite(&self) -> bool {
        self.quaternion.is_finite()
    }
}
