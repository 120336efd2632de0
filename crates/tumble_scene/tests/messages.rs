//! What a user reads when a scene is wrong: one test per kind of mistake, the whole message each time.

use tumble_scene::format::Scene;

/// The message about a scene that must be refused.
fn mistakes(text: &str) -> String {
    Scene::parse(text, "scene.ron").expect_err("the scene is wrong").to_string()
}

/// The message about a scene that may be run all the same.
fn warnings(text: &str) -> String {
    let loaded = Scene::parse(text, "scene.ron").unwrap_or_else(|mistakes| panic!("{mistakes}"));
    loaded.warnings.to_string()
}

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
  = help: allowed are format, about, dt, duration, gravity, length_scale, slop, integrator, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, forces, expect
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

#[test]
fn unknown_material() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    materials: {"ice cream": ()},
    bodies: [
        (name: "box", material: "stel", parts: [Box(size: (1, 1))]),
    ],
)"##), @r##"
error: there is no material "stel"
 --> scene.ron:6:33
  |
6 |         (name: "box", material: "stel", parts: [Box(size: (1, 1))]),
  |                                 ^^^^^^ did you mean "steel"?
  |
  = help: there is "BAM", "PTFE", "alumina", "aluminium", "brass", "cartilage", "cast iron", "concrete", "copper", "glass", "gold", "human synovial fluid", "ice", "ice cream", "metal", "platinum", "polyethene", "rubber", "silicon nitride", "silver", "steel", "titanium boride", "wood", "zinc"
"##);
}

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

#[test]
fn restitution_and_friction_out_of_range() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    materials: {"a": (restitution: 1.5, static_friction: -0.1, kinetic_friction: (0.5, 0.4))},
)"##), @r##"
error: restitution must be from 0 to 1
 --> scene.ron:5:36
  |
5 |     materials: {"a": (restitution: 1.5, static_friction: -0.1, kinetic_friction: (0.5, 0.4))},
  |                                    ^^^ 1.5 is outside

error: a friction coefficient must not be negative
 --> scene.ron:5:58
  |
5 |     materials: {"a": (restitution: 1.5, static_friction: -0.1, kinetic_friction: (0.5, 0.4))},
  |                                                          ^^^^ -0.1 is below 0

error: a range goes from low to high
 --> scene.ron:5:82
  |
5 |     materials: {"a": (restitution: 1.5, static_friction: -0.1, kinetic_friction: (0.5, 0.4))},
  |                                                                                  ^ 0.5 is above 0.4
"##);
}

#[test]
fn pair_listed_twice() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    bodies: [(name: "box", parts: [Box(size: (1, 1))])],
    pairs: [(between: ("a", "b")), (between: ("b", "a"))],
)"##), @r##"
error: the pair "b" and "a" is listed twice
 --> scene.ron:5:46
  |
5 |     pairs: [(between: ("a", "b")), (between: ("b", "a"))],
  |                       - first here           ^ again here
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
fn several_mistakes_in_one_file() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: "2 s",
    gravty: (0, -9.81),
    bodies: [
        (name: "box", kind: Dynamik, parts: [Box(size: (1, 1), density: inf)]),
        (name: "stick", parts: [Rod(from: (0, 0))]),
    ],
    expect: [Sped(of: "box")],
)"##), @r##"
error: `duration` must be a number
 --> scene.ron:3:15
  |
3 |     duration: "2 s",
  |               ^^^^^ found a text in quotes
  |
  = help: write the number without quotes

error: the scene has no field `gravty`
 --> scene.ron:4:5
  |
4 |     gravty: (0, -9.81),
  |     ^^^^^^ did you mean `gravity`?
  |
  = help: allowed are format, about, dt, duration, gravity, length_scale, slop, integrator, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, forces, expect

error: `kind` cannot be `Dynamik`
 --> scene.ron:6:29
  |
6 |         (name: "box", kind: Dynamik, parts: [Box(size: (1, 1), density: inf)]),
  |                             ^^^^^^^ did you mean `Dynamic`?
  |
  = help: allowed are Dynamic, Kinematic, Static

error: `density` must be finite
 --> scene.ron:6:73
  |
6 |         (name: "box", kind: Dynamik, parts: [Box(size: (1, 1), density: inf)]),
  |                                                                         ^^^ neither infinity nor NaN is a value

error: `Rod` needs `to`
 --> scene.ron:7:33
  |
7 |         (name: "stick", parts: [Rod(from: (0, 0))]),
  |                                 ^^^ `to` is missing here

error: an element of `expect` cannot be `Sped`
 --> scene.ron:9:14
  |
9 |     expect: [Sped(of: "box")],
  |              ^^^^ did you mean `Speed`?
  |
  = help: allowed are Position, X, Y, Angle, Velocity, VelocityX, VelocityY, Speed, AngularVelocity, AtRest, EnergyNeverRises, EnergyKept, MomentumKept, AngularMomentumKept, Depth, ContactForceSum, FrictionForce, Order, Happens, Never, Fingerprint
"##);
}

#[test]
fn mistakes_of_writing_and_of_meaning_in_one_file() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    dt: -0.01,
    bodies: [
        (name: "ghost", kind: Dynamik, parts: [Disc(radius: 1)]),
        (name: "box", parts: [Box(size: (1, 0))]),
        (name: "ball", parts: [Disc(radius: 1)]),
        (name: "ball", parts: [Disc(radius: 1, densty: 2)]),
    ],
    expect: [Speed(of: "box", at: 3.0, is: 1, within: 0), Depth(bellow: 1), Speed(of: "ghost", at: 1.0, is: 1)],
)"##), @r##"
error: the time step dt must be positive
 --> scene.ron:4:9
  |
4 |     dt: -0.01,
  |         ^^^^^ -0.01 is not above 0

error: `kind` cannot be `Dynamik`
 --> scene.ron:6:31
  |
6 |         (name: "ghost", kind: Dynamik, parts: [Disc(radius: 1)]),
  |                               ^^^^^^^ did you mean `Dynamic`?
  |
  = help: allowed are Dynamic, Kinematic, Static

error: this part has no proper shape
 --> scene.ron:7:31
  |
7 |         (name: "box", parts: [Box(size: (1, 0))]),
  |                               ^^^ the half extents of a box are 0.5 m and 0 m, but both must be positive

error: `Disc` has no field `densty`
 --> scene.ron:9:48
  |
9 |         (name: "ball", parts: [Disc(radius: 1, densty: 2)]),
  |                                                ^^^^^^ did you mean `density`?
  |
  = help: allowed are radius, at, density, mass, material, sensor, groups, collides_with

error: this is after the end of the run
  --> scene.ron:11:35
   |
11 |     expect: [Speed(of: "box", at: 3.0, is: 1, within: 0), Depth(bellow: 1), Speed(of: "ghost", at: 1.0, is: 1)],
   |                                   ^^^ 3 s, but the run takes 2 s

error: `Depth` needs `below`
  --> scene.ron:11:59
   |
11 |     expect: [Speed(of: "box", at: 3.0, is: 1, within: 0), Depth(bellow: 1), Speed(of: "ghost", at: 1.0, is: 1)],
   |                                                           ^^^^^ `below` is missing here

error: `Depth` has no field `bellow`
  --> scene.ron:11:65
   |
11 |     expect: [Speed(of: "box", at: 3.0, is: 1, within: 0), Depth(bellow: 1), Speed(of: "ghost", at: 1.0, is: 1)],
   |                                                                 ^^^^^^ did you mean `below`?
   |
   = help: allowed are below, at, always, from, until, because, under

error: a value needs a tolerance
  --> scene.ron:11:109
   |
11 |     expect: [Speed(of: "box", at: 3.0, is: 1, within: 0), Depth(bellow: 1), Speed(of: "ghost", at: 1.0, is: 1)],
   |                                                                                                             ^ add `within`
"##);
}

#[test]
fn several_meaningless_values_in_one_file() {
    insta::assert_snapshot!(mistakes(r##"(
    format: 1,
    duration: 2.0,
    dt: -0.01,
    bodies: [
        (name: "box", parts: [Box(size: (1, 0))]),
        (name: "box", material: "unobtainium", parts: [Disc(radius: 1, density: -1)]),
    ],
    expect: [AtRest(of: "boks", from: 1.0), Depth(below: 0.005, at: 3.0)],
)"##), @r##"
error: the time step dt must be positive
 --> scene.ron:4:9
  |
4 |     dt: -0.01,
  |         ^^^^^ -0.01 is not above 0

error: this part has no proper shape
 --> scene.ron:6:31
  |
6 |         (name: "box", parts: [Box(size: (1, 0))]),
  |                               ^^^ the half extents of a box are 0.5 m and 0 m, but both must be positive

error: two bodies are named "box"
 --> scene.ron:7:16
  |
7 |         (name: "box", material: "unobtainium", parts: [Disc(radius: 1, density: -1)]),
  |                ^^^^^ again here
  |
 ::: scene.ron:6:16
  |
6 |         (name: "box", parts: [Box(size: (1, 0))]),
  |                ----- first here

error: there is no material "unobtainium"
 --> scene.ron:7:33
  |
7 |         (name: "box", material: "unobtainium", parts: [Disc(radius: 1, density: -1)]),
  |                                 ^^^^^^^^^^^^^ unknown material
  |
  = help: there is "BAM", "PTFE", "alumina", "aluminium", "brass", "cartilage", "cast iron", "concrete", "copper", "glass", "gold", "human synovial fluid", "ice", "metal", "platinum", "polyethene", "rubber", "silicon nitride", "silver", "steel", "titanium boride", "wood", "zinc"

error: a density must be positive
 --> scene.ron:7:81
  |
7 |         (name: "box", material: "unobtainium", parts: [Disc(radius: 1, density: -1)]),
  |                                                                                 ^^ -1 is not above 0

error: there is no body "boks"
 --> scene.ron:9:25
  |
9 |     expect: [AtRest(of: "boks", from: 1.0), Depth(below: 0.005, at: 3.0)],
  |                         ^^^^^^ did you mean "box"?
  |
  = help: there is "box"

error: this is after the end of the run
 --> scene.ron:9:69
  |
9 |     expect: [AtRest(of: "boks", from: 1.0), Depth(below: 0.005, at: 3.0)],
  |                                                                     ^^^ 3 s, but the run takes 2 s
"##);
}

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
  = help: allowed are format, about, dt, duration, gravity, length_scale, slop, integrator, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, forces, expect
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
