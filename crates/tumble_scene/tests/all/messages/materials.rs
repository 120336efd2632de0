//! Materials that are unknown or impossible.

use super::mistakes;

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
