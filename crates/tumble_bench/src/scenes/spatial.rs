//! Scenes of space: piles, pits, a drum.

use glam::{DQuat, DVec3, dvec3};
use tumble_math::{Pose, Spatial, SpatialRotation};

use crate::plan::{Body, Kind, Part, Plan, SpatialShape};
use crate::scatter::Scatter;

fn fixed(centre: DVec3, half_extents: DVec3) -> Body<Spatial> {
    Body::simple(Kind::Static, centre, SpatialShape::Box { half_extents })
}

fn floor() -> Body<Spatial> {
    fixed(dvec3(0.0, -1.0, 0.0), dvec3(60.0, 1.0, 60.0))
}

/// A floor and four walls 1 m thick or more, their inner sides `half` from the middle [m].
fn pit(half: f64, half_height: f64) -> Vec<Body<Spatial>> {
    let (outer, wall) = (half + 2.0, half + 1.0);
    vec![
        fixed(dvec3(0.0, -1.0, 0.0), dvec3(outer, 1.0, outer)),
        fixed(dvec3(-wall, half_height, 0.0), dvec3(1.0, half_height, outer)),
        fixed(dvec3(0.0, half_height, -wall), dvec3(outer, half_height, 1.0)),
        fixed(dvec3(wall, half_height, 0.0), dvec3(1.0, half_height, outer)),
        fixed(dvec3(0.0, half_height, wall), dvec3(outer, half_height, 1.0)),
    ]
}

/// A square pyramid of cubes of 1 m, each on four others, so many along a side of the lowest layer; neighbours are 5 cm apart.
pub(super) fn layers(base: u32, ground: DVec3) -> impl Iterator<Item = Body<Spatial>> {
    (0..base).flat_map(move |layer| {
        let side = base - layer;
        let place = move |index: u32| 1.05 * (f64::from(index) - 0.5 * f64::from(side - 1));
        (0..side * side).map(move |i| {
            let centre = ground + dvec3(place(i / side), 0.5 + f64::from(layer), place(i % side));
            Body::simple(Kind::Dynamic, centre, SpatialShape::block(0.5, 0.5, 0.5))
        })
    })
}

pub fn pyramid() -> Plan<Spatial> {
    let mut bodies = vec![floor()];
    bodies.extend(layers(20, DVec3::ZERO));
    Plan::new("pyramid3d", 200, bodies)
}

pub fn wall() -> Plan<Spatial> {
    let mut bodies = vec![floor()];
    for row in 0..25 {
        for column in 0..40 {
            let shift = if row % 2 == 1 { 0.25 } else { -0.25 };
            let place = dvec3((f64::from(column) - 19.5) * 1.02 + shift, 0.25 + 0.5 * f64::from(row), 0.0);
            bodies.push(Body::simple(Kind::Dynamic, place, SpatialShape::block(0.5, 0.25, 0.25)));
        }
    }
    Plan::new("wall3d", 300, bodies)
}

pub fn balls() -> Plan<Spatial> {
    let mut bodies = pit(9.0, 20.0);
    let mut scatter = Scatter::new(3);
    for layer in 0..16 {
        for i in 0..16 {
            for k in 0..16 {
                let x = (f64::from(i) - 7.5) * 1.1 + 0.04 * scatter.signed();
                let z = (f64::from(k) - 7.5) * 1.1 + 0.04 * scatter.signed();
                let place = dvec3(x, 1.0 + 1.1 * f64::from(layer), z);
                bodies.push(Body::simple(Kind::Dynamic, place, SpatialShape::Sphere { radius: 0.5 }));
            }
        }
    }
    Plan::new("balls3d", 400, bodies)
}

pub fn drop() -> Plan<Spatial> {
    let mut bodies = pit(6.0, 25.0);
    let mut scatter = Scatter::new(5);
    for i in 0..1000 {
        let (layer, row, column) = (i / 72, i / 8 % 9, i % 8);
        let x = (f64::from(row) - 4.0) * 1.25 + 0.05 * scatter.signed();
        let z = (f64::from(column) - 3.5) * 1.35 + 0.05 * scatter.signed();
        let shape = match i % 3 {
            0 => SpatialShape::block(0.5, 0.3, 0.4),
            1 => SpatialShape::Icosahedron { radius: 0.5 },
            _ => SpatialShape::Capsule { half_length: 0.3, radius: 0.25 },
        };
        let turn = DQuat::from_array(std::array::from_fn(|_| scatter.signed()));
        let rotation = SpatialRotation::try_from_quaternion(turn).unwrap_or_default();
        let place = dvec3(x, 1.0 + 1.3 * f64::from(layer), z);
        bodies.push(Body::simple(Kind::Dynamic, place, shape).turned(rotation));
    }
    Plan::new("drop3d", 400, bodies)
}

pub fn tumbler() -> Plan<Spatial> {
    let half = 5.0;
    let sides = (0..3).flat_map(|axis| {
        [1.0, -1.0].map(|side| {
            let (mut position, mut half_extents) = (DVec3::ZERO, DVec3::splat(half));
            position[axis] = side * half;
            half_extents[axis] = 0.5;
            Part { shape: SpatialShape::Box { half_extents }, pose: Pose { position, ..Pose::default() } }
        })
    });
    let drum = Body::compound(Kind::Kinematic, DVec3::ZERO, sides.collect());
    let mut bodies = vec![drum.turning(DVec3::Z * 25.0_f64.to_radians())];
    let place = |index: u32| (f64::from(index) - 5.5) * 0.65;
    for i in 0..12 * 12 * 12 {
        let centre = dvec3(place(i / 12 % 12), place(i / 144), place(i % 12));
        bodies.push(Body::simple(Kind::Dynamic, centre, SpatialShape::block(0.25, 0.25, 0.25)));
    }
    Plan::new("tumbler3d", 450, bodies)
}

pub fn rod_one() -> Plan<Spatial> {
    // Square, so that it cannot roll away.
    let rod = Body::simple(Kind::Dynamic, dvec3(0.0, 2.0, 0.0), SpatialShape::block(0.5, 0.05, 0.05));
    let rod = rod.turned(SpatialRotation::from_rotation_vector(DVec3::Z));
    Plan { restitution: 0.9, ..Plan::new("rod_one3d", 1_000_000, vec![floor(), rod]) }
}
