//! Fields, words and kinds of values that the format does not know.

use super::mistakes;

#[test]
fn unknown_field_with_a_near_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "stick", parts: [Rod(from: (0, 0), to: (1, 0), densty: 2.0)]),
    ],
)"##), @r##"
error: `Rod` has no field `densty`
 --> scene.ron:5:63
  |
5 |         (name: "stick", parts: [Rod(from: (0, 0), to: (1, 0), densty: 2.0)]),
  |                                                               ^^^^^^ did you mean `density`?
  |
  = help: allowed are from, to, radius, density, mass, material, sensor, groups, collides_with
"##);
}

#[test]
fn unknown_field_without_a_near_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    wind: 3,
)"##), @r##"
error: the scene has no field `wind`
 --> scene.ron:5:5
  |
5 |     wind: 3,
  |     ^^^^ unknown field
  |
  = help: allowed are format, dimension, about, dt, duration, gravity, length_scale, slop, integrator, time_of_impact, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, joints, forces, expect
"##);
}

#[test]
fn missing_fields() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (kind: Static),
    ],
)"##), @r##"
error: an element of `bodies` needs `name` and `parts`
 --> scene.ron:5:9
  |
5 |         (kind: Static),
  |         ^ `name` and `parts` are missing here
"##);
}

#[test]
fn repeated_field() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    dt: 0.01, dt: 0.02,
)"##), @r##"
error: `dt` stands twice in the scene
 --> scene.ron:5:15
  |
5 |     dt: 0.01, dt: 0.02,
  |     --        ^^ again here
  |     |
  |     first here
"##);
}

#[test]
fn text_instead_of_number() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    dt: "0.01",
)"##), @r##"
error: `dt` must be a number
 --> scene.ron:5:9
  |
5 |     dt: "0.01",
  |         ^^^^^^ found a text in quotes
  |
  = help: write the number without quotes
"##);
}

#[test]
fn word_instead_of_text() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: box, parts: [Box(size: (1, 1))]),
    ],
)"##), @r##"
error: `name` must be a text in quotes
 --> scene.ron:5:16
  |
5 |         (name: box, parts: [Box(size: (1, 1))]),
  |                ^^^ found the word `box`
  |
  = help: write "box" in quotes
"##);
}

#[test]
fn text_instead_of_word() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    contact: "Impulse",
)"##), @r##"
error: `contact` is a word, not a text
 --> scene.ron:5:14
  |
5 |     contact: "Impulse",
  |              ^^^^^^^^^ found a text in quotes
  |
  = help: write Impulse without quotes
"##);
}

#[test]
fn unknown_word() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", kind: dynamc, parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
error: `kind` cannot be `dynamc`
 --> scene.ron:5:29
  |
5 |         (name: "box", kind: dynamc, parts: [Disc(radius: 1)]),
  |                             ^^^^^^ did you mean `Dynamic`?
  |
  = help: allowed are Dynamic, Kinematic, Static
"##);
}

#[test]
fn unknown_part() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", parts: [Circle(radius: 1)]),
    ],
)"##), @r##"
error: an element of `parts` cannot be `Circle`
 --> scene.ron:5:31
  |
5 |         (name: "box", parts: [Circle(radius: 1)]),
  |                               ^^^^^^ unknown word
  |
  = help: allowed are Rod, Disc, Polygon, Box, HalfPlane, List
"##);
}

#[test]
fn square_brackets_around_a_point() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", at: [1, 2], parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
error: `at` must be two numbers `(x, y)`
 --> scene.ron:5:27
  |
5 |         (name: "box", at: [1, 2], parts: [Disc(radius: 1)]),
  |                           ^ found a list
  |
  = help: use parentheses instead of square brackets
"##);
}

#[test]
fn three_numbers_for_a_point() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", at: (1, 2, 3), parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
error: `at` must be two numbers `(x, y)`
 --> scene.ron:5:27
  |
5 |         (name: "box", at: (1, 2, 3), parts: [Disc(radius: 1)]),
  |                           ^^^^^^^^^ found 3 values in parentheses
"##);
}

#[test]
fn part_without_square_brackets() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "box", parts: Disc(radius: 1)),
    ],
)"##), @r##"
error: `parts` must be a list `[…]`
 --> scene.ron:5:30
  |
5 |         (name: "box", parts: Disc(radius: 1)),
  |                              ^^^^ found `Disc(…)`
  |
  = help: put square brackets around it: `[…]`
"##);
}

#[test]
fn part_without_parentheses() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        (name: "floor", kind: Static, parts: [HalfPlane]),
    ],
)"##), @r##"
error: `HalfPlane` has fields
 --> scene.ron:5:47
  |
5 |         (name: "floor", kind: Static, parts: [HalfPlane]),
  |                                               ^^^^^^^^^ write `HalfPlane(name: value, …)`
"##);
}

#[test]
fn struct_with_a_name() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [
        Body(name: "box", parts: [Disc(radius: 1)]),
    ],
)"##), @r##"
error: an element of `bodies` is written without a name
 --> scene.ron:5:9
  |
5 |         Body(name: "box", parts: [Disc(radius: 1)]),
  |         ^^^^ remove this
  |
  = help: write only the parentheses: `(name: value, …)`
"##);
}

#[test]
fn infinity_and_nan() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    dt: inf, gravity: (0, NaN), length_scale: 1e999,
)"##), @r##"
error: `dt` must be finite
 --> scene.ron:5:9
  |
5 |     dt: inf, gravity: (0, NaN), length_scale: 1e999,
  |         ^^^ neither infinity nor NaN is a value

error: `gravity` must be finite
 --> scene.ron:5:27
  |
5 |     dt: inf, gravity: (0, NaN), length_scale: 1e999,
  |                           ^^^ neither infinity nor NaN is a value

error: `length_scale` must be finite
 --> scene.ron:5:47
  |
5 |     dt: inf, gravity: (0, NaN), length_scale: 1e999,
  |                                               ^^^^^ neither infinity nor NaN is a value
"##);
}

#[test]
fn fraction_where_a_whole_number_is_needed() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    every: 1.5, seed: -1,
)"##), @r##"
error: `every` must be a whole number
 --> scene.ron:5:12
  |
5 |     every: 1.5, seed: -1,
  |            ^^^ expected a whole number from 0 to 4294967295

error: `seed` must be a whole number
 --> scene.ron:5:23
  |
5 |     every: 1.5, seed: -1,
  |                       ^^ expected a whole number from 0 to 18446744073709551615
"##);
}
