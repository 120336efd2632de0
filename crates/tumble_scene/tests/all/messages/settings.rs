//! Settings that mean nothing.

use super::mistakes;

#[test]
fn unknown_format() {
    insta::assert_snapshot!(mistakes(r##"(format: 2, duration: 1.0)"##), @r##"
warning: the scene has no bodies
 --> scene.ron:1:1
  |
1 | (format: 2, duration: 1.0)
  | ^ nothing will happen

error: format 2 is not known
 --> scene.ron:1:10
  |
1 | (format: 2, duration: 1.0)
  |          ^ this version of tumble reads format 1
"##);
}

#[test]
fn time_step_and_duration() {
    insta::assert_snapshot!(mistakes(r##"(format: 1, duration: 0.001, dt: 0.01, bodies: [(name: "a", parts: [Disc(radius: 1)])])"##), @r##"
error: the duration is shorter than one step
 --> scene.ron:1:23
  |
1 | (format: 1, duration: 0.001, dt: 0.01, bodies: [(name: "a", parts: [Disc(radius: 1)])])
  |                       ^^^^^ 0.001 s, but one step takes 0.01 s
"##);
}

#[test]
fn time_step_not_positive() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    dt: 0.0,
)"##), @r##"
error: the time step dt must be positive
 --> scene.ron:5:9
  |
5 |     dt: 0.0,
  |         ^^^ 0 is not above 0
"##);
}
