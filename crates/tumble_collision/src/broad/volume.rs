//! Coarse volumes: boxes and half-spaces.

use glam::{DVec2, DVec3};
use tumble_math::{Bounds, Planar, Pose, Spatial, Vector};
use tumble_shape::{PlanarShape, SpatialShape};

/// Where a shape may be, coarsely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Volume<V> {
    /// Inside a box.
    Box(Bounds<V>),
    /// Where normal · p ≤ offset.
    HalfSpace {
        /// Unit vector out of the solid.
        normal: V,
        /// Signed distance of the surface from the origin along the normal [m].
        offset: f64,
    },
}

impl<V: Vector> Volume<V> {
    /// The volume grown by a margin on every side [m].
    pub fn grown(self, margin: f64) -> Self {
        match self {
            Self::Box(bounds) => Self::Box(bounds.grown(margin)),
            Self::HalfSpace { normal, offset } => Self::HalfSpace { normal, offset: offset + margin },
        }
    }

    /// All that a box passes through as it moves by `travel` [m]. Half-spaces stay as they are: they reach everywhere as it is.
    pub fn swept(self, travel: V) -> Self {
        match self {
            Self::Box(bounds) => Self::Box(bounds.join(Bounds { min: bounds.min + travel, max: bounds.max + travel })),
            Self::HalfSpace { .. } => self,
        }
    }

    /// Whether two volumes share a point; touching counts. Two half-spaces never do: neither can move into the other.
    pub fn overlaps(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Box(one), Self::Box(two)) => one.overlaps(two),
            (Self::Box(bounds), Self::HalfSpace { normal, offset })
            | (Self::HalfSpace { normal, offset }, Self::Box(bounds)) => lowest(bounds, *normal) <= *offset,
            (Self::HalfSpace { .. }, Self::HalfSpace { .. }) => false,
        }
    }

    /// Whether `other` lies inside, as far as this is cheap to say: half-spaces are compared when they are parallel only.
    pub(super) fn contains(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Box(one), Self::Box(two)) => one.contains(two),
            (Self::HalfSpace { normal: n, offset: o }, Self::HalfSpace { normal, offset }) => {
                n == normal && offset <= o
            }
            _ => false,
        }
    }
}

impl Volume<DVec2> {
    /// The volume of a shape in a pose.
    pub fn of_planar(shape: &PlanarShape, pose: &Pose<Planar>) -> Self {
        match shape {
            PlanarShape::HalfPlane(half_plane) => {
                let posed = half_plane.posed(pose);
                Self::HalfSpace { normal: posed.normal(), offset: posed.offset() }
            }
            _ => Self::Box(shape.bounds(pose).unwrap_or(Bounds::empty())),
        }
    }
}

impl Volume<DVec3> {
    /// The volume of a shape in a pose.
    pub fn of_spatial(shape: &SpatialShape, pose: &Pose<Spatial>) -> Self {
        match shape {
            SpatialShape::HalfSpace(half_space) => {
                let posed = half_space.posed(pose);
                Self::HalfSpace { normal: posed.normal(), offset: posed.offset() }
            }
            _ => Self::Box(shape.bounds(pose).unwrap_or(Bounds::empty())),
        }
    }
}

/// Smallest normal · p over the points of a box [m].
fn lowest<V: Vector>(bounds: &Bounds<V>, normal: V) -> f64 {
    (0..V::AXES).map(|i| normal[i] * if normal[i] > 0.0 { bounds.min[i] } else { bounds.max[i] }).sum()
}
