//! Springs and forces.

use super::mistakes;

#[test]
fn spring_to_itself() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    springs: [(from: Body(name: "box"), to: Body(name: "box", point: (0, 1)), stiffness: 3)],
)"##), @r##"
error: a spring ties "box" to itself
 --> scene.ron:5:56
  |
5 |     springs: [(from: Body(name: "box"), to: Body(name: "box", point: (0, 1)), stiffness: 3)],
  |                                                        ^^^^^ the same body as at the other end
"##);
}

#[test]
fn force_that_ends_before_it_begins() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    forces: [(on: "box", force: (1, 0), from: 2, until: 1, factor: [(0, 0), (0, 1)])],
)"##), @r##"
error: a force must end after it begins
 --> scene.ron:5:57
  |
5 |     forces: [(on: "box", force: (1, 0), from: 2, until: 1, factor: [(0, 0), (0, 1)])],
  |                                                         ^ 1 s does not come after 2 s

error: times of a factor must rise
 --> scene.ron:5:77
  |
5 |     forces: [(on: "box", force: (1, 0), from: 2, until: 1, factor: [(0, 0), (0, 1)])],
  |                                                                             ^ 0 s does not come after 0 s
"##);
}

#[test]
fn repeated_body_where_one_is_meant() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", parts: [Box(size: (1, 1))], repeat: Line(count: 3, spacing: (2, 0))),
    ],
    forces: [(on: "box", torque: 1)],
)"##), @r##"
error: "box" stands for many bodies
 --> scene.ron:7:19
  |
7 |     forces: [(on: "box", torque: 1)],
  |                   ^^^^^ name one of them, such as "box-0"
"##);
}
