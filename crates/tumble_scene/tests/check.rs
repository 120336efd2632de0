//! Simulations are held to what was promised of them, by a scene or in code.

use glam::{DVec2, dvec2};
use tumble_record::Record;
use tumble_scene::expect::{NotMeasured, Status};
use tumble_scene::format::{
    BodyEntry, DiscPart, Expectation, ForceExpectation, Part, ScalarExpectation, Scene, TargetForce,
};
use tumble_scene::{Check, FromScene, RunError};
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
