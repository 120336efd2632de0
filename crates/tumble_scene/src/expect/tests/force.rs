use super::*;

#[test]
fn contact_forces_add_as_vectors_with_the_sign_of_the_side() {
    let recording = recording();
    // On the box: floor (3, 19.62) N and crate-0 (−5, 0) N. It is `a` of both contacts.
    met(&recording, r#"ContactForceSum(on: "box", at: 1.0, is: Vector(-2, 19.62), within: 1e-9)"#);
    met(&recording, r#"ContactForceSum(on: "box", by: "floor", at: 1.0, is: Vector(3, 19.62), within: 1e-9)"#);
    // What acts on the other side is the opposite; the crate is `b`.
    met(&recording, r#"ContactForceSum(on: "crate-0", at: 1.0, is: Vector(5, 0), within: 1e-9)"#);
    met(&recording, r#"ContactForceSum(on: "floor", by: "box", at: 1.0, is: Vector(-3, -19.62), within: 1e-9)"#);
    met(&recording, r#"ContactForceSum(on: "floor", by: "crate", at: 1.0, is: Vector(0, 0), within: 0.0)"#);
    let failed = failed(&recording, r#"ContactForceSum(on: "box", at: 1.0, is: Vector(3, 19.62), within: 4.9)"#);
    assert_vector(failed.measured.unwrap().vector(), dvec2(-2.0, 19.62));
}

#[test]
fn magnitudes_are_of_the_sum() {
    let recording = recording();
    let magnitude = dvec2(-2.0, 19.62).length();
    let sum = format!(r#"ContactForceSum(on: "box", at: 1.0, is: Newtons({magnitude}), within: 1e-9)"#);
    assert_measured(&met(&recording, &sum), magnitude);
    failed(&recording, r#"ContactForceSum(on: "box", at: 1.0, is: Newtons(19.62), within: 0.1)"#);
    assert_measured(&met(&recording, r#"FrictionForce(on: "box", at: 1.0, is: 3.0, within: 1e-9)"#), 3.0);
    assert_measured(&met(&recording, r#"FrictionForce(on: "floor", at: 1.0, is: 3.0, within: 1e-9)"#), 3.0);
    assert_measured(
        &failed(&recording, r#"FrictionForce(on: "box", by: "crate-0", at: 1.0, is: 3.0, within: 2.9)"#),
        0.0,
    );
}

#[test]
fn friction_of_opposite_contacts_cancels() {
    let mut recording = recording();
    for sample in &mut recording.samples[1..] {
        // The same pull on the other side of the box: normal up, tangent +x, so −0.3 N·s towards x on a ceiling (b).
        sample.contacts.push(contact(BOX, FLOOR, dvec2(0.0, 1.0), 0.0, 0.3));
    }
    assert_measured(&met(&recording, r#"FrictionForce(on: "box", at: 1.0, is: 0.0, within: 1e-9)"#), 0.0);
}

#[test]
fn weight_is_the_opposite_of_gravity_on_the_body() {
    let recording = recording();
    let by_floor = r#"ContactForceSum(on: "box", by: "floor", at: 1.0, is: Weight, within: 3.01)"#;
    let met = met(&recording, by_floor);
    // 2 kg · 9.81 m/s², up; the 3 N sideways are the distance.
    assert_vector(met.expected.unwrap().vector(), dvec2(0.0, 19.62));
    failed(&recording, &by_floor.replace("3.01", "2.99"));
    // A body of which half the gravity acts weighs half.
    let mut light = scene(by_floor);
    light.bodies[0].gravity_scale = 0.5;
    let verdict = evaluate(&light, ContactModel::Impulse, &recording);
    assert_eq!(verdict.outcomes[0].status, Status::Failed);
    assert_vector(verdict.outcomes[0].expected.as_ref().unwrap().vector(), dvec2(0.0, 9.81));
    let on_floor = failed(&recording, r#"ContactForceSum(on: "floor", at: 1.0, is: Weight, within: 1e9)"#);
    assert_eq!(on_floor.obstacle, Some(NotMeasured::NoWeight { body: "floor".to_owned() }));
}

#[test]
fn every_copy_of_a_repeated_body_must_be_carried() {
    let mut recording = recording();
    let carried = r#"ContactForceSum(on: "crate", by: "floor", from: 0.0, is: Weight, within: 1e-9)"#;
    for sample in &mut recording.samples[1..] {
        sample.contacts.push(contact(CRATE_0, FLOOR, dvec2(0.0, -1.0), 9.81 * DT, 0.0));
    }
    assert_eq!(failed(&recording, carried).body.as_deref(), Some("crate-1"));
    for sample in &mut recording.samples[1..] {
        sample.contacts.push(contact(CRATE_1, FLOOR, dvec2(0.0, -1.0), 9.81 * DT, 0.0));
    }
    met(&recording, carried);
}

#[test]
fn window_averages_the_vectors_without_the_start() {
    let mut recording = recording();
    // Friction to and fro: ±3 N in turn averages to nothing over an even number of steps.
    for sample in recording.samples.iter_mut().filter(|sample| sample.step > 0 && sample.step % 2 == 0) {
        sample.contacts[0].tangent_impulse = -0.3;
    }
    let even = met(&recording, r#"FrictionForce(on: "box", until: 2.0, is: 0.0, within: 1e-9)"#);
    assert_eq!(even.time, None);
    // Steps 1, 2, 3: 3 − 3 + 3 over three; the start took no step and does not count.
    assert_measured(&met(&recording, r#"FrictionForce(on: "box", until: 0.3, is: 1.0, within: 1e-9)"#), 1.0);
    let only_start = failed(&recording, r#"FrictionForce(on: "box", until: 0.05, is: 0.0, within: 1e9)"#);
    assert_eq!(only_start.obstacle, Some(NotMeasured::EmptyWindow));
}

#[test]
fn force_at_a_time_is_that_of_the_nearest_sampled_step() {
    let mut recording = sampled_every(7);
    recording.samples[1].contacts[0].tangent_impulse = 0.1;
    recording.samples[2].contacts[0].tangent_impulse = 0.2;
    // Samples at 0.7 s (1 N) and 1.4 s (2 N); the start has no force, so 0 s means the first sample after it.
    for (at, newtons) in [(0.0, 1.0), (1.0, 1.0), (1.1, 2.0)] {
        let expectation = format!(r#"FrictionForce(on: "box", at: {at:?}, is: {newtons:?}, within: 1e-9)"#);
        assert_measured(&met(&recording, &expectation), newtons);
    }
}

#[test]
fn forces_not_reached_or_not_numbers_have_failed() {
    let stopped = stopped_after(12);
    for expectation in [
        r#"FrictionForce(on: "box", at: 1.3, is: 3.0, within: 1e9)"#,
        r#"FrictionForce(on: "box", from: 1.0, is: 3.0, within: 1e9)"#,
        r#"ContactForceSum(on: "box", until: 1.3, is: Weight, within: 1e9)"#,
    ] {
        assert!(matches!(failed(&stopped, expectation).obstacle, Some(NotMeasured::NotReached { .. })));
    }
    let mut recording = recording();
    recording.samples[10].contacts[0].tangent_impulse = f64::NAN;
    for expectation in [
        r#"FrictionForce(on: "box", at: 1.0, is: 3.0, within: 1e9)"#,
        r#"FrictionForce(on: "box", from: 0.0, is: 3.0, within: 1e9)"#,
        r#"ContactForceSum(on: "box", from: 0.0, is: Weight, within: 1e9)"#,
        r#"ContactForceSum(on: "box", at: 1.0, is: Newtons(20), within: 1e9)"#,
    ] {
        failed(&recording, expectation);
    }
}
