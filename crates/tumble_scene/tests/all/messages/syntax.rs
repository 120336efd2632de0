//! Text that is not RON.

use super::mistakes;

#[test]
fn missing_comma() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1
    duration: 2.0,
)"##), @r##"
error: a comma is missing
 --> scene.ron:2:13
  |
2 |     format: 1
  |             ^ expected `,` after this
"##);
}

#[test]
fn equals_sign_instead_of_colon() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration = 2.0,
)"##), @r##"
error: a field is written with a colon
 --> scene.ron:3:14
  |
3 |     duration = 2.0,
  |              ^ expected `:`
  |
  = help: write `name: value`
"##);
}

#[test]
fn wrong_bracket() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    forces: [(on: "box", force: (1, 0)]),
)"##), @r##"
error: expected `,` or `)`, found `]`
 --> scene.ron:5:39
  |
5 |     forces: [(on: "box", force: (1, 0)]),
  |              - this is still open     ^ `)` is what closes here
"##);
}

#[test]
fn truncated_file() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    bodies: [
        (name: "box", parts: ["##), @r##"
error: the file ends before this `[` is closed
 --> scene.ron:4:30
  |
4 |         (name: "box", parts: [
  |                              ^ expected `]` after this
"##);
}

#[test]
fn unclosed_text() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    about: "Falls,
)"##), @r##"
error: this text never ends
 --> scene.ron:3:12
  |
3 |     about: "Falls,
  |            ^ expected `"` after this
"##);
}

#[test]
fn unclosed_comment() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1, /* why
)"##), @r##"
error: this comment never ends
 --> scene.ron:2:16
  |
2 |     format: 1, /* why
  |                ^^ expected `*/` after this
"##);
}

#[test]
fn empty_file() {
    insta::assert_snapshot!(mistakes(""), @r##"
error: the file is empty
 --> scene.ron:1:1
  |
1 |
  | ^ nothing here
  |
  = help: the smallest scene is `(format: 1, duration: 1.0)`
"##);
}

#[test]
fn text_after_the_end() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
)
(format: 1)"##), @r##"
error: there is text after the end of the scene
 --> scene.ron:5:1
  |
5 | (format: 1)
  | ^ the scene ended before this
"##);
}
