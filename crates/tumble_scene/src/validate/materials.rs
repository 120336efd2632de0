//! Figures of materials and pairs, and notices about those that a scene uses.

use std::collections::{BTreeMap, BTreeSet};

use tumble_math::Planar;

use super::Findings;
use crate::diagnostics::Diagnostic;
use crate::dim::SceneDim;
use crate::format::{Coefficient, Dialect, FrictionEntry, MaterialEntry, MaterialTable, PairEntry, Scene};
use crate::materials::MaterialLibrary;
use crate::meetings::{Meeting, meetings};
use crate::path::ScenePath;

/// Every mistake of a table.
pub(crate) fn check_table(table: &MaterialTable) -> Vec<Diagnostic> {
    let mut found = Findings { list: Vec::new() };
    if table.format != Scene::<Planar>::FORMAT {
        let label = format!("this version of tumble reads format {}", Scene::<Planar>::FORMAT);
        found.error(&ScenePath::root().field("format"), format!("format {} is not known", table.format), label);
    }
    figures(&table.materials, &table.pairs, &mut found);
    found.list
}

pub(super) fn check<D: Dialect>(scene: &Scene<D>, found: &mut Findings) {
    figures(&scene.materials, &scene.pairs, found);
}

fn figures(materials: &BTreeMap<String, MaterialEntry>, pairs: &[PairEntry], found: &mut Findings) {
    for (name, material) in materials {
        let path = ScenePath::root().field("materials").key(name);
        friction(&path, material.static_friction, material.kinetic_friction, found);
        restitution(&path, material.restitution, found);
    }
    let mut listed: BTreeMap<BTreeSet<&str>, usize> = BTreeMap::new();
    for (index, pair) in pairs.iter().enumerate() {
        let path = ScenePath::root().field("pairs").index(index);
        let (a, b) = &pair.between;
        if let Some(first) = listed.insert(BTreeSet::from([a.as_str(), b.as_str()]), index) {
            let first_path = ScenePath::root().field("pairs").index(first).field("between");
            let message = format!("the pair \"{a}\" and \"{b}\" is listed twice");
            let diagnostic = Diagnostic::error(message).about(path.field("between")).labelled("again here");
            found.add(diagnostic.also_about(first_path, "first here"));
        }
        for (state, FrictionEntry { static_friction, kinetic_friction, .. }) in
            [("dry", &pair.dry), ("lubricated", &pair.lubricated)]
        {
            friction(&path.field(state), *static_friction, *kinetic_friction, found);
        }
        restitution(&path, pair.restitution, found);
    }
}

fn friction(path: &ScenePath, of_rest: Option<Coefficient>, of_motion: Option<Coefficient>, found: &mut Findings) {
    for (field, coefficient) in [("static_friction", of_rest), ("kinetic_friction", of_motion)] {
        let Some(Coefficient { low, high }) = coefficient else { continue };
        let path = path.field(field);
        if low > high {
            found.error(&path, "a range goes from low to high", format!("{low} is above {high}"));
        }
        found.not_negative(&path, "a friction coefficient", low.min(high));
    }
}

fn restitution(path: &ScenePath, restitution: Option<f64>, found: &mut Findings) {
    let Some(restitution) = restitution else { return };
    if !(0.0..=1.0).contains(&restitution) {
        let message = "restitution must be from 0 to 1";
        found.error(&path.field("restitution"), message, format!("{restitution} is outside"));
    }
}

/// Notices about every pair of materials that can meet in the scene.
pub(super) fn notices<D: SceneDim>(scene: &Scene<D>, library: &MaterialLibrary, found: &mut Findings) {
    for Meeting { materials: [a, b], places: [place_a, place_b] } in meetings(scene) {
        for notice in library.pair(&a, &b).notices {
            let diagnostic = Diagnostic::warning(format!("\"{a}\" on \"{b}\": {notice}"));
            let diagnostic = diagnostic.about(place_a.clone()).labelled("used here");
            let is_one_place = place_a == place_b;
            found.add(if is_one_place { diagnostic } else { diagnostic.also_about(place_b.clone(), "and here") });
        }
    }
}
