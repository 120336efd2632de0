//! `tumble check`: mistakes, warnings, masses and surfaces of scenes, without running anything.

use tumble_math::{Planar, Spatial, SymmetricTensor, Vector};
use tumble_scene::materials::ResolvedPair;
use tumble_scene::{AnyLoaded, FromScene, Loaded, SceneDim, meetings};
use tumble_sim::{BodyKind, BodyTable, Simulation};

use crate::args::CheckArguments;
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::{Column, counted, figure, table};
use crate::page::Page;
use crate::source::Source;

/// Checks every scene, and goes on after one with mistakes.
pub fn check(arguments: &CheckArguments, page: &mut Page) -> Result<Exit, Failure> {
    let mut exit = Exit::Fine;
    for (index, word) in arguments.scenes.iter().enumerate() {
        if index > 0 {
            page.line("");
        }
        if let Err(failure) = Source::of(word).and_then(|source| check_one(&source, page)) {
            page.line(format!("{}: FAILED", word.display()));
            exit = failure.tell();
        }
    }
    Ok(exit)
}

fn check_one(source: &Source, page: &mut Page) -> Result<(), Failure> {
    match source.load()? {
        AnyLoaded::Planar(loaded) => check_loaded(source, &loaded, page),
        AnyLoaded::Spatial(loaded) => check_loaded(source, &loaded, page),
    }
}

fn check_loaded<D: Moments>(source: &Source, loaded: &Loaded<D>, page: &mut Page) -> Result<(), Failure> {
    let simulation = Simulation::from_loaded(loaded).map_err(|error| Failure::of_build(&source.label(), error))?;
    if !loaded.warnings.is_empty() {
        tell(loaded.warnings.render(stderr_color()));
    }
    page.line(format!("{}: {}", source.label(), contents(loaded, &simulation)));
    page.line("");
    for line in masses(&simulation) {
        page.line(line);
    }
    let surfaces = surfaces(loaded);
    if !surfaces.is_empty() {
        page.line("");
    }
    for line in surfaces {
        page.line(line);
    }
    Ok(())
}

/// What is in the scene, in a line.
fn contents<D: SceneDim>(loaded: &Loaded<D>, simulation: &Simulation<D>) -> String {
    let scene = &loaded.scene;
    let bodies = simulation.world().resource::<BodyTable>().entries().len();
    let mut counts = vec![(bodies, "body")];
    counts.extend([
        (scene.springs.len(), "spring"),
        (scene.joints.len(), "joint"),
        (scene.forces.len(), "force"),
        (scene.expect.len(), "expectation"),
    ]);
    counts.push((loaded.warnings.len(), "warning"));
    let words = counts.iter().filter(|(count, _)| *count > 0).map(|(count, one)| match *one {
        "body" if *count != 1 => format!("{count} bodies"),
        one => counted(*count as u64, one),
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { "empty".to_owned() } else { words.join(", ") }
}

/// How inertia is printed.
trait Moments: SceneDim {
    /// Heads of the columns of a centre of mass and of an inertia.
    const HEADS: &'static [&'static str];

    /// An inertia, a number for each of its columns.
    fn moments(inertia: Self::Inertia) -> Vec<f64>;
}

impl Moments for Planar {
    const HEADS: &'static [&'static str] = &["centre x [m]", "y [m]", "inertia [kg·m²]"];

    fn moments(inertia: f64) -> Vec<f64> {
        vec![inertia]
    }
}

impl Moments for Spatial {
    const HEADS: &'static [&'static str] = &[
        "centre x [m]",
        "y [m]",
        "z [m]",
        "Ixx [kg·m²]",
        "Iyy",
        "Izz",
        "Ixy",
        "Ixz",
        "Iyz",
        "principal moments",
        "",
        "",
    ];

    fn moments(inertia: SymmetricTensor) -> Vec<f64> {
        let (d, o) = (inertia.diagonal, inertia.off_diagonal);
        [d.x, d.y, d.z, o.z, o.y, o.x].into_iter().chain(inertia.principal_moments()).collect()
    }
}

/// Mass, centre of mass at the start and inertia of every body, in space along the axes of its design frame.
fn masses<D: Moments>(simulation: &Simulation<D>) -> Vec<String> {
    let heads = ["body", "kind", "mass [kg]"].iter().chain(D::HEADS);
    let mut rows = vec![heads.map(|&head| head.to_owned()).collect::<Vec<String>>()];
    for entry in simulation.world().resource::<BodyTable>().entries() {
        let Ok(body) = simulation.body(&entry.name) else { continue };
        let centre = body.position();
        // What no force moves has no mass that matters.
        let of_mass = |value: f64| if entry.kind == BodyKind::Dynamic { figure(value) } else { "-".to_owned() };
        let kind = match entry.kind {
            BodyKind::Dynamic => "dynamic",
            BodyKind::Kinematic => "kinematic",
            BodyKind::Static => "static",
        };
        let mut row = vec![entry.name.clone(), kind.to_owned(), of_mass(body.mass())];
        row.extend((0..D::Vector::AXES).map(|axis| figure(centre[axis])));
        row.extend(D::moments(body.inertia()).into_iter().map(of_mass));
        rows.push(row);
    }
    let columns: Vec<Column> =
        (0..rows[0].len()).map(|index| if index < 2 { Column::Left } else { Column::Right }).collect();
    table(&columns, &rows)
}

/// Friction and restitution of every pair of materials that can meet, each with where it came from; nothing without such pairs.
fn surfaces<D: SceneDim>(loaded: &Loaded<D>) -> Vec<String> {
    let heads = ["material", "on", "μ_s [1]", "from", "μ_k [1]", "from", "ε [1]", "from"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for meeting in meetings(&loaded.scene) {
        let [a, b] = meeting.materials;
        let ResolvedPair { properties, origins, .. } = loaded.materials.pair(&a, &b);
        rows.push(vec![
            a,
            b,
            figure(properties.static_friction),
            origins.static_friction.to_string(),
            figure(properties.kinetic_friction),
            origins.kinetic_friction.to_string(),
            figure(properties.restitution),
            origins.restitution.to_string(),
        ]);
    }
    use Column::{Left, Right};
    if rows.len() == 1 { Vec::new() } else { table(&[Left, Left, Right, Left, Right, Left, Right, Left], &rows) }
}
