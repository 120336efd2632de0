//! Bodies that overlap at the start.
//!
//! An overlap deeper than the slop is pushed apart with a violence that nobody meant, so it is a mistake unless the scene says
//! `allow_overlap: true`.

use std::collections::BTreeMap;

use tumble_sim::Simulation;

use crate::build::{BuildError, FromScene};
use crate::diagnostics::Diagnostic;
use crate::dim::SceneDim;
use crate::format::Scene;
use crate::materials::MaterialLibrary;
use crate::path::ScenePath;

/// A mistake for every pair of bodies that overlaps by more than the slop at the start; none if the scene allows it.
///
/// # Errors
///
/// When a body cannot be simulated.
pub fn initial_overlaps<D: SceneDim>(
    scene: &Scene<D>,
    materials: &MaterialLibrary,
) -> Result<Vec<Diagnostic>, BuildError> {
    (D::scene_engine().overlaps)(scene, materials)
}

pub(crate) fn overlaps_at_start<D: SceneDim>(
    scene: &Scene<D>,
    materials: &MaterialLibrary,
) -> Result<Vec<Diagnostic>, BuildError> {
    if scene.allow_overlap {
        return Ok(Vec::new());
    }
    // A simulation of its own, because looking at contacts leaves memories that a run must not begin with.
    let mut simulation = Simulation::<D>::with_materials(scene, materials)?;
    simulation.detect()?;
    let mut deepest: BTreeMap<[u64; 2], f64> = BTreeMap::new();
    for (pair, overlap) in simulation.overlaps_deeper_than(scene.slop_or_default()) {
        let known = deepest.entry([pair.a.0, pair.b.0]).or_insert(overlap);
        *known = known.max(overlap);
    }
    let bodies = scene.expand();
    let place = |entry: usize| ScenePath::root().field("bodies").index(entry).field("name");
    let findings = deepest.into_iter().map(|([a, b], overlap)| {
        let [a, b] = [a, b].map(|id| &bodies[id as usize]);
        let (name_a, name_b) = (&a.body.name, &b.body.name);
        let message = format!("bodies \"{name_a}\" and \"{name_b}\" overlap by {overlap:.3e} m at the start");
        let label = format!("deeper than the slop of {} m", scene.slop_or_default());
        let finding = Diagnostic::error(message)
            .about(place(a.entry))
            .labelled(label)
            .help("move them apart, or say `allow_overlap: true`");
        if a.entry == b.entry { finding } else { finding.also_about(place(b.entry), "the other body") }
    });
    Ok(findings.collect())
}
