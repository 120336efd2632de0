//! Laws of contact in space: symmetry, invariance, well-formed manifolds, continuity, and the cases that stacks are made of.

use std::f64::consts::FRAC_PI_4;

use crate::spatial;
use crate::spatial::{
    after, assert_same, at, best_separation, boxed, config, cuboid, floor, hull, listed, moved, polyhedron, pose,
    query, rod, rotation, shape, sphere, swapped, turned, vector,
};
use glam::{DVec3, dvec3};
use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};
use tumble_collision::{
    ContactKind, FeatureId, SpatialManifold, SpatialOrientedBox, SpatialQuery, TurningBox, collide_spatial as collide,
};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation};
use tumble_shape::{Cone, ConvexHull, Cuboid, Cylinder, HalfSpace, SpatialShape};

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn swapping_the_shapes_negates_the_normal(a in shape(), b in shape(), pose_a in pose(0.5), pose_b in pose(1.5)) {
        let forth = collide(&a, &pose_a, &b, &pose_b, &query(0.5, 0.0));
        let back = collide(&b, &pose_b, &a, &pose_a, &query(0.5, 0.0));
        // Some ten roundings in either body's frame, amplified where edges cross at a small angle.
        assert_same(&listed(&forth), &swapped(&back), 1e-10);
    }

    #[test]
    fn moving_everything_moves_the_answer(a in shape(), b in shape(), pose_a in pose(0.5), pose_b in pose(1.5), by in pose(10.0)) {
        let here = collide(&a, &pose_a, &b, &pose_b, &query(0.5, 0.0));
        let there = collide(&a, &after(&by, &pose_a), &b, &after(&by, &pose_b), &query(0.5, 0.0));
        assert_same(&moved(&here, &by), &listed(&there), 1e-10);
    }

    #[test]
    fn manifolds_are_well_formed(
        a in shape(), b in shape(), pose_a in pose(0.5), pose_b in pose(1.2), nudge in vector(0.05),
        margin in 0.0..3.0_f64, tolerance in 0.0..0.01_f64, remember in any::<bool>(),
    ) {
        let before = collide(&a, &pose_a, &b, &Pose { position: pose_b.position + nudge, ..pose_b }, &query(3.0, tolerance));
        let query = SpatialQuery { previous: remember.then_some(&before), ..query(margin, tolerance) };
        let manifold = collide(&a, &pose_a, &b, &pose_b, &query);
        prop_assert!(manifold.is_empty() || (manifold.normal.length() - 1.0).abs() < 1e-14);
        prop_assert!(manifold.points().iter().all(|point| point.separation <= margin && point.point.is_finite()));
        let ids: Vec<FeatureId> = manifold.points().iter().map(|point| point.feature).collect();
        prop_assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "{manifold:#?}");
    }

    #[test]
    fn memory_of_a_gap_changes_no_contact(a in polyhedron(), b in polyhedron(), pose_a in pose(0.5), pose_b in pose(1.2), by in vector(0.8)) {
        let away = Pose { position: pose_b.position + by, ..pose_b };
        let before = collide(&a, &pose_a, &b, &away, &query(0.01, 0.0));
        let remembering = SpatialQuery { previous: Some(&before), ..query(0.01, 0.0) };
        let manifold = collide(&a, &pose_a, &b, &pose_b, &remembering);
        let fresh = collide(&a, &pose_a, &b, &pose_b, &query(0.01, 0.0));
        prop_assert_eq!(manifold.points(), fresh.points());
    }

    #[test]
    fn a_box_is_the_hull_of_its_corners(
        half in (0.2..1.0_f64, 0.2..1.0_f64, 0.2..1.0_f64), turn in rotation(), other in hull(), pose_a in pose(0.3), pose_b in pose(1.2),
    ) {
        let cuboid = Cuboid::try_new(DVec3::ZERO, half.into(), turn).unwrap();
        let as_hull: SpatialShape = cuboid.hull().clone().into();
        let second: SpatialShape = Cuboid::with_half_extents(dvec3(0.4, 0.5, 0.6)).unwrap().into();
        let cuboid: SpatialShape = cuboid.into();
        let second_hull: SpatialShape = second.hull().unwrap().clone().into();
        for (b, b_hull) in [(&other, &other), (&second, &second_hull)] {
            let one = collide(&cuboid, &pose_a, b, &pose_b, &query(0.5, 0.0));
            let two = collide(&as_hull, &pose_a, b_hull, &pose_b, &query(0.5, 0.0));
            assert_same(&listed(&one), &listed(&two), 1e-10);
        }
    }

    #[test]
    fn a_half_space_is_as_far_as_the_lowest_point_of_the_other_shape(
        shape in shape(), normal in vector(1.0), offset in -2.0..2.0_f64, pose_shape in pose(2.0), pose_plane in pose(1.0),
    ) {
        let plane = HalfSpace::try_new(normal, offset).unwrap();
        let surface = plane.posed(&pose_plane);
        let height = |vertex: &DVec3| surface.normal().dot(pose_shape.transform_point(*vertex)) - surface.offset();
        let lowest = shape.vertices().iter().map(height).fold(f64::INFINITY, f64::min) - shape.radius();
        let plane = SpatialShape::from(plane);
        let forth = collide(&plane, &pose_plane, &shape, &pose_shape, &query(100.0, 0.0));
        // A few roundings of numbers below 8.
        prop_assert!((forth.deepest_separation().unwrap() - lowest).abs() < 2e-14);
        prop_assert!(forth.normal.distance(surface.normal()) < 3e-15);
        let back = collide(&shape, &pose_shape, &plane, &pose_plane, &query(100.0, 0.0));
        prop_assert_eq!(listed(&forth), swapped(&back));
    }

    #[test]
    fn points_of_a_face_span_as_much_as_any_four_with_a_deepest_one(sides in 5..12_u32, turn in 0.0..6.3_f64, tilt in vector(0.002), x in -0.3..0.3_f64) {
        // A many-sided plate on a box: its corners inside the box's top, cut where it hangs over.
        let corner = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(sides);
            let (sin, cos) = tumble_math::trig::sin_cos(angle);
            [dvec3(cos, sin, -0.1), dvec3(cos, sin, 0.1)]
        };
        let points: Vec<DVec3> = (0..sides).flat_map(corner).collect();
        let plate: SpatialShape = ConvexHull::try_new(&points).unwrap().into();
        let upright = SpatialRotation::from_rotation_vector(DVec3::Z * turn);
        let pose = Pose { position: dvec3(x, 0.0, 1.1), rotation: upright.turned(tilt) };
        let manifold = collide(&boxed(0.9, 0.9, 1.0), &at(0.0, 0.0, 0.0), &plate, &pose, &query(1.0, 0.05));
        prop_assert_eq!(manifold.points().len(), 4);
        let area = |points: &[DVec3]| {
            // Seen from above, in the order round their middle.
            let middle = points.iter().copied().sum::<DVec3>() / 4.0;
            let mut arms: Vec<DVec3> = points.iter().map(|&point| point - middle).collect();
            arms.sort_by(|p, q| tumble_math::trig::atan2(p.y, p.x).total_cmp(&tumble_math::trig::atan2(q.y, q.x)));
            (0..4).map(|i| 0.5 * arms[i].truncate().perp_dot(arms[(i + 1) % 4].truncate())).sum::<f64>()
        };
        let places: Vec<DVec3> = manifold.points().iter().map(|point| point.point).collect();
        // A regular pentagon of radius 1 has the area 2.38, of which the box's top carries 2 or more; four corners of a regular
        // polygon of n corners span at least 2/π of it.
        prop_assert!(area(&places) > 2.0 * std::f64::consts::FRAC_2_PI, "{} {manifold:#?}", area(&places));
    }
}

#[test]
fn a_corner_on_a_face_has_the_normal_of_the_face() {
    // A cube standing on a corner, over another cube's top.
    let tip = DVec3::ONE.normalize();
    let turn = SpatialRotation::try_from_quaternion(glam::DQuat::from_rotation_arc(tip, DVec3::Z)).unwrap();
    let height = 0.5 * 3.0_f64.sqrt();
    for separation in [-0.1, -1e-9, 0.05] {
        let pose = Pose { position: dvec3(0.1, 0.2, 0.5 + height + separation), rotation: turn };
        let manifold =
            collide(&boxed(0.5, 0.5, 0.5), &at(0.0, 0.0, 0.0), &boxed(0.5, 0.5, 0.5), &pose, &query(0.1, 0.0));
        let lowest = manifold.points().iter().min_by(|p, q| p.separation.total_cmp(&q.separation)).unwrap();
        assert_eq!((lowest.kind, manifold.normal), (ContactKind::VertexFace, DVec3::Z));
        assert_eq!(lowest.feature, FeatureId::vertex_of_b(0));
        assert!((lowest.separation - separation).abs() < 1e-14);
        assert!(lowest.point.distance(dvec3(0.1, 0.2, 0.5 + 0.5 * separation)) < 1e-14);
    }
}

#[test]
fn crossed_edges_have_the_normal_square_to_both() {
    // A bar lying with an edge down across another one with an edge up.
    let up = turned(DVec3::ZERO, DVec3::X * FRAC_PI_4);
    let half_diagonal = 0.5 * 2.0_f64.sqrt();
    let bar = (boxed(2.0, 0.5, 0.5), boxed(0.5, 2.0, 0.5));
    for separation in [-0.05, -1e-9, 0.05] {
        let down = turned(dvec3(0.3, 0.4, 2.0 * half_diagonal + separation), DVec3::Y * FRAC_PI_4);
        let manifold = collide(&bar.0, &up, &bar.1, &down, &query(0.1, 0.0));
        let [point] = manifold.points() else { panic!("{manifold:#?}") };
        assert_eq!(point.kind, ContactKind::EdgeEdge);
        assert!(manifold.normal.distance(DVec3::Z) < 1e-15);
        assert!((point.separation - separation).abs() < 1e-14);
        assert!(point.point.distance(dvec3(0.3, 0.0, half_diagonal + 0.5 * separation)) < 1e-14);
    }
}

#[test]
fn boxes_lying_flush_touch_at_four_points_that_keep_their_ids_while_sliding() {
    let (ground, slider) = (boxed(2.0, 2.0, 0.5), boxed(0.5, 0.5, 0.5));
    let mut ids = None;
    for i in 0..100 {
        // Rounding noise of both signs in height and angle, as in a stack at rest.
        let noise = |k: i32| 1e-13 * f64::from((i * k) % 7 - 3);
        let pose = turned(dvec3(-1.0 + 0.02 * f64::from(i), noise(2), 1.0 + noise(3)), dvec3(noise(1), noise(5), 0.3));
        let manifold = collide(&ground, &at(0.0, 0.0, 0.0), &slider, &pose, &query(0.1, 1e-9));
        assert_eq!(manifold.points().len(), 4, "{manifold:#?}");
        assert!(
            manifold
                .points()
                .iter()
                .all(|point| point.separation.abs() < 1e-12 && point.kind == ContactKind::VertexFace)
        );
        let found: Vec<FeatureId> = manifold.points().iter().map(|point| point.feature).collect();
        assert_eq!(*ids.get_or_insert(found.clone()), found);
    }
    assert_eq!(ids.unwrap(), [0, 1, 2, 3].map(FeatureId::vertex_of_b));
}

#[test]
fn boxes_of_one_size_stacked_exactly_keep_their_ids_under_rounding_noise() {
    let one = boxed(0.5, 0.5, 0.5);
    for i in 0..200 {
        let noise = |k: i32| 1e-13 * f64::from((i * k) % 7 - 3);
        let pose = turned(dvec3(noise(3), noise(4), 1.0 + noise(2)), dvec3(noise(5), noise(6), noise(8)));
        let manifold =
            collide(&one, &turned(DVec3::ZERO, dvec3(noise(9), 0.0, noise(1))), &one, &pose, &query(0.1, 1e-9));
        let ids: Vec<FeatureId> = manifold.points().iter().map(|point| point.feature).collect();
        assert_eq!(ids, [0, 1, 2, 3].map(FeatureId::vertex_of_b), "{i}");
    }
}

#[test]
fn crosswise_planks_touch_where_their_outlines_cross() {
    let plank = boxed(2.0, 0.25, 0.1);
    let across = turned(dvec3(0.0, 0.0, 0.2), DVec3::Z * std::f64::consts::FRAC_PI_2);
    let manifold = collide(&plank, &at(0.0, 0.0, 0.0), &plank, &across, &query(0.1, 1e-9));
    assert_eq!(manifold.points().len(), 4);
    for point in manifold.points() {
        assert_eq!(point.kind, ContactKind::EdgeEdge);
        assert!((point.point.abs() - dvec3(0.25, 0.25, 0.1)).length() < 1e-12);
    }
}

#[test]
fn a_capsule_or_rod_lies_on_a_face_with_two_points_and_along_another_one_too() {
    for radius in [0.0, 0.1] {
        let lying = rod(1.0, radius);
        let manifold =
            collide(&boxed(2.0, 2.0, 0.5), &at(0.0, 0.0, 0.0), &lying, &at(0.2, 0.0, 0.5 + radius), &query(0.1, 0.0));
        let along: Vec<f64> = manifold.points().iter().map(|point| point.point.x).collect();
        assert!(along.len() == 2 && (along[0] + 0.3).abs() < 1e-14 && (along[1] - 0.7).abs() < 1e-14, "{manifold:#?}");
        let kind = if radius > 0.0 { ContactKind::RoundFace } else { ContactKind::VertexFace };
        assert!(manifold.points().iter().all(|point| point.kind == kind));

        let manifold =
            collide(&lying, &at(0.0, 0.0, 0.0), &lying, &at(0.4, 0.0, 2.0 * radius + 0.01), &query(0.1, 0.0));
        let along: Vec<f64> = manifold.points().iter().map(|point| point.point.x).collect();
        assert!(
            along.len() == 2 && along[0].min(along[1]) + 0.1 < 1e-14 && along[0].max(along[1]) - 0.5 < 1e-14,
            "{manifold:#?}"
        );
    }
}

#[test]
fn a_capsule_beside_a_box_edge_touches_it_along_a_stretch() {
    let lying = rod(1.0, 0.1);
    let offset = 0.5 + 0.1 * 0.5_f64.sqrt();
    let manifold =
        collide(&boxed(2.0, 0.5, 0.5), &at(0.0, 0.0, 0.0), &lying, &at(0.0, offset, offset), &query(0.1, 0.0));
    assert_eq!(manifold.points().len(), 2, "{manifold:#?}");
    assert!(
        manifold.points().iter().all(|point| point.separation.abs() < 1e-14 && point.kind == ContactKind::RoundVertex)
    );
    assert!(manifold.normal.distance(dvec3(0.0, 1.0, 1.0).normalize()) < 1e-14);
}

#[test]
fn thin_rods_that_cross_stay_on_their_side() {
    let one = rod(2.0, 0.0);
    let across = |height: f64| turned(dvec3(0.1, 0.2, height), DVec3::Z * 1.2);
    let mut previous = collide(&one, &at(0.0, 0.0, 0.0), &one, &across(0.01), &query(0.1, 0.0));
    assert_eq!(previous.points()[0].kind, ContactKind::EdgeEdge);
    for height in [0.001, 0.0, -0.001, -0.05] {
        let query = SpatialQuery { previous: Some(&previous), ..query(0.1, 0.0) };
        let manifold = collide(&one, &at(0.0, 0.0, 0.0), &one, &across(height), &query);
        assert!(manifold.normal.distance(DVec3::Z) < 1e-12, "{height} {manifold:#?}");
        assert!((manifold.points()[0].separation - height).abs() < 1e-12);
        previous = manifold;
    }
}

#[test]
fn a_box_on_the_floor_stands_on_the_corners_of_its_lowest_face() {
    let manifold = collide(&floor(), &at(0.0, 0.0, 0.0), &boxed(0.5, 1.0, 1.5), &at(3.0, 4.0, 1.49), &query(0.1, 0.01));
    let ids: Vec<FeatureId> = manifold.points().iter().map(|point| point.feature).collect();
    assert_eq!(ids, [0, 1, 2, 3].map(FeatureId::vertex_of_b));
    assert_eq!(manifold.normal, DVec3::Z);
    assert!(manifold.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-14));
}

#[test]
fn a_box_sliding_over_flush_tiles_meets_no_side() {
    let (tile, slider) = (boxed(0.5, 0.5, 0.5), boxed(0.25, 0.2, 0.25));
    for i in 0..2000 {
        // It sinks in by 4 mm, rocks a little, and slides askew over the seam between two tiles.
        let rock = 1e-3 * f64::from(i % 5 - 2);
        let pose = turned(dvec3(-0.6 + 6e-4 * f64::from(i), 0.1, 0.746), dvec3(rock, -rock, 0.2));
        for x in [-0.5, 0.5] {
            let manifold = collide(&tile, &at(x, 0.0, 0.0), &slider, &pose, &query(0.02, 0.01));
            assert!(manifold.is_empty() || manifold.normal.z > 0.99, "step {i}: {manifold:#?}");
        }
    }
    // A step higher than the tolerance stops it.
    let wall = collide(&tile, &at(0.5, 0.0, 0.02), &slider, &at(-0.24, 0.0, 0.75), &query(0.02, 0.01));
    assert_eq!(wall.normal, DVec3::NEG_X);
}

#[test]
fn the_contact_changes_continuously_along_slow_motions() {
    let shapes = [boxed(0.5, 0.4, 0.3), sphere(0.4), rod(1.0, 0.1)];
    let path = |i: u32| {
        let s = f64::from(i) / 20_000.0;
        let (sin, cos) = tumble_math::trig::sin_cos(std::f64::consts::TAU * s);
        turned(dvec3(0.95 * cos, 0.95 * sin, 0.5 * sin * cos), dvec3(s, 2.0 * s, -s))
    };
    for a in &shapes {
        for b in &shapes {
            let mut before: Option<SpatialManifold> = None;
            for i in 0..20_000 {
                let manifold = collide(a, &at(0.0, 0.0, 0.0), b, &path(i), &query(10.0, 0.0));
                let deepest = manifold.deepest_separation().unwrap();
                if let Some(before) = before.and_then(|before| before.deepest_separation()) {
                    // A step of 3e-4 m and 6e-4 rad on 0.6 m; the separation follows the motion.
                    assert!((deepest - before).abs() < 1.5e-3, "{a:?} {b:?} step {i}: {before} {deepest}");
                }
                before = Some(manifold);
            }
        }
    }
}

#[test]
fn coincident_shapes_have_a_finite_normal() {
    let pose = turned(dvec3(1.0, 2.0, 3.0), dvec3(0.3, 0.2, 0.1));
    for shape in [sphere(0.5), rod(1.0, 0.0), rod(1.0, 0.1), boxed(0.5, 0.5, 0.5)] {
        let manifold = collide(&shape, &pose, &shape, &pose, &query(0.1, 0.0));
        assert!((manifold.normal.length() - 1.0).abs() < 1e-14 && !manifold.is_empty(), "{shape:?} {manifold:#?}");
    }
}

#[test]
fn cylinders_and_cones_stand_and_lie_on_the_floor() {
    let cylinder: SpatialShape = Cylinder::try_new(dvec3(0.0, 0.0, -0.5), dvec3(0.0, 0.0, 0.5), 0.3).unwrap().into();
    let cone: SpatialShape = Cone::try_new(DVec3::ZERO, dvec3(0.0, 0.0, 0.4), 0.3).unwrap().into();
    let on_floor = |shape: &SpatialShape, pose: &Pose<Spatial>| {
        collide(&floor(), &at(0.0, 0.0, 0.0), shape, pose, &query(0.05, 0.01))
    };
    // Standing, with rounding noise: four places on the rim that stay where they are.
    for i in 0..20 {
        let noise = 1e-12 * f64::from(i % 7 - 3);
        let standing = on_floor(&cylinder, &turned(dvec3(1.0, 2.0, 0.5), dvec3(noise, -noise, 0.0)));
        let ids: Vec<FeatureId> = standing.points().iter().map(|point| point.feature).collect();
        assert_eq!(ids, [0, 1, 2, 3].map(FeatureId::vertex_of_b));
        assert!((standing.points()[0].point - standing.points()[2].point).length() > 0.6 - 1e-9);
    }
    // Lying: a line, from rim to rim.
    let lying = on_floor(&cylinder, &turned(dvec3(0.0, 0.0, 0.29), DVec3::Y * std::f64::consts::FRAC_PI_2));
    assert_eq!(lying.points().len(), 2);
    assert!(lying.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-14));
    // A cone of base radius 3 and height 4 rolls on its side of length 5: its tip and one place of the rim are down.
    let tilt = std::f64::consts::PI - tumble_math::trig::atan2(4.0, 3.0);
    let rolling = on_floor(&cone, &turned(dvec3(0.0, 0.0, 0.24), DVec3::X * tilt));
    assert_eq!(rolling.points().len(), 2, "{rolling:#?}");
    assert!(rolling.points().iter().all(|point| point.separation.abs() < 1e-14));
    assert!((rolling.points()[0].point.distance(rolling.points()[1].point) - 0.5).abs() < 1e-14);
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn the_lowest_place_of_a_cylinder_or_cone_is_its_separation_from_the_floor(
        ends in (vector(1.0), vector(1.0)), radius in 0.1..1.0_f64, pose in pose(1.0),
    ) {
        let shapes: [SpatialShape; 2] = [
            Cylinder::try_new(ends.0, ends.1, radius).unwrap().into(),
            Cone::try_new(ends.0, ends.1, radius).unwrap().into(),
        ];
        for shape in shapes {
            let manifold = collide(&floor(), &at(0.0, 0.0, 0.0), &shape, &pose, &query(10.0, 0.0));
            let lowest = shape.bounds(&pose).unwrap().min.z;
            // A few roundings of numbers below 4, squared under a root.
            prop_assert!((manifold.deepest_separation().unwrap() - lowest).abs() < 1e-13);
        }
    }
}

#[test]
fn a_manifold_of_other_shapes_does_no_harm() {
    // A body's shape may change between two steps: features of the old one may not exist any more.
    let many: Vec<DVec3> =
        (0..60).map(|i| turned(DVec3::ZERO, dvec3(f64::from(i), 0.3, 0.7)).transform_point(DVec3::ONE)).collect();
    let many: SpatialShape = ConvexHull::try_new(&many).unwrap().into();
    let small = boxed(0.5, 0.5, 0.5);
    let pose = at(0.0, 0.0, 0.9);
    for (a, b) in [(&many, &small), (&small, &many), (&many, &many)] {
        let previous = collide(a, &at(0.0, 0.0, 0.0), b, &pose, &query(0.1, 0.01));
        let query = SpatialQuery { previous: Some(&previous), ..query(0.1, 0.01) };
        let manifold = collide(&small, &at(0.0, 0.0, 0.0), &small, &pose, &query);
        assert!((manifold.deepest_separation().unwrap() + 0.1).abs() < 1e-12);
    }
}

#[test]
fn a_pose_that_is_not_finite_makes_no_contact() {
    let nowhere = Pose::<Spatial> { position: DVec3::NAN, rotation: SpatialRotation::IDENTITY };
    for a in [floor(), sphere(0.5), rod(1.0, 0.0), boxed(0.5, 0.5, 0.5)] {
        for b in [sphere(0.5), rod(1.0, 0.0), boxed(0.5, 0.5, 0.5)] {
            assert!(collide(&a, &at(0.0, 0.0, 0.0), &b, &nowhere, &query(0.1, 1e-3)).is_empty(), "{a:?} {b:?}");
        }
    }
}

proptest! {
    #![proptest_config(config(3000))]

    #[test]
    fn a_remembered_axis_is_as_good_as_the_best_to_a_tenth_of_the_flush_tolerance(
        a in polyhedron(), b in polyhedron(), pose_a in pose(0.3), pose_b in pose(0.9), step in vector(1e-4), turn in vector(2e-4),
    ) {
        let tolerance = 0.01;
        let mut pose = pose_b;
        let mut previous = SpatialManifold::EMPTY;
        for i in 0..12 {
            let query = SpatialQuery { previous: Some(&previous), ..query(0.0, tolerance) };
            let manifold = collide(&a, &pose_a, &b, &pose, &query);
            if let Some(deepest) = manifold.deepest_separation() {
                let best = best_separation(&a, &pose_a, &b, &pose);
                // Twice a tenth: edges yield to the better face by a tenth, and b's face to a's.
                prop_assert!(deepest >= best - 2.001e-3 && deepest <= best + 2.001e-3, "step {i}: {best} {manifold:#?}");
                // Along the same axis the same points are found without memory; of more than four, others may be chosen.
                let fresh = collide(&a, &pose_a, &b, &pose, &spatial::query(0.0, tolerance));
                if fresh.normal.distance(manifold.normal) < 1e-12 && fresh.points().len() < 4 {
                    assert_same(&listed(&manifold), &listed(&fresh), 1e-11);
                }
            }
            previous = manifold;
            pose = Pose { position: pose.position + step, rotation: pose.rotation.turned(turn) };
        }
    }

    #[test]
    fn oriented_boxes_of_shapes_that_touch_overlap(a in shape(), b in shape(), pose_a in pose(0.5), pose_b in pose(2.0), margin in 0.0..0.2_f64) {
        let around = |shape, pose| SpatialOrientedBox::around(shape, pose, margin).unwrap();
        let (box_a, box_b) = (around(&a, &pose_a), around(&b, &pose_b));
        let touching = !collide(&a, &pose_a, &b, &pose_b, &query(2.0 * margin, 0.0)).is_empty();
        prop_assert!(box_a.overlaps(&box_b) || !touching);
        prop_assert_eq!(box_a.overlaps(&box_b), box_b.overlaps(&box_a));
    }

    #[test]
    fn swept_and_grown_oriented_box_contains_what_it_passes_through_and_meets_all_that_meets_it(
        a in shape(), b in shape(), pose_a in pose(0.5), pose_b in pose(2.0), travel in (-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64),
        part in 0.0..1.0_f64, margin in 1e-9..0.5_f64,
    ) {
        let travel = DVec3::new(travel.0, travel.1, travel.2);
        let moved = |by: DVec3| Pose::<Spatial> { position: pose_a.position + by, rotation: pose_a.rotation };
        let around = |shape: &SpatialShape, pose: &Pose<Spatial>| SpatialOrientedBox::around(shape, pose, 0.0).unwrap();
        let (start, other) = (around(&a, &pose_a), around(&b, &pose_b));
        let fat = start.swept(travel).grown(margin);
        let on_the_way = around(&a, &moved(travel * part));
        prop_assert!(fat.contains(&on_the_way));
        prop_assert!(fat.overlaps(&other) || !on_the_way.overlaps(&other));
        // Beyond the end by more than the margin along some side.
        let beyond = travel + travel.normalize_or(DVec3::X) * (margin * 2.0);
        prop_assert!(!fat.contains(&around(&a, &moved(beyond))));
        prop_assert!(!start.contains(&fat));
    }

    #[test]
    fn oriented_boxes_of_boxes_are_apart_exactly_when_the_boxes_are(a in cuboid(), b in cuboid(), pose_a in pose(0.5), pose_b in pose(1.5)) {
        let around = |shape, pose| SpatialOrientedBox::around(shape, pose, 0.0).unwrap();
        let separation = best_separation(&a, &pose_a, &b, &pose_b);
        prop_assert_eq!(around(&a, &pose_a).overlaps(&around(&b, &pose_b)), separation <= 1e-12);
    }
}
