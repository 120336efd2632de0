//! Names, repeats, groups and motion of bodies.

use super::mistakes;

#[test]
fn two_bodies_of_one_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", parts: [Box(size: (1, 1))]),
        (name: "ball", parts: [Disc(radius: 1)]),
        (name: "box", parts: [Box(size: (1, 1))]),
    ],
)"##), @r##"
error: two bodies are named "box"
 --> scene.ron:7:16
  |
7 |         (name: "box", parts: [Box(size: (1, 1))]),
  |                ^^^^^ again here
  |
 ::: scene.ron:5:16
  |
5 |         (name: "box", parts: [Box(size: (1, 1))]),
  |                ----- first here
"##);
}

#[test]
fn repeat_that_produces_a_taken_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box-1", parts: [Box(size: (1, 1))]),
        (name: "box", parts: [Box(size: (1, 1))], repeat: Line(count: 3, spacing: (2, 0))),
    ],
)"##), @r##"
error: two bodies are named "box-1", repeats included
 --> scene.ron:6:16
  |
6 |         (name: "box", parts: [Box(size: (1, 1))], repeat: Line(count: 3, spacing: (2, 0))),
  |                ^^^^^ again here
  |
 ::: scene.ron:5:16
  |
5 |         (name: "box-1", parts: [Box(size: (1, 1))]),
  |                ------- first here
"##);
}

#[test]
fn keyframes() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "lift", kind: Kinematic, parts: [Disc(radius: 1)], keyframes: [(time: 1, at: (0, 0)), (time: 1, at: (0, 1))]),
        (name: "box", parts: [Disc(radius: 1)], keyframes: [(time: 1, at: (0, 0))]),
    ],
)"##), @r##"
error: times of keyframes must rise
 --> scene.ron:5:109
  |
5 |         (name: "lift", kind: Kinematic, parts: [Disc(radius: 1)], keyframes: [(time: 1, at: (0, 0)), (time: 1, at: (0, 1))]),
  |                                                                                                             ^ 1 s does not come after 1 s

error: only a kinematic body follows keyframes
 --> scene.ron:6:60
  |
6 |         (name: "box", parts: [Disc(radius: 1)], keyframes: [(time: 1, at: (0, 0))]),
  |                                                            ^ write `kind: Kinematic` for this body
"##);
}

#[test]
fn static_body_with_velocity() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", kind: Static, velocity: (1, 0), parts: [HalfPlane()]),
    ],
)"##), @r##"
error: a static body never moves
 --> scene.ron:5:49
  |
5 |         (name: "floor", kind: Static, velocity: (1, 0), parts: [HalfPlane()]),
  |                                                 ^ write `kind: Kinematic` for a body that follows its velocity
"##);
}

#[test]
fn group_names_beside_bits() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "a", parts: [Disc(radius: 1)], groups: ["balls"]),
        (name: "b", parts: [Disc(radius: 1)], collides_with: 0b10),
    ],
)"##), @r##"
error: collision groups are given by name and as bits
 --> scene.ron:6:62
  |
6 |         (name: "b", parts: [Disc(radius: 1)], collides_with: 0b10),
  |                                                              ^^^^ as bits here
  |
 ::: scene.ron:5:55
  |
5 |         (name: "a", parts: [Disc(radius: 1)], groups: ["balls"]),
  |                                                       - by name here
  |
  = help: use one of the two throughout the scene
"##);
}
