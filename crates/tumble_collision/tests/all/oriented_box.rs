//! Oriented boxes against the narrow phase, which they spare work.

use glam::DVec2;
use proptest::prelude::proptest;
use tumble_collision::{OrientedBox, TurningBox, collide};
use tumble_shape::{HalfPlane, PlanarShape};

use crate::common::{at, config, query, shape, thin};

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn shapes_whose_boxes_are_apart_have_no_contact_points(
        a in shape(), b in shape(), x in -3.0..3.0_f64, y in -3.0..3.0_f64, turns in (-3.0..3.0_f64, -3.0..3.0_f64),
        margins in (0.0..0.5_f64, 0.0..0.5_f64),
    ) {
        let (pose_a, pose_b) = (at(0.0, 0.0, turns.0), at(x, y, turns.1));
        let boxes = (OrientedBox::around(&a, &pose_a, margins.0), OrientedBox::around(&b, &pose_b, margins.1));
        if let (Some(box_a), Some(box_b)) = boxes
            && !box_a.overlaps(&box_b)
        {
            assert!(!box_b.overlaps(&box_a));
            // Less than the boxes were grown by, so that rounding decides nothing.
            let margin = (margins.0 + margins.1) * (1.0 - 1e-9);
            assert!(collide(&a, &pose_a, &b, &pose_b, &query(margin, 0.0)).is_empty());
        }
    }

    #[test]
    fn swept_and_grown_box_contains_what_it_passes_through_and_meets_all_that_meets_it(
        a in shape(), b in shape(), x in -3.0..3.0_f64, y in -3.0..3.0_f64, turns in (-3.0..3.0_f64, -3.0..3.0_f64),
        travel in (-2.0..2.0_f64, -2.0..2.0_f64), part in 0.0..1.0_f64, margin in 1e-9..0.5_f64,
    ) {
        let travel = DVec2::new(travel.0, travel.1);
        let boxes = (OrientedBox::around(&a, &at(0.0, 0.0, turns.0), 0.0), OrientedBox::around(&b, &at(x, y, turns.1), 0.0));
        if let (Some(start), Some(other)) = boxes {
            let fat = start.swept(travel).grown(margin);
            let on_the_way = OrientedBox::around(&a, &at(travel.x * part, travel.y * part, turns.0), 0.0).unwrap();
            assert!(fat.contains(&on_the_way));
            assert!(fat.overlaps(&other) || !on_the_way.overlaps(&other));
            // Beyond the end by more than the margin in every direction.
            let beyond = travel + travel.normalize_or(DVec2::X) * (margin * 1.5);
            assert!(!fat.contains(&OrientedBox::around(&a, &at(beyond.x, beyond.y, turns.0), 0.0).unwrap()));
            assert!(!start.contains(&fat));
        }
    }
}

#[test]
fn parallel_rods_are_apart_as_soon_as_a_gap_shows() {
    let level = OrientedBox::around(&thin(2.0), &at(0.0, 0.0, 0.5), 0.0).unwrap();
    let beside = |gap: f64| {
        let across = DVec2::new(-tumble_math::trig::sin(0.5), tumble_math::trig::cos(0.5)) * gap;
        OrientedBox::around(&thin(2.0), &at(across.x, across.y, 0.5), 0.0).unwrap()
    };
    assert!(level.overlaps(&level));
    assert!(!level.overlaps(&beside(1e-3)));
    assert!(!level.overlaps(&beside(-1e-3)));
}

#[test]
fn half_plane_has_no_box() {
    let plane = PlanarShape::from(HalfPlane::try_new(DVec2::Y, 0.0).unwrap());
    assert_eq!(OrientedBox::around(&plane, &at(0.0, 0.0, 0.0), 0.0), None);
}
