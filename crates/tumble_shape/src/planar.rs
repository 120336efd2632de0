//! Shapes of the plane.
//!
//! All of them but the half-plane are a *core* and a radius: a point (disc), a segment (rod) or a polygon, grown by the radius.
//! Collision detection works on the cores and subtracts the radii at the end. A core is a closed chain of
//! [`vertices`](PlanarShape::vertices), counter-clockwise, with one outward [`normal`](PlanarShape::normals) per side; a rod is
//! the chain of two sides that runs there and back.

mod convex_polygon;
mod disc;
mod half_plane;
mod rod;

pub use convex_polygon::ConvexPolygon;
pub use disc::Disc;
pub use half_plane::HalfPlane;
pub use rod::Rod;

use glam::DVec2;
use tumble_math::{Bounds, Planar, PlanarRotation, Pose, Rotation};

use crate::MassProperties;

/// Any shape of the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanarShape {
    /// A straight line, thin or with round ends and sides.
    Rod(Rod),
    /// A filled circle.
    Disc(Disc),
    /// A filled polygon without inward corners.
    ConvexPolygon(ConvexPolygon),
    /// Everything on one side of a line: a floor or a wall.
    HalfPlane(HalfPlane),
}

impl PlanarShape {
    /// Corners of the core, counter-clockwise: none for a half-plane, one for a disc, two for a rod [m].
    #[inline]
    pub fn vertices(&self) -> &[DVec2] {
        match self {
            Self::Rod(rod) => rod.ends(),
            Self::Disc(disc) => disc.centre_slice(),
            Self::ConvexPolygon(polygon) => polygon.points(),
            Self::HalfPlane(_) => &[],
        }
    }

    /// Outward unit normals of the sides of the core; side i runs from vertex i to the next one. None for a disc or half-plane.
    #[inline]
    pub fn normals(&self) -> &[DVec2] {
        match self {
            Self::Rod(rod) => rod.normals(),
            Self::Disc(_) | Self::HalfPlane(_) => &[],
            Self::ConvexPolygon(polygon) => polygon.normals(),
        }
    }

    /// How far the surface lies outside the core [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        match self {
            Self::Rod(rod) => rod.radius(),
            Self::Disc(disc) => disc.radius(),
            Self::ConvexPolygon(_) | Self::HalfPlane(_) => 0.0,
        }
    }

    /// The smallest box around the shape in world axes; `None` for a half-plane, which has no end [m].
    pub fn bounds(&self, pose: &Pose<Planar>) -> Option<Bounds<DVec2>> {
        let vertices = self.vertices();
        let around = || Bounds::around(vertices.iter().map(|&vertex| pose.transform_point(vertex)));
        (!vertices.is_empty()).then(|| around().grown(self.radius()))
    }

    /// Largest distance of any of its points from a point; `None` for a half-plane [m].
    pub fn extent_about(&self, point: DVec2) -> Option<f64> {
        let farthest = self.vertices().iter().map(|vertex| vertex.distance_squared(point)).reduce(f64::max)?;
        Some(farthest.sqrt() + self.radius())
    }

    /// The shape moved without turning [m].
    pub fn translated(&self, by: DVec2) -> Self {
        self.posed(&Pose { position: by, rotation: PlanarRotation::IDENTITY })
    }

    /// The shape turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Planar>) -> Self {
        match self {
            Self::Rod(rod) => Self::Rod(rod.posed(pose)),
            Self::Disc(disc) => Self::Disc(disc.posed(pose)),
            Self::ConvexPolygon(polygon) => Self::ConvexPolygon(polygon.posed(pose)),
            Self::HalfPlane(half_plane) => Self::HalfPlane(half_plane.posed(pose)),
        }
    }

    /// Mass properties at a density: of a rod's line [kg/m], of the area of others [kg/m²]; `None` for a half-plane.
    pub fn mass_properties(&self, density: f64) -> Option<MassProperties<Planar>> {
        match self {
            Self::Rod(rod) => Some(rod.mass_properties(density)),
            Self::Disc(disc) => Some(disc.mass_properties(density)),
            Self::ConvexPolygon(polygon) => Some(polygon.mass_properties(density)),
            Self::HalfPlane(_) => None,
        }
    }

    /// Mass properties when the mass is given, spread evenly [kg]; `None` for a half-plane.
    pub fn mass_properties_of_mass(&self, mass: f64) -> Option<MassProperties<Planar>> {
        let unit = self.mass_properties(1.0)?;
        Some(MassProperties { mass, ..unit.scaled(mass / unit.mass) })
    }
}

macro_rules! into_shape {
    ($($shape:ident),*) => {$(
        impl From<$shape> for PlanarShape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        }
    )*};
}

into_shape!(Rod, Disc, ConvexPolygon, HalfPlane);

/// Turns a unit vector and removes the round-off that turning adds to its length.
fn turned_unit(rotation: &PlanarRotation, unit: DVec2) -> DVec2 {
    let turned = rotation.rotate(unit);
    turned * (1.0 / turned.length())
}
