//! Line ends, tabs, wide letters and bytes that are no text.

use super::mistakes;

#[test]
fn carriage_returns_and_tabs() {
    insta::assert_snapshot!(mistakes("(\r\n\tformat: 1,\r\n\tduration:\t\"long\",\r\n)\r\n"), @r##"
error: `duration` must be a number
 --> scene.ron:3:12
  |
3 |     duration:    "long",
  |                  ^^^^^^ found a text in quotes
  |
  = help: write the number without quotes
"##);
}

#[test]
fn columns_count_characters() {
    insta::assert_snapshot!(mistakes(r##"(format: 1, duration: 1.0, about: "größer als 2 µm ✓", dtt: 0.1)"##), @r##"
error: the scene has no field `dtt`
 --> scene.ron:1:56
  |
1 | (format: 1, duration: 1.0, about: "größer als 2 µm ✓", dtt: 0.1)
  |                                                        ^^^ did you mean `dt`?
  |
  = help: allowed are format, dimension, about, dt, duration, gravity, length_scale, slop, integrator, time_of_impact, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, joints, forces, expect
"##);
}

#[test]
fn control_characters_in_a_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "a\u{1b}[31m", parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
error: a body needs a name
 --> scene.ron:5:16
  |
5 |         (name: "a\u{1b}[31m", parts: [Disc(radius: 1)]),
  |                ^^^^^^^^^^^^^ empty, or with control characters
"##);
}

#[test]
fn binary_garbage() {
    insta::assert_snapshot!(mistakes("\u{0}\u{1}\u{2}\u{3}garbage"), @r##"
error: this is no value
 --> scene.ron:1:1
  |
1 | ␀␁␂␃garbage
  | ^ expected a number, a text, a word, `(`, `[` or `{`
"##);
}
