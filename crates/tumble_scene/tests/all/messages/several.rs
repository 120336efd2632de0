//! Several mistakes in one file, each at its place.

use super::mistakes;

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
  = help: allowed are format, dimension, about, dt, duration, gravity, length_scale, slop, integrator, time_of_impact, contact, models, every, seed, allow_overlap, materials_from, materials, pairs, surface, take, part_lists, bodies, springs, joints, forces, expect

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
  = help: allowed are Position, X, Y, Angle, Velocity, VelocityX, VelocityY, Speed, AngularVelocity, AtRest, EnergyNeverRises, EnergyKept, MomentumKept, AngularMomentumKept, Depth, ContactForceSum, FrictionForce, JointForce, Order, Happens, Never, Fingerprint
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
