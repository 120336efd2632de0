//! Scenes and expectations in code. You will see a scene built from plain data, its verdict line by line, a world written as a RON file, and that the
//! world which is read back moves the same to the last bit.

use std::error::Error;

use tumble::prelude::*;
use tumble::scene::format::{BodyEntry, DiscPart, HalfPlanePart, MaterialEntry, Part as PartEntry};

/// A disc falls on a floor.
fn scene() -> Scene {
    let floor = BodyEntry {
        name: "floor".into(),
        kind: tumble::scene::format::BodyKind::Static,
        parts: vec![PartEntry::HalfPlane(HalfPlanePart::default())],
        ..BodyEntry::default()
    };
    let ball = BodyEntry {
        name: "ball".into(),
        at: dvec2(0.0, 2.0),
        material: Some("rubber".into()),
        parts: vec![PartEntry::Disc(DiscPart { radius: 0.1, ..DiscPart::default() })],
        ..BodyEntry::default()
    };
    let rubber = MaterialEntry { restitution: Some(0.6), ..MaterialEntry::default() };
    Scene {
        about: "A ball bounces.".into(),
        dt: 0.001,
        duration: 1.2,
        materials: [("rubber".to_owned(), rubber)].into(),
        bodies: vec![floor, ball],
        expect: vec![Expectation::VelocityY(ScalarExpectation {
            of: "ball".into(),
            at: Some(0.5),
            is: Some(-4.905),
            within: Some(1e-9),
            because: "−g t, exact for symplectic Euler".into(),
            ..ScalarExpectation::default()
        })],
        ..Scene::default()
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = Simulation::from_scene(&scene())?;
    // Expectations can be added to a simulation, too.
    simulation.expect(Expectation::Y(ScalarExpectation {
        of: "ball".into(),
        at: Some(0.988),
        is: Some(0.1 + 0.36 * 1.9),
        within: Some(0.02),
        because: "the apex: ε² of the drop, at (1 + ε) √(2 h/g); first order, g t Δt".into(),
        ..ScalarExpectation::default()
    }));
    let written = simulation.to_scene()?;
    simulation.run_scene()?;
    let verdict = simulation.check();
    println!("{verdict}\n\nThe same world as a file:\n\n{}", written.to_ron());
    assert!(verdict.passed() && verdict.count(Status::Met) == 2);

    let mut again = Simulation::from_loaded(&Scene::parse(&written.to_ron(), "written.ron")?)?;
    again.run_scene()?;
    assert!(again.check().passed());
    let [first, second] = [&mut simulation, &mut again].map(|simulation| {
        let recording = simulation.recording()?;
        recording.samples.last().map(|last| recording.fingerprint(last))
    });
    println!("fingerprints: {} and {}", first.ok_or("no sample")?, second.ok_or("no sample")?);
    assert_eq!(first, second);
    Ok(())
}
