//! Channels: every name has values, every mistake names what would have been right.

use crate::common;
use glam::DVec2;
use tumble_math::{Planar, Spatial};
use tumble_record::{
    AnchorRecord, AuditRow, BodyKind, BodyRecord, BodyState, Channel, ChannelError, ContactRecord, JointForce,
    JointRecord, Recording, Sample, body_quantity_names, world_names,
};

fn parse(text: &str) -> Channel {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str) -> ChannelError {
    text.parse::<Channel>().expect_err("not a channel")
}

fn body(id: u64, name: &str, kind: BodyKind) -> BodyRecord {
    BodyRecord { id, name: name.to_owned(), kind, mass: 2.0, inertia: 0.5, shapes: Vec::new() }
}

/// A block that slides to the right on a floor with ids in either order; dt = 0.5, weight 20, friction −5.
fn sliding_block(block_first: bool) -> Recording {
    let block = body(u64::from(!block_first), "block", BodyKind::Dynamic);
    let floor = body(u64::from(block_first), "floor", BodyKind::Static);
    let moving = Some(BodyState {
        position: DVec2::new(1.0, 2.0),
        orientation: 0.25,
        velocity: DVec2::new(3.0, 4.0),
        angular_velocity: 2.0,
    });
    let resting = Some(BodyState::default());
    // Force of the floor on the block at each of two points: (−2.5, 10); the record holds what acts on b.
    let normal = if block_first { DVec2::NEG_Y } else { DVec2::Y };
    let contact: ContactRecord = ContactRecord {
        a: 0,
        b: 1,
        point: DVec2::ZERO,
        normal,
        separation: 0.0,
        normal_impulse: 5.0,
        tangent_impulse: -1.25,
        kind: "vertex_on_half_plane".into(),
    };
    let on_block = if block_first { -contact.impulse_on_b() } else { contact.impulse_on_b() };
    assert_eq!(on_block / 0.5, DVec2::new(-2.5, 10.0), "the floor pushes up and to the left");
    let (bodies, states) = if block_first {
        (vec![block, floor], vec![moving, resting])
    } else {
        (vec![floor, block], vec![resting, moving])
    };
    let sample = Sample { step: 1, time: 0.5, states, contacts: vec![contact.clone(), contact], joints: Vec::new() };
    let audit =
        AuditRow { step: 1, time: 0.5, kinetic: 26.0, iterations: None, residual: Some(1e-9), ..AuditRow::default() };
    Recording { dt: 0.5, bodies, samples: vec![sample], audit: vec![audit], ..Recording::default() }
}

#[test]
fn values_of_a_body_are_those_of_its_state_and_contacts() {
    for recording in [sliding_block(true), sliding_block(false)] {
        for (name, value) in [
            ("x", 1.0),
            ("y", 2.0),
            ("angle", 0.25),
            ("vx", 3.0),
            ("vy", 4.0),
            ("omega", 2.0),
            ("speed", 5.0),
            // ½ · 2 · 25 + ½ · 0.5 · 4
            ("kinetic", 26.0),
            ("normal_force", 20.0),
            // To the left is negative, whichever of the two is a.
            ("friction_force", -5.0),
            ("contacts", 2.0),
        ] {
            let series = parse(&format!("{name}:block")).series(&recording).expect("the block is there");
            assert_eq!((series.len(), series[0].label.as_str()), (1, "block"));
            assert_eq!((series[0].times.as_slice(), series[0].values.as_slice()), (&[0.5][..], &[value][..]), "{name}");
        }
    }
}

#[test]
fn body_that_leaves_the_world_leaves_its_curve() {
    let mut recording = common::falling_rods(0.05, 10);
    recording.samples[2].states[0] = None;
    recording.samples[4].states.clear();
    let series = parse("y:L").series(&recording).expect("a body");
    assert_eq!(series[0].times.len(), recording.samples.len() - 2);
}

#[test]
fn iterations_have_no_value_where_nothing_was_solved() {
    let recording = sliding_block(true);
    assert!(parse("iterations").series(&recording).expect("of the world")[0].values.is_empty());
    assert_eq!(parse("residual").series(&recording).expect("of the world")[0].values, [1e-9]);
}

#[test]
fn every_name_parses_has_a_title_and_shows_itself() {
    let recording = sliding_block(true);
    let of_plane = |text: &str| match parse(text).series(&recording) {
        Ok(series) => assert!(!series.is_empty(), "{text}"),
        Err(error) => assert!(matches!(error, ChannelError::NotHere { .. }), "{error}"),
    };
    for name in world_names() {
        assert_eq!(parse(name).to_string(), name);
        of_plane(name);
    }
    for name in body_quantity_names() {
        let text = format!("{name}:block");
        assert_eq!(parse(&text).to_string(), text);
        assert!(parse(&text).title().starts_with("block: "));
        of_plane(&text);
    }
}

#[test]
fn channels_of_space_are_refused_in_the_plane_and_the_other_way_round() {
    let message = |error: Result<(), ChannelError>| error.expect_err("not here").to_string();
    let plane = sliding_block(true);
    assert_eq!(message(parse("z:block").check(&plane)), "channel `z:block` is of space, this scene is of the plane");
    let space = Recording::<Spatial>::default();
    let expected = "channel `omega` is of the plane, this scene is of space";
    assert_eq!(message(parse("omega").check(&space)), expected);
    assert!(parse("wx").check(&space).is_ok() && parse("speed").check(&space).is_ok());
}

#[test]
fn name_of_both_kinds_means_the_world_unless_a_body_is_named() {
    assert!(matches!(parse("kinetic"), Channel::World(_)));
    assert!(matches!(parse("kinetic:block"), Channel::Body(..)));
    assert!(matches!(parse("y"), Channel::EveryBody(_)));
}

#[test]
fn body_names_may_contain_colons() {
    assert_eq!(parse("y:a:b").to_string(), "y:a:b");
    assert!(matches!(parse("y:a:b"), Channel::Body(_, name) if name == "a:b"));
}

#[test]
fn unknown_channel_lists_the_allowed_names_and_the_nearest() {
    assert_eq!(
        error("omeg:block").to_string(),
        "unknown channel `omeg` (did you mean `omega`?); of the world: kinetic, potential, total, momentum_x, momentum_y, \
         momentum_z, angular_momentum, angular_momentum_x, angular_momentum_y, angular_momentum_z, deepest_overlap, contacts, \
         iterations, residual; of a body (NAME:BODY): x, y, z, angle, vx, vy, vz, omega, wx, wy, wz, speed, kinetic, \
         normal_force, friction_force, contacts; of a joint (NAME:JOINT): joint_force, joint_force_x, joint_force_y, \
         joint_force_z, joint_torque"
    );
    assert!(matches!(error("zebra"), ChannelError::UnknownName { suggestion: None, .. }));
    assert!(matches!(error(""), ChannelError::UnknownName { .. }));
}

#[test]
fn channel_of_the_world_takes_no_body() {
    let message = error("potential:block").to_string();
    assert!(message.starts_with("channel `potential` is of the whole world: leave out `:block`"), "{message}");
}

#[test]
fn unknown_body_lists_the_bodies_and_the_nearest() {
    let error = parse("y:blok").check(&sliding_block(true)).expect_err("no such body");
    assert_eq!(
        error.to_string(),
        "channel `y:blok`: there is no body `blok` (did you mean `block`?); bodies: block, floor"
    );
    assert!(parse("y:floor").check(&sliding_block(true)).is_ok(), "a static body has values too");
}

#[test]
fn too_many_curves_are_refused() {
    let bodies = (0..13).map(|id| body(id, &format!("crate-{id}"), BodyKind::Dynamic)).collect();
    let mut recording = Recording { bodies, ..Recording::default() };
    let message = parse("y").check(&recording).expect_err("too many").to_string();
    assert!(message.starts_with("channel `y` would show 13 bodies, at most 12 fit: name one as `y:BODY`"), "{message}");
    recording.bodies.pop();
    assert!(parse("y").check(&recording).is_ok());
}

#[test]
fn file_names_are_safe_and_distinct() {
    assert_eq!(parse("y:crate-0-3").file_stem(), "y-crate-0-3");
    assert_eq!(parse("total").file_stem(), "total");
    let stems = ["y:a/b", "y:a_b", "y:a b", "y:../../etc", "y:é"].map(|text| parse(text).file_stem());
    for (index, stem) in stems.iter().enumerate() {
        assert!(stem.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"._-".contains(&byte)), "{stem}");
        assert!(!stems[..index].contains(stem), "{stem} twice");
    }
}

#[test]
fn forces_of_joints_are_curves_from_the_first_step_on() {
    let end: AnchorRecord = AnchorRecord { body: None, point: DVec2::ZERO };
    let joint = |name: &str| JointRecord {
        name: name.to_owned(),
        kind: "fixed".into(),
        a: end,
        b: end,
        axis: None,
        from: 0.0,
        until: None,
    };
    let given = |joint, x| JointForce { joint, point: DVec2::ZERO, force: DVec2::new(x, -4.0), torque: 7.0 };
    let sample = |step: u64, x| Sample {
        step,
        time: 0.5 * step as f64,
        joints: vec![given(0, 0.0), given(1, x)],
        ..Sample::default()
    };
    let samples = vec![sample(0, 9.0), sample(1, 3.0), sample(2, -3.0)];
    let recording = Recording { joints: vec![joint("pin"), joint("weld")], samples, ..Recording::default() };
    let values = |text: &str| parse(text).series(&recording).expect("the joint exists")[0].values.clone();
    assert_eq!(values("joint_force:weld"), [5.0, 5.0]);
    assert_eq!(values("joint_force_x:weld"), [3.0, -3.0]);
    assert_eq!(values("joint_force_y:pin"), [-4.0, -4.0]);
    assert_eq!(values("joint_torque:pin"), [7.0, 7.0]);
    let every = parse("joint_force").series(&recording).expect("two joints");
    assert_eq!(every.iter().map(|series| &*series.label).collect::<Vec<_>>(), ["pin", "weld"]);
    assert_eq!(parse("joint_force:weld").file_stem(), "joint_force-weld");
    let error = parse("joint_force:wled").check(&recording).expect_err("no such joint");
    assert_eq!(
        error.to_string(),
        "channel `joint_force:wled`: there is no joint `wled` (did you mean `weld`?); joints: pin, weld"
    );
    let error = parse("joint_torque").check::<Planar>(&Recording::default()).expect_err("no joints");
    assert!(matches!(error, ChannelError::NotSoManyJoints { .. }));
}
