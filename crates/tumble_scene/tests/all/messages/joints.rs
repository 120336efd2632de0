//! Joints.

use super::mistakes;

#[test]
fn joints_that_hold_nothing_or_one_thing() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "rod", parts: [Rod(from: (0, 0), to: (1, 0))]), (name: "wall", kind: Static, parts: [Disc(radius: 1)])],
    joints: [
        (name: "pin", kind: Revolute, a: Body(name: "rod"), b: Body(name: "rod", point: (0, 0))),
        (name: "pin", kind: Fixed, a: World(point: (0, 0)), b: World(point: (0, 0))),
        (name: "weld", kind: Fixed, a: World(point: (0, 0)), b: Body(name: "wall")),
        (name: "", kind: Fixed, a: World(point: (0.5, 0)), b: Body(name: "rot")),
    ],
)"##), @r##"
error: joint "pin" holds "rod" to itself
 --> scene.ron:6:75
  |
6 |         (name: "pin", kind: Revolute, a: Body(name: "rod"), b: Body(name: "rod", point: (0, 0))),
  |                                                                           ^^^^^ the same body as at the other end

error: two joints are named "pin"
 --> scene.ron:7:16
  |
7 |         (name: "pin", kind: Fixed, a: World(point: (0, 0)), b: World(point: (0, 0))),
  |                ^^^^^ again here
  |
 ::: scene.ron:6:16
  |
6 |         (name: "pin", kind: Revolute, a: Body(name: "rod"), b: Body(name: "rod", point: (0, 0))),
  |                ----- first here

error: a joint must hold a body
 --> scene.ron:7:64
  |
7 |         (name: "pin", kind: Fixed, a: World(point: (0, 0)), b: World(point: (0, 0))),
  |                                                                ^^^^^ both ends hold the world

error: joint "weld" holds nothing that forces move
 --> scene.ron:8:16
  |
8 |         (name: "weld", kind: Fixed, a: World(point: (0, 0)), b: Body(name: "wall")),
  |                ^^^^^^ one end must hold a dynamic body

error: a joint needs a name
 --> scene.ron:9:16
  |
9 |         (name: "", kind: Fixed, a: World(point: (0.5, 0)), b: Body(name: "rot")),
  |                ^^ empty, or with control characters

error: there is no body "rot"
 --> scene.ron:9:74
  |
9 |         (name: "", kind: Fixed, a: World(point: (0.5, 0)), b: Body(name: "rot")),
  |                                                                          ^^^^^ did you mean "rod"?
  |
  = help: there is "rod", "wall"
"##);
}

#[test]
fn lengths_and_axes_that_mean_nothing() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "rod", parts: [Rod(from: (0, 0), to: (1, 0))])],
    joints: [
        (name: "stay", kind: Distance(length: 0), a: World(point: (0, 0)), b: Body(name: "rod")),
        (name: "none", kind: Distance(), a: World(point: (0.5, 0)), b: Body(name: "rod")),
        (name: "guide", kind: Prismatic(axis: (0, 0)), a: World(point: (0, 0)), b: Body(name: "rod")),
    ],
)"##), @r##"
error: the length of joint "stay" must be positive
 --> scene.ron:6:47
  |
6 |         (name: "stay", kind: Distance(length: 0), a: World(point: (0, 0)), b: Body(name: "rod")),
  |                                               ^ 0 is not above 0

error: the length of joint "none" must be positive
 --> scene.ron:7:30
  |
7 |         (name: "none", kind: Distance(), a: World(point: (0.5, 0)), b: Body(name: "rod")),
  |                              ^^^^^^^^ the anchors coincide at the start

error: the axis of joint "guide" has no direction
 --> scene.ron:8:47
  |
8 |         (name: "guide", kind: Prismatic(axis: (0, 0)), a: World(point: (0, 0)), b: Body(name: "rod")),
  |                                               ^ it must not be (0, 0)
"##);
}

#[test]
fn joints_that_are_open_at_the_start() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "rod", at: (1, 0), angle_degrees: 90, parts: [Rod(from: (0, 0), to: (1, 0))])],
    joints: [
        (name: "pin", kind: Revolute, a: World(point: (1, 0.1)), b: Body(name: "rod", point: (0, 0))),
        (name: "stay", kind: Distance(length: 1), a: World(point: (0, 0.5)), b: Body(name: "rod")),
        (name: "rod", kind: Distance(length: 1.1), a: World(point: (0, 0.5)), b: Body(name: "rod")),
        (name: "guide", kind: Prismatic(axis: (0, 1)), a: World(point: (1.2, 5)), b: Body(name: "rod")),
        (name: "meant", kind: Fixed, a: World(point: (1.2, 5)), b: Body(name: "rod"), allow_gap: true),
    ],
)"##), @r##"
error: joint "pin" is open by 1.000e-1 m at the start
 --> scene.ron:6:16
  |
6 |         (name: "pin", kind: Revolute, a: World(point: (1, 0.1)), b: Body(name: "rod", point: (0, 0))),
  |                ^^^^^ it holds (1.000000, 0.100000) and (1.000000, 0.000000); the slop is 0.005 m
  |
  = help: move the bodies or the anchors, or say `allow_gap: true`

error: joint "rod" is open by 1.000e-1 m at the start
 --> scene.ron:8:16
  |
8 |         (name: "rod", kind: Distance(length: 1.1), a: World(point: (0, 0.5)), b: Body(name: "rod")),
  |                ^^^^^ it holds (0.000000, 0.500000) and (1.000000, 0.500000); the slop is 0.005 m
  |
  = help: move the bodies or the anchors, or say `allow_gap: true`

error: joint "guide" is open by 2.000e-1 m at the start
 --> scene.ron:9:16
  |
9 |         (name: "guide", kind: Prismatic(axis: (0, 1)), a: World(point: (1.2, 5)), b: Body(name: "rod")),
  |                ^^^^^^^ it holds (1.200000, 5.000000) and (1.000000, 0.500000); the slop is 0.005 m
  |
  = help: move the bodies or the anchors, or say `allow_gap: true`
"##);
}

#[test]
fn expectation_of_a_joint_that_does_not_exist() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "rod", parts: [Rod(from: (0, 0), to: (1, 0))])],
    joints: [(name: "pin", kind: Revolute, a: World(point: (0, 0)), b: Body(name: "rod", point: (0, 0)))],
    expect: [
        JointForce(of: "pim", at: 1, is: 2, within: 1),
        JointForce(of: "pin", is: -2, within: 1),
        JointForce(of: "pin", part: Sideways, at: 1, below: 1),
    ],
)"##), @r##"
error: there is no joint "pim"
 --> scene.ron:7:24
  |
7 |         JointForce(of: "pim", at: 1, is: 2, within: 1),
  |                        ^^^^^ did you mean "pin"?
  |
  = help: there is "pin"

error: this expectation does not say when
 --> scene.ron:8:9
  |
8 |         JointForce(of: "pin", is: -2, within: 1),
  |         ^^^^^^^^^^ add `at: TIME`, `always: true`, or `from: TIME`

error: a magnitude must not be negative
 --> scene.ron:8:35
  |
8 |         JointForce(of: "pin", is: -2, within: 1),
  |                                   ^^ -2 is below 0

error: `part` cannot be `Sideways`
 --> scene.ron:9:37
  |
9 |         JointForce(of: "pin", part: Sideways, at: 1, below: 1),
  |                                     ^^^^^^^^ unknown word
  |
  = help: allowed are Magnitude, X, Y, Torque
"##);
}
