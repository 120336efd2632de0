//! Scenes of the plane with many moving compounds.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, dvec2};
use tumble_math::{Planar, PlanarRotation};

use super::planar::{fixed, part};
use crate::plan::{Body, Kind, Part, Plan, PlanarShape};
use crate::scatter::Scatter;

const BODIES: u32 = 1500;
const COLUMNS: u32 = 50;

/// Bodies in rows above `bottom` [m], `spacing` apart [m], turned by chance, whose shape is that of their number.
///
/// Each reaches at most 0.55 m from its centre, so that none touch.
fn cloud(bottom: f64, spacing: f64, seed: u64, shape: impl Fn(u32) -> Vec<Part<Planar>>) -> Vec<Body<Planar>> {
    let mut scatter = Scatter::new(seed);
    let body = |i: u32| {
        let across = f64::from(i % COLUMNS) - 0.5 * f64::from(COLUMNS - 1);
        let place = dvec2(across, f64::from(i / COLUMNS)) * spacing + dvec2(0.05 * scatter.signed(), bottom);
        let turn = PlanarRotation::from_angle(std::f64::consts::PI * scatter.signed());
        Body::compound(Kind::Dynamic, place, shape(i)).turned(turn)
    };
    (0..BODIES).map(body).collect()
}

/// A floor and two walls with their inner sides `half_width` from the middle [m].
fn yard(half_width: f64, height: f64) -> Vec<Body<Planar>> {
    let wall = |side: f64| fixed(dvec2(side * (half_width + 1.0), 0.5 * height), dvec2(1.0, 0.5 * height));
    vec![fixed(dvec2(0.0, -1.0), dvec2(half_width + 2.0, 1.0)), wall(-1.0), wall(1.0)]
}

pub fn rain() -> Plan<Planar> {
    let mut bodies = yard(31.0, 60.0);
    // Six rows of pegs, every other one shifted by half a gap: what falls has to turn.
    for row in 0..6 {
        for column in 0..20 {
            let shift = if row % 2 == 0 { 0.0 } else { 1.5 };
            let peg = dvec2(f64::from(column) * 3.0 - 29.25 + shift, 6.0 + 2.5 * f64::from(row));
            bodies.push(Body::simple(Kind::Static, peg, PlanarShape::Disc { radius: 0.25 }));
        }
    }
    bodies.extend(cloud(20.5, 1.2, 11, |i| match i % 3 {
        0 => cross(),
        1 => dumb_bell(),
        _ => clover(),
    }));
    Plan::new("rain2d", 400, bodies)
}

pub fn junkyard() -> Plan<Planar> {
    let mut bodies = yard(31.0, 60.0);
    for (x, turn) in [(-20.0, 40.0_f64), (0.0, -40.0), (20.0, 40.0)] {
        let blades = [0.0, FRAC_PI_2].map(|angle| part(PlanarShape::block(5.0, 0.2), DVec2::ZERO, angle));
        let paddle = Body::compound(Kind::Kinematic, dvec2(x, 5.5), blades.into());
        bodies.push(paddle.turning(turn.to_radians()));
    }
    bodies.extend(cloud(12.0, 1.2, 13, |i| match i % 4 {
        0 => angle(),
        1 => tee(),
        2 => channel(),
        _ => anchor(),
    }));
    Plan::new("junkyard2d", 400, bodies)
}

fn cross() -> Vec<Part<Planar>> {
    [0.0, FRAC_PI_2].map(|angle| part(PlanarShape::block(0.45, 0.1), DVec2::ZERO, angle)).into()
}

fn dumb_bell() -> Vec<Part<Planar>> {
    let weight = |x| part(PlanarShape::Disc { radius: 0.2 }, dvec2(x, 0.0), 0.0);
    vec![part(PlanarShape::block(0.3, 0.06), DVec2::ZERO, 0.0), weight(-0.3), weight(0.3)]
}

fn clover() -> Vec<Part<Planar>> {
    let leaf = |k: i32| {
        let direction = PlanarRotation::from_angle(f64::from(k) * TAU / 3.0);
        part(PlanarShape::Disc { radius: 0.22 }, dvec2(direction.cos(), direction.sin()) * 0.24, 0.0)
    };
    (0..3).map(leaf).collect()
}

fn angle() -> Vec<Part<Planar>> {
    vec![
        part(PlanarShape::block(0.38, 0.1), DVec2::ZERO, 0.0),
        part(PlanarShape::block(0.1, 0.25), dvec2(-0.28, 0.35), 0.0),
    ]
}

fn tee() -> Vec<Part<Planar>> {
    vec![
        part(PlanarShape::block(0.4, 0.1), DVec2::ZERO, 0.0),
        part(PlanarShape::block(0.1, 0.3), dvec2(0.0, -0.4), 0.0),
    ]
}

fn channel() -> Vec<Part<Planar>> {
    let side = |x| part(PlanarShape::block(0.08, 0.23), dvec2(x, 0.31), 0.0);
    vec![part(PlanarShape::block(0.4, 0.08), DVec2::ZERO, 0.0), side(-0.32), side(0.32)]
}

fn anchor() -> Vec<Part<Planar>> {
    let ring = part(PlanarShape::Disc { radius: 0.13 }, dvec2(0.0, 0.37), 0.0);
    let arm = PlanarShape::Capsule { half_length: 0.3, radius: 0.07 };
    vec![part(PlanarShape::block(0.06, 0.3), DVec2::ZERO, 0.0), part(arm, dvec2(0.0, -0.3), 0.0), ring]
}
