//! The plane and space, behind one trait.

use std::fmt::Debug;

use glam::{DMat2, DMat3, DVec2, DVec3};

use crate::{Angular, Inertia, Matrix, PlanarRotation, Rotation, SpatialRotation, SymmetricTensor, Vector, inertia};

/// What differs between mechanics in the plane and in space.
pub trait Dim: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// Position, velocity, force: 2 or 3 components.
    type Vector: Vector;
    /// Rate of turn, torque: a number or a vector.
    type Angular: Angular;
    /// Body axes to world axes.
    type Rotation: Rotation<Self::Angular, Vector = Self::Vector>;
    /// Inertia about the centre of mass, or its inverse.
    type Inertia: Inertia<Self::Angular, Self::Rotation>;
    /// A matrix over `Vector`, such as the compliance of a contact.
    type Matrix: Matrix<Self::Vector>;

    /// r × f: the torque of a force at an arm; also the angular impulse of an impulse.
    fn torque(arm: Self::Vector, force: Self::Vector) -> Self::Angular;

    /// ω × r: the velocity of a point at an arm of a turning body.
    fn spin(angular_velocity: Self::Angular, arm: Self::Vector) -> Self::Vector;

    /// ω × L: what it takes to turn an angular momentum along with a body; nothing in the plane.
    fn gyroscopic_torque(angular_velocity: Self::Angular, angular_momentum: Self::Angular) -> Self::Angular;

    /// The contact frame of a unit normal: columns normal, then tangents. In the plane the tangent is (n_y, −n_x).
    fn contact_frame(normal: Self::Vector) -> Self::Matrix;

    /// The matrix of a rotation, body to world.
    fn matrix(rotation: &Self::Rotation) -> Self::Matrix;

    /// Rotation and rate of turn after one step without torque; `inertia` and its inverse are in the body frame.
    fn turn_freely(
        rotation: Self::Rotation,
        inertia: &Self::Inertia,
        inverse_inertia: &Self::Inertia,
        angular_velocity: Self::Angular,
        dt: f64,
    ) -> (Self::Rotation, Self::Angular);

    /// The constant rate of turn with which [`turn_freely`](Self::turn_freely) turns a body; `inertia` is in the axes of `rotation`.
    fn midpoint_rate(
        rotation: Self::Rotation,
        inertia: &Self::Inertia,
        inverse_inertia: &Self::Inertia,
        angular_velocity: Self::Angular,
        dt: f64,
    ) -> Self::Angular;
}

/// Mechanics in the plane: one angle, counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Planar;

impl Dim for Planar {
    type Vector = DVec2;
    type Angular = f64;
    type Rotation = PlanarRotation;
    type Inertia = f64;
    type Matrix = DMat2;

    #[inline]
    fn torque(arm: DVec2, force: DVec2) -> f64 {
        arm.perp_dot(force)
    }

    #[inline]
    fn spin(angular_velocity: f64, arm: DVec2) -> DVec2 {
        DVec2::new(-angular_velocity * arm.y, angular_velocity * arm.x)
    }

    #[inline]
    fn gyroscopic_torque(_: f64, _: f64) -> f64 {
        0.0
    }

    #[inline]
    fn contact_frame(normal: DVec2) -> DMat2 {
        DMat2::from_cols(normal, DVec2::new(normal.y, -normal.x))
    }

    #[inline]
    fn matrix(rotation: &PlanarRotation) -> DMat2 {
        rotation.to_matrix()
    }

    #[inline]
    fn turn_freely(rotation: PlanarRotation, _: &f64, _: &f64, rate: f64, dt: f64) -> (PlanarRotation, f64) {
        (rotation.turned(rate * dt), rate)
    }

    #[inline]
    fn midpoint_rate(_: PlanarRotation, _: &f64, _: &f64, rate: f64, _: f64) -> f64 {
        rate
    }
}

/// Mechanics in space: right-handed axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spatial;

impl Dim for Spatial {
    type Vector = DVec3;
    type Angular = DVec3;
    type Rotation = SpatialRotation;
    type Inertia = SymmetricTensor;
    type Matrix = DMat3;

    #[inline]
    fn torque(arm: DVec3, force: DVec3) -> DVec3 {
        arm.cross(force)
    }

    #[inline]
    fn spin(angular_velocity: DVec3, arm: DVec3) -> DVec3 {
        angular_velocity.cross(arm)
    }

    #[inline]
    fn gyroscopic_torque(angular_velocity: DVec3, angular_momentum: DVec3) -> DVec3 {
        angular_velocity.cross(angular_momentum)
    }

    #[inline]
    fn contact_frame(normal: DVec3) -> DMat3 {
        // Any tangent will do, as long as it is a continuous function of the normal almost everywhere and never degenerate.
        let helper = if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
        let tangent = normal.cross(helper);
        let tangent = tangent * (1.0 / tangent.length());
        DMat3::from_cols(normal, tangent, normal.cross(tangent))
    }

    #[inline]
    fn matrix(rotation: &SpatialRotation) -> DMat3 {
        rotation.to_matrix()
    }

    /// By the implicit midpoint rule.
    fn turn_freely(
        rotation: SpatialRotation,
        inertia: &SymmetricTensor,
        inverse_inertia: &SymmetricTensor,
        angular_velocity: DVec3,
        dt: f64,
    ) -> (SpatialRotation, DVec3) {
        inertia::turn_freely(rotation, inertia, inverse_inertia, angular_velocity, dt)
    }

    fn midpoint_rate(
        rotation: SpatialRotation,
        inertia: &SymmetricTensor,
        inverse_inertia: &SymmetricTensor,
        angular_velocity: DVec3,
        dt: f64,
    ) -> DVec3 {
        inertia::midpoint_rate(rotation, inertia, inverse_inertia, angular_velocity, dt)
    }
}
