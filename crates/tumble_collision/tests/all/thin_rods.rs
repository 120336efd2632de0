//! Rods without thickness keep the side they were on.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{at, boxed, config, disc, query, thin};
use glam::DVec2;
use proptest::prelude::{prop_assert, proptest};
use tumble_collision::{ContactKind, PlanarManifold, collide};
use tumble_math::{Planar, Pose};
use tumble_shape::PlanarShape;

/// The manifold after following b along poses, each query remembering the one before.
fn follow(
    a: &PlanarShape,
    b: &PlanarShape,
    poses: impl IntoIterator<Item = Pose<Planar>>,
    mut each: impl FnMut(&PlanarManifold),
) -> PlanarManifold {
    let mut manifold = PlanarManifold::EMPTY;
    for pose in poses {
        let mut query = query(0.2, 1e-3);
        query.previous = Some(&manifold);
        manifold = collide(a, &at(0.0, 0.0, 0.0), b, &pose, &query);
        each(&manifold);
    }
    manifold
}

/// Depths from just above to well through, by way of every small power of ten.
fn sinking() -> Vec<f64> {
    let powers = || (3..=12).map(|power: i32| 10.0_f64.powi(-power));
    let above: Vec<f64> = [0.1].into_iter().chain(powers()).collect();
    let below: Vec<f64> = powers().map(|depth| -depth).collect();
    let deep = (1..=6).map(|i| -0.01 * f64::from(i));
    above.into_iter().chain([0.0]).chain(below.into_iter().rev()).chain(deep).collect()
}

#[test]
fn an_end_that_sinks_through_a_side_is_pushed_back_where_it_came_from() {
    // Upright and slanted rods whose lower end comes down at the middle and 1 cm from the end of the other.
    for angle in [FRAC_PI_2, 1.2, 2.3, 0.1, PI - 0.02] {
        for x in [0.0, 0.49] {
            let heights = sinking();
            let lower_end = DVec2::new(x, 0.0);
            let pose = |height: f64| {
                let centre = lower_end + DVec2::new(0.5 * angle.cos_exact(), height + 0.5 * angle.sin_exact());
                at(centre.x, centre.y, angle)
            };
            let mut i = 0;
            follow(&thin(1.0), &thin(1.0), heights.iter().map(|&height| pose(height)), |manifold| {
                let lowest = manifold.deepest_separation().unwrap();
                assert!(manifold.normal.y > 0.5, "angle {angle}, x {x}, height {}: {manifold:?}", heights[i]);
                // The end's height is the separation along y; along a tilted rod's own normal less, by at most the cosine.
                assert!((lowest - heights[i] * manifold.normal.y).abs() < 0.02, "{manifold:?} {}", heights[i]);
                i += 1;
            });
        }
    }
}

#[test]
fn a_rod_that_sinks_through_another_lying_flat_is_pushed_back_where_it_came_from() {
    for tilt in [0.0, 1e-13, -1e-9, 1e-3] {
        for from_above in [1.0, -1.0] {
            let heights = sinking();
            let mut i = 0;
            follow(&thin(1.0), &thin(0.8), heights.iter().map(|h| at(0.05, h * from_above, tilt)), |manifold| {
                assert!(manifold.normal.y * from_above > 0.99, "tilt {tilt}: {manifold:?}");
                assert_eq!(manifold.points().len(), 2);
                // Both ends are within the tilt times half the length of the middle's height.
                let lowest = manifold.deepest_separation().unwrap();
                assert!((lowest - heights[i]).abs() <= 0.4 * tilt.abs() + 1e-12, "{manifold:?}");
                i += 1;
            });
        }
    }
}

#[test]
fn a_disc_whose_centre_sinks_through_a_thin_rod_is_pushed_back_where_it_came_from() {
    let heights = (0..=14).map(|i| 0.08 - 0.01 * f64::from(i));
    let last = follow(&thin(1.0), &disc(0.2), heights.map(|height| at(0.1, height, 0.3)), |manifold| {
        assert_eq!(manifold.normal, DVec2::Y, "{manifold:?}");
    });
    // Centre 0.06 below the rod, radius 0.2; a rounding or two.
    assert!((last.points()[0].separation + 0.26).abs() < 1e-15);
}

#[test]
fn without_memory_the_least_depth_decides() {
    let upright = |low: f64| at(0.0, low + 0.5, FRAC_PI_2);
    let shallow = collide(&thin(1.0), &at(0.0, 0.0, 0.0), &thin(1.0), &upright(-0.1), &query(0.1, 0.0));
    assert!(shallow.normal.y > 0.99 && (shallow.deepest_separation().unwrap() + 0.1).abs() < 1e-15);
    let far_through = collide(&thin(1.0), &at(0.0, 0.0, 0.0), &thin(1.0), &upright(-0.9), &query(0.1, 0.0));
    assert!(far_through.normal.y < -0.99 && (far_through.deepest_separation().unwrap() + 0.1).abs() < 1e-15);
}

#[test]
fn a_rod_that_walks_round_the_end_of_another_changes_sides_freely() {
    // From above, round the right end, to below: no overlap anywhere, so memory must not hold it back.
    let poses = (0..=400).map(|i| {
        let angle = FRAC_PI_2 - PI * f64::from(i) / 400.0;
        let arm = DVec2::new(angle.cos_exact(), angle.sin_exact()) * 0.1;
        at(0.5 + arm.x, arm.y, angle + FRAC_PI_2)
    });
    let last =
        follow(&thin(1.0), &thin(0.05), poses, |manifold| assert!(manifold.deepest_separation().unwrap() > 0.05));
    assert!(last.normal.y < -0.99, "{last:?}");
}

#[test]
fn two_rods_that_met_end_to_end_keep_their_normal_when_the_ends_cross_a_little() {
    let gaps = [0.1, 0.01, 1e-9, 1e-16, 0.0, -1e-16, -1e-12, -1e-6, -0.01];
    let poses = gaps.iter().map(|gap| at(1.0 + gap, 1e-5 * gap, 0.0));
    let mut i = 0;
    follow(&thin(1.0), &thin(1.0), poses, |manifold| {
        assert!(manifold.normal.x > 0.999, "gap {}: {manifold:?}", gaps[i]);
        let [point] = manifold.points() else { panic!("{manifold:?}") };
        assert_eq!(point.kind, ContactKind::VertexVertex);
        assert!((point.separation - gaps[i]).abs() < 1e-9);
        i += 1;
    });
}

proptest! {
    #![proptest_config(config(500))]

    #[test]
    fn slow_sinking_never_flips_the_normal(
        // Never less than 0.1 from lying flat, so that it is its lower end that sinks.
        x in -0.4..0.4_f64, angle in 0.7..2.4_f64, speed in 1e-6..5e-3_f64, turn in -0.01..0.01_f64,
    ) {
        let mut before: Option<DVec2> = None;
        let poses = (0..60).map(|i| {
            let time = f64::from(i);
            let angle = angle + turn * time;
            let centre = DVec2::new(x + 0.4 * angle.cos_exact(), 20.0 * speed - speed * time + 0.4 * angle.sin_exact());
            at(centre.x, centre.y, angle)
        });
        let mut flipped = false;
        follow(&thin(1.0), &thin(0.8), poses, |manifold| {
            flipped |= before.is_some_and(|before| before.dot(manifold.normal) < 0.0);
            before = Some(manifold.normal);
        });
        prop_assert!(!flipped);
        prop_assert!(before.is_some_and(|normal| normal.y > 0.0));
    }

    #[test]
    fn a_rod_end_in_a_box_is_pushed_out_of_the_side_it_came_in(x in -0.4..0.4_f64, speed in 1e-6..5e-3_f64) {
        let poses = (0..60).map(|i| at(x, 1.0 + 20.0 * speed - speed * f64::from(i), FRAC_PI_2));
        let mut sideways = false;
        follow(&boxed(0.5, 0.5), &thin(1.0), poses, |manifold| sideways |= manifold.normal.y < 0.999);
        prop_assert!(!sideways);
    }
}

/// Sine and cosine by the project's own functions.
trait Trigonometry {
    fn sin_exact(self) -> f64;
    fn cos_exact(self) -> f64;
}

impl Trigonometry for f64 {
    fn sin_exact(self) -> f64 {
        tumble_math::trig::sin(self)
    }

    fn cos_exact(self) -> f64 {
        tumble_math::trig::cos(self)
    }
}
