//! Simulations are held to what was promised of them, by a scene or in code.

use glam::{DVec2, dvec2};
use tumble_math::Spatial;
use tumble_record::{Record, Sampling};
use tumble_scene::expect::{NotMeasured, Status, watched_steps};
use tumble_scene::format::{
    BodyEntry, DiscPart, Expectation, ForceExpectation, Part, ScalarExpectation, Scene, TargetForce,
};
use tumble_scene::{Check, FromScene, Loaded, RunError};
use tumble_shape::{Disc, HalfPlane};
use tumble_sim::{Amount, BodyKind, GravityScale, Position, Settings, Simulation};

/// v = −g t after one second: exact for symplectic Euler, apart from rounding of a hundred sums.
fn falls_with(speed: f64) -> Expectation {
    let (is, within) = (Some(-speed), Some(1e-12));
    Expectation::VelocityY(ScalarExpectation { of: "ball".into(), at: Some(1.0), is, within, ..Default::default() })
}

fn drop() -> Scene {
    let disc = Part::Disc(DiscPart { radius: 0.1, ..DiscPart::default() });
    let ball = BodyEntry { name: "ball".into(), at: dvec2(0.0, 10.0), parts: vec![disc], ..BodyEntry::default() };
    Scene { bodies: vec![ball], expect: vec![falls_with(9.81)], ..Scene::default() }
}

#[test]
fn a_scene_runs_its_duration_and_is_checked() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::from_scene(&drop())?;
    simulation.run_scene()?;
    assert_eq!(simulation.clock().step, 100);
    let verdict = simulation.check();
    assert!(verdict.passed(), "{verdict}");
    assert_eq!(verdict.count(Status::Met), 1);
    Ok(())
}

#[test]
fn a_scene_that_was_partly_run_ends_at_its_duration() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::from_scene(&drop())?;
    simulation.record(10)?;
    simulation.run_for(0.3)?;
    simulation.run_scene()?;
    assert_eq!(simulation.clock().step, 100);
    assert_eq!(simulation.recording().map(|recording| recording.samples.len()), Some(11), "the recording goes on");
    assert!(simulation.check().passed());
    Ok(())
}

#[test]
fn a_broken_promise_fails_and_says_what_was_measured() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::from_scene(&drop())?;
    simulation.expect(falls_with(10.0));
    simulation.run_scene()?;
    let verdict = simulation.check();
    assert_eq!((verdict.count(Status::Met), verdict.count(Status::Failed)), (1, 1));
    let measured = verdict.failures().next().and_then(|failure| failure.measured.as_ref()?.number());
    assert!(measured.is_some_and(|speed| (speed + 9.81).abs() < 1e-12), "{verdict}");
    Ok(())
}

#[test]
fn without_a_recording_every_promise_is_broken() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::from_scene(&drop())?;
    simulation.run_for(1.0)?;
    let verdict = simulation.check();
    assert!(!verdict.passed());
    assert_eq!(verdict.outcomes[0].obstacle, Some(NotMeasured::NothingRecorded));
    Ok(())
}

#[test]
fn a_run_that_stopped_early_keeps_no_promise_about_its_end() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::from_scene(&drop())?;
    simulation.record(1)?;
    simulation.run_for(0.5)?;
    assert!(!simulation.check().passed());
    Ok(())
}

#[test]
fn a_simulation_built_in_code_is_checked_too() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::new(Settings::default());
    let name = |name: &'static str| bevy_ecs::name::Name::new(name);
    let floor = simulation.spawn((name("floor"), BodyKind::Static, Position(DVec2::ZERO)));
    simulation.attach(floor, tumble_sim::Part::new(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?, Amount::Mass(0.0)));
    let ball = simulation.spawn((name("ball"), Position(dvec2(0.0, 0.1)), GravityScale(0.5)));
    simulation.attach(ball, tumble_sim::Part::new(Disc::try_new(DVec2::ZERO, 0.1)?, Amount::Mass(2.0)));
    // Half of 2 kg · 9.81 m/s², to rounding.
    let carried = |is| ForceExpectation {
        on: "ball".into(),
        by: Some("floor".into()),
        at: Some(0.5),
        from: None,
        until: None,
        is,
        within: 1e-9,
        because: "the floor carries it".into(),
        under: Vec::new(),
    };
    simulation.expect(Expectation::ContactForceSum(carried(TargetForce::Weight)));
    simulation.expect(Expectation::ContactForceSum(carried(TargetForce::Newtons(9.81))));
    assert_eq!(simulation.run_scene(), Err(RunError::NoScene), "nothing says how long it runs");
    simulation.record(1)?;
    simulation.run_for(0.5)?;
    let verdict = simulation.check();
    assert!(verdict.passed(), "{verdict}");
    Ok(())
}

#[test]
fn a_promise_about_a_repeated_body_is_one_about_each_copy() -> Result<(), Box<dyn std::error::Error>> {
    // Each ball falls by 4.954 m; the highest of them began at 12 m.
    let text = r#"(
        format: 1, duration: 1,
        bodies: [
            (name: "ball", at: (0, 10), parts: [Disc(radius: 0.1)], repeat: Line(count: 3, spacing: (0, 1))),
            (name: "floor", kind: Static, parts: [HalfPlane()]),
        ],
        expect: [
            VelocityY(of: "ball", at: 1, is: -9.81, within: 1e-12),
            Y(of: "ball", at: 1, below: 7),
            Never(event: Touch("ball", "ball")),
            Never(event: Touch("floor", "ball")),
            Depth(below: 0),
        ],
    )"#;
    let mut simulation = Simulation::from_loaded(&Scene::parse(text, "balls.ron")?)?;
    simulation.run_scene()?;
    let verdict = simulation.check();
    let failed: Vec<_> = verdict.failures().map(|failure| (failure.index, failure.body.as_deref())).collect();
    assert_eq!(failed, [(1, Some("ball-2"))], "{verdict}");
    Ok(())
}

#[test]
fn samples_of_the_steps_that_are_watched_give_the_verdict_of_all_steps() -> Result<(), Box<dyn std::error::Error>> {
    let text = r#"(
        format: 1, duration: 2, contact: Impulse, materials: { "default": (static_friction: 0.5, restitution: 0.5) },
        bodies: [
            (name: "ball", at: (0, 1), velocity: (0.3, 0), parts: [Disc(radius: 0.1)], repeat: Line(count: 2, spacing: (1, 0))),
            (name: "floor", kind: Static, parts: [HalfPlane()]),
        ],
        expect: [
            Position(of: "ball-0", at: 0.333, is: (0, 0), within: 1e-9),
            Angle(of: "ball", at: 1.2345, is_degrees: 7, within_degrees: 1),
            Speed(of: "ball-1", from: 0.4, until: 0.6, below: 1),
            AtRest(from: 1.9),
            ContactForceSum(on: "ball", by: "floor", at: 0.0, is: Weight, within: 1e-9),
            ContactForceSum(on: "ball", from: 1.777, is: Weight, within: 1e-9),
            FrictionForce(on: "ball-0", at: 0.43, is: 1, within: 1e-9),
            Depth(below: 0), EnergyNeverRises(slack: 0), MomentumKept(within: 0),
            Order(events: [Touch("ball", "floor"), Part("ball", "floor")]),
            Fingerprint(is: "00000000000000000000000000000000"),
        ],
    )"#;
    let scene = Scene::parse(text, "balls.ron")?.scene;
    let verdict_of = |sampling: Sampling| {
        let mut simulation = Simulation::from_scene(&scene)?;
        simulation.record_sampled(sampling)?;
        simulation.run_scene()?;
        let samples = simulation.recording().map_or(0, |recording| recording.samples.len());
        Ok::<_, Box<dyn std::error::Error>>((simulation.check(), samples))
    };
    let (full, _) = verdict_of(Sampling::every(1))?;
    assert!(full.outcomes.iter().all(|outcome| outcome.measured.is_some()), "{full}");
    let (watched, samples) = verdict_of(Sampling::every(1000).and(watched_steps(&scene, scene.contact)))?;
    assert_eq!(watched, full);
    assert!(samples < 80, "{samples} of 201 steps are sampled");
    Ok(())
}

/// What a scene of the plane and the one of space that it is at z = 0 have in common.
const TILTED_BOX: &str = r#"
    format: 1, duration: 1, dt: 0.001, contact: VelocityLcp,
"#;

#[test]
fn a_planar_scene_embedded_in_space_moves_alike() -> Result<(), Box<dyn std::error::Error>> {
    moves_alike(r#"materials: { "default": (static_friction: 0.5, kinetic_friction: 0.4) }"#)
}

#[test]
fn a_planar_scene_embedded_in_space_bounces_alike() -> Result<(), Box<dyn std::error::Error>> {
    moves_alike(r#"materials: { "default": (static_friction: 0.5, kinetic_friction: 0.4, restitution: 0.3) }"#)
}

fn moves_alike(materials: &str) -> Result<(), Box<dyn std::error::Error>> {
    let planar = format!(
        r#"({TILTED_BOX} {materials}, bodies: [
            (name: "floor", kind: Static, parts: [HalfPlane()]),
            (name: "box", at: (0, 0.8), angle_degrees: 25, velocity: (0.5, 0), angular_velocity: -1.5, parts: [Box(size: (1, 0.5), mass: 2)]),
        ])"#
    );
    let spatial = format!(
        r#"({TILTED_BOX} {materials}, dimension: Spatial, bodies: [
            (name: "floor", kind: Static, parts: [HalfSpace()]),
            (name: "box", at: (0, 0.8, 0), orientation: Turn(axis: (0, 0, 1), angle_degrees: 25), velocity: (0.5, 0, 0), angular_velocity: (0, 0, -1.5),
                parts: [Box(size: (1, 0.5, 0.7), mass: 2)]),
        ])"#
    );
    let mut flat = Simulation::from_loaded(&Scene::parse(&planar, "plane.ron")?)?;
    let mut deep = Simulation::from_loaded(&Loaded::<Spatial>::parse(&spatial, "space.ron")?)?;
    for _ in 0..1000 {
        flat.step()?;
        deep.step()?;
        let (in_plane, in_space) = (flat.body("box")?, deep.body("box")?);
        let seen = in_space.position();
        // Quaternions and angles round differently, and each of the few impacts multiplies that.
        assert!((in_plane.position().extend(0.0) - seen).length() < 1e-9, "{seen} at {} s", flat.time());
        assert!((in_plane.angular_velocity() - in_space.angular_velocity().z).abs() < 1e-8, "at {} s", flat.time());
    }
    Ok(())
}
