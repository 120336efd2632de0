//! Oriented boxes of space: the same second look as in the plane, by the fifteen axes of two boxes.

use glam::{DMat3, DVec3};
use tumble_math::{Pose, Rotation, Spatial};
use tumble_shape::SpatialShape;

use super::oriented::TurningBox;

/// A box that turns with a shape of space, in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialOrientedBox {
    centre: DVec3,
    /// Unit vectors along its sides.
    axes: DMat3,
    /// Half the length of each side [m].
    half: DVec3,
}

impl SpatialOrientedBox {
    /// A box around a shape, grown by a margin on every side [m]; `None` for a half-space, which has no end.
    ///
    /// Boxes keep their own sides, what is long is boxed along its line, and hulls along the axes of their body.
    pub fn around(shape: &SpatialShape, pose: &Pose<Spatial>, margin: f64) -> Option<Self> {
        let along_line = |ends: &[DVec3; 2], radius: DVec3| {
            let along = (ends[1] - ends[0]).try_normalize().unwrap_or(DVec3::Z);
            let across = along.any_orthonormal_vector();
            let half = radius + DVec3::Z * (0.5 * ends[0].distance(ends[1]));
            ((ends[0] + ends[1]) * 0.5, DMat3::from_cols(across, along.cross(across), along), half)
        };
        let flat = |radius: f64| DVec3::new(radius, radius, 0.0);
        let (centre, axes, half) = match shape {
            SpatialShape::HalfSpace(_) => return None,
            SpatialShape::Sphere(sphere) => (sphere.centre(), DMat3::IDENTITY, DVec3::splat(sphere.radius())),
            SpatialShape::SpatialRod(rod) => along_line(rod.ends(), DVec3::splat(rod.radius())),
            SpatialShape::Capsule(capsule) => along_line(capsule.ends(), DVec3::splat(capsule.radius())),
            SpatialShape::Cylinder(cylinder) => along_line(cylinder.ends(), flat(cylinder.radius())),
            SpatialShape::Cone(cone) => along_line(&[cone.base(), cone.tip()], flat(cone.radius())),
            SpatialShape::Cuboid(cuboid) => (cuboid.centre(), *cuboid.axes(), cuboid.half_extents()),
            SpatialShape::ConvexHull(_) | SpatialShape::Facet(_) => {
                let bounds = shape.bounds(&Pose::default())?;
                (bounds.centre(), DMat3::IDENTITY, bounds.size() * 0.5)
            }
        };
        Some(Self {
            centre: pose.transform_point(centre),
            axes: DMat3::from_cols(
                pose.rotation.rotate(axes.x_axis),
                pose.rotation.rotate(axes.y_axis),
                pose.rotation.rotate(axes.z_axis),
            ),
            half: half + DVec3::splat(margin),
        })
    }

    /// The sizes of a vector along the sides.
    fn along_sides(&self, vector: DVec3) -> DVec3 {
        (self.axes.transpose() * vector).abs()
    }
}

impl TurningBox for SpatialOrientedBox {
    type Vector = DVec3;

    /// By the axes of both boxes and the nine cross products of them (Gottschalk 1996). Where two axes are parallel their product is no
    /// axis; there both sides of the comparison are rounding, and the slack keeps it from telling the boxes apart.
    fn overlaps(&self, other: &Self) -> bool {
        const SLACK: f64 = 1e-12;
        let back = self.axes.transpose();
        let t = back * (other.centre - self.centre);
        let r = [other.axes.x_axis, other.axes.y_axis, other.axes.z_axis].map(|axis| back * axis);
        let abs = r.map(|axis| axis.abs() + DVec3::splat(SLACK));
        let (h, g) = (self.half, other.half);
        let reach = h + abs[0] * g.x + abs[1] * g.y + abs[2] * g.z;
        if t.abs().cmpgt(reach).any() {
            return false;
        }
        if (0..3).any(|j| r[j].dot(t).abs() > g[j] + abs[j].dot(h)) {
            return false;
        }
        (0..3).all(|j| {
            let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
            (0..3).all(|i| {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                let distance = (t[l] * r[j][k] - t[k] * r[j][l]).abs();
                distance <= h[k] * abs[j][l] + h[l] * abs[j][k] + g[j1] * abs[j2][i] + g[j2] * abs[j1][i]
            })
        })
    }

    fn contains(&self, other: &Self) -> bool {
        let seen = self.along_sides(other.axes.x_axis) * other.half.x
            + self.along_sides(other.axes.y_axis) * other.half.y
            + self.along_sides(other.axes.z_axis) * other.half.z;
        (self.along_sides(other.centre - self.centre) + seen).cmple(self.half).all()
    }

    fn grown(self, margin: f64) -> Self {
        Self { half: self.half + DVec3::splat(margin), ..self }
    }

    fn swept(self, travel: DVec3) -> Self {
        Self { centre: self.centre + travel * 0.5, half: self.half + self.along_sides(travel) * 0.5, ..self }
    }
}
