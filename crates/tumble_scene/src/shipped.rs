//! The scenes that come with the program, embedded so that it needs no files.

use std::path::Path;

use tumble_math::Planar;

use crate::diagnostics::{Diagnostics, nearest};
use crate::dim::SceneDim;
use crate::load::{AnyLoaded, Loaded};

/// A scene that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shipped {
    /// Its name, which is that of its file without `.ron`.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($folder:literal: $($name:literal),* $(,)?;)*) => {
        &[$($(Shipped {
            name: $name,
            text: include_str!(concat!("../../../assets/scenes/", $folder, "/", $name, ".ron")),
        },)*)*]
    };
}

/// Every shipped scene: those of the plane by name, then those of space.
pub const SHIPPED: &[Shipped] = shipped![
    "planar":
    "angle_of_repose",
    "arch",
    "beam_many_legs",
    "bouncing_ball",
    "bouncing_rod",
    "box_stack",
    "braking",
    "card_house",
    "dominoes",
    "double_pendulum",
    "drag_terminal_velocity",
    "hanging_chain",
    "head_on",
    "homework_rods",
    "homework_rods_impulse",
    "jammed_bracket",
    "ladder",
    "mass_ratio",
    "newtons_cradle",
    "overhang",
    "painleve",
    "pinned_rod_pendulum",
    "quiz_pushed_block",
    "rocking_block",
    "rod_hits_floor_at_angle",
    "rod_pile",
    "rolling_disc",
    "slider_crank",
    "spring_pendulum",
    "stick_slip",
    "stopping_distance",
    "three_discs",
    "thrown_uphill",
    "wedge";
    "spatial":
    "bouncing_49",
    "box_corner_impact",
    "box_stack_3d",
    "card_house_3d",
    "domino_spiral",
    "edge_edge",
    "elastic_666",
    "gyroscope",
    "incline_3d",
    "opening_pile",
    "pulled_board",
    "rattleback",
    "rolling_ball",
    "slip_to_roll",
    "spheres_666",
    "symmetric_precession",
    "t_handle",
    "table_four_legs",
    "tippe_top",
    "vertex_face";
];

/// The scene that runs when none is named.
pub const DEFAULT_SCENE: &str = "homework_rods";

impl Shipped {
    /// The scene of a name.
    pub fn named(name: &str) -> Option<Self> {
        SHIPPED.iter().copied().find(|scene| scene.name == name)
    }

    /// Names that may have been meant by one that does not exist: the nearest one, and those that contain it.
    pub fn near(name: &str) -> Vec<&'static str> {
        let names = || SHIPPED.iter().map(|scene| scene.name);
        let mut near: Vec<&str> = nearest(name, names()).into_iter().collect();
        let lower = name.to_lowercase();
        if !lower.is_empty() {
            near.extend(names().filter(|known| known.contains(&lower)));
        }
        near.sort_unstable();
        near.dedup();
        near
    }

    /// Reads a scene of the plane.
    ///
    /// # Errors
    ///
    /// For a scene of space: see [`load_any`](Self::load_any).
    pub fn load(self) -> Result<Loaded, Diagnostics> {
        (Planar::scene_engine().read)(self.text, Path::new(&self.origin()), None)
    }

    /// Reads a scene of either dimension.
    ///
    /// # Errors
    ///
    /// Never for a scene of [`SHIPPED`]: a test loads them all.
    pub fn load_any(self) -> Result<AnyLoaded, Diagnostics> {
        AnyLoaded::embedded(self.text, &self.origin())
    }

    fn origin(self) -> String {
        format!("{}.ron", self.name)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    #[test]
    fn the_table_is_the_folder() {
        let mut files = Vec::new();
        for folder in ["planar", "spatial"] {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes").join(folder);
            let entries = fs::read_dir(folder).expect("the folder of shipped scenes exists");
            let names = entries.map(|entry| entry.expect("readable").file_name().into_string().expect("a plain name"));
            let mut names: Vec<String> = names.collect();
            names.sort();
            files.append(&mut names);
        }
        let table: Vec<String> = SHIPPED.iter().map(|scene| format!("{}.ron", scene.name)).collect();
        assert_eq!(files, table, "add the new scene to the table, in alphabetical order");
    }

    #[test]
    fn every_shipped_scene_loads() {
        for scene in SHIPPED {
            if let Err(mistakes) = scene.load_any() {
                panic!("{mistakes}");
            }
        }
        assert!(Shipped::named(DEFAULT_SCENE).is_some());
    }

    #[test]
    fn a_slip_or_a_piece_leads_to_the_scene_that_was_meant() {
        assert_eq!(Shipped::near("newton_cradel"), ["newtons_cradle"]);
        assert_eq!(Shipped::near("homework"), ["homework_rods", "homework_rods_impulse"]);
        assert_eq!(Shipped::near("zebra"), [""; 0]);
        assert_eq!(Shipped::near(""), [""; 0]);
    }
}
