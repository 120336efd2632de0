//! Mistakes in scenes of space, which are told like those of the plane.

use tumble_scene::AnyLoaded;

/// The message about a scene of space with these bodies and expectations.
fn refused(bodies: &str, expect: &str) -> String {
    let text = format!(
        "(\n    format: 1, dimension: Spatial, duration: 1.0,\n    bodies: [\n        {bodies}\n    ],\n    expect: [{expect}],\n)"
    );
    match AnyLoaded::parse(&text, "space.ron") {
        Ok(_) => panic!("this was accepted:\n{text}"),
        Err(mistakes) => mistakes.to_string(),
    }
}

#[test]
fn fields_of_the_plane_are_unknown_in_space() {
    let message = refused("(name: \"a\", angle_degrees: 3.0, parts: [Sphere(radius: 1.0)]),", "");
    assert!(message.contains("has no field `angle_degrees`"), "{message}");
    assert!(message.contains("orientation"), "{message}");
    assert!(message.contains("space.ron:4:21"), "{message}");
}

#[test]
fn words_of_the_plane_are_unknown_in_space_and_near_ones_are_told() {
    let message = refused("(name: \"a\", parts: [Spere(radius: 1.0)]),", "");
    assert!(message.contains("did you mean `Sphere`?"), "{message}");
    let message =
        refused("(name: \"a\", parts: [Sphere(radius: 1.0)]),", "Angle(of: \"a\", always: true, is_degrees: 0)");
    assert!(message.contains("cannot be `Angle`"), "{message}");
    assert!(message.contains("Tilt"), "{message}");
}

#[test]
fn words_of_space_are_unknown_in_the_plane() {
    let text = "(format: 1, duration: 1.0, bodies: [(name: \"a\", parts: [Disc(radius: 1.0)])],
        expect: [AngularVelocityY(of: \"a\", at: 1, below: 0)])";
    let message = AnyLoaded::parse(text, "plane.ron").expect_err("it is refused").to_string();
    assert!(message.contains("cannot be `AngularVelocityY`"), "{message}");
    assert!(message.contains("AngularVelocity"), "{message}");
}

#[test]
fn vectors_of_space_have_three_numbers() {
    let message = refused("(name: \"a\", at: (1, 2), parts: [Sphere(radius: 1.0)]),", "");
    assert!(message.contains("`at` must be three numbers `(x, y, z)`"), "{message}");
    assert!(message.contains("found 2 values in parentheses"), "{message}");
}

#[test]
fn quantities_that_mean_nothing_are_told_together() {
    let bodies = "(name: \"a\", orientation: Quaternion(0, 0, 0, 0), parts: [Sphere(radius: -1.0)]),
        (name: \"b\", parts: [Sphere(radius: 1.0)], inertia: Diagonal(1, 1, 3)),
        (name: \"c\", parts: [HalfSpace()]),
        (name: \"d\", parts: [Box(size: (1, 1, 1), orientation: Turn(axis: (0, 0, 0), angle_degrees: 3))]),
        (name: \"e\", parts: [Rod(from: (0, 0, 0), to: (1, 0, 0))]),";
    let message = refused(bodies, "Tilt(of: \"b\", axis: (0, 0, 0), always: true, below_degrees: 1)");
    for part in [
        "the orientation of \"a\" has no direction",
        "the radius of a sphere is -1 m, but must be positive",
        "the inertia of \"b\" is that of no body",
        "the largest is more than the other two together",
        "a half-space has no end and no mass, so the dynamic body \"c\" cannot have one",
        "its orientation has an axis or a quaternion without direction",
        // A thin rod cannot be turned about itself by a definite torque.
        "\"e\" has a mass that cannot be computed with",
        "this has no direction",
    ] {
        assert!(message.contains(part), "{part} is missing from\n{message}");
    }
}

#[test]
fn a_misspelt_dimension_is_told_with_the_two_that_exist() {
    let mistakes =
        AnyLoaded::parse("(format: 1, dimension: Spatal, duration: 1.0)", "space.ron").unwrap_err().to_string();
    assert!(mistakes.contains("`dimension` cannot be `Spatal`"), "{mistakes}");
    assert!(mistakes.contains("allowed are Planar, Spatial"), "{mistakes}");
}

#[test]
fn a_scene_of_space_is_refused_where_one_of_the_plane_is_read() {
    let text = "(format: 1, dimension: Spatial, duration: 1.0)";
    let mistakes = tumble_scene::format::Scene::parse(text, "space.ron").unwrap_err().to_string();
    assert!(mistakes.contains("this scene is not Planar"), "{mistakes}");
    assert!(mistakes.contains("space.ron:1:24"), "{mistakes}");
}
