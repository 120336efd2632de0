//! The same pyramids again and again: contacts grow, and nothing else does.

use glam::{dvec2, dvec3};
use tumble_math::{Planar, Spatial};

use super::planar::{PYRAMID_SPACING, SHELF_HALF_WIDTH, pyramid_of, shelf};
use super::spatial::layers;
use crate::plan::{Body, Kind, Plan, SpatialShape};

/// Pyramids on a shelf.
const PER_SHELF: u32 = 20;

/// Pyramids of ten rows, 145 contacts each, twenty on a shelf.
pub fn planar(pyramids: u32) -> Plan<Planar> {
    let mut bodies: Vec<Body<Planar>> =
        (0..pyramids.div_ceil(PER_SHELF)).map(|row| shelf(row, SHELF_HALF_WIDTH)).collect();
    for i in 0..pyramids {
        let (row, column) = (i / PER_SHELF, i % PER_SHELF);
        let centre = (f64::from(column) - 0.5 * f64::from(PER_SHELF - 1)) * PYRAMID_SPACING;
        bodies.extend(pyramid_of(10, dvec2(centre, f64::from(row) * PYRAMID_SPACING)));
    }
    Plan::new("growth2d", 100, bodies)
}

/// Square pyramids of six layers, 256 contacts each, on one floor.
pub fn spatial(pyramids: u32) -> Plan<Spatial> {
    let columns = 20;
    let half = 0.5 * f64::from(columns) * 8.0;
    let floor = SpatialShape::block(half, 1.0, half);
    let mut bodies = vec![Body::simple(Kind::Static, dvec3(0.0, -1.0, 0.0), floor)];
    for i in 0..pyramids {
        let place = |index: u32| (f64::from(index) - 0.5 * f64::from(columns - 1)) * 8.0;
        bodies.extend(layers(6, dvec3(place(i % columns), 0.0, place(i / columns))));
    }
    Plan::new("growth3d", 100, bodies)
}
