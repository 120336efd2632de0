//! Parts without shape, and bodies without mass.

use super::mistakes;

#[test]
fn coincident_rod_ends() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "stick", parts: [Rod(from: (1, 2), to: (1, 2))]),
    ],
)"##), @r##"
error: this part has no proper shape
 --> scene.ron:5:33
  |
5 |         (name: "stick", parts: [Rod(from: (1, 2), to: (1, 2))]),
  |                                 ^^^ both ends of the rod are at (1, 2), so it has no length
"##);
}

#[test]
fn self_crossing_polygon() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "bow", parts: [Polygon(points: [(0, 0), (1, 1), (1, 0), (0, 1)])]),
    ],
)"##), @r##"
error: this part has no proper shape
 --> scene.ron:5:31
  |
5 |         (name: "bow", parts: [Polygon(points: [(0, 0), (1, 1), (1, 0), (0, 1)])]),
  |                               ^^^^^^^ the polygon crosses itself: the side after point 0 meets the side after point 2
"##);
}

#[test]
fn zero_density_and_negative_mass() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "a", parts: [Disc(radius: 1, density: 0)]),
        (name: "b", parts: [Disc(radius: 1, mass: -1)]),
    ],
)"##), @r##"
error: a density must be positive
 --> scene.ron:5:54
  |
5 |         (name: "a", parts: [Disc(radius: 1, density: 0)]),
  |                                                      ^ 0 is not above 0

error: a mass must be positive
 --> scene.ron:6:51
  |
6 |         (name: "b", parts: [Disc(radius: 1, mass: -1)]),
  |                                                   ^^ -1 is not above 0
"##);
}

#[test]
fn density_and_mass() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "a", parts: [Disc(radius: 1, density: 1, mass: 1)]),
    ],
)"##), @r##"
error: a part has either a density or a mass
 --> scene.ron:5:63
  |
5 |         (name: "a", parts: [Disc(radius: 1, density: 1, mass: 1)]),
  |                                                      -        ^ one of the two is too much
  |                                                      |
  |                                                      the other
"##);
}

#[test]
fn no_mass() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "ghost", parts: []),
    ],
)"##), @r##"
error: the dynamic body "ghost" has no mass
 --> scene.ron:5:32
  |
5 |         (name: "ghost", parts: []),
  |                                ^ give it parts, or both `mass` and `inertia`
"##);
}

#[test]
fn overrides_not_positive() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", mass: 0, inertia: -2, parts: [Box(size: (1, 1))]),
    ],
)"##), @r##"
error: the mass of "box" must be positive
 --> scene.ron:5:29
  |
5 |         (name: "box", mass: 0, inertia: -2, parts: [Box(size: (1, 1))]),
  |                             ^ 0 is not above 0

error: the inertia of "box" must be positive
 --> scene.ron:5:41
  |
5 |         (name: "box", mass: 0, inertia: -2, parts: [Box(size: (1, 1))]),
  |                                         ^^ -2 is not above 0
"##);
}

#[test]
fn half_plane_on_a_dynamic_body() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", parts: [HalfPlane()]),
    ],
)"##), @r##"
error: a half-plane has no end and no mass, so the dynamic body "floor" cannot have one
 --> scene.ron:5:33
  |
5 |         (name: "floor", parts: [HalfPlane()]),
  |                                 ^^^^^^^^^ write `kind: Static` or `kind: Kinematic` for this body
"##);
}

#[test]
fn unknown_list_of_parts() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    part_lists: {"hammer": [Disc(radius: 1)]},
    bodies: [
        (name: "box", parts: [List("hamer")]),
    ],
)"##), @r##"
error: there is no list of parts "hamer"
 --> scene.ron:6:31
  |
6 |         (name: "box", parts: [List("hamer")]),
  |                               ^^^^ did you mean "hammer"?
  |
  = help: there is "hammer"
"##);
}
