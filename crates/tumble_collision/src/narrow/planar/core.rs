//! Cores, and separating axes between them.

use glam::DVec2;
use tumble_math::{Planar, PlanarRotation, Pose, Rotation};
use tumble_shape::PlanarShape;

/// Which shape of the pair something belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    A,
    B,
}

/// The core of a shape in the world: corners and sides stay in the body frame, and are turned when asked for.
///
/// Places are in world axes, relative to an origin near the pair.
pub(super) struct Core<'a> {
    vertices: &'a [DVec2],
    normals: &'a [DVec2],
    position: DVec2,
    rotation: &'a PlanarRotation,
    /// Distance of the surface outside the core [m].
    pub(super) radius: f64,
}

impl<'a> Core<'a> {
    pub(super) fn new(shape: &'a PlanarShape, pose: &'a Pose<Planar>, origin: DVec2) -> Self {
        Self {
            vertices: shape.vertices(),
            normals: shape.normals(),
            position: pose.position - origin,
            rotation: &pose.rotation,
            radius: shape.radius(),
        }
    }

    #[inline]
    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    #[inline]
    pub(super) fn side_count(&self) -> usize {
        self.normals.len()
    }

    #[inline]
    pub(super) fn vertex(&self, i: usize) -> DVec2 {
        self.position + self.rotation.rotate(self.vertices[i])
    }

    #[inline]
    pub(super) fn normal(&self, i: usize) -> DVec2 {
        self.rotation.rotate(self.normals[i])
    }

    /// The number after i, round the corners (or sides).
    #[inline]
    pub(super) fn next(&self, i: usize) -> usize {
        if i + 1 == self.vertices.len() { 0 } else { i + 1 }
    }

    /// The number before i.
    #[inline]
    pub(super) fn previous(&self, i: usize) -> usize {
        if i == 0 { self.vertices.len() - 1 } else { i - 1 }
    }

    /// A point or a segment: a core without an inside.
    #[inline]
    pub(super) fn is_flat(&self) -> bool {
        self.vertices.len() <= 2
    }

    #[inline]
    pub(super) fn is_rod(&self) -> bool {
        self.vertices.len() == 2
    }

    /// The corner lowest along a world direction, and its height [m].
    #[inline]
    pub(super) fn lowest(&self, direction: DVec2) -> (usize, f64) {
        let (lowest, height) = self.lowest_in_body(self.rotation.unrotate(direction));
        (lowest, height + direction.dot(self.position))
    }

    /// The corner lowest along a direction of the body frame, and its height above the body's origin [m].
    #[inline]
    fn lowest_in_body(&self, direction_body: DVec2) -> (usize, f64) {
        let mut lowest = (0, f64::INFINITY);
        for (i, vertex) in self.vertices.iter().enumerate() {
            let height = direction_body.dot(*vertex);
            if height < lowest.1 {
                lowest = (i, height);
            }
        }
        lowest
    }

    /// Largest distance between its corners, or its diameter if that is more [m].
    pub(super) fn length(&self) -> f64 {
        let reach = self.vertices.iter().map(|vertex| vertex.distance_squared(self.vertices[0])).fold(0.0, f64::max);
        reach.sqrt().max(2.0 * self.radius)
    }
}

/// A side of one core, as a separating axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) owner: Owner,
    /// Which side of the owner.
    pub(super) side: usize,
    /// Outward unit normal of the side, world axes.
    pub(super) normal: DVec2,
    /// Corner of the other core that is lowest along the normal.
    pub(super) support: usize,
    /// Height of that corner above the side [m].
    pub(super) separation: f64,
}

impl Axis {
    /// Its normal, made to run from a to b.
    #[inline]
    pub(super) fn normal_a_to_b(&self) -> DVec2 {
        match self.owner {
            Owner::A => self.normal,
            Owner::B => -self.normal,
        }
    }

    /// Whether it runs across another axis: 60° to 120° between the two.
    #[inline]
    pub(super) fn is_across(&self, other: &Self) -> bool {
        self.normal.dot(other.normal).abs() < 0.5
    }
}

/// The separating axes along the sides of one core.
///
/// ```text
/// s = n · (x_o + R_o v − x_c − R_c p) = (Rᵀ n) · v + n · (d − p),   R = R_cᵀ R_o,   d = R_cᵀ (x_o − x_c)
/// ```
///
/// with side normal n and corner p of the core in its body frame, and v the corner of the other core, in its own, that makes it
/// least. R and d are found once, so that a side costs one turn of its normal and one product per corner.
#[inline]
pub(super) fn axes_of<'a>(owner: Owner, core: &'a Core, other: &'a Core) -> impl Iterator<Item = Axis> + 'a {
    let (r_c, r_o) = (core.rotation, other.rotation);
    let cos = r_c.cos() * r_o.cos() + r_c.sin() * r_o.sin();
    let sin = r_c.sin() * r_o.cos() - r_c.cos() * r_o.sin();
    let offset = r_c.unrotate(other.position - core.position);
    (0..core.side_count()).map(move |side| {
        let n = core.normals[side];
        let in_other = DVec2::new(cos * n.x - sin * n.y, sin * n.x + cos * n.y);
        let (support, height) = other.lowest_in_body(in_other);
        let separation = height + n.dot(offset - core.vertices[side]);
        Axis { owner, side, normal: core.normal(side), support, separation }
    })
}
