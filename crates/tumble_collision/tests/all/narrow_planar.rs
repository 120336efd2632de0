//! Laws and oracles of planar contact: distances and normals against `parry2d-f64`, symmetry, invariance.

use crate::common;
use crate::common::{at, bar, boxed, config, disc, hull, query, rod, shape, thin};
use glam::DVec2;
use parry2d_f64::math::{Pose2, Vec2};
use parry2d_f64::query as parry;
use parry2d_f64::shape::{Ball, ConvexPolygon, Segment, Shape};
use proptest::prelude::{any, prop_assert, prop_assume, proptest};
use tumble_collision::{ContactKind, FeatureId, PlanarManifold, collide};
use tumble_math::{Planar, PlanarRotation, Pose};
use tumble_shape::{HalfPlane, PlanarShape};

fn to_parry(v: DVec2) -> Vec2 {
    Vec2::new(v.x, v.y)
}

/// A shape for parry: the core, its pose, and the radius that is to be taken off; discs are balls as they are.
struct Peer {
    shape: Box<dyn Shape>,
    pose: Pose2,
    radius: f64,
}

impl Peer {
    fn new(shape: &PlanarShape, pose: &Pose<Planar>) -> Self {
        let turned = |at: DVec2| Pose2::new(to_parry(at), pose.rotation.angle());
        let here = turned(pose.position);
        match shape {
            PlanarShape::Rod(rod) => {
                let segment = Segment::new(to_parry(rod.from()), to_parry(rod.to()));
                Self { shape: Box::new(segment), pose: here, radius: rod.radius() }
            }
            PlanarShape::Disc(disc) => {
                let centre = turned(pose.transform_point(disc.centre()));
                Self { shape: Box::new(Ball::new(disc.radius())), pose: centre, radius: 0.0 }
            }
            PlanarShape::ConvexPolygon(polygon) => {
                let points = polygon.points().iter().map(|&point| to_parry(point)).collect();
                let polygon = ConvexPolygon::from_convex_polyline(points).unwrap();
                Self { shape: Box::new(polygon), pose: here, radius: 0.0 }
            }
            PlanarShape::HalfPlane(_) => unreachable!("not generated"),
        }
    }

    /// Distance of the two shapes; below zero only by the radii.
    fn distance(&self, other: &Self) -> f64 {
        let cores = parry::distance(&self.pose, &*self.shape, &other.pose, &*other.shape).unwrap();
        cores.distance - self.radius - other.radius
    }
}

proptest! {
    #![proptest_config(config(3000))]

    #[test]
    fn smallest_separation_of_separated_shapes_is_their_distance(
        a in shape(), b in shape(), x in -4.0..4.0_f64, y in -4.0..4.0_f64, angle in -4.0..4.0_f64,
    ) {
        let (pose_a, pose_b) = (at(0.3, -0.2, 0.7), at(x, y, angle));
        let distance = Peer::new(&a, &pose_a).distance(&Peer::new(&b, &pose_b));
        // Parry calls everything that overlaps 0.
        prop_assume!(distance > 1e-6);
        let manifold = collide(&a, &pose_a, &b, &pose_b, &query(100.0, 0.0));
        let separation = manifold.deepest_separation().unwrap();
        // Parry's GJK stops at about 1e-10 of the size.
        prop_assert!((separation - distance).abs() < 1e-8, "{separation} {distance} {manifold:?}");
    }

    #[test]
    fn depth_of_overlapping_polygons_is_that_of_parry(
        a in hull(), b in hull(), x in -0.4..0.4_f64, y in -0.4..0.4_f64, angle in -4.0..4.0_f64,
    ) {
        let (pose_a, pose_b) = (at(0.0, 0.0, 0.7), at(x, y, angle));
        let (peer_a, peer_b) = (Peer::new(&a, &pose_a), Peer::new(&b, &pose_b));
        let contact = parry::contact(&peer_a.pose, &*peer_a.shape, &peer_b.pose, &*peer_b.shape, 0.0).unwrap();
        prop_assume!(contact.is_some_and(|contact| contact.dist < -1e-3));
        let contact = contact.unwrap();
        let manifold = collide(&a, &pose_a, &b, &pose_b, &query(0.0, 0.0));
        // How far b has to move along the normal to be free of a.
        let heights = |shape: &PlanarShape, pose: &Pose<Planar>| -> Vec<f64> {
            shape.vertices().iter().map(|&vertex| manifold.normal.dot(pose.transform_point(vertex))).collect()
        };
        let top_of_a = heights(&a, &pose_a).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let bottom_of_b = heights(&b, &pose_b).into_iter().fold(f64::INFINITY, f64::min);
        // Both are the least depth over all directions; EPA stops at about 1e-10.
        prop_assert!((bottom_of_b - top_of_a - contact.dist).abs() < 1e-8, "{manifold:?} {contact:?}");
        // The deepest corner may lie beyond the end of the reference side, and is cut away; what is left is never deeper.
        let separation = manifold.deepest_separation().unwrap();
        prop_assert!(separation >= contact.dist - 1e-8 && separation <= 0.0, "{separation} {}", contact.dist);
    }

    #[test]
    fn a_half_plane_is_as_far_as_the_lowest_point_of_the_other_shape(
        shape in shape(), normal_angle in -4.0..4.0_f64, offset in -2.0..2.0_f64, x in -2.0..2.0_f64, angle in -4.0..4.0_f64,
    ) {
        let plane = HalfPlane::try_new(at(0.0, 0.0, normal_angle).transform_vector(DVec2::X), offset).unwrap();
        let (pose, pose_plane) = (at(x, 0.4, angle), at(0.2, -0.3, 0.5));
        let surface = plane.posed(&pose_plane);
        let height = |vertex: &DVec2| surface.normal().dot(pose.transform_point(*vertex)) - surface.offset();
        let lowest = shape.vertices().iter().map(height).fold(f64::INFINITY, f64::min) - shape.radius();
        let plane = PlanarShape::from(plane);
        let forth = collide(&plane, &pose_plane, &shape, &pose, &query(100.0, 0.0));
        // A few roundings of numbers below 8.
        prop_assert!((forth.deepest_separation().unwrap() - lowest).abs() < 1e-14);
        prop_assert!(forth.normal.distance(surface.normal()) < 1e-15);
        prop_assert!(forth.points().len() == shape.vertices().len().min(2));
        let mut back = collide(&shape, &pose, &plane, &pose_plane, &query(100.0, 0.0));
        back.normal = -back.normal;
        common::assert_same_contact(&forth, &back, 1e-15);
    }

    #[test]
    fn swapping_the_shapes_negates_the_normal(
        a in shape(), b in shape(), x in -2.0..2.0_f64, y in -2.0..2.0_f64, angle in -4.0..4.0_f64,
    ) {
        let (pose_a, pose_b) = (at(0.1, -0.2, 0.4), at(x, y, angle));
        let forth = collide(&a, &pose_a, &b, &pose_b, &query(0.5, 0.0));
        let back = collide(&b, &pose_b, &a, &pose_a, &query(0.5, 0.0));
        let mut swapped = back;
        swapped.normal = -back.normal;
        common::assert_same_contact(&forth, &swapped, 1e-12);
    }

    #[test]
    fn moving_everything_moves_the_answer(
        a in shape(), b in shape(), x in -2.0..2.0_f64, y in -2.0..2.0_f64, angle in -4.0..4.0_f64, turn in -4.0..4.0_f64,
    ) {
        let (pose_a, pose_b) = (at(0.1, -0.2, 0.4), at(x, y, angle));
        let all = at(13.0, -7.0, turn);
        let moved = |pose: &Pose<Planar>| Pose {
            position: all.transform_point(pose.position),
            rotation: PlanarRotation::from_angle(pose.rotation.angle() + turn),
        };
        let here = collide(&a, &pose_a, &b, &pose_b, &query(0.5, 0.0));
        let there = collide(&a, &moved(&pose_a), &b, &moved(&pose_b), &query(0.5, 0.0));
        // Points come at coordinates near 15, rounded to 2e-15, in a few operations.
        common::assert_same_contact(common::moved(&here, &all), &there, 1e-12);
    }

    #[test]
    fn manifolds_are_well_formed(
        a in shape(), b in shape(), x in -1.0..1.0_f64, y in -1.0..1.0_f64, angle in -4.0..4.0_f64,
        margin in 0.0..3.0_f64, tolerance in 0.0..0.01_f64, remember in any::<bool>(),
    ) {
        let before = collide(&a, &at(0.0, 0.0, 0.0), &b, &at(x, y + 0.05, angle), &query(3.0, tolerance));
        let mut query = query(margin, tolerance);
        query.previous = remember.then_some(&before);
        let manifold = collide(&a, &at(0.0, 0.0, 0.0), &b, &at(x, y, angle), &query);
        // Unit to the rounding of a turned and normalised vector.
        prop_assert!(manifold.is_empty() || (manifold.normal.length() - 1.0).abs() < 1e-15 * 10.0);
        prop_assert!(manifold.points().iter().all(|point| point.separation <= margin && point.point.is_finite()));
        prop_assert!(manifold.points().is_sorted_by_key(|point| point.feature));
    }
}

#[test]
fn a_contact_point_lies_midway_between_the_surfaces() {
    let cases = [
        // Floor at y = 0 and a disc 0.1 above it.
        (HalfPlane::try_new(DVec2::Y, 0.0).unwrap().into(), disc(0.5), at(2.0, 0.6, 0.3), DVec2::new(2.0, 0.05), 0.1),
        (boxed(1.0, 1.0), disc(0.5), at(0.25, 1.4, 0.3), DVec2::new(0.25, 0.95), -0.1),
        (disc(1.0), disc(0.5), at(0.0, 2.0, 0.3), DVec2::new(0.0, 1.25), 0.5),
        (thin(2.0), thin(1.0), at(0.5, 0.7, std::f64::consts::FRAC_PI_2), DVec2::new(0.5, 0.1), 0.2),
        (rod(2.0, 0.1), rod(1.0, 0.2), at(1.5, 0.0, 0.0), DVec2::new(1.05, 0.0), -0.3),
    ];
    for (a, b, pose_b, point, separation) in cases {
        let manifold = collide(&a, &at(0.0, 0.0, 0.0), &b, &pose_b, &query(1.0, 0.0));
        let found = *manifold.points().iter().min_by(|p, q| p.separation.total_cmp(&q.separation)).unwrap();
        // A dozen roundings of numbers near 1.
        assert!((found.separation - separation).abs() < 1e-14, "{found:?}");
        assert!(separation < -0.2 || found.point.distance(point) < 1e-14, "{found:?}");
    }
}

#[test]
fn boxes_lying_flush_touch_at_two_points_that_keep_their_ids_while_sliding() {
    let (floor, slider) = (boxed(2.0, 0.5), boxed(0.5, 0.5));
    let mut ids = None;
    for i in 0..100 {
        // Rounding noise of both signs in height and angle, as in a stack at rest.
        let noise = 1e-13 * f64::from(i % 7 - 3);
        let pose = at(-1.0 + 0.02 * f64::from(i), 1.0 + noise, noise);
        let manifold = collide(&floor, &at(0.0, 0.0, 0.0), &slider, &pose, &query(0.1, 1e-9));
        let [left, right] = manifold.points() else { panic!("{manifold:?}") };
        assert!(left.separation.abs() < 1e-12 && right.separation.abs() < 1e-12);
        assert!((left.point.x - right.point.x).abs() > 0.999);
        let found = [left.feature, right.feature];
        assert_eq!(*ids.get_or_insert(found), found);
        assert_eq!(left.kind, ContactKind::VertexFace);
    }
    assert_eq!(ids, Some([FeatureId::vertex_of_b(0), FeatureId::vertex_of_b(1)]));
}

#[test]
fn boxes_of_one_width_stacked_exactly_keep_their_ids_under_rounding_noise() {
    let one = boxed(0.5, 0.5);
    for i in 0..100 {
        let noise = |k: i32| 1e-13 * f64::from((i * k) % 7 - 3);
        let manifold =
            collide(&one, &at(0.0, 0.0, noise(1)), &one, &at(noise(3), 1.0 + noise(2), noise(5)), &query(0.1, 1e-9));
        let ids: Vec<FeatureId> = manifold.points().iter().map(|point| point.feature).collect();
        assert_eq!(ids, [FeatureId::vertex_of_b(0), FeatureId::vertex_of_b(1)], "{i}");
    }
}

#[test]
fn a_half_plane_carries_a_many_sided_polygon_at_its_outermost_low_corners() {
    // A flat bottom with a corner in its middle that sticks out by less than the tolerance.
    let points = [DVec2::new(-1.0, 0.0), DVec2::new(0.0, -1e-7), DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0)];
    let shape = tumble_shape::ConvexPolygon::try_new(points).unwrap().into();
    let floor = HalfPlane::try_new(DVec2::Y, 0.0).unwrap().into();
    let manifold = collide(&floor, &at(0.0, 0.0, 0.0), &shape, &at(0.0, 0.0, 0.0), &query(0.1, 1e-6));
    let along: Vec<f64> = manifold.points().iter().map(|point| point.point.x).collect();
    assert_eq!(along, [-1.0, 1.0]);
}

#[test]
fn coincident_shapes_have_a_finite_normal() {
    for shape in [disc(0.5), thin(1.0), rod(1.0, 0.1), boxed(0.5, 0.5)] {
        let manifold = collide(&shape, &at(1.0, 2.0, 0.3), &shape, &at(1.0, 2.0, 0.3), &query(0.1, 0.0));
        // A turned unit vector, three roundings.
        assert!((manifold.normal.length() - 1.0).abs() < 1e-15, "{manifold:?}");
        assert!(!manifold.is_empty());
    }
    let mut before = collide(&disc(0.5), &at(0.0, 0.0, 0.0), &disc(0.5), &at(0.1, 0.0, 0.0), &query(0.1, 0.0));
    assert_eq!(before.normal, DVec2::X);
    before = {
        let mut query = query(0.1, 0.0);
        query.previous = Some(&before);
        collide(&disc(0.5), &at(0.0, 0.0, 0.0), &disc(0.5), &at(0.0, 0.0, 0.0), &query)
    };
    assert_eq!(before.normal, DVec2::X);
}

#[test]
fn a_pose_that_is_not_finite_makes_no_contact() {
    for a in [disc(0.5), thin(1.0), boxed(0.5, 0.5), HalfPlane::try_new(DVec2::Y, 0.0).unwrap().into()] {
        for b in [disc(0.5), thin(1.0), boxed(0.5, 0.5)] {
            let manifold = collide(&a, &at(0.0, 0.0, 0.0), &b, &at(f64::NAN, 0.0, 0.0), &query(0.1, 1e-3));
            assert!(manifold.is_empty(), "{a:?} {b:?} {manifold:?}");
        }
    }
}

#[test]
fn the_normal_turns_steadily_while_a_disc_or_rod_goes_round_a_shape() {
    for a in [boxed(0.5, 0.5), thin(1.0), rod(1.0, 0.1), disc(0.7)] {
        for b in [disc(0.5), rod(0.4, 0.1), bar(0.2)] {
            let steps = 20_000;
            let mut previous = PlanarManifold::EMPTY;
            for i in 0..=steps {
                let angle = std::f64::consts::TAU * f64::from(i) / f64::from(steps);
                let turned = PlanarRotation::from_angle(angle).to_matrix();
                // b keeps its broad side turned inwards.
                let position = turned * DVec2::new(0.0, 1.5);
                let mut query = query(10.0, 0.0);
                query.previous = Some(&previous);
                let manifold = collide(&a, &at(0.0, 0.0, 0.0), &b, &at(position.x, position.y, angle), &query);
                let turn = manifold.normal.distance(previous.normal);
                // A flat side that comes to lie along another one turns the contact to it at once: only for b a disc is it smooth.
                if i > 0 && matches!(b, PlanarShape::Disc(_)) {
                    // At 0.8 m from a corner, 1.5 m × 3.1e-4 rad per step turns the normal by less than 1e-3.
                    assert!(turn < 2e-3, "{a:?} {b:?} step {i}: {turn}");
                }
                assert!(manifold.normal.dot(position) > 0.0);
                previous = manifold;
            }
        }
    }
}
