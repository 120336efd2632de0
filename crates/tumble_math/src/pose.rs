//! Where a body is and how it is turned.

use crate::{Dim, Rotation};

/// Position of the centre of mass and rotation, body → world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose<D: Dim> {
    /// Centre of mass in world axes [m].
    pub position: D::Vector,
    /// Body axes to world axes.
    pub rotation: D::Rotation,
}

impl<D: Dim> Pose<D> {
    /// World place of a point given in the body frame: R(a) s + x (R3) [m].
    #[inline]
    pub fn transform_point(&self, point_body: D::Vector) -> D::Vector {
        self.position + self.rotation.rotate(point_body)
    }

    /// Body-frame place of a world point [m].
    #[inline]
    pub fn inverse_transform_point(&self, point_world: D::Vector) -> D::Vector {
        self.rotation.unrotate(point_world - self.position)
    }

    /// World direction of a vector given in the body frame.
    #[inline]
    pub fn transform_vector(&self, vector_body: D::Vector) -> D::Vector {
        self.rotation.rotate(vector_body)
    }
}
