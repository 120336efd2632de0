//! Sliding over flush neighbours meets no side of the next one, and a real step does.

use crate::common::{at, boxed, query, thin};
use glam::DVec2;
use tumble_collision::{PlanarManifold, collide};
use tumble_math::PlanarRotation;
use tumble_shape::PlanarShape;

const SLOP: f64 = 0.005;

/// Heights of a slider above flush: sunk in to the slop, rounding on both sides, a hair above.
fn heights() -> impl Iterator<Item = f64> {
    [-SLOP, -0.8 * SLOP, -1e-3, -1e-6, -1e-9, -1e-12, -1e-15, 0.0, 1e-15, 1e-12, 1e-9].into_iter()
}

/// All manifolds of a slider with three boxes of width 1 and height 1 side by side, tops at y = 0, the whole turned by `turn`.
fn slide(slider: &PlanarShape, x: f64, y: f64, margin: f64, turn: f64) -> [PlanarManifold; 3] {
    let rotation = PlanarRotation::from_angle(turn);
    let turned = |x: f64, y: f64| {
        let place = rotation.to_matrix() * DVec2::new(x, y);
        at(place.x, place.y, turn)
    };
    [0.5, 1.5, 2.5].map(|centre| {
        let manifold = collide(&boxed(0.5, 0.5), &turned(centre, -0.5), slider, &turned(x, y), &query(margin, SLOP));
        let mut seen = manifold;
        seen.normal = rotation.to_matrix().transpose() * manifold.normal;
        seen
    })
}

#[test]
fn a_box_or_thin_rod_sliding_over_flush_boxes_meets_no_side() {
    let sliders = [(boxed(0.3, 0.3), 0.3), (boxed(0.8, 0.2), 0.2), (thin(0.7), 0.0)];
    for (slider, half_height) in &sliders {
        for turn in [0.0, 0.4] {
            for height in heights() {
                for margin in [0.0, 0.02, 2.0] {
                    // Fine steps, and the exact and nearly exact alignments with the seams.
                    let fine = (0..600).map(|i| 0.005 * f64::from(i));
                    let aligned = [0.7, 1.0, 1.3, 1.7, 2.0, 2.2].into_iter();
                    let nearly = aligned.flat_map(|x| [-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3].map(|d| x + d));
                    for x in fine.chain(nearly) {
                        for manifold in slide(slider, x, half_height + height, margin, turn) {
                            // Turned and turned back: a few roundings of a unit vector.
                            let sideways = manifold.normal.x.abs() > 1e-14;
                            assert!(!sideways, "x {x} height {height} margin {margin}: {manifold:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_box_sliding_over_flush_boxes_is_carried_everywhere() {
    for height in heights().filter(|height| *height <= 0.0) {
        for i in 0..=400 {
            let x = 0.5 + 0.005 * f64::from(i);
            let manifolds = slide(&boxed(0.3, 0.3), x, 0.3 + height, 1e-9, 0.0);
            let places = || manifolds.iter().flat_map(|manifold| manifold.points()).map(|point| point.point.x);
            let (left, right) = (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
            // A last sliver as wide as the tolerance may be left out.
            assert!(left <= x - 0.3 + SLOP + 1e-9 && right >= x + 0.3 - SLOP - 1e-9, "x {x} height {height}");
        }
    }
}

#[test]
fn a_step_higher_than_the_tolerance_stops_the_slider() {
    for step in [1.1 * SLOP, 0.01, 0.1, 0.5] {
        for gap in [0.1, 1e-3, 0.0, -1e-3, -0.9 * SLOP] {
            let next = collide(
                &boxed(0.3, 0.3),
                &at(0.0, 0.3, 0.0),
                &boxed(0.5, 0.5),
                &at(0.8 + gap, step - 0.5, 0.0),
                &query(0.2, SLOP),
            );
            assert_eq!(next.normal, DVec2::X, "step {step} gap {gap}: {next:?}");
            // Numbers near 1, a few roundings.
            assert!((next.deepest_separation().unwrap() - gap).abs() < 1e-15 * 4.0);
        }
    }
}

#[test]
fn boxes_of_one_height_pushed_together_touch_side_by_side() {
    for gap in [0.1, 1e-9, 0.0, -1e-9, -SLOP] {
        let manifold = collide(
            &boxed(0.5, 0.5),
            &at(0.0, 0.0, 0.0),
            &boxed(0.5, 0.5),
            &at(1.0 + gap, 0.0, 0.0),
            &query(0.2, SLOP),
        );
        assert_eq!((manifold.normal, manifold.points().len()), (DVec2::X, 2), "gap {gap}");
    }
}

#[test]
fn boxes_that_pass_corner_by_corner_never_overlap_deeper_than_the_tolerance_without_contact() {
    let grid = || (-20..=40).map(|i| f64::from(i) * 1e-3);
    for (x, y) in grid().flat_map(|x| grid().map(move |y| (x, y))) {
        // Overlap x by y at the corner.
        let manifold = collide(
            &boxed(0.5, 0.5),
            &at(0.0, 0.0, 0.0),
            &boxed(0.5, 0.5),
            &at(1.0 - x, 1.0 - y, 0.0),
            &query(0.0, SLOP),
        );
        // One millionth beside the tolerance, where rounding decides.
        assert!(x.min(y) <= SLOP * 1.000_001 || !manifold.is_empty(), "{x} {y}");
        let least = x.min(y);
        assert!(manifold.is_empty() || (manifold.deepest_separation().unwrap() + least).abs() < 1e-12, "{x} {y}");
    }
}
