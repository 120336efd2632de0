//! An integration test of one's own scene. You will see a seesaw tip, and the test that keeps it tipping: load, run, check. In a project
//! of your own, the scene is a file beside the test, and `Scene::load("seesaw.ron")` reads it.

use std::error::Error;

use tumble::prelude::*;

const SCENE: &str = r#"(
    format: 1, about: "A child of 30 kg and one of 20 kg on a seesaw.", dt: 0.002, duration: 3,
    materials: { "wood": (static_friction: 0.6, kinetic_friction: 0.5) },
    bodies: [
        (name: "ground", kind: Static, material: "wood", parts: [HalfPlane()]),
        (name: "pivot", kind: Static, material: "wood", parts: [Polygon(points: [(-0.3, 0), (0.3, 0), (0, 0.5)])]),
        (name: "plank", at: (0, 0.55), material: "wood", parts: [Box(size: (4, 0.1), density: 50)]),
        (name: "heavy", at: (-1.5, 0.85), material: "wood", parts: [Box(size: (0.4, 0.5), mass: 30)]),
        (name: "light", at: (1.5, 0.85), material: "wood", parts: [Box(size: (0.4, 0.5), mass: 20)]),
    ],
    expect: [
        Angle(of: "plank", at: 3, above_degrees: 5, below_degrees: 20, because: "it tips to the heavy side until its end is on the ground: asin(0.5/2) at most"),
        Y(of: "light", at: 3, above: 0.9, because: "the lighter child is up"),
        Y(of: "heavy", at: 3, below: 0.7, because: "the heavier child is down"),
        Order(events: [Touch("plank", "pivot"), Touch("plank", "ground")], because: "it stands on the pivot first"),
        Depth(below: 0.01, because: "the slop, and what a step of impact adds"),
        EnergyNeverRises(slack: 1e-6, because: "nobody pushes, and impacts take energy; rounding"),
    ],
)"#;

/// What a test in `tests/` would contain.
fn seesaw_tips_to_the_heavy_side() -> Result<Verdict, Box<dyn Error>> {
    let mut simulation = Simulation::from_loaded(&Scene::parse(SCENE, "seesaw.ron")?)?;
    simulation.run_scene()?;
    let verdict = simulation.check();
    assert!(verdict.passed(), "{verdict}");
    Ok(verdict)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("{}", seesaw_tips_to_the_heavy_side()?);
    Ok(())
}
