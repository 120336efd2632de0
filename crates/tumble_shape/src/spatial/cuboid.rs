//! Cuboid: a filled box.

use glam::{DMat3, DVec3};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation, SymmetricTensor};

use super::{ConvexHull, SpatialShapeError};
use crate::MassProperties;

/// A filled box.
///
/// ```text
///        6______7            vertex number: bit 0 set for +x, bit 1 for +y, bit 2 for +z
///       /|     /|            faces: −x, +x, −y, +y, −z, +z
///     4/_2___5/ 3     y z
///     | /    | /      |/__x
///     |/_____|/
///     0      1
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    centre: DVec3,
    axes: DMat3,
    half_extents: DVec3,
    hull: ConvexHull,
}

/// Vertices of the faces, counter-clockwise seen from outside.
const LOOPS: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

impl Cuboid {
    /// A box around a point [m] with half the lengths of its sides [m], turned by a rotation.
    pub fn try_new(centre: DVec3, half_extents: DVec3, rotation: SpatialRotation) -> Result<Self, SpatialShapeError> {
        if !(centre.is_finite() && half_extents.is_finite() && rotation.is_finite()) {
            return Err(SpatialShapeError::NotFinite);
        }
        let DVec3 { x, y, z } = half_extents;
        if !(x > 0.0 && y > 0.0 && z > 0.0) {
            return Err(SpatialShapeError::HalfExtentNotPositive { x, y, z });
        }
        let sign = |vertex: u32, bit: u32| if vertex >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |i: u32| centre + rotation.rotate(DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)) * half_extents);
        let loops = LOOPS.map(Vec::from);
        let mut hull = ConvexHull::from_loops((0..8).map(corner).collect(), &loops);
        hull.centre_on(centre);
        Ok(Self { centre, axes: rotation.to_matrix(), half_extents, hull })
    }

    /// A box around the origin along the axes, with half the lengths of its sides [m].
    pub fn with_half_extents(half_extents: DVec3) -> Result<Self, SpatialShapeError> {
        Self::try_new(DVec3::ZERO, half_extents, SpatialRotation::IDENTITY)
    }

    /// Its middle [m].
    #[inline]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Unit vectors along its sides, as columns.
    #[inline]
    pub fn axes(&self) -> &DMat3 {
        &self.axes
    }

    /// Half the lengths of its sides [m].
    #[inline]
    pub fn half_extents(&self) -> DVec3 {
        self.half_extents
    }

    /// The same box as a polyhedron.
    #[inline]
    pub fn hull(&self) -> &ConvexHull {
        &self.hull
    }

    /// The box turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        let turned = |axis: DVec3| super::turned_unit(&pose.rotation, axis);
        let axes = DMat3::from_cols(turned(self.axes.x_axis), turned(self.axes.y_axis), turned(self.axes.z_axis));
        Self {
            centre: pose.transform_point(self.centre),
            axes,
            half_extents: self.half_extents,
            hull: self.hull.posed(pose),
        }
    }

    /// Mass properties at a density [kg/m³].
    ///
    /// ```text
    /// m = 8 ρ h_x h_y h_z,   I_x = m (h_y² + h_z²)/3 about the first side's axis, and so on
    /// ```
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        let h = self.half_extents;
        let mass = 8.0 * density * h.x * h.y * h.z;
        let squared = h * h;
        let moments = DVec3::new(squared.y + squared.z, squared.z + squared.x, squared.x + squared.y) * (mass / 3.0);
        let inertia = SymmetricTensor::from_matrix(self.axes * DMat3::from_diagonal(moments) * self.axes.transpose());
        MassProperties { mass, centre: self.centre, inertia }
    }
}
