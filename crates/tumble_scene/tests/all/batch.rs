//! Many runs of one scene: every run is that of its own scene, whichever others run.

use std::num::NonZero;

use tumble_math::Spatial;
use tumble_record::Record;
use tumble_scene::format::Scene;
use tumble_scene::{Batch, BatchError, Check, FromScene, Loaded, Variation};
use tumble_sim::Simulation;

type Fallible<T = ()> = Result<T, Box<dyn std::error::Error>>;

const ROD: &str = r#"(
    format: 1, duration: 0.5, dt: 0.01,
    materials: { "rubber": (static_friction: 0.8, kinetic_friction: 0.6, restitution: 0.5) },
    bodies: [
        (name: "floor", kind: Static, parts: [HalfPlane()]),
        (name: "rod 1.5", at: (0, 0.6), angle_degrees: 20, material: "rubber", parts: [Rod(from: (-0.5, 0), to: (0.5, 0))]),
    ],
)"#;

fn varied(texts: &[&str]) -> Vec<Variation> {
    texts.iter().map(|text| text.parse().expect("a variation")).collect()
}

const VARIED: [&str; 4] = [
    "bodies.rod 1.5.velocity.x=-2..2",
    "gravity.y=-12..-8",
    "materials.rubber.restitution=0..0.9",
    "bodies.rod 1.5.mass=1..3",
];

#[test]
fn every_run_is_that_of_its_scene_on_any_number_of_threads() -> Fallible {
    let loaded = Scene::parse(ROD, "rod.ron")?;
    let batch = Batch::new(&loaded, varied(&VARIED), 7)?.showing(vec!["x:rod 1.5".parse()?, "kinetic".parse()?])?;
    let runs = batch.run_all(0..40, None);
    assert_eq!(runs, batch.run_all(0..40, NonZero::new(1)));
    assert_eq!(runs[10..20], batch.run_all(10..20, NonZero::new(3)));
    for run in &runs {
        let end = run.end.as_ref().map_err(|failure| failure.to_string())?;
        let scene = batch.scene(run.number)?;
        assert_eq!(scene.bodies[1].velocity.x, run.values[0]);
        assert_eq!((scene.gravity.y, scene.bodies[1].mass), (run.values[1], Some(run.values[3])));
        let mut single = Simulation::from_scene(&scene)?;
        single.run_scene()?;
        let recording = single.take_recording().ok_or("it was recorded")?;
        let last = recording.samples.last().ok_or("it ran")?;
        assert_eq!((end.steps, end.time, end.fingerprint), (50, last.time, recording.fingerprint(last)));
        let kinetic = recording.audit.last().ok_or("it ran")?.kinetic;
        assert_eq!(end.shown, [last.state(1).ok_or("it is there")?.position.x, kinetic]);
    }
    let mut fingerprints: Vec<_> = runs.iter().map(|run| run.end.as_ref().map(|end| end.fingerprint).ok()).collect();
    fingerprints.sort();
    fingerprints.dedup();
    assert_eq!(fingerprints.len(), 40, "each run is another one");
    Ok(())
}

#[test]
fn numbers_are_uniform_and_depend_on_seed_and_run_alone() -> Fallible {
    let loaded = Scene::parse(ROD, "rod.ron")?;
    let batch = |texts: &[&str], seed| Batch::new(&loaded, varied(texts), seed);
    let (one, other) = (batch(&VARIED, 7)?, batch(&VARIED, 8)?);
    assert_ne!(one.values(3), other.values(3));
    assert_eq!(batch(&VARIED[..1], 7)?.values(3)[0], one.values(3)[0], "a further variation changes none before it");
    let (count, mut sum, mut squares) = (4000, 0.0, 0.0);
    for run in 0..count {
        let value = one.values(run)[0];
        assert!((-2.0..2.0).contains(&value));
        sum += value;
        squares += value * value;
    }
    // Four standard deviations of the mean, 2/√3/√4000, and of the mean of squares, 4/3 · √(4/5)/√4000.
    assert!((sum / count as f64).abs() < 0.073, "{sum}");
    assert!((squares / count as f64 - 4.0 / 3.0).abs() < 0.076, "{squares}");
    Ok(())
}

#[test]
fn space_is_varied_as_well() -> Fallible {
    let text = r#"(format: 1, dimension: Spatial, duration: 0.1,
        bodies: [(name: "ball", parts: [Sphere(radius: 0.5), Box(size: (1, 1, 1), at: (1, 0, 0))])])"#;
    let loaded = Loaded::<Spatial>::parse(text, "ball.ron")?;
    let batch =
        Batch::new(&loaded, varied(&["bodies.ball.angular_velocity.z=1..2", "bodies.ball.parts.1.size.x=1..2"]), 1)?;
    let scene = batch.scene(5)?;
    assert_eq!(scene.bodies[0].angular_velocity.z, batch.values(5)[0]);
    assert!(batch.run(5).end.is_ok());
    Ok(())
}

#[test]
fn a_path_that_leads_nowhere_says_where_it_went_astray() -> Fallible {
    let loaded = Scene::parse(ROD, "rod.ron")?;
    let refused = |text: &str| match text.parse::<Variation>().and_then(|it| Batch::new(&loaded, vec![it], 0)) {
        Ok(_) => panic!("{text} is not refused"),
        Err(error) => error.to_string(),
    };
    for (text, words) in [
        ("bodies.rood.velocity.x=0..1", "there is no \"rood\" in bodies"),
        ("bodies.rod 1.5.velocty.x=0..1", "there is no \"velocty\" in bodies.rod 1.5: did you mean \"velocity\"?"),
        ("bodies.rod 1.5.velocity.z=0..1", "there is no \"z\" in bodies.rod 1.5.velocity"),
        ("bodies.rod 1.5.velocity=0..1", "is 2 values in parentheses, not a number"),
        ("bodies.rod 1.5.name=0..1", "is a text in quotes, not a number"),
        ("gravity.y=1..0", "the range 1..0 of gravity.y has no finite number in it"),
        ("gravity.y=0..inf", "has no finite number in it"),
        ("gravity.y", "a variation is written PATH=LOW..HIGH"),
        ("gravity.y=a..b", "a variation is written PATH=LOW..HIGH"),
        ("bodies.rod 1.5.mass=-1..1", "with bodies.rod 1.5.mass = -1 the scene is wrong"),
        ("models.impulse.iterations=1..2", "with models.impulse.iterations = 1 the scene is wrong"),
    ] {
        let message = refused(text);
        assert!(message.contains(words), "{text}: {message}");
    }
    let twice = Batch::new(&loaded, varied(&["gravity.y=0..1", "gravity.y=0..1"]), 0).err();
    assert_eq!(twice, Some(BatchError::Twice("gravity.y".to_owned())));
    let shown = Batch::new(&loaded, Vec::new(), 0)?.showing(vec!["y:rood".parse()?]).err();
    assert!(shown.is_some_and(|words| words.contains("there is no body `rood`")));
    Ok(())
}

#[test]
fn a_run_that_fails_is_named_and_the_others_run() -> Fallible {
    // Above the floor the rod falls; below it overlaps at the start.
    let loaded = Scene::parse(ROD, "rod.ron")?;
    let batch = Batch::new(&loaded, varied(&["bodies.rod 1.5.at.y=-0.5..1.5"]), 3);
    let Ok(batch) = batch else { panic!("{:?}", batch.err()) };
    let runs = batch.run_all(0..20, None);
    for run in &runs {
        match &run.end {
            Ok(_) => assert!(run.values[0] > 0.0, "{run:?}"),
            Err(failure) => assert!(failure.to_string().contains("overlap"), "{failure}"),
        }
    }
    assert!(runs.iter().any(|run| run.end.is_ok()) && runs.iter().any(|run| run.end.is_err()));
    Ok(())
}
