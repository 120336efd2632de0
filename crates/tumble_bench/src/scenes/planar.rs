//! Scenes of the plane: piles, a drum, thin rods.

use glam::{DVec2, dvec2};
use tumble_math::{Planar, PlanarRotation, Pose};

use crate::plan::{Body, Kind, Part, Plan, PlanarShape};
use crate::scatter::Scatter;

/// Distance between pyramids of ten rows, and between shelves [m].
pub(super) const PYRAMID_SPACING: f64 = 11.0;

/// Half the width of a shelf for twenty of them [m].
pub(super) const SHELF_HALF_WIDTH: f64 = 112.0;

/// A box that nothing moves, by its middle and half extents [m].
pub(super) fn fixed(centre: DVec2, half_extents: DVec2) -> Body<Planar> {
    Body::simple(Kind::Static, centre, PlanarShape::Box { half_extents })
}

/// A part with its middle [m] and angle [rad] in the body.
pub(super) fn part(shape: PlanarShape, position: DVec2, angle: f64) -> Part<Planar> {
    Part { shape, pose: Pose { position, rotation: PlanarRotation::from_angle(angle) } }
}

/// A pyramid of boxes of 1 m, so many in its lowest row, whose ground has this middle [m]; neighbours touch.
pub(super) fn pyramid_of(base: u32, ground: DVec2) -> impl Iterator<Item = Body<Planar>> {
    (0..base).flat_map(move |row| {
        (0..base - row).map(move |k| {
            let across = f64::from(k) - 0.5 * f64::from(base - row - 1);
            let place = ground + dvec2(across, f64::from(row) + 0.5);
            Body::simple(Kind::Dynamic, place, PlanarShape::block(0.5, 0.5))
        })
    })
}

/// The shelf of a row.
pub(super) fn shelf(row: u32, half_width: f64) -> Body<Planar> {
    fixed(dvec2(0.0, PYRAMID_SPACING * f64::from(row) - 0.1), dvec2(half_width, 0.1))
}

pub fn pyramid() -> Plan<Planar> {
    let mut bodies = vec![fixed(dvec2(0.0, -1.0), dvec2(100.0, 1.0))];
    bodies.extend(pyramid_of(100, DVec2::ZERO));
    Plan::new("pyramid2d", 400, bodies)
}

pub fn many_pyramids() -> Plan<Planar> {
    let mut bodies: Vec<Body<Planar>> = (0..20).map(|row| shelf(row, SHELF_HALF_WIDTH)).collect();
    for row in 0..20 {
        for column in 0..20 {
            let ground = dvec2(f64::from(column) - 9.5, f64::from(row)) * PYRAMID_SPACING;
            bodies.extend(pyramid_of(10, ground));
        }
    }
    Plan::new("many_pyramids2d", 200, bodies)
}

pub fn tumbler() -> Plan<Planar> {
    let wall = |x, y, half_width, half_height| part(PlanarShape::block(half_width, half_height), dvec2(x, y), 0.0);
    let walls = vec![
        wall(10.0, 0.0, 0.5, 10.0),
        wall(-10.0, 0.0, 0.5, 10.0),
        wall(0.0, 10.0, 10.0, 0.5),
        wall(0.0, -10.0, 10.0, 0.5),
    ];
    let centre = dvec2(0.0, 10.0);
    let mut bodies = vec![Body::compound(Kind::Kinematic, centre, walls).turning(25.0_f64.to_radians())];
    for row in 0..45 {
        for column in 0..45 {
            let place = centre + dvec2(f64::from(column), f64::from(row)) * 0.4 - DVec2::splat(8.8);
            bodies.push(Body::simple(Kind::Dynamic, place, PlanarShape::block(0.125, 0.125)));
        }
    }
    Plan::new("tumbler2d", 750, bodies)
}

pub fn rods() -> Plan<Planar> {
    let mut bodies = vec![
        fixed(dvec2(0.0, -1.0), dvec2(40.0, 1.0)),
        fixed(dvec2(-31.5, 30.0), dvec2(1.0, 32.0)),
        fixed(dvec2(31.5, 30.0), dvec2(1.0, 32.0)),
    ];
    let rod = PlanarShape::Capsule { half_length: 0.48, radius: 0.02 };
    let mut scatter = Scatter::new(7);
    for row in 0..40 {
        for column in 0..50 {
            let x = (f64::from(column) - 24.5) * 1.2 + 0.05 * scatter.signed();
            let spokes = (0..3).map(|k| part(rod, DVec2::ZERO, f64::from(k) * std::f64::consts::FRAC_PI_3));
            let body = Body::compound(Kind::Dynamic, dvec2(x, 1.0 + 1.2 * f64::from(row)), spokes.collect());
            bodies.push(body.turned(PlanarRotation::from_angle(0.5 * scatter.signed())));
        }
    }
    Plan::new("rods2d", 600, bodies)
}

pub fn rod_one() -> Plan<Planar> {
    let rod = PlanarShape::Capsule { half_length: 0.5, radius: 0.05 };
    let falling = Body::simple(Kind::Dynamic, dvec2(0.0, 2.0), rod).turned(PlanarRotation::from_angle(0.6));
    let floor = fixed(dvec2(0.0, -1.0), dvec2(100.0, 1.0));
    Plan { restitution: 0.9, ..Plan::new("rod_one2d", 1_000_000, vec![floor, falling]) }
}
