//! Bodies that overlap at the start.

use tumble_scene::format::Scene;
use tumble_scene::{BuildError, FromScene, Loaded, initial_overlaps};
use tumble_sim::Simulation;

/// Two discs of radius 1 whose centres are this far apart [m].
fn discs(distance: f64, settings: &str) -> Loaded {
    let text = format!(
        r#"(
    format: 1, duration: 1, {settings}
    bodies: [
        (name: "left", parts: [Disc(radius: 1)]),
        (name: "right", at: ({distance}, 0), parts: [Disc(radius: 1)]),
    ],
)"#
    );
    Scene::parse(&text, "discs.ron").unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn overlap_deeper_than_the_slop_is_a_mistake_with_both_places() {
    let loaded = discs(1.75, "");
    let Err(BuildError::Scene(mistakes)) = Simulation::from_loaded(&loaded) else { panic!("it was built") };
    let words = mistakes.to_string();
    assert_eq!(mistakes.len(), 1, "{words}");
    for part in ["bodies \"left\" and \"right\" overlap by 2.500e-1 m", "discs.ron:4:", "the other body"] {
        assert!(words.contains(part), "no `{part}` in:\n{words}");
    }
}

#[test]
fn scenes_made_in_code_are_checked_too() {
    assert!(matches!(Simulation::from_scene(&discs(1.75, "").scene), Err(BuildError::Scene(_))));
    assert!(Simulation::from_scene(&discs(1.999, "").scene).is_ok());
}

#[test]
fn the_slop_of_the_scene_decides() {
    // The slop is 0.005 m by default; the overlap is 2 m less the distance.
    for (distance, settings, count) in [
        (1.996, "", 0),
        (1.994, "", 1),
        (1.994, "slop: 0.01,", 0),
        (1.996, "slop: 0,", 1),
        (1.9, "allow_overlap: true,", 0),
        (2.0, "slop: 0,", 0),
    ] {
        let loaded = discs(distance, settings);
        let found = initial_overlaps(&loaded.scene, &loaded.materials).expect("it can be built");
        assert_eq!(found.len(), count, "{distance} {settings}");
    }
}

#[test]
fn bodies_that_pass_through_each_other_may_overlap() {
    let mut loaded = discs(0.5, "");
    loaded.scene.bodies[0].ignores = vec!["right".to_owned()];
    assert!(Simulation::from_loaded(&loaded).is_ok());
}
