//! Cylinders and cones among themselves and with all other shapes: distances and depths that no direction betters, lines and regions to rest on.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::spatial::{
    Noise, after, assert_same, at, boxed, config, listed, moved, pose, query, rotation, shape, sphere, swapped, turned,
    vector,
};
use glam::{DVec3, dvec3};
use parry3d_f64::math::{Pose3, Rot3, Vec3};
use parry3d_f64::query::distance as parry_distance;
use proptest::prelude::{Strategy, prop_assert, prop_oneof, proptest};
use tumble_collision::{FeatureId, SpatialManifold, collide_spatial as collide};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation};
use tumble_shape::{Capsule, Cone, Cylinder, SpatialShape};

/// A cylinder along z around the origin.
fn cylinder(radius: f64, length: f64) -> SpatialShape {
    Cylinder::try_new(dvec3(0.0, 0.0, -0.5 * length), dvec3(0.0, 0.0, 0.5 * length), radius).unwrap().into()
}

/// A cone along z, its base around the origin.
fn cone(radius: f64, height: f64) -> SpatialShape {
    Cone::try_new(DVec3::ZERO, dvec3(0.0, 0.0, height), radius).unwrap().into()
}

fn rims() -> impl Strategy<Value = SpatialShape> {
    let size = || (0.1..1.0_f64, 0.1..2.0_f64);
    prop_oneof![
        (vector(0.5), rotation(), size()).prop_map(|(centre, turn, (r, length))| {
            let half = turn.rotate(DVec3::Z) * (0.5 * length);
            Cylinder::try_new(centre - half, centre + half, r).unwrap().into()
        }),
        (vector(0.5), rotation(), size()).prop_map(|(base, turn, (r, height))| Cone::try_new(
            base,
            base + turn.rotate(DVec3::Z) * height,
            r
        )
        .unwrap()
        .into()),
    ]
}

/// Largest n · x over a shape in a pose [m].
fn height(shape: &SpatialShape, pose: &Pose<Spatial>, n: DVec3) -> f64 {
    let disc = |centre: DVec3, axis: DVec3, radius: f64| {
        let axis = pose.rotation.rotate(axis);
        n.dot(pose.transform_point(centre)) + radius * n.cross(axis).length()
    };
    match shape {
        SpatialShape::Cylinder(c) => {
            c.ends().iter().map(|end| disc(*end, c.direction(), c.radius())).fold(f64::MIN, f64::max)
        }
        SpatialShape::Cone(c) => disc(c.base(), c.direction(), c.radius()).max(disc(c.tip(), c.direction(), 0.0)),
        SpatialShape::Sphere(sphere) => n.dot(pose.transform_point(sphere.centre())) + sphere.radius(),
        _ => shape.vertices().iter().map(|v| n.dot(pose.transform_point(*v))).fold(f64::MIN, f64::max) + shape.radius(),
    }
}

/// What is wrong with the normal and separation of a contact, if anything is: some direction is better, or they do not belong together.
fn complaint(
    a: (&SpatialShape, &Pose<Spatial>),
    b: (&SpatialShape, &Pose<Spatial>),
    manifold: &SpatialManifold,
    noise: &mut Noise,
) -> Option<String> {
    let along = |n: DVec3| -height(b.0, b.1, -n) - height(a.0, a.1, n);
    let deepest = manifold.deepest_separation()?;
    let own = along(manifold.normal);
    // Roundings of numbers below 10, some under a root.
    if (own - deepest).abs() > 1e-12 {
        return Some(format!("{deepest} is not {own}, the separation along the normal"));
    }
    for i in 0..400 {
        // Everywhere, and ever closer to the normal.
        let size = [1.0, 1e-2, 1e-4, 1e-6][i % 4];
        let from = if i % 4 == 0 { DVec3::ZERO } else { manifold.normal };
        let Some(n) = (from + noise.vector(size)).try_normalize() else { continue };
        if along(n) > deepest + 1e-12 {
            return Some(format!(
                "{deepest}, but {} along {n} which is {} away",
                along(n),
                n.distance(manifold.normal)
            ));
        }
    }
    None
}

proptest! {
    #![proptest_config(config(1500))]

    #[test]
    fn no_direction_is_better(a in prop_oneof![shape(), rims()], b in rims(), pose_a in pose(0.5), pose_b in pose(1.5)) {
        let manifold = collide(&a, &pose_a, &b, &pose_b, &query(100.0, 0.0));
        prop_assert!(!manifold.is_empty());
        // A core that lies in the other one has no inside of its own: the depth is that of its whole shape all the same.
        let complaint = complaint((&a, &pose_a), (&b, &pose_b), &manifold, &mut Noise(5));
        prop_assert!(complaint.is_none(), "{complaint:?} {a:?} {b:?} {manifold:#?}");
    }

    #[test]
    fn swapping_and_moving_change_nothing_else(
        a in prop_oneof![shape(), rims()], b in rims(), pose_a in pose(0.5), pose_b in pose(1.5), by in pose(5.0),
    ) {
        let manifold = collide(&a, &pose_a, &b, &pose_b, &query(0.3, 0.0));
        let other_way = collide(&b, &pose_b, &a, &pose_a, &query(0.3, 0.0));
        // Rounding at 10 m, amplified where curves lie nearly along each other.
        assert_same(&listed(&other_way), &swapped(&manifold), 1e-6);
        let elsewhere = collide(&a, &after(&by, &pose_a), &b, &after(&by, &pose_b), &query(0.3, 0.0));
        assert_same(&listed(&elsewhere), &moved(&manifold, &by), 1e-6);
    }

    #[test]
    fn distances_agree_with_parry(a in rims(), b in rims(), pose_a in pose(0.5), pose_b in pose(2.5)) {
        let peer = |shape: &SpatialShape, pose: &Pose<Spatial>| -> (Box<dyn parry3d_f64::shape::Shape>, Pose3) {
            let (from, to, radius) = match shape {
                SpatialShape::Cylinder(c) => (c.ends()[0], c.ends()[1], c.radius()),
                SpatialShape::Cone(c) => (c.base(), c.tip(), c.radius()),
                _ => unreachable!("rims are cylinders or cones"),
            };
            let (middle, half) = (pose.transform_point((from + to) * 0.5), 0.5 * from.distance(to));
            let axis = pose.transform_vector((to - from).normalize());
            let turn = Rot3::from_rotation_arc(Vec3::Y, Vec3::new(axis.x, axis.y, axis.z));
            let place = Pose3::from_parts(Vec3::new(middle.x, middle.y, middle.z), turn);
            match shape {
                SpatialShape::Cylinder(_) => (Box::new(parry3d_f64::shape::Cylinder::new(half, radius)), place),
                _ => (Box::new(parry3d_f64::shape::Cone::new(half, radius)), place),
            }
        };
        let ((peer_a, at_a), (peer_b, at_b)) = (peer(&a, &pose_a), peer(&b, &pose_b));
        let expected = parry_distance(&at_a, &*peer_a, &at_b, &*peer_b).unwrap().distance;
        let found = collide(&a, &pose_a, &b, &pose_b, &query(100.0, 0.0)).deepest_separation().unwrap();
        // Its distance is that of two points, and never too small; on curved shapes it stops some millionths early.
        prop_assert!(expected > found.max(0.0) - 1e-9 && expected < found.max(0.0) + 1e-5, "{found} {expected}");
    }
}

#[test]
fn a_standing_cylinder_rests_on_four_places_that_stay() {
    let table = boxed(1.0, 1.0, 0.5);
    let mut known: Option<Vec<FeatureId>> = None;
    for i in 0..20 {
        let noise = 1e-12 * f64::from(i % 7 - 3);
        let pose = turned(dvec3(0.1, 0.2, 0.99 + noise), dvec3(noise, -noise, 0.0));
        let manifold = collide(&table, &at(0.0, 0.0, 0.0), &cylinder(0.3, 1.0), &pose, &query(0.05, 0.01));
        assert!((manifold.normal - DVec3::Z).length() < 1e-11);
        assert_eq!(manifold.points().len(), 4);
        assert!(manifold.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-11));
        let ids = manifold.points().iter().map(|point| point.feature).collect();
        assert_eq!(*known.get_or_insert_with(|| Vec::clone(&ids)), ids);
    }
}

#[test]
fn a_flat_end_beyond_an_edge_rests_where_outlines_cross() {
    let table = boxed(1.0, 1.0, 0.5);
    let manifold = collide(&table, &at(0.0, 0.0, 0.0), &cylinder(0.5, 1.0), &at(1.2, 0.0, 1.0), &query(0.05, 0.01));
    // The chord 0.2 from the middle, and the places of the rim above the table.
    let crossing = |y: f64| manifold.points().iter().any(|point| (point.point - dvec3(1.0, y, 0.5)).length() < 1e-12);
    let half = (0.25_f64 - 0.04).sqrt();
    assert!(crossing(half) && crossing(-half), "{manifold:#?}");
    assert!(manifold.points().len() == 3 && manifold.points().iter().all(|point| point.point.x < 1.0 + 1e-12));
    // A plank narrower than the flat end: its own corners.
    let plank = boxed(0.1, 0.2, 0.05);
    let manifold = collide(&plank, &at(0.0, 0.0, 0.55), &cylinder(0.5, 1.0), &at(0.0, 0.0, 0.0), &query(0.05, 0.01));
    assert_eq!(manifold.points().len(), 4);
    assert!(manifold.points().iter().all(|point| (point.point.abs() - dvec3(0.1, 0.2, 0.5)).length() < 1e-14));
}

#[test]
fn a_lying_cylinder_or_cone_rests_along_a_line() {
    let table = boxed(1.0, 1.0, 0.5);
    let on_table = |shape: &SpatialShape, pose: &Pose<Spatial>| {
        collide(&table, &at(0.0, 0.0, 0.0), shape, pose, &query(0.05, 0.01))
    };
    let lying = on_table(&cylinder(0.3, 1.0), &turned(dvec3(0.0, 0.0, 0.79), DVec3::Y * FRAC_PI_2));
    assert_eq!(lying.points().len(), 2);
    assert!(lying.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-14));
    assert!((lying.points()[0].point.distance(lying.points()[1].point) - 1.0).abs() < 1e-14);
    // A long one on the sides of the table, askew.
    let long = on_table(&cylinder(0.3, 8.0), &turned(dvec3(0.0, 0.0, 0.8), DVec3::Y * FRAC_PI_2));
    assert_eq!(long.points().len(), 2);
    assert!(long.points().iter().all(|point| (point.point.x.abs() - 1.0).abs() < 1e-12), "{long:#?}");
    // A cone of base radius 3 and height 4 on its side of length 5.
    let tilt = PI - tumble_math::trig::atan2(4.0, 3.0);
    let rolling = on_table(&cone(0.3, 0.4), &turned(dvec3(0.0, 0.0, 0.74), DVec3::X * tilt));
    assert_eq!(rolling.points().len(), 2, "{rolling:#?}");
    assert!(rolling.points().iter().all(|point| point.separation.abs() < 1e-14));
    // On its tip.
    let on_tip = on_table(&cone(0.3, 0.4), &turned(dvec3(0.2, 0.0, 0.89), DVec3::X * PI));
    let deepest = on_tip.points().iter().find(|point| (point.separation + 0.01).abs() < 1e-14).unwrap();
    assert!((deepest.point - dvec3(0.2, 0.0, 0.495)).length() < 1e-14, "{on_tip:#?}");
}

#[test]
fn cylinders_stack_lie_along_and_across_each_other() {
    let (thick, thin) = (cylinder(0.5, 1.0), cylinder(0.3, 1.0));
    let of = |a: &SpatialShape, b: &SpatialShape, pose: &Pose<Spatial>| {
        collide(a, &at(0.0, 0.0, 0.0), b, pose, &query(0.05, 0.01))
    };
    let stacked = of(&thick, &thin, &at(0.1, 0.0, 0.99));
    assert_eq!(stacked.points().len(), 4);
    assert!(stacked.points().iter().all(|point| (point.point - dvec3(0.1, 0.0, 0.495)).length() < 0.3 + 1e-12));
    let alike = of(&thick, &thick, &at(0.0, 0.0, 0.99));
    assert_eq!(alike.points().len(), 4, "{alike:#?}");
    // Half over the edge: both crossings, and a place of each rim between them.
    let moved = of(&thick, &thick, &at(0.5, 0.0, 1.0));
    let crossing = dvec3(0.25, 0.1875_f64.sqrt(), 0.5);
    assert!(moved.points().iter().any(|point| (point.point - crossing).length() < 1e-12), "{moved:#?}");
    let beside = of(&thick, &thin, &at(0.79, 0.0, 0.5));
    assert_eq!(beside.points().len(), 2);
    assert!((beside.normal - DVec3::X).length() < 1e-14);
    assert!(beside.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-14));
    let across = of(&thick, &thin, &turned(dvec3(0.79, 0.0, 0.2), DVec3::X * 1.0));
    assert!(across.points().len() == 1 && (across.normal - DVec3::X).length() < 1e-14, "{across:#?}");
    // Corner to corner like two edges: rims that pass each other at right angles.
    let edges = of(&thick, &thick, &turned(dvec3(0.5 + 0.5, 0.0, 0.5 + 0.5), DVec3::Y * 1e-9));
    assert!((edges.deepest_separation().unwrap()).abs() < 1e-8, "{edges:#?}");
}

#[test]
fn spheres_and_capsules_touch_sides_ends_and_rims_exactly() {
    let can = cylinder(0.5, 1.0);
    let of =
        |shape: &SpatialShape, pose: &Pose<Spatial>| collide(&can, &at(0.0, 0.0, 0.0), shape, pose, &query(1.0, 0.01));
    let ball = sphere(0.1);
    for (place, separation, normal) in [
        (dvec3(0.7, 0.0, 0.2), 0.1, DVec3::X),
        (dvec3(0.1, 0.2, 0.7), 0.1, DVec3::Z),
        (dvec3(0.8, 0.0, 0.9), 0.4, dvec3(0.6, 0.0, 0.8)),
        (dvec3(0.0, 0.42, 0.1), -0.18, DVec3::Y),
        (dvec3(0.1, 0.0, -0.45), -0.15, -DVec3::Z),
        (DVec3::ZERO, -0.6, DVec3::ZERO),
    ] {
        let manifold = of(&ball, &at(place.x, place.y, place.z));
        assert_eq!(manifold.points().len(), 1);
        assert!((manifold.points()[0].separation - separation).abs() < 1e-14, "{place}: {manifold:#?}");
        assert!(normal == DVec3::ZERO || (manifold.normal - normal).length() < 1e-14, "{place}: {manifold:#?}");
    }
    let capsule: SpatialShape = Capsule::try_new(dvec3(-0.2, 0.0, 0.0), dvec3(0.2, 0.0, 0.0), 0.1).unwrap().into();
    let lying = of(&capsule, &at(0.1, 0.2, 0.6));
    assert_eq!(lying.points().len(), 2);
    assert!(lying.points().iter().all(|point| point.separation.abs() < 1e-14));
    let hanging_over = of(&capsule, &at(0.5, 0.0, 0.6));
    assert_eq!(hanging_over.points().len(), 2);
    assert!(hanging_over.points().iter().all(|point| point.point.x < 0.5 + 1e-12), "{hanging_over:#?}");
    let along = of(&capsule, &turned(dvec3(0.6, 0.0, 0.1), DVec3::Y * FRAC_PI_2));
    assert_eq!(along.points().len(), 2, "{along:#?}");
    assert!(along.points().iter().all(|point| point.separation.abs() < 1e-14));
}

#[test]
fn the_contact_changes_continuously_along_slow_motions() {
    let mut noise = Noise(3);
    let shapes = [cylinder(0.5, 1.0), cone(0.4, 0.9), boxed(0.4, 0.5, 0.6), sphere(0.4)];
    for round in 0..60 {
        let a = &shapes[round % 2];
        let b = &shapes[round / 2 % 4];
        let (from, to) = (noise.pose(0.6), noise.pose(0.6));
        let turn = from.rotation.turn_to(&to.rotation).rotation_vector();
        let mut before: Option<f64> = None;
        for i in 0..=500 {
            let share = f64::from(i) / 500.0;
            let pose = Pose::<Spatial> {
                position: from.position.lerp(to.position, share),
                rotation: from.rotation.turned(turn * share),
            };
            let origin = Pose { position: DVec3::ZERO, rotation: SpatialRotation::IDENTITY };
            let manifold = collide(a, &origin, b, &pose, &query(10.0, 0.0));
            let now = manifold.deepest_separation().unwrap();
            // No point of b moves by more than this in a step.
            let moved = (from.position.distance(to.position) + turn.length() * 1.0) / 500.0;
            assert!(before.is_none_or(|before| (now - before).abs() <= moved + 1e-12), "{round} {i}: {before:?} {now}");
            before = Some(now);
        }
    }
}
