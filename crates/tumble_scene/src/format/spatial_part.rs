//! Parts of space: the shapes a body is made of, in its design frame.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::part::{PartEntry, Shared, part};
use super::{Groups, OrientationEntry};

/// A shape of a body. Its mass comes from `density` or `mass`; with neither, the density is 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum SpatialPart {
    /// A ball.
    Sphere(SpherePart),
    /// A box.
    Box(SpatialBoxPart),
    /// A straight line with round ends and sides, filled.
    Capsule(CapsulePart),
    /// A straight rod, thin unless it has a radius, its mass on the line between its ends.
    Rod(SpatialRodPart),
    /// A round cylinder with flat ends.
    Cylinder(CylinderPart),
    /// A cone with a flat round base.
    Cone(ConePart),
    /// The convex hull of points.
    Hull(HullPart),
    /// The convex hull of the surface in a file.
    HullFile(HullFilePart),
    /// Everything below a plane: a floor, a wall or a slope. Only for bodies that forces do not move.
    HalfSpace(HalfSpacePart),
    /// Ground made of triangles. Only for bodies that forces do not move.
    Mesh(MeshPart),
    /// Ground made of the triangles in a file. Only for bodies that forces do not move.
    MeshFile(MeshFilePart),
    /// Ground given by its heights over a grid. Only for bodies that forces do not move.
    HeightField(HeightFieldPart),
    /// All parts of a named list.
    List(String),
}

part! {
    /// A ball.
    #[derive(Default)]
    SpherePart ["volume [kg/m³]"] {
        /// Radius [m].
        radius: f64,
        /// Its centre [m]. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "(f64, f64, f64)")]
        at: DVec3,
    }
}

part! {
    /// A box.
    #[derive(Default)]
    SpatialBoxPart ["volume [kg/m³]"] {
        /// Full lengths along its own axes [m].
        #[schemars(with = "(f64, f64, f64)")]
        size: DVec3,
        /// Its centre [m]. Default (0, 0, 0).
        #[serde(default)]
        #[schemars(with = "(f64, f64, f64)")]
        at: DVec3,
        /// How it is turned in the design frame. Default not at all.
        #[serde(default)]
        orientation: Option<OrientationEntry>,
    }
}

part! {
    /// All points within the radius of the segment between two points.
    #[derive(Default)]
    CapsulePart ["volume [kg/m³]"] {
        /// One end of the segment [m].
        #[schemars(with = "(f64, f64, f64)")]
        from: DVec3,
        /// The other end of the segment [m].
        #[schemars(with = "(f64, f64, f64)")]
        to: DVec3,
        /// Radius [m].
        radius: f64,
    }
}

part! {
    /// A straight rod; with a radius, contact is that of a capsule, but the mass stays on the line.
    #[derive(Default)]
    SpatialRodPart ["length [kg/m]"] {
        /// One end [m].
        #[schemars(with = "(f64, f64, f64)")]
        from: DVec3,
        /// The other end [m].
        #[schemars(with = "(f64, f64, f64)")]
        to: DVec3,
        /// Half the thickness [m]; it counts for contact, not for mass. Default 0.
        #[serde(default)]
        radius: f64,
    }
}

part! {
    /// A round cylinder with flat ends.
    #[derive(Default)]
    CylinderPart ["volume [kg/m³]"] {
        /// Centre of one end [m].
        #[schemars(with = "(f64, f64, f64)")]
        from: DVec3,
        /// Centre of the other end [m].
        #[schemars(with = "(f64, f64, f64)")]
        to: DVec3,
        /// Radius [m].
        radius: f64,
    }
}

part! {
    /// A cone with a flat round base.
    #[derive(Default)]
    ConePart ["volume [kg/m³]"] {
        /// Centre of the base [m].
        #[schemars(with = "(f64, f64, f64)")]
        base: DVec3,
        /// The tip [m].
        #[schemars(with = "(f64, f64, f64)")]
        tip: DVec3,
        /// Radius of the base [m].
        radius: f64,
    }
}

part! {
    /// The convex hull of points.
    #[derive(Default)]
    HullPart ["volume [kg/m³]"] {
        /// Points, at least four that lie in no plane; those inside the hull do not count [m].
        #[schemars(with = "Vec<(f64, f64, f64)>")]
        points: Vec<DVec3>,
        /// Distance from the plane of a face that still counts as in it, as a share of the longest extent [1]. Default 1e-9.
        #[serde(default)]
        flat_within: Option<f64>,
    }
}

part! {
    /// The convex hull of the surface in a file; loading the scene turns it into a hull of points.
    #[derive(Default)]
    HullFilePart ["volume [kg/m³]"] {
        /// File with the surface, relative to the folder of the scene: Wavefront OBJ (`.obj`) or STL (`.stl`).
        file: String,
        /// Length of the file's unit [m]. Default 1.
        #[serde(default)]
        scale: Option<f64>,
        /// Distance from the plane of a face that still counts as in it, as a share of the longest extent [1]. Default 1e-6, for files are
        /// rounded to single precision.
        #[serde(default)]
        flat_within: Option<f64>,
    }
}

part! {
    /// All points p with normal · p ≤ offset, the normal made a unit vector first.
    HalfSpacePart [] {
        /// Direction out of the solid side; any length but zero [1]. Default (0, 1, 0): a floor.
        #[serde(default = "up")]
        #[schemars(with = "(f64, f64, f64)")]
        normal: DVec3,
        /// Distance of the surface from the origin of the design frame, along the normal [m]. Default 0.
        #[serde(default)]
        offset: f64,
    }
}

part! {
    /// Ground made of triangles, solid below each of them.
    #[derive(Default)]
    MeshPart [] {
        /// Corners [m].
        #[schemars(with = "Vec<(f64, f64, f64)>")]
        points: Vec<DVec3>,
        /// Triangles, as numbers of corners counted from 0; counter-clockwise seen from outside.
        triangles: Vec<(u32, u32, u32)>,
        /// Depth of solid ground below each triangle [m]: more than a body travels in a step.
        thickness: f64,
    }
}

part! {
    /// Ground made of the triangles in a file, solid below each of them; loading the scene turns it into a mesh.
    #[derive(Default)]
    MeshFilePart [] {
        /// File with the surface, relative to the folder of the scene: Wavefront OBJ (`.obj`) or STL (`.stl`); its triangles must be
        /// counter-clockwise seen from outside.
        file: String,
        /// Length of the file's unit [m]. Default 1.
        #[serde(default)]
        scale: Option<f64>,
        /// Depth of solid ground below each triangle [m]: more than a body travels in a step.
        thickness: f64,
    }
}

part! {
    /// Ground given by its heights over a grid, first along x, then along z, the first one at the origin; each cell is two triangles.
    #[derive(Default)]
    HeightFieldPart [] {
        /// Distance between heights along x and along z [m].
        spacing: (f64, f64),
        /// Rows of heights along x, from small z to large [m].
        heights: Vec<Vec<f64>>,
        /// Depth of solid ground below each triangle [m]: more than a body travels in a step.
        thickness: f64,
    }
}

/// A floor at the origin.
impl Default for HalfSpacePart {
    fn default() -> Self {
        Self { normal: up(), offset: 0.0, material: None, sensor: false, groups: None, collides_with: None }
    }
}

fn up() -> DVec3 {
    DVec3::Y
}

impl PartEntry for SpatialPart {
    fn shared(&self) -> Shared<'_> {
        match self {
            Self::Sphere(part) => part.shared(),
            Self::Box(part) => part.shared(),
            Self::Capsule(part) => part.shared(),
            Self::Rod(part) => part.shared(),
            Self::Cylinder(part) => part.shared(),
            Self::Cone(part) => part.shared(),
            Self::Hull(part) => part.shared(),
            Self::HullFile(part) => part.shared(),
            Self::HalfSpace(part) => part.shared(),
            Self::Mesh(part) => part.shared(),
            Self::MeshFile(part) => part.shared(),
            Self::HeightField(part) => part.shared(),
            Self::List(_) => Shared::default(),
        }
    }

    fn list(&self) -> Option<&str> {
        if let Self::List(name) = self { Some(name) } else { None }
    }

    fn without_mass(&self) -> Option<&'static str> {
        match self {
            Self::HalfSpace(_) => Some("a half-space"),
            Self::Mesh(_) | Self::MeshFile(_) => Some("a mesh"),
            Self::HeightField(_) => Some("a height field"),
            _ => None,
        }
    }
}
