//! What is claimed of space: a body that turns about x by 1 rad/s, sampled every tenth of a second, and is pushed along z by 3 N.

use glam::{DVec3, dvec3};
use tumble_math::{Spatial, SpatialRotation, SymmetricTensor};

use super::{DT, ROUNDING, STEPS, assert_measured};
use crate::expect::{Outcome, Status, evaluate};
use crate::format::{BodyEntry, ContactModel, Expectation, Scene};
use tumble_record::{AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, Recording, Sample};

fn recording() -> Recording<Spatial> {
    let body = |id, name: &str, kind| BodyRecord {
        id,
        name: name.to_owned(),
        kind,
        mass: 2.0,
        inertia: SymmetricTensor::from_diagonal(DVec3::ONE),
        shapes: Vec::new(),
    };
    let sample = |step: u64| {
        let time = step as f64 * DT;
        let state = |angle| BodyState::<Spatial> {
            position: dvec3(0.0, 0.0, 4.0 * time),
            orientation: SpatialRotation::from_rotation_vector(DVec3::X * angle).quaternion(),
            velocity: dvec3(0.0, 0.0, 4.0),
            angular_velocity: DVec3::X,
        };
        let contact = ContactRecord::<Spatial> {
            a: 0,
            b: 1,
            point: DVec3::ZERO,
            normal: DVec3::NEG_Y,
            separation: 0.0,
            normal_impulse: 2.0 * 9.81 * DT,
            tangent_impulse: dvec3(0.0, 0.0, -3.0 * DT),
            kind: "any".into(),
        };
        let contacts = if step == 0 { Vec::new() } else { vec![contact] };
        Sample { step, time, states: vec![Some(state(time)), Some(state(0.0))], contacts, joints: Vec::new() }
    };
    let audit = |step| AuditRow { step, time: step as f64 * DT, angular_momentum: DVec3::X, ..AuditRow::default() };
    Recording {
        dt: DT,
        bodies: vec![body(0, "box", BodyKind::Dynamic), body(1, "floor", BodyKind::Static)],
        samples: (0..=STEPS).map(sample).collect(),
        audit: (0..=STEPS).map(audit).collect(),
        ..Recording::default()
    }
}

fn outcome(recording: &Recording<Spatial>, expectation: &str) -> Outcome {
    let expectation: Expectation<Spatial> = crate::text::read(expectation).expect("the expectation is well-formed");
    let body = |name: &str| BodyEntry { name: name.to_owned(), ..BodyEntry::default() };
    let scene = Scene {
        dt: DT,
        duration: STEPS as f64 * DT,
        bodies: vec![body("box"), body("floor")],
        expect: vec![expectation],
        ..Scene::empty()
    };
    evaluate(&scene, ContactModel::Impulse, recording).outcomes.pop().expect("there is one expectation")
}

#[test]
fn what_is_so_in_space_is_met_and_what_is_not_has_failed() {
    let recording = recording();
    for (expectation, status) in [
        (r#"Position(of: "box", at: 1, is: (0, 0, 4), within: 1e-12)"#, Status::Met),
        (r#"Position(of: "box", at: 1, is: (0, 0, 4.1), within: 0.09)"#, Status::Failed),
        (r#"Z(of: "box", at: 1, is: 4, within: 1e-12)"#, Status::Met),
        (r#"VelocityZ(of: "box", always: true, is: 4, within: 1e-12)"#, Status::Met),
        (r#"AngularVelocity(of: "box", always: true, is: (1, 0, 0), within: 1e-12)"#, Status::Met),
        (r#"AngularVelocity(of: "box", always: true, is: (0, 1, 0), within: 1)"#, Status::Failed),
        (r#"AngularVelocityX(of: "box", always: true, is: 1, within: 1e-12)"#, Status::Met),
        (r#"AngularVelocityX(of: "box", at: 1, below: 0)"#, Status::Failed),
        (r#"AngularVelocityY(of: "box", always: true, is: 0, within: 0)"#, Status::Met),
        (r#"AngularVelocityZ(of: "box", from: 0.5, above: -1, below: 1)"#, Status::Met),
        (r#"TurnRate(of: "box", always: true, is: 1, within: 1e-12)"#, Status::Met),
        (r#"ContactForceSum(on: "box", at: 1, is: Weight, within: 3.001)"#, Status::Met),
        (r#"ContactForceSum(on: "box", at: 1, is: Vector(0, 19.62, 3), within: 1e-9)"#, Status::Met),
        (r#"FrictionForce(on: "box", from: 0, is: 3, within: 1e-9)"#, Status::Met),
        (r#"AngularMomentumKept(within: 0)"#, Status::Met),
        (r#"AtRest(of: "floor", from: 0, speed_below: 5, turn_below: 2)"#, Status::Met),
        (r#"AtRest(of: "box", from: 0, speed_below: 5, turn_below: 0.5)"#, Status::Failed),
    ] {
        let outcome = outcome(&recording, expectation);
        assert_eq!(outcome.status, status, "{outcome}");
    }
}

#[test]
fn tilt_is_the_angle_of_an_axis_from_where_it_was_or_from_a_direction() {
    let recording = recording();
    // y turns by 1 rad in 1 s; x is the axis and stays.
    let tilt = |claim: &str| outcome(&recording, &format!(r#"Tilt(of: "box", at: 1, {claim}, below_degrees: 180)"#));
    assert_measured(&tilt("axis: (0, 2, 0)"), 1_f64.to_degrees());
    assert_measured(&tilt("axis: (1, 0, 0)"), 0.0);
    assert_measured(&tilt("axis: (0, 1, 0), against: (0, 0, 3)"), 90.0 - 1_f64.to_degrees());
}

#[test]
fn orientation_is_measured_by_the_turn_that_is_missing() {
    let recording = recording();
    let half_a_radian = 0.5_f64.to_degrees();
    let claim = format!(
        r#"Orientation(of: "box", at: 1, is: Turn(axis: (1, 0, 0), angle_degrees: {half_a_radian:?}), within_degrees: 30)"#
    );
    assert_measured(&outcome(&recording, &claim), half_a_radian);
    assert_measured(&outcome(&recording, r#"Orientation(of: "box", at: 0, within_degrees: 0)"#), 0.0);
}

#[test]
fn orientations_between_samples_lie_on_the_turn_between_them() {
    let mut recording = recording();
    recording.samples.retain(|sample| sample.step % 4 == 0);
    let tilt =
        outcome(&recording, r#"Tilt(of: "box", axis: (0, 1, 0), at: 0.6, is_degrees: 34.3775, within_degrees: 0.01)"#);
    assert!((tilt.measured.unwrap().number().unwrap() - 0.6_f64.to_degrees()).abs() <= 100.0 * ROUNDING);
}
