//! What may be run all the same.

use super::warnings;

#[test]
fn kinetic_friction_above_static() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", kind: Static, material: "silver", parts: [HalfPlane()]),
        (name: "coin", at: (0, 1), material: "silver", parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
warning: "silver" on "silver": kinetic friction 1.5 is above static friction 1.4
 --> scene.ron:5:49
  |
5 |         (name: "floor", kind: Static, material: "silver", parts: [HalfPlane()]),
  |                                                 ^^^^^^^^ used here
  |
 ::: scene.ron:6:46
  |
6 |         (name: "coin", at: (0, 1), material: "silver", parts: [Disc(radius: 1)]),
  |                                              -------- and here
"##);
}

#[test]
fn one_coefficient_for_both() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", kind: Static, parts: [HalfPlane(material: "ice")]),
        (name: "skate", at: (0, 1), material: "steel", parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
warning: "ice" on "steel": no kinetic friction is known, so it is taken as 0.03, like the other one
 --> scene.ron:5:16
  |
5 |         (name: "floor", kind: Static, parts: [HalfPlane(material: "ice")]),
  |                ^^^^^^^ used here
  |
 ::: scene.ron:6:47
  |
6 |         (name: "skate", at: (0, 1), material: "steel", parts: [Disc(radius: 1)]),
  |                                               ------- and here
"##);
}

#[test]
fn no_friction_known() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", kind: Static, material: "zinc", parts: [HalfPlane()]),
        (name: "coin", at: (0, 1), material: "gold", parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
warning: "gold" on "zinc": no static friction is known, so it is taken as 2.5, like the other one
 --> scene.ron:6:46
  |
6 |         (name: "coin", at: (0, 1), material: "gold", parts: [Disc(radius: 1)]),
  |                                              ^^^^^^ used here
  |
 ::: scene.ron:5:49
  |
5 |         (name: "floor", kind: Static, material: "zinc", parts: [HalfPlane()]),
  |                                                 ------ and here

warning: "gold" on "zinc": no table tells the friction of "zinc" against it, so there is none
 --> scene.ron:6:46
  |
6 |         (name: "coin", at: (0, 1), material: "gold", parts: [Disc(radius: 1)]),
  |                                              ^^^^^^ used here
  |
 ::: scene.ron:5:49
  |
5 |         (name: "floor", kind: Static, material: "zinc", parts: [HalfPlane()]),
  |                                                 ------ and here
"##);
}

#[test]
fn length_scale_too_large() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "flea", parts: [Disc(radius: 0.001)]),
    ],
)"##), @r##"
warning: "flea" is very small for a length scale of 1 m
 --> scene.ron:5:16
  |
5 |         (name: "flea", parts: [Disc(radius: 0.001)]),
  |                ^^^^^^ 0.002 m across, so the default overlap left alone is more than a tenth of it
  |
  = help: set `length_scale` to the size of a typical body
"##);
}

#[test]
fn length_scale_too_small() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "moon", parts: [Disc(radius: 1.7e6)]),
    ],
)"##), @r##"
warning: all dynamic bodies are very large for a length scale of 1 m
 --> scene.ron:5:16
  |
5 |         (name: "moon", parts: [Disc(radius: 1.7e6)]),
  |                ^^^^^^ 3400000 m across
  |
  = help: set `length_scale` to the size of a typical body
"##);
}

#[test]
fn force_that_does_nothing() {
    insta::assert_snapshot!(warnings(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    forces: [(on: "box")],
)"##), @r##"
warning: this force does nothing
 --> scene.ron:5:14
  |
5 |     forces: [(on: "box")],
  |              ^ neither `force` nor `torque` is given
"##);
}

#[test]
fn no_bodies() {
    insta::assert_snapshot!(warnings(r##"(format: 1, duration: 1.0)"##), @r##"
warning: the scene has no bodies
 --> scene.ron:1:1
  |
1 | (format: 1, duration: 1.0)
  | ^ nothing will happen
"##);
}
