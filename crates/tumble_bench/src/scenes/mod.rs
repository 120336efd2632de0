//! The scenes by name.

mod compounds;
mod growth;
mod planar;
mod spatial;

use tumble_math::{Planar, Spatial};

use crate::plan::Plan;

/// A plan of the plane or of space.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyPlan {
    /// Of the plane.
    Planar(Plan<Planar>),
    /// Of space.
    Spatial(Plan<Spatial>),
}

/// A scene of the list.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Its name.
    pub name: &'static str,
    /// What happens in it.
    pub about: &'static str,
    build: Build,
}

#[derive(Clone, Copy, Debug)]
enum Build {
    Planar(fn() -> Plan<Planar>),
    Spatial(fn() -> Plan<Spatial>),
}

impl Scene {
    const fn planar(name: &'static str, about: &'static str, build: fn() -> Plan<Planar>) -> Self {
        Self { name, about, build: Build::Planar(build) }
    }

    const fn spatial(name: &'static str, about: &'static str, build: fn() -> Plan<Spatial>) -> Self {
        Self { name, about, build: Build::Spatial(build) }
    }

    /// Its bodies.
    pub fn plan(&self) -> AnyPlan {
        match self.build {
            Build::Planar(build) => AnyPlan::Planar(Plan { name: self.name.to_owned(), ..build() }),
            Build::Spatial(build) => AnyPlan::Spatial(Plan { name: self.name.to_owned(), ..build() }),
        }
    }

    /// Whether it is of the plane.
    pub fn is_planar(&self) -> bool {
        matches!(self.build, Build::Planar(_))
    }
}

/// Every scene. A name with a dash is one size of a series.
pub const SCENES: &[Scene] = &[
    Scene::planar("pyramid2d", "pyramid of 100 rows of boxes", planar::pyramid),
    Scene::planar("many_pyramids2d", "400 pyramids of 10 rows on 20 shelves", planar::many_pyramids),
    Scene::planar("tumbler2d", "2025 boxes in a turning square drum", planar::tumbler),
    Scene::planar("rods2d", "2000 bodies of three crossed rods fall between walls", planar::rods),
    Scene::planar("rain2d", "1500 crosses, dumb-bells and clovers rain through pegs", compounds::rain),
    Scene::planar(
        "junkyard2d",
        "1500 angles, tees, channels and anchors in a yard with turning paddles",
        compounds::junkyard,
    ),
    Scene::planar("rod_one2d", "one rod on a floor: the cost of an almost empty step", planar::rod_one),
    Scene::spatial("pyramid3d", "square pyramid of 20 layers of cubes", spatial::pyramid),
    Scene::spatial("wall3d", "wall of 1000 bricks", spatial::wall),
    Scene::spatial("balls3d", "4096 balls fall into a pit", spatial::balls),
    Scene::spatial("drop3d", "1000 boxes, icosahedra and capsules fall into a pit", spatial::drop),
    Scene::spatial("tumbler3d", "1728 cubes in a turning box", spatial::tumbler),
    Scene::spatial("rod_one3d", "one square rod on a floor: the cost of an almost empty step", spatial::rod_one),
    Scene::planar("growth2d-1000", "7 pyramids: 1015 contacts", || growth::planar(7)),
    Scene::planar("growth2d-3000", "21 pyramids: 3045 contacts", || growth::planar(21)),
    Scene::planar("growth2d-10000", "69 pyramids: 10005 contacts", || growth::planar(69)),
    Scene::planar("growth2d-30000", "207 pyramids: 30015 contacts", || growth::planar(207)),
    Scene::planar("growth2d-100000", "690 pyramids: 100050 contacts", || growth::planar(690)),
    Scene::spatial("growth3d-1000", "4 square pyramids: 1024 contacts", || growth::spatial(4)),
    Scene::spatial("growth3d-3000", "12 square pyramids: 3072 contacts", || growth::spatial(12)),
    Scene::spatial("growth3d-10000", "39 square pyramids: 9984 contacts", || growth::spatial(39)),
    Scene::spatial("growth3d-30000", "117 square pyramids: 29952 contacts", || growth::spatial(117)),
    Scene::spatial("growth3d-100000", "391 square pyramids: 100096 contacts", || growth::spatial(391)),
];

/// No scene or series has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no scene `{name}`; there are: {}, and the series growth2d, growth3d", SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", "))]
pub struct UnknownScene {
    /// What was asked for.
    pub name: String,
}

/// The scene of a name, or all sizes of a series.
///
/// # Errors
///
/// When there is none of that name.
pub fn find(name: &str) -> Result<Vec<Scene>, UnknownScene> {
    let is_meant =
        |scene: &&Scene| scene.name == name || scene.name.split_once('-').is_some_and(|(series, _)| series == name);
    let found: Vec<Scene> = SCENES.iter().filter(is_meant).copied().collect();
    if found.is_empty() { Err(UnknownScene { name: name.to_owned() }) } else { Ok(found) }
}
