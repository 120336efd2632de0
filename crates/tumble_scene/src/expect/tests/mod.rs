//! One small recording with known numbers, and what expectations say about it.
//!
//! 20 steps of 0.1 s. "box" (2 kg) moves by (3, −4) m/s from the origin and turns by 1 rad/s; "crate-0" and "crate-1" (1 kg) stand still at
//! (1, 0) and (2, 0); "floor" is static. In every step the floor carries the box and pulls it by 3 N towards x, "crate-0" pushes the box
//! by 5 N towards −x.

mod event;
mod force;
mod joint;
mod lines;
mod space;
mod state;
mod world;

use std::borrow::Cow;

use glam::{DVec2, dvec2};
use ron::extensions::Extensions;
use tumble_record::{AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, Recording, Sample, Touch, TouchPhase};

use super::{Measured, NotMeasured, Outcome, Status, Verdict, WorldVector, evaluate};
use crate::format::{BodyEntry, ContactModel, Expectation, Repeat, RepeatLine, Scene};

const BOX: usize = 0;
const CRATE_0: usize = 1;
const CRATE_1: usize = 2;
const FLOOR: usize = 3;

const STEPS: u64 = 20;
const DT: f64 = 0.1;

/// Room for the rounding of a handful of operations on numbers up to 100.
const ROUNDING: f64 = 1e-12;

fn body(id: u64, name: &str, kind: BodyKind, mass: f64) -> BodyRecord {
    BodyRecord { id, name: name.to_owned(), kind, mass, inertia: mass, shapes: Vec::new() }
}

/// Contact with a normal impulse and a tangent impulse on b [N·s].
fn contact(a: usize, b: usize, normal: DVec2, normal_impulse: f64, tangent_impulse: f64) -> ContactRecord {
    let (point, separation, kind) = (DVec2::ZERO, 0.0, Cow::Borrowed("any"));
    ContactRecord { a, b, point, normal, separation, normal_impulse, tangent_impulse, kind }
}

fn sample(step: u64) -> Sample {
    let time = step as f64 * DT;
    let state = |position, velocity, orientation, angular_velocity| {
        Some(BodyState { position, orientation, velocity, angular_velocity })
    };
    let still = |x| state(dvec2(x, 0.0), DVec2::ZERO, 0.0, 0.0);
    let velocity = dvec2(3.0, -4.0);
    let states = vec![state(velocity * time, velocity, time, 1.0), still(1.0), still(2.0), still(0.0)];
    // Normal from the box down to the floor, so that the tangent is −x and its impulse on the floor 0.3 N·s towards −x.
    let on_floor = contact(BOX, FLOOR, dvec2(0.0, -1.0), 2.0 * 9.81 * DT, 0.3);
    let on_crate = contact(BOX, CRATE_0, dvec2(1.0, 0.0), 5.0 * DT, 0.0);
    let contacts = if step == 0 { Vec::new() } else { vec![on_floor, on_crate] };
    Sample { step, time, states, contacts, joints: Vec::new() }
}

fn recording() -> Recording {
    let audit = (0..=STEPS).map(|step| AuditRow { step, time: step as f64 * DT, total: 10.0, ..AuditRow::default() });
    Recording {
        dt: DT,
        bodies: vec![
            body(0, "box", BodyKind::Dynamic, 2.0),
            body(1, "crate-0", BodyKind::Dynamic, 1.0),
            body(2, "crate-1", BodyKind::Dynamic, 1.0),
            body(3, "floor", BodyKind::Static, f64::INFINITY),
        ],
        samples: (0..=STEPS).map(sample).collect(),
        audit: audit.collect(),
        ..Recording::default()
    }
}

/// The recording with only every n-th sample and the last.
fn sampled_every(n: u64) -> Recording {
    let mut recording = recording();
    recording.samples.retain(|sample| sample.step % n == 0 || sample.step == STEPS);
    recording
}

/// The recording of a run that stopped after some steps.
fn stopped_after(step: u64) -> Recording {
    let mut recording = recording();
    recording.samples.retain(|sample| sample.step <= step);
    recording.audit.retain(|row| row.step <= step);
    recording
}

fn touch(step: u64, a: usize, b: usize, phase: TouchPhase) -> Touch {
    Touch { step, time: step as f64 * DT, a, b, phase, sensor: false }
}

fn scene(expectations: &str) -> Scene {
    let options = ron::Options::default().with_default_extension(
        Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES,
    );
    let expect: Vec<Expectation> =
        options.from_str(&format!("[{expectations}]")).expect("the expectations are well-formed");
    let crates = Repeat::Line(RepeatLine { count: 2, spacing: DVec2::X, jitter: Default::default() });
    let entry = |name: &str, repeat| BodyEntry { name: name.to_owned(), repeat, ..BodyEntry::default() };
    let bodies = vec![entry("box", None), entry("crate", Some(crates)), entry("floor", None)];
    Scene { dt: DT, duration: STEPS as f64 * DT, bodies, expect, ..Scene::default() }
}

fn verdict(recording: &Recording, expectations: &str) -> Verdict {
    evaluate(&scene(expectations), ContactModel::Impulse, recording)
}

/// The outcome of a single expectation.
fn outcome(recording: &Recording, expectation: &str) -> Outcome {
    verdict(recording, expectation).outcomes.pop().expect("there is one expectation")
}

#[track_caller]
fn met(recording: &Recording, expectation: &str) -> Outcome {
    let outcome = outcome(recording, expectation);
    assert_eq!(outcome.status, Status::Met, "{outcome}");
    outcome
}

#[track_caller]
fn failed(recording: &Recording, expectation: &str) -> Outcome {
    let outcome = outcome(recording, expectation);
    assert_eq!(outcome.status, Status::Failed, "{outcome}");
    outcome
}

/// Asserts that a measured number is right up to rounding.
#[track_caller]
fn assert_measured(outcome: &Outcome, number: f64) {
    let measured = outcome.measured.as_ref().and_then(Measured::number).expect("a number was measured");
    assert!((measured - number).abs() <= ROUNDING, "{measured} instead of {number}");
}

/// Asserts that a vector is right up to rounding.
#[track_caller]
fn assert_vector(vector: Option<WorldVector>, wanted: DVec2) {
    let vector = vector.expect("there is a vector");
    assert!(vector.distance(&WorldVector::new(wanted)) <= ROUNDING, "{vector:?} instead of {wanted}");
}

#[test]
fn verdict_passes_if_nothing_failed_and_skips_what_is_not_claimed() {
    let expectations = r#"
        X(of: "box", at: 1.0, is: 3.0, within: 0.01),
        X(of: "box", at: 1.0, is: 99.0, within: 0.01, under: [Penalty]),
    "#;
    let scene = scene(expectations);
    let verdict = evaluate(&scene, ContactModel::Impulse, &recording());
    assert!(verdict.passed());
    assert_eq!(verdict.outcomes[1].status, Status::NotClaimed);
    assert_eq!((verdict.count(Status::Met), verdict.count(Status::NotClaimed)), (1, 1));
    let verdict = evaluate(&scene, ContactModel::Penalty, &recording());
    assert!(!verdict.passed());
    assert_eq!(verdict.failures().map(|outcome| outcome.index).collect::<Vec<_>>(), [1]);
}

#[test]
fn nothing_recorded_fails_every_kind() {
    let expectations = r#"
        X(of: "box", at: 0.0, is: 0.0, within: 1.0), AtRest(from: 0.0), EnergyNeverRises(slack: 1.0), EnergyKept(within: 1.0),
        MomentumKept(within: 1.0), AngularMomentumKept(within: 1.0), Depth(below: 1.0), Depth(below: 1.0, at: 0.0),
        ContactForceSum(on: "box", at: 0.0, is: Newtons(0.0), within: 1.0), FrictionForce(on: "box", from: 0.0, is: 0.0, within: 1.0),
        Order(events: [Touch("box", "floor"), Part("box", "floor")]), Happens(event: Touch("box", "floor"), at: 0.0, within: 1.0),
        Never(event: Touch("box", "floor")), Fingerprint(is: "00000000000000000000000000000000"),
    "#;
    for empty in [Recording::default(), Recording { samples: Vec::new(), audit: Vec::new(), ..recording() }] {
        let verdict = verdict(&empty, expectations);
        assert_eq!(verdict.failures().count(), 14, "{verdict}");
    }
}
