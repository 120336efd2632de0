//! Words that belong to the other dimension. A file with them is refused when it is read; scenes built in code get here.

use super::Findings;
use crate::dim::SceneDim;
use crate::format::{Expectation, JointForcePart, Scene};
use crate::path::ScenePath;

pub(super) fn check<D: SceneDim>(scene: &Scene<D>, found: &mut Findings) {
    let mut check = |path: ScenePath, of: &str, word: &str| {
        if D::FOREIGN_WORDS.contains(&(of, word)) {
            found.error(&path, format!("a scene that is {} knows no {word}", D::WORD), "only for the other dimension");
        }
    };
    for (index, body) in scene.bodies.iter().enumerate() {
        for (number, axis) in body.locked.iter().enumerate() {
            let path = ScenePath::root().field("bodies").index(index).field("locked").index(number);
            check(path, "Axis", &format!("{axis:?}"));
        }
    }
    for (index, expectation) in scene.expect.iter().enumerate() {
        let path = ScenePath::root().field("expect").index(index);
        check(path.clone(), "Expectation", expectation.name());
        if let Expectation::JointForce(e) = expectation
            && e.part == JointForcePart::Z
        {
            check(path.field("part"), "JointForcePart", "Z");
        }
    }
}
