//! Cores: what is left of a shape when its radius is taken off.

use glam::DVec3;
use tumble_shape::{ConvexHull, Cuboid, Facet, SpatialShape};

use super::place::Place;

/// The core of a shape, in the frame of the pair (that of shape a).
#[derive(Clone, Copy, Debug)]
pub(super) struct Core<'a> {
    vertices: &'a [DVec3],
    place: Option<&'a Place>,
}

impl<'a> Core<'a> {
    /// A core whose own frame is that of the pair.
    pub(super) fn own(vertices: &'a [DVec3]) -> Self {
        Self { vertices, place: None }
    }

    /// A core whose frame stands in that of the pair.
    pub(super) fn placed(vertices: &'a [DVec3], place: &'a Place) -> Self {
        Self { vertices, place: Some(place) }
    }

    /// The point farthest in a direction [m], and the number of its vertex.
    pub(super) fn farthest(&self, direction: DVec3) -> (DVec3, u32) {
        let own = self.place.map_or(direction, |place| place.unturned(direction));
        let mut best = (0, f64::NEG_INFINITY);
        for (i, vertex) in self.vertices.iter().enumerate() {
            let height = own.dot(*vertex);
            if height > best.1 {
                best = (i, height);
            }
        }
        let vertex = self.vertices[best.0];
        (self.place.map_or(vertex, |place| place.point(vertex)), best.0 as u32)
    }
}

/// A convex shape as the narrow phase sees it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid<'a> {
    /// A polyhedron, and the box that it is, if it is one.
    Hull(&'a ConvexHull, Option<&'a Cuboid>),
    /// A segment with a radius.
    Segment(&'a [DVec3; 2], f64),
    /// A point with a radius.
    Point(DVec3, f64),
    /// A triangle of ground.
    Facet(&'a Facet),
    /// A cylinder, or a cone from its base to its tip: both ends of the axis, and the radii there.
    Rims([DVec3; 2], [f64; 2]),
}

impl<'a> Solid<'a> {
    /// `None` for half-spaces.
    pub(super) fn of(shape: &'a SpatialShape) -> Option<Self> {
        match shape {
            SpatialShape::Sphere(sphere) => Some(Self::Point(sphere.centre(), sphere.radius())),
            SpatialShape::SpatialRod(rod) => Some(Self::Segment(rod.ends(), rod.radius())),
            SpatialShape::Capsule(capsule) => Some(Self::Segment(capsule.ends(), capsule.radius())),
            SpatialShape::Cuboid(cuboid) => Some(Self::Hull(cuboid.hull(), Some(cuboid))),
            SpatialShape::ConvexHull(hull) => Some(Self::Hull(hull, None)),
            SpatialShape::Cylinder(cylinder) => Some(Self::Rims(*cylinder.ends(), [cylinder.radius(); 2])),
            SpatialShape::Cone(cone) => Some(Self::Rims([cone.base(), cone.tip()], [cone.radius(), 0.0])),
            SpatialShape::Facet(facet) => Some(Self::Facet(facet)),
            SpatialShape::HalfSpace(_) => None,
        }
    }

    /// A length that none of its points is farther from its body's origin than [m].
    pub(super) fn reach(&self) -> f64 {
        match self {
            Self::Hull(hull, _) => hull.centre().length() + hull.outer_radius(),
            Self::Facet(facet) => facet.prism().centre().length() + facet.prism().outer_radius(),
            Self::Segment(ends, radius) => ends[0].length().max(ends[1].length()) + radius,
            Self::Point(centre, radius) => centre.length() + radius,
            Self::Rims(ends, radii) => ends[0].length().max(ends[1].length()) + radii[0],
        }
    }
}
