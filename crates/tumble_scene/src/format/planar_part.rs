//! Parts of the plane: the shapes a body is made of, in its design frame.

use glam::{DVec2, dvec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Groups;
use super::part::{PartEntry, Shared, part};

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

part! {
    /// A straight rod; with a radius, the rod of all points that close to the segment between its ends.
    #[derive(Default)]
    RodPart ["length [kg/m]"] {
        /// One end [m].
        #[schemars(with = "(f64, f64)")]
        from: DVec2,
        /// The other end [m].
        #[schemars(with = "(f64, f64)")]
        to: DVec2,
        /// Half the thickness [m]; it counts for contact, not for mass. Default 0.
        #[serde(default)]
        radius: f64,
    }
}

part! {
    /// A disc.
    #[derive(Default)]
    DiscPart ["area [kg/m²]"] {
        /// Radius [m].
        radius: f64,
        /// Its centre [m]. Default (0, 0).
        #[serde(default)]
        #[schemars(with = "(f64, f64)")]
        at: DVec2,
    }
}

part! {
    /// A convex polygon.
    #[derive(Default)]
    PolygonPart ["area [kg/m²]"] {
        /// Corners, at least three, in order around the polygon, either way round [m].
        #[schemars(with = "Vec<(f64, f64)>")]
        points: Vec<DVec2>,
    }
}

part! {
    /// A rectangle.
    #[derive(Default)]
    BoxPart ["area [kg/m²]"] {
        /// Full width and height [m].
        #[schemars(with = "(f64, f64)")]
        size: DVec2,
        /// Its centre [m]. Default (0, 0).
        #[serde(default)]
        #[schemars(with = "(f64, f64)")]
        at: DVec2,
        /// Its angle in the design frame, counter-clockwise [degrees]. Default 0.
        #[serde(default)]
        angle_degrees: f64,
    }
}

part! {
    /// All points p with normal · p ≤ offset, the normal made a unit vector first.
    HalfPlanePart [] {
        /// Direction out of the solid side; any length but zero [1]. Default (0, 1): a floor.
        #[serde(default = "up")]
        #[schemars(with = "(f64, f64)")]
        normal: DVec2,
        /// Distance of the surface from the origin of the design frame, along the normal [m]. Default 0.
        #[serde(default)]
        offset: f64,
    }
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

impl PartEntry for Part {
    fn shared(&self) -> Shared<'_> {
        match self {
            Self::Rod(part) => part.shared(),
            Self::Disc(part) => part.shared(),
            Self::Polygon(part) => part.shared(),
            Self::Box(part) => part.shared(),
            Self::HalfPlane(part) => part.shared(),
            Self::List(_) => Shared::default(),
        }
    }

    fn list(&self) -> Option<&str> {
        if let Self::List(name) = self { Some(name) } else { None }
    }

    fn without_mass(&self) -> Option<&'static str> {
        matches!(self, Self::HalfPlane(_)).then_some("a half-plane")
    }
}
