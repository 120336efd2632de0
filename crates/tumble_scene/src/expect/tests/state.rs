use super::*;

#[test]
fn each_quantity_of_a_state_is_met_with_its_number() {
    let recording = recording();
    // At 1.5 s: position (4.5, −6), angle 1.5 rad, velocity (3, −4), rate of turn 1 rad/s.
    for (expectation, number) in [
        (r#"X(of: "box", at: 1.5, is: 4.5, within: 1e-9)"#, 4.5),
        (r#"Y(of: "box", at: 1.5, is: -6.0, within: 1e-9)"#, -6.0),
        (r#"Angle(of: "box", at: 1.5, above_degrees: 85.9, below_degrees: 86.0)"#, 1.5_f64.to_degrees()),
        (r#"VelocityX(of: "box", always: true, is: 3.0, within: 0.0)"#, 3.0),
        (r#"VelocityY(of: "box", from: 1.0, below: -3.9)"#, -4.0),
        (r#"Speed(of: "box", until: 1.0, is: 5.0, within: 1e-9, above: 4.0)"#, 5.0),
        (r#"AngularVelocity(of: "box", at: 0.0, is: 1.0, within: 0.0)"#, 1.0),
    ] {
        let met = met(&recording, expectation);
        assert_measured(&met, number);
        assert_eq!(met.body.as_deref(), Some("box"));
    }
    let position = met(&recording, r#"Position(of: "box", at: 1.5, is: (4.5, -6.3), within: 0.31)"#);
    assert_vector(position.measured.unwrap().vector(), dvec2(4.5, -6.0));
    met(&recording, r#"Velocity(of: "box", always: true, is: (3, -4), within: 0.0)"#);
}

#[test]
fn each_quantity_of_a_state_fails_beyond_its_tolerance() {
    let recording = recording();
    for expectation in [
        r#"Position(of: "box", at: 1.5, is: (4.5, -6.3), within: 0.29)"#,
        r#"X(of: "box", at: 1.5, is: 4.6, within: 0.09)"#,
        r#"Y(of: "box", at: 1.5, above: -5.9)"#,
        r#"Angle(of: "box", at: 1.5, is_degrees: 87.0, within_degrees: 1.0)"#,
        r#"Velocity(of: "box", at: 1.5, is: (3, -4.1), within: 0.09)"#,
        r#"VelocityX(of: "box", at: 1.5, is: 3.0, within: 1.0, below: 2.9)"#,
        r#"VelocityY(of: "box", at: 1.5, is: -4.1, within: 0.09)"#,
        r#"Speed(of: "box", at: 1.5, below: 4.9)"#,
        r#"AngularVelocity(of: "box", at: 1.5, above: 1.1)"#,
    ] {
        assert!(failed(&recording, expectation).measured.is_some(), "{expectation}");
    }
}

#[test]
fn tolerance_is_allowed_and_bounds_are_not() {
    let recording = recording();
    met(&recording, r#"VelocityX(of: "box", at: 1.0, is: 2.5, within: 0.5)"#);
    failed(&recording, r#"VelocityX(of: "box", at: 1.0, above: 3.0)"#);
    failed(&recording, r#"VelocityX(of: "box", at: 1.0, below: 3.0)"#);
}

#[test]
fn time_within_round_off_of_a_step_is_that_step_and_others_are_the_nearest() {
    let recording = recording();
    // 0.3 s is 2.9999999999999996 steps of 0.1 s.
    assert_measured(&met(&recording, r#"X(of: "box", at: 0.3, is: 0.9, within: 1e-9)"#), 0.9);
    let nearest = met(&recording, r#"X(of: "box", at: 0.34, is: 0.9, within: 1e-9)"#);
    assert!((nearest.time.unwrap() - 0.3).abs() <= ROUNDING);
    assert_measured(&met(&recording, r#"X(of: "box", at: 0.36, is: 1.2, within: 1e-9)"#), 1.2);
}

#[test]
fn step_that_was_not_sampled_is_interpolated_between_its_neighbours() {
    let mut recording = sampled_every(7);
    // Samples at steps 7 and 14; the box moves uniformly, so step 9 is on the line.
    assert_measured(&met(&recording, r#"X(of: "box", at: 0.9, is: 2.7, within: 1e-9)"#), 2.7);
    assert_measured(&met(&recording, r#"Angle(of: "box", at: 0.9, above_degrees: 0)"#), 0.9_f64.to_degrees());
    // A jump of the velocity between them shows as two sevenths of it.
    recording.samples[2].states[BOX].as_mut().unwrap().velocity = dvec2(10.0, -4.0);
    let jump = met(&recording, r#"VelocityX(of: "box", at: 0.9, is: 5.0, within: 1e-9)"#);
    assert_measured(&jump, 5.0);
    assert!((jump.time.unwrap() - 0.9).abs() <= ROUNDING);
}

#[test]
fn never_reached_has_failed() {
    let stopped = stopped_after(12);
    for expectation in [
        r#"X(of: "box", at: 1.3, above: -1000)"#,
        r#"X(of: "box", always: true, above: -1000)"#,
        r#"X(of: "box", from: 0.5, above: -1000)"#,
        r#"X(of: "box", until: 1.5, above: -1000)"#,
        r#"X(of: "box", from: 1.5, above: -1000)"#,
        r#"AtRest(of: "crate-0", from: 0.5)"#,
        r#"Fingerprint(is: "00000000000000000000000000000000")"#,
    ] {
        let failed = failed(&stopped, expectation);
        assert_eq!(failed.measured, None);
        assert!(matches!(failed.obstacle, Some(NotMeasured::NotReached { end }) if (end - 1.2).abs() <= ROUNDING));
    }
    met(&stopped, r#"X(of: "box", at: 1.2, above: -1000)"#);
    met(&stopped, r#"X(of: "box", until: 1.2, above: -1000)"#);
}

#[test]
fn failure_before_an_early_end_is_reported_with_its_number() {
    let failed = failed(&stopped_after(12), r#"X(of: "box", always: true, below: 2.0)"#);
    // The worst sample that there is: the last, 3 m/s · 1.2 s.
    assert_measured(&failed, 3.6);
}

#[test]
fn worst_sample_of_a_window_decides_and_says_when() {
    let mut recording = recording();
    recording.samples[13].states[BOX].as_mut().unwrap().position.x = 50.0;
    let worst = failed(&recording, r#"X(of: "box", from: 0.5, until: 1.5, is: 3.0, within: 1.6)"#);
    assert_measured(&worst, 50.0);
    assert!((worst.time.unwrap() - 1.3).abs() <= ROUNDING);
    // Ends included, so 0.5 s and 1.2 s count and 1.3 s does not.
    let met = met(&recording, r#"X(of: "box", from: 0.5, until: 1.2, is: 1.5, within: 2.2)"#);
    assert_measured(&met, 3.6);
}

#[test]
fn window_without_samples_has_failed() {
    let failed = failed(&sampled_every(7), r#"X(of: "box", from: 0.8, until: 1.3, above: -1000)"#);
    assert_eq!(failed.obstacle, Some(NotMeasured::EmptyWindow));
}

#[test]
fn not_a_number_fails_every_comparison() {
    let mut recording = recording();
    *recording.samples[10].states[BOX].as_mut().unwrap() =
        BodyState { position: DVec2::NAN, orientation: f64::NAN, velocity: DVec2::NAN, angular_velocity: f64::NAN };
    for expectation in [
        r#"X(of: "box", at: 1.0, is: 3.0, within: 1000)"#,
        r#"X(of: "box", at: 1.0, above: -1000)"#,
        r#"X(of: "box", always: true, below: 1000)"#,
        r#"Position(of: "box", always: true, is: (0, 0), within: 1000)"#,
        r#"Angle(of: "box", at: 1.0, below_degrees: 1000)"#,
        r#"Speed(of: "box", always: true, below: 1000)"#,
        r#"AtRest(of: "box", from: 0.0, speed_below: 1000, turn_below: 1000)"#,
        r#"AtRest(from: 0.0, speed_below: 1000, turn_below: 1000, drift_below: 1000)"#,
    ] {
        let time = failed(&recording, expectation).time.expect("the sample is known");
        assert!((time - 1.0).abs() <= ROUNDING, "{expectation}");
    }
    // A tolerance that is not a number is no tolerance.
    failed(&recording, r#"X(of: "box", at: 0.5, is: 1.5, within: NaN)"#);
    failed(&recording, r#"X(of: "box", at: 0.5, below: NaN)"#);
}

#[test]
fn rest_is_asked_of_the_named_body_or_of_every_dynamic_one() {
    let mut recording = recording();
    met(&recording, r#"AtRest(of: "crate-1", from: 1.0)"#);
    let moving = failed(&recording, "AtRest(from: 1.0)");
    assert_eq!(moving.body.as_deref(), Some("box"));
    assert!(matches!(moving.measured, Some(Measured::Rest { speed, turn, .. }) if speed == 5.0 && turn == 1.0));
    // Static bodies are not asked; bodies outside the world are not either.
    for sample in &mut recording.samples {
        sample.states[FLOOR].as_mut().unwrap().velocity = DVec2::X;
        sample.states[BOX] = None;
    }
    met(&recording, "AtRest(from: 1.0)");
    let absent = failed(&recording, r#"AtRest(of: "box", from: 1.0)"#).obstacle;
    assert!(matches!(absent, Some(NotMeasured::BodyAbsent { body, .. }) if body == "box"));
    recording.bodies.iter_mut().for_each(|body| body.kind = BodyKind::Static);
    assert_eq!(failed(&recording, "AtRest(from: 1.0)").obstacle, Some(NotMeasured::NoDynamicBody));
}

#[test]
fn drift_is_counted_from_the_beginning_of_rest() {
    let mut recording = recording();
    for sample in &mut recording.samples {
        // Creeps by 0.01 m per step, below the bound of its speed as far as the velocity tells.
        sample.states[CRATE_0].as_mut().unwrap().position.x = 0.01 * sample.step as f64;
    }
    met(&recording, r#"AtRest(of: "crate-0", from: 1.0)"#);
    met(&recording, r#"AtRest(of: "crate-0", from: 1.0, drift_below: 0.101)"#);
    let failed = failed(&recording, r#"AtRest(of: "crate-0", from: 1.0, drift_below: 0.099)"#);
    assert!(matches!(failed.measured, Some(Measured::Rest { drift, .. }) if (drift - 0.1).abs() <= ROUNDING));
}

#[test]
fn name_of_a_repeated_body_means_all_copies_and_the_worst_is_named() {
    let recording = recording();
    met(&recording, r#"AtRest(of: "crate", from: 0.0)"#);
    let worst = failed(&recording, r#"X(of: "crate", always: true, is: 1.0, within: 0.5)"#);
    assert_eq!(worst.body.as_deref(), Some("crate-1"));
    assert_measured(&worst, 2.0);
    let at = failed(&recording, r#"X(of: "crate", at: 1.0, above: 1.5)"#);
    assert_eq!(at.body.as_deref(), Some("crate-0"));
}

#[test]
fn unknown_or_absent_bodies_have_failed() {
    let mut recording = recording();
    let unknown = failed(&recording, r#"X(of: "ghost", at: 1.0, above: -1000)"#).obstacle;
    assert_eq!(unknown, Some(NotMeasured::UnknownBody { name: "ghost".to_owned() }));
    recording.samples[10].states[BOX] = None;
    for when in ["at: 1.0", "always: true"] {
        let absent = failed(&recording, &format!(r#"X(of: "box", {when}, above: -1000)"#)).obstacle;
        assert_eq!(absent, Some(NotMeasured::BodyAbsent { body: "box".to_owned(), time: 1.0 }));
    }
}

#[test]
fn fingerprint_is_that_of_the_last_sample() {
    let mut recording = recording();
    let digits = recording.fingerprint(&recording.samples[STEPS as usize]).to_string();
    met(&recording, &format!(r#"Fingerprint(is: "{digits}")"#));
    met(&recording, &format!(r#"Fingerprint(is: "{}")"#, digits.to_uppercase()));
    failed(&recording, r#"Fingerprint(is: "nonsense")"#);
    let position = &mut recording.samples[STEPS as usize].states[CRATE_1].as_mut().unwrap().position;
    position.x = position.x.next_up();
    let changed = failed(&recording, &format!(r#"Fingerprint(is: "{digits}")"#));
    assert!(matches!(changed.measured, Some(Measured::Fingerprint(other)) if other.to_string() != digits));
}
