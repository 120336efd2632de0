//! Expectations about what is not there, at no time, or of nothing.

use super::{mistakes, warnings};

#[test]
fn unknown_body_in_expectation() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    expect: [Speed(of: "bx", at: 1.0, is: 0, within: 1)],
)"##), @r##"
error: there is no body "bx"
 --> scene.ron:5:24
  |
5 |     expect: [Speed(of: "bx", at: 1.0, is: 0, within: 1)],
  |                        ^^^^ did you mean "box"?
  |
  = help: there is "box"
"##);
}

#[test]
fn expectation_past_the_end() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    expect: [Speed(of: "box", at: 2.5, is: 0, within: 1)],
)"##), @r##"
error: this is after the end of the run
 --> scene.ron:5:35
  |
5 |     expect: [Speed(of: "box", at: 2.5, is: 0, within: 1)],
  |                                   ^^^ 2.5 s, but the run takes 2 s
"##);
}

#[test]
fn expectation_without_time_value_or_tolerance() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    expect: [Speed(of: "box"), Speed(of: "box", at: 1, always: true, is: 3)],
)"##), @r##"
error: this expectation does not say when
 --> scene.ron:5:14
  |
5 |     expect: [Speed(of: "box"), Speed(of: "box", at: 1, always: true, is: 3)],
  |              ^^^^^ add `at: TIME`, `always: true`, or `from: TIME`

error: this expectation does not say what
 --> scene.ron:5:14
  |
5 |     expect: [Speed(of: "box"), Speed(of: "box", at: 1, always: true, is: 3)],
  |              ^^^^^ add `is` and `within`, or `above`, or `below`

error: this expectation says in two ways when it holds
 --> scene.ron:5:53
  |
5 |     expect: [Speed(of: "box"), Speed(of: "box", at: 1, always: true, is: 3)],
  |                                                     ^ use one of `at`, `always`, or `from` and `until`

error: a value needs a tolerance
 --> scene.ron:5:74
  |
5 |     expect: [Speed(of: "box"), Speed(of: "box", at: 1, always: true, is: 3)],
  |                                                                          ^ add `within`
"##);
}

#[test]
fn bounds_that_exclude_everything() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    expect: [Y(of: "box", always: true, above: 2, below: 1)],
)"##), @r##"
error: these bounds exclude every value
 --> scene.ron:5:58
  |
5 |     expect: [Y(of: "box", always: true, above: 2, below: 1)],
  |                                                          ^ nothing is above 2 and below 1
"##);
}

#[test]
fn event_between_one_body() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    expect: [Order(events: [Touch("box", "box")]), Never(event: Touch("box", "flor")), Fingerprint(is: "12")],
)"##), @r##"
error: an order needs at least two events
 --> scene.ron:5:28
  |
5 |     expect: [Order(events: [Touch("box", "box")]), Never(event: Touch("box", "flor")), Fingerprint(is: "12")],
  |                            ^ name them here

error: an event is between two bodies
 --> scene.ron:5:42
  |
5 |     expect: [Order(events: [Touch("box", "box")]), Never(event: Touch("box", "flor")), Fingerprint(is: "12")],
  |                                          ^^^^^ "box" on both sides

error: there is no body "flor"
 --> scene.ron:5:78
  |
5 |     expect: [Order(events: [Touch("box", "box")]), Never(event: Touch("box", "flor")), Fingerprint(is: "12")],
  |                                                                              ^^^^^^ unknown body
  |
  = help: there is "box"

error: a fingerprint has 32 hexadecimal digits
 --> scene.ron:5:104
  |
5 |     expect: [Order(events: [Touch("box", "box")]), Never(event: Touch("box", "flor")), Fingerprint(is: "12")],
  |                                                                                                        ^^^^ 2 characters
"##);
}

#[test]
fn repeated_body_stands_for_its_copies_in_expectations() {
    let scene = r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", parts: [Box(size: (1, 1))], repeat: Line(count: 3, spacing: (2, 0))),
        (name: "floor", kind: Static, at: (0, -9), parts: [HalfPlane()]),
    ],
    expect: [
        Y(of: "box", at: 1.0, above: -5),
        AtRest(of: "box", from: 1.9),
        ContactForceSum(on: "box", by: "floor", at: 1.0, is: Weight, within: 1),
        FrictionForce(on: "floor", by: "box", at: 1.0, is: 0, within: 1),
        Never(event: Touch("box", "box")),
        Happens(event: Touch("floor", "box"), at: 1.0, within: 0.1),
    ],
)"##;
    assert_eq!(warnings(scene), "");
}

#[test]
fn unknown_body_beside_a_repeated_one() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))], repeat: Line(count: 2, spacing: (2, 0)))],
    expect: [Never(event: Touch("bx", "box"))],
)"##), @r##"
error: there is no body "bx"
 --> scene.ron:5:33
  |
5 |     expect: [Never(event: Touch("bx", "box"))],
  |                                 ^^^^ did you mean "box"?
  |
  = help: there is "box", "box-0", "box-1"
"##);
}
