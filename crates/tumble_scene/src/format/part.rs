//! Parts of the plane: the shapes a body is made of, in its design frame.

use std::fmt::Debug;

use glam::{DVec2, dvec2};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::Groups;

/// A shape of a body. Its mass comes from `density` or `mass`; with neither, the density is 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Part {
    /// A straight rod, thin unless it has a radius.
    Rod(RodPart),
    /// A disc.
    Disc(DiscPart),
    /// A convex polygon.
    Polygon(PolygonPart),
    /// A rectangle.
    Box(BoxPart),
    /// Everything below a straight line: a floor, a wall or a slope. Only for bodies that forces do not move.
    HalfPlane(HalfPlanePart),
    /// All parts of a named list.
    List(String),
}

/// A straight rod; with a radius, the rod of all points that close to the segment between its ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RodPart {
    /// One end [m].
    #[schemars(with = "(f64, f64)")]
    pub from: DVec2,
    /// The other end [m].
    #[schemars(with = "(f64, f64)")]
    pub to: DVec2,
    /// Half the thickness [m]; it counts for contact, not for mass. Default 0.
    #[serde(default)]
    pub radius: f64,
    /// Mass per length [kg/m]. Default 1, unless `mass` is given.
    #[serde(default)]
    pub density: Option<f64>,
    /// Mass [kg], instead of a density.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Material. Default that of the body.
    #[serde(default)]
    pub material: Option<String>,
    /// Whether touching is only reported, without any response. Default false.
    #[serde(default)]
    pub sensor: bool,
    /// Collision groups of this part. Default those of the body.
    #[serde(default)]
    pub groups: Option<Groups>,
    /// Collision groups this part collides with. Default those of the body.
    #[serde(default)]
    pub collides_with: Option<Groups>,
}

/// A disc.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiscPart {
    /// Radius [m].
    pub radius: f64,
    /// Its centre [m]. Default (0, 0).
    #[serde(default)]
    #[schemars(with = "(f64, f64)")]
    pub at: DVec2,
    /// Mass per area [kg/m²]. Default 1, unless `mass` is given.
    #[serde(default)]
    pub density: Option<f64>,
    /// Mass [kg], instead of a density.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Material. Default that of the body.
    #[serde(default)]
    pub material: Option<String>,
    /// Whether touching is only reported, without any response. Default false.
    #[serde(default)]
    pub sensor: bool,
    /// Collision groups of this part. Default those of the body.
    #[serde(default)]
    pub groups: Option<Groups>,
    /// Collision groups this part collides with. Default those of the body.
    #[serde(default)]
    pub collides_with: Option<Groups>,
}

/// A convex polygon.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PolygonPart {
    /// Corners, at least three, in order around the polygon, either way round [m].
    #[schemars(with = "Vec<(f64, f64)>")]
    pub points: Vec<DVec2>,
    /// Mass per area [kg/m²]. Default 1, unless `mass` is given.
    #[serde(default)]
    pub density: Option<f64>,
    /// Mass [kg], instead of a density.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Material. Default that of the body.
    #[serde(default)]
    pub material: Option<String>,
    /// Whether touching is only reported, without any response. Default false.
    #[serde(default)]
    pub sensor: bool,
    /// Collision groups of this part. Default those of the body.
    #[serde(default)]
    pub groups: Option<Groups>,
    /// Collision groups this part collides with. Default those of the body.
    #[serde(default)]
    pub collides_with: Option<Groups>,
}

/// A rectangle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxPart {
    /// Full width and height [m].
    #[schemars(with = "(f64, f64)")]
    pub size: DVec2,
    /// Its centre [m]. Default (0, 0).
    #[serde(default)]
    #[schemars(with = "(f64, f64)")]
    pub at: DVec2,
    /// Its angle in the design frame, counter-clockwise [degrees]. Default 0.
    #[serde(default)]
    pub angle_degrees: f64,
    /// Mass per area [kg/m²]. Default 1, unless `mass` is given.
    #[serde(default)]
    pub density: Option<f64>,
    /// Mass [kg], instead of a density.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Material. Default that of the body.
    #[serde(default)]
    pub material: Option<String>,
    /// Whether touching is only reported, without any response. Default false.
    #[serde(default)]
    pub sensor: bool,
    /// Collision groups of this part. Default those of the body.
    #[serde(default)]
    pub groups: Option<Groups>,
    /// Collision groups this part collides with. Default those of the body.
    #[serde(default)]
    pub collides_with: Option<Groups>,
}

/// All points p with normal · p ≤ offset, the normal made a unit vector first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HalfPlanePart {
    /// Direction out of the solid side; any length but zero [1]. Default (0, 1): a floor.
    #[serde(default = "up")]
    #[schemars(with = "(f64, f64)")]
    pub normal: DVec2,
    /// Distance of the surface from the origin of the design frame, along the normal [m]. Default 0.
    #[serde(default)]
    pub offset: f64,
    /// Material. Default that of the body.
    #[serde(default)]
    pub material: Option<String>,
    /// Whether touching is only reported, without any response. Default false.
    #[serde(default)]
    pub sensor: bool,
    /// Collision groups of this part. Default those of the body.
    #[serde(default)]
    pub groups: Option<Groups>,
    /// Collision groups this part collides with. Default those of the body.
    #[serde(default)]
    pub collides_with: Option<Groups>,
}

/// A floor at the origin.
impl Default for HalfPlanePart {
    fn default() -> Self {
        Self { normal: up(), offset: 0.0, material: None, sensor: false, groups: None, collides_with: None }
    }
}

fn up() -> DVec2 {
    dvec2(0.0, 1.0)
}

/// What the shapes of the plane and of space have in common.
pub trait PartEntry:
    Clone + Debug + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// The material that the part itself names.
    fn material(&self) -> Option<&str>;

    /// The collision groups that the part itself names, and those it collides with.
    fn groups(&self) -> (Option<&Groups>, Option<&Groups>);

    /// Whether touching is only reported.
    fn is_sensor(&self) -> bool;

    /// The density and the mass as written; ground has neither.
    fn density_and_mass(&self) -> (Option<f64>, Option<f64>);

    /// The name of the list whose parts it stands for.
    fn list(&self) -> Option<&str>;

    /// What it is called, for one that has no end and no mass, so that forces cannot move it.
    fn without_mass(&self) -> Option<&'static str>;
}

impl PartEntry for Part {
    fn material(&self) -> Option<&str> {
        match self {
            Self::Rod(rod) => rod.material.as_deref(),
            Self::Disc(disc) => disc.material.as_deref(),
            Self::Polygon(polygon) => polygon.material.as_deref(),
            Self::Box(rectangle) => rectangle.material.as_deref(),
            Self::HalfPlane(plane) => plane.material.as_deref(),
            Self::List(_) => None,
        }
    }

    fn groups(&self) -> (Option<&Groups>, Option<&Groups>) {
        match self {
            Self::Rod(rod) => (rod.groups.as_ref(), rod.collides_with.as_ref()),
            Self::Disc(disc) => (disc.groups.as_ref(), disc.collides_with.as_ref()),
            Self::Polygon(polygon) => (polygon.groups.as_ref(), polygon.collides_with.as_ref()),
            Self::Box(rectangle) => (rectangle.groups.as_ref(), rectangle.collides_with.as_ref()),
            Self::HalfPlane(plane) => (plane.groups.as_ref(), plane.collides_with.as_ref()),
            Self::List(_) => (None, None),
        }
    }

    fn is_sensor(&self) -> bool {
        match self {
            Self::Rod(rod) => rod.sensor,
            Self::Disc(disc) => disc.sensor,
            Self::Polygon(polygon) => polygon.sensor,
            Self::Box(rectangle) => rectangle.sensor,
            Self::HalfPlane(plane) => plane.sensor,
            Self::List(_) => false,
        }
    }

    fn density_and_mass(&self) -> (Option<f64>, Option<f64>) {
        match self {
            Self::Rod(rod) => (rod.density, rod.mass),
            Self::Disc(disc) => (disc.density, disc.mass),
            Self::Polygon(polygon) => (polygon.density, polygon.mass),
            Self::Box(rectangle) => (rectangle.density, rectangle.mass),
            Self::HalfPlane(_) | Self::List(_) => (None, None),
        }
    }
    fn list(&self) -> Option<&str> {
        if let Self::List(name) = self { Some(name) } else { None }
    }

    fn without_mass(&self) -> Option<&'static str> {
        matches!(self, Self::HalfPlane(_)).then_some("a half-plane")
    }
}
