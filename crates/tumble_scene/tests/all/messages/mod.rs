//! What a user reads when a scene is wrong: one test per kind of mistake, the whole message each time.

mod bodies;
mod characters;
mod expectations;
mod fields;
mod forces;
mod joints;
mod materials;
mod parts;
mod settings;
mod several;
mod space;
mod syntax;
mod warnings;

use tumble_scene::format::Scene;

/// The message about a scene that must be refused.
fn mistakes(text: &str) -> String {
    Scene::parse(text, "scene.ron").expect_err("the scene is wrong").to_string()
}

/// The message about a scene that may be run all the same.
fn warnings(text: &str) -> String {
    let loaded = Scene::parse(text, "scene.ron").unwrap_or_else(|mistakes| panic!("{mistakes}"));
    loaded.warnings.to_string()
}
