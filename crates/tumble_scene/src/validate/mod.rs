//! What a well-written file can still get wrong: names that do not exist, quantities that mean nothing, times past the end.

mod bodies;
mod expectations;
mod finite;
mod forces;
mod joints;
mod materials;
mod settings;
mod words;

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostic, nearest_or_all};
use crate::dim::SceneDim;
use crate::expand::{MOST_BODIES, copies, count};
use crate::format::Scene;
use crate::materials::MaterialLibrary;
use crate::path::ScenePath;

pub(crate) use joints::open_joints;
pub(crate) use materials::check_table;

/// Every mistake and warning of a scene.
///
/// Initial overlap is not looked for here: it needs collision detection, so whoever builds the world adds it with
/// [`Loaded::diagnose`](crate::Loaded::diagnose).
pub fn validate<D: SceneDim>(scene: &Scene<D>, library: &MaterialLibrary) -> Vec<Diagnostic> {
    (D::scene_engine().validate)(scene, library)
}

pub(crate) fn findings<D: SceneDim>(scene: &Scene<D>, library: &MaterialLibrary) -> Vec<Diagnostic> {
    let mut found = Findings { list: finite::check(scene) };
    // Comparisons below assume finite numbers.
    if !found.list.is_empty() {
        return found.list;
    }
    let bodies = bodies::BodyNames::of(scene);
    words::check(scene, &mut found);
    settings::check(scene, &mut found);
    materials::check(scene, &mut found);
    bodies::check(scene, library, &bodies, &mut found);
    forces::check(scene, &bodies, &mut found);
    joints::check(scene, &bodies, &mut found);
    expectations::check(scene, &bodies, &mut found);
    if found.list.is_empty() {
        materials::notices(scene, library, &mut found);
    }
    found.list
}

/// Collects mistakes.
struct Findings {
    list: Vec<Diagnostic>,
}

impl Findings {
    fn add(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    fn error(&mut self, path: &ScenePath, message: impl Into<String>, label: impl Into<String>) {
        self.add(Diagnostic::error(message).about(path.clone()).labelled(label));
    }

    fn warning(&mut self, path: &ScenePath, message: impl Into<String>, label: impl Into<String>) {
        self.add(Diagnostic::warning(message).about(path.clone()).labelled(label));
    }

    fn positive(&mut self, path: &ScenePath, what: &str, value: f64) {
        if value <= 0.0 {
            self.error(path, format!("{what} must be positive"), format!("{value} is not above 0"));
        }
    }

    fn not_negative(&mut self, path: &ScenePath, what: &str, value: f64) {
        if value < 0.0 {
            self.error(path, format!("{what} must not be negative"), format!("{value} is below 0"));
        }
    }

    /// Reports a name that is not among the allowed ones.
    fn unknown(&mut self, path: &ScenePath, kind: &str, name: &str, allowed: &[&str]) {
        let (label, help) = nearest_or_all(name, kind, allowed);
        let message = format!("there is no {kind} \"{name}\"");
        let mut diagnostic = Diagnostic::error(message).about(path.clone()).labelled(label).help(help);
        diagnostic.needs_all_names = true;
        self.add(diagnostic);
    }
}

/// Names of single bodies, repeats unrolled; too large repeats are left out.
fn single_names<D: SceneDim>(scene: &Scene<D>) -> BTreeSet<String> {
    let small = scene.bodies.iter().filter(|entry| count(entry) <= MOST_BODIES);
    small.flat_map(|entry| copies(entry).map(|copy| copy.name)).collect()
}
