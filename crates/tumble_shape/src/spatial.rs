//! Shapes of space.
//!
//! ```text
//!  SpatialRod  Capsule     Sphere     Cuboid, ConvexHull   Cylinder   Cone    HalfSpace
//!                 .-.       .-"-.        _______            .---.      .        ^ normal
//!      |         |   |     /     \      /      /|           |   |     / \    ___|___
//!      |         |   |     \     /     /______/ |           |   |    /   \   ///////
//!      |          '-'       '-.-'      |______|/            '---'   '-----'
//! ```
//!
//! Spheres, rods, capsules, boxes and hulls are a *core* and a radius, as in the plane: a point, a segment or a polyhedron, grown
//! by the radius. A compound is a list of parts, each with a shape; [`MassProperties::combine`] adds them up. A [`TriangleMesh`] or
//! height field is a list of [`Facet`]s.

mod axis;
mod capsule;
mod cone;
mod convex_hull;
mod cuboid;
mod cylinder;
mod error;
mod half_space;
mod hull;
mod polyhedron_mass;
mod rod;
mod sphere;
mod triangle_mesh;

pub use capsule::Capsule;
pub use cone::Cone;
pub use convex_hull::{ConvexHull, Edge, Face, Side};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use error::SpatialShapeError;
pub use half_space::HalfSpace;
pub use rod::SpatialRod;
pub use sphere::Sphere;
pub use triangle_mesh::{Facet, MeshError, TriangleMesh, join_corners};

use glam::DVec3;
use tumble_math::{Bounds, Pose, Rotation, Spatial, SpatialRotation};

use crate::MassProperties;

/// Any shape of space.
#[derive(Clone, Debug, PartialEq)]
pub enum SpatialShape {
    /// A filled ball.
    Sphere(Sphere),
    /// A straight line, thin or with round ends and sides, its mass on the line.
    SpatialRod(SpatialRod),
    /// A filled line with round ends and sides.
    Capsule(Capsule),
    /// A filled box.
    Cuboid(Cuboid),
    /// A filled polyhedron without inward corners.
    ConvexHull(ConvexHull),
    /// A filled round cylinder with flat ends.
    Cylinder(Cylinder),
    /// A filled cone with a flat round base.
    Cone(Cone),
    /// Everything on one side of a plane: a floor or a wall.
    HalfSpace(HalfSpace),
    /// A triangle of ground that does not move.
    Facet(Facet),
}

impl SpatialShape {
    /// Corners of the core: one of a sphere, two of a rod or capsule; none of cylinders, cones and half-spaces [m].
    #[inline]
    pub fn vertices(&self) -> &[DVec3] {
        match self {
            Self::Sphere(sphere) => sphere.centre_slice(),
            Self::SpatialRod(rod) => rod.ends(),
            Self::Capsule(capsule) => capsule.ends(),
            Self::Cuboid(cuboid) => cuboid.hull().vertices(),
            Self::ConvexHull(hull) => hull.vertices(),
            Self::Facet(facet) => facet.prism().vertices(),
            Self::Cylinder(_) | Self::Cone(_) | Self::HalfSpace(_) => &[],
        }
    }

    /// The polyhedron, if the shape is one.
    #[inline]
    pub fn hull(&self) -> Option<&ConvexHull> {
        match self {
            Self::Cuboid(cuboid) => Some(cuboid.hull()),
            Self::ConvexHull(hull) => Some(hull),
            _ => None,
        }
    }

    /// How far the surface lies outside the core [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius(),
            Self::SpatialRod(rod) => rod.radius(),
            Self::Capsule(capsule) => capsule.radius(),
            _ => 0.0,
        }
    }

    /// The smallest box around the shape in world axes; `None` for a half-space, which has no end [m].
    pub fn bounds(&self, pose: &Pose<Spatial>) -> Option<Bounds<DVec3>> {
        match self {
            Self::HalfSpace(_) => None,
            Self::Cylinder(cylinder) => {
                let rim = rim_reach(pose.rotation.rotate(cylinder.direction()), cylinder.radius());
                let ends = Bounds::around(cylinder.ends().map(|end| pose.transform_point(end)));
                Some(Bounds { min: ends.min - rim, max: ends.max + rim })
            }
            Self::Cone(cone) => {
                let rim = rim_reach(pose.rotation.rotate(cone.direction()), cone.radius());
                let (base, tip) = (pose.transform_point(cone.base()), pose.transform_point(cone.tip()));
                Some(Bounds { min: tip.min(base - rim), max: tip.max(base + rim) })
            }
            _ => {
                let vertices = self.vertices().iter();
                Some(Bounds::around(vertices.map(|&vertex| pose.transform_point(vertex))).grown(self.radius()))
            }
        }
    }

    /// Largest distance of any of its points from a point; `None` for a half-space [m].
    pub fn extent_about(&self, point: DVec3) -> Option<f64> {
        let rim = |centre: DVec3, direction: DVec3, radius: f64| {
            let to_centre = centre - point;
            let along = direction.dot(to_centre);
            let across = (to_centre - direction * along).length() + radius;
            (along * along + across * across).sqrt()
        };
        match self {
            Self::HalfSpace(_) => None,
            Self::Cylinder(cylinder) => {
                let [from, to] = cylinder.ends().map(|end| rim(end, cylinder.direction(), cylinder.radius()));
                Some(from.max(to))
            }
            Self::Cone(cone) => Some(rim(cone.base(), cone.direction(), cone.radius()).max(cone.tip().distance(point))),
            _ => {
                let farthest = self.vertices().iter().map(|vertex| vertex.distance_squared(point)).reduce(f64::max)?;
                Some(farthest.sqrt() + self.radius())
            }
        }
    }

    /// The shape moved without turning [m].
    pub fn translated(&self, by: DVec3) -> Self {
        self.posed(&Pose { position: by, rotation: SpatialRotation::IDENTITY })
    }

    /// The shape turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        match self {
            Self::Sphere(sphere) => Self::Sphere(sphere.posed(pose)),
            Self::SpatialRod(rod) => Self::SpatialRod(rod.posed(pose)),
            Self::Capsule(capsule) => Self::Capsule(capsule.posed(pose)),
            Self::Cuboid(cuboid) => Self::Cuboid(cuboid.posed(pose)),
            Self::ConvexHull(hull) => Self::ConvexHull(hull.posed(pose)),
            Self::Cylinder(cylinder) => Self::Cylinder(cylinder.posed(pose)),
            Self::Cone(cone) => Self::Cone(cone.posed(pose)),
            Self::HalfSpace(half_space) => Self::HalfSpace(half_space.posed(pose)),
            Self::Facet(facet) => Self::Facet(facet.posed(pose)),
        }
    }

    /// Mass properties at a density: of a rod's line [kg/m], of the volume of others [kg/m³]; `None` for ground: half-spaces and
    /// facets.
    pub fn mass_properties(&self, density: f64) -> Option<MassProperties<Spatial>> {
        match self {
            Self::Sphere(sphere) => Some(sphere.mass_properties(density)),
            Self::SpatialRod(rod) => Some(rod.mass_properties(density)),
            Self::Capsule(capsule) => Some(capsule.mass_properties(density)),
            Self::Cuboid(cuboid) => Some(cuboid.mass_properties(density)),
            Self::ConvexHull(hull) => Some(hull.mass_properties(density)),
            Self::Cylinder(cylinder) => Some(cylinder.mass_properties(density)),
            Self::Cone(cone) => Some(cone.mass_properties(density)),
            Self::HalfSpace(_) | Self::Facet(_) => None,
        }
    }

    /// Mass properties when the mass is given, spread evenly [kg]; `None` for ground.
    pub fn mass_properties_of_mass(&self, mass: f64) -> Option<MassProperties<Spatial>> {
        let unit = self.mass_properties(1.0)?;
        Some(MassProperties { mass, ..unit.scaled(mass / unit.mass) })
    }
}

macro_rules! into_shape {
    ($($shape:ident),*) => {$(
        impl From<$shape> for SpatialShape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        }
    )*};
}

into_shape!(Sphere, SpatialRod, Capsule, Cuboid, ConvexHull, Cylinder, Cone, HalfSpace, Facet);

/// How far a circle reaches from its middle along each axis: r √(1 − u²) for its unit normal u [m].
fn rim_reach(direction: DVec3, radius: f64) -> DVec3 {
    // 1 − u_x² as u_y² + u_z², which does not cancel.
    let u = direction * direction;
    DVec3::new((u.y + u.z).sqrt(), (u.z + u.x).sqrt(), (u.x + u.y).sqrt()) * radius
}

/// Turns a unit vector and removes the round-off that turning adds to its length.
fn turned_unit(rotation: &SpatialRotation, unit: DVec3) -> DVec3 {
    let turned = rotation.rotate(unit);
    turned * (1.0 / turned.length())
}
