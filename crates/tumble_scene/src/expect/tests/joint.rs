use tumble_record::{AnchorRecord, JointForce, JointRecord};

use super::*;

/// The recording with a joint that gives the box (t, −4) N and 0.5 N·m.
fn jointed() -> Recording {
    let mut recording = recording();
    let end = |body| AnchorRecord { body, point: DVec2::ZERO };
    let (name, kind) = ("pin".to_owned(), Cow::Borrowed("fixed"));
    recording.joints =
        vec![JointRecord { name, kind, a: end(None), b: end(Some(BOX)), axis: None, from: 0.0, until: None }];
    for sample in &mut recording.samples[1..] {
        let force = dvec2(sample.time, -4.0);
        sample.joints = vec![JointForce { joint: 0, point: DVec2::ZERO, force, torque: 0.5 }];
    }
    recording
}

#[test]
fn joint_forces_are_those_of_the_step_at_a_time() {
    let recording = jointed();
    for (part, measured) in [("Magnitude", dvec2(1.0, 4.0).length()), ("X", 1.0), ("Y", -4.0), ("Torque", 0.5)] {
        let text = format!(r#"JointForce(of: "pin", part: {part}, at: 1.0, is: {measured}, within: 1e-9)"#);
        assert_measured(&met(&recording, &text), measured);
    }
    // At the start the force of the first step stands.
    assert_measured(&met(&recording, r#"JointForce(of: "pin", part: X, at: 0, is: 0.1, within: 1e-9)"#), 0.1);
    let missing = failed(&recording, r#"JointForce(of: "weld", at: 1.0, is: 1, within: 9)"#);
    assert_eq!(missing.obstacle, Some(NotMeasured::UnknownJoint { name: "weld".to_owned() }));
}

#[test]
fn the_worst_step_of_a_window_decides_and_the_start_does_not_count() {
    let recording = jointed();
    let worst = failed(&recording, r#"JointForce(of: "pin", part: X, always: true, below: 2.0)"#);
    assert_measured(&worst, 2.0);
    met(&recording, r#"JointForce(of: "pin", part: Y, always: true, is: -4, within: 0)"#);
    let text = worst.to_string();
    assert!(text.contains("JointForce along x of \"pin\" always: 2 N at 2 s, expected below 2"), "{text}");
}
