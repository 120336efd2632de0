//! The judge against overlaps made by hand.

use glam::{DQuat, DVec2, DVec3, dvec2, dvec3};
use tumble_bench::judge::judge;
use tumble_bench::{Body, Kind, Plan, PlanDim, PlanarShape, SpatialShape};
use tumble_math::{Planar, PlanarRotation, Spatial, SpatialRotation};

/// Overlaps are sums and products of a few numbers of size 1: rounding is below 1e-15 times some dozens.
const ROUNDING: f64 = 1e-14;

const TURN: f64 = std::f64::consts::PI;

/// Touching pairs and overlap of two bodies; the overlap is 0 where they do not touch.
fn pair<D: PlanDim>(one: Body<D>, other: Body<D>) -> (usize, f64) {
    let plan = Plan::new("by hand", 1, vec![one, other]);
    let poses: Vec<_> = plan.bodies.iter().map(|body| body.pose).collect();
    let verdict = judge(&plan, &poses);
    assert_eq!(verdict.max_overlap, verdict.mean_overlap, "one pair has one overlap");
    (verdict.touching, verdict.max_overlap)
}

fn flat(shape: PlanarShape, position: DVec2, angle: f64) -> Body<Planar> {
    Body::simple(Kind::Dynamic, position, shape).turned(PlanarRotation::from_angle(angle))
}

fn solid(shape: SpatialShape, position: DVec3, angle: DVec3) -> Body<Spatial> {
    Body::simple(Kind::Dynamic, position, shape).turned(SpatialRotation::from_rotation_vector(angle))
}

fn overlaps(found: (usize, f64), overlap: f64) {
    assert_eq!(found.0, 1, "they touch");
    assert!((found.1 - overlap).abs() < ROUNDING, "{} instead of {overlap}", found.1);
}

const UNIT: PlanarShape = PlanarShape::Box { half_extents: DVec2::new(0.5, 0.5) };
const CUBE: SpatialShape = SpatialShape::Box { half_extents: DVec3::splat(0.5) };

#[test]
fn boxes_overlap_by_their_smaller_shadow() {
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(UNIT, dvec2(0.9, 0.3), 0.0)), 0.1);
    // On a corner: half a diagonal reaches 0.7071 down.
    let half_diagonal = 0.5_f64.sqrt();
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(UNIT, dvec2(0.0, 1.2), TURN / 4.0)), half_diagonal + 0.5 - 1.2);
}

#[test]
fn a_gap_below_a_hundredth_touches_and_one_above_does_not() {
    assert_eq!(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(UNIT, dvec2(1.009, 0.3), 0.0)), (1, 0.0));
    assert_eq!(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(UNIT, dvec2(1.011, 0.3), 0.0)), (0, 0.0));
    // Corner to corner: each coordinate is near enough, their distance is not.
    assert_eq!(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(UNIT, dvec2(1.008, 1.008), 0.0)), (0, 0.0));
    let above = |gap| solid(CUBE, dvec3(0.1, 1.0 + gap, 0.2), DVec3::ZERO);
    assert_eq!(pair(solid(CUBE, DVec3::ZERO, DVec3::ZERO), above(0.009)), (1, 0.0));
    assert_eq!(pair(solid(CUBE, DVec3::ZERO, DVec3::ZERO), above(0.011)), (0, 0.0));
}

#[test]
fn discs_overlap_by_radii_less_distance() {
    let disc = |radius| PlanarShape::Disc { radius };
    overlaps(pair(flat(disc(0.5), DVec2::ZERO, 0.0), flat(disc(0.3), dvec2(0.42, 0.56), 1.0)), 0.1);
    // In a box, the centre is inside and 0.2 from the nearest side.
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(disc(0.1), dvec2(0.3, 0.1), 0.0)), 0.3);
    // Beside a corner, at a distance of 0.5.
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(disc(0.6), dvec2(0.8, 0.9), 0.0)), 0.1);
    assert_eq!(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(disc(0.48), dvec2(0.8, 0.9), 0.0)).0, 0);
}

#[test]
fn crossed_rods_overlap_up_to_the_nearer_end() {
    let rod = PlanarShape::Capsule { half_length: 0.5, radius: 0.02 };
    overlaps(pair(flat(rod, DVec2::ZERO, 0.0), flat(rod, dvec2(0.1, 0.4), TURN / 2.0)), 0.1 + 0.04);
    // In line, end to end: 0.01 deep; and apart.
    overlaps(
        pair(flat(rod, DVec2::ZERO, 0.3), flat(rod, PlanarRotation::from_angle(0.3).to_matrix().x_axis * 1.03, 0.3)),
        0.01,
    );
    assert_eq!(pair(flat(rod, DVec2::ZERO, 0.0), flat(rod, dvec2(1.06, 0.0), 0.0)).0, 0);
    // The middle of one on the end of the other, as a T.
    overlaps(pair(flat(rod, DVec2::ZERO, 0.0), flat(rod, dvec2(0.2, 0.53), TURN / 2.0)), 0.01);
}

#[test]
fn a_rod_in_a_box_overlaps_by_its_depth() {
    let rod = PlanarShape::Capsule { half_length: 0.5, radius: 0.05 };
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(rod, dvec2(0.1, 0.52), 0.0)), 0.03);
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(rod, dvec2(0.1, 0.45), 0.0)), 0.1);
    // Through a side: it has to leave upwards, by 0.2 and its radius.
    overlaps(pair(flat(UNIT, DVec2::ZERO, 0.0), flat(rod, dvec2(0.6, 0.3), 0.0)), 0.25);
}

#[test]
fn boxes_of_space_overlap_by_face_corner_and_edge() {
    let floor = || solid(SpatialShape::block(5.0, 0.5, 5.0), dvec3(0.0, -0.5, 0.0), DVec3::ZERO);
    overlaps(pair(floor(), solid(CUBE, dvec3(1.0, 0.45, 0.3), DVec3::Y * 0.7)), 0.05);
    // On an edge, then on a corner: half of the diagonals of a face and of the cube.
    overlaps(pair(floor(), solid(CUBE, dvec3(0.0, 0.7, 0.0), DVec3::X * (TURN / 4.0))), 0.5_f64.sqrt() - 0.7);
    let on_corner = SpatialRotation::try_from_quaternion(DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::Y));
    let corner = Body::simple(Kind::Dynamic, dvec3(0.0, 0.8, 0.0), CUBE).turned(on_corner.expect("it is unit"));
    overlaps(pair(floor(), corner), 0.75_f64.sqrt() - 0.8);
    // Edge across edge: 0.7071 each, 1.4 apart.
    let low = solid(CUBE, DVec3::ZERO, DVec3::X * (TURN / 4.0));
    let high = solid(CUBE, dvec3(0.1, 1.4, 0.1), DVec3::Z * (TURN / 4.0));
    overlaps(pair(low, high), 2.0_f64.sqrt() - 1.4);
}

#[test]
fn round_shapes_of_space_overlap_by_radius_less_distance() {
    let ball = |radius| SpatialShape::Sphere { radius };
    let capsule = SpatialShape::Capsule { half_length: 0.3, radius: 0.25 };
    overlaps(pair(solid(ball(0.5), DVec3::ZERO, DVec3::ZERO), solid(ball(0.5), dvec3(0.0, 0.54, 0.72), DVec3::Z)), 0.1);
    // A ball off a corner by (0.2, 0.3, 0.6), whose length is 0.7; over an edge; over a face.
    let cube = || solid(CUBE, DVec3::ZERO, DVec3::ZERO);
    overlaps(pair(cube(), solid(ball(0.8), dvec3(0.7, 0.8, 1.1), DVec3::ZERO)), 0.1);
    overlaps(pair(cube(), solid(ball(0.6), dvec3(0.8, 0.9, 0.1), DVec3::ZERO)), 0.1);
    overlaps(pair(cube(), solid(ball(0.5), dvec3(0.1, 0.9, 0.1), DVec3::ZERO)), 0.1);
    assert_eq!(pair(cube(), solid(ball(0.68), dvec3(0.7, 0.8, 1.1), DVec3::ZERO)).0, 0);
    // Capsules crosswise, and one that stands on the cube.
    let lying = solid(capsule, dvec3(0.1, 0.45, 0.1), DVec3::X * (TURN / 2.0));
    overlaps(pair(solid(capsule, DVec3::ZERO, DVec3::Z * (TURN / 2.0)), lying), 0.05);
    overlaps(pair(cube(), solid(capsule, dvec3(0.2, 1.0, 0.1), DVec3::ZERO)), 0.05);
    // Lying over an edge of the cube, with both ends in the air: two lines are nearest.
    let tilted = solid(capsule, dvec3(0.65, 0.65, 0.0), DVec3::Z * (TURN / 4.0));
    overlaps(pair(cube(), tilted), 0.25 - 0.045_f64.sqrt());
}

#[test]
fn icosahedra_overlap_between_opposite_faces() {
    // Opposite faces are φ²/√3 edges apart, and the radius is √(φ² + 1)/2 edges.
    let square = (3.0 + 5.0_f64.sqrt()) / 2.0;
    let shape = SpatialShape::Icosahedron { radius: 0.5 };
    // (1, 1, 1) is the middle of a face; the corners are symmetric about the origin, so the opposite face is parallel to it.
    let apart = square / (3.0 * (square + 1.0)).sqrt() - 0.04;
    let other = solid(shape, DVec3::ONE.normalize() * apart, DVec3::ZERO);
    overlaps(pair(solid(shape, DVec3::ZERO, DVec3::ZERO), other), 0.04);
}

#[test]
fn parts_of_one_body_and_bodies_that_nothing_moves_are_not_judged() {
    let still = |x| Body::<Planar>::simple(Kind::Static, dvec2(x, 0.0), UNIT);
    assert_eq!(pair(still(0.0), still(0.3)), (0, 0.0));
    let part = |x| tumble_bench::Part {
        shape: UNIT,
        pose: tumble_math::Pose { position: dvec2(x, 0.0), ..Default::default() },
    };
    let compound = Body::<Planar>::compound(Kind::Dynamic, DVec2::ZERO, vec![part(0.0), part(0.2)]);
    assert_eq!(pair(compound, still(9.0)), (0, 0.0));
}

#[test]
fn a_pose_that_is_not_finite_is_no_verdict() {
    let plan = Plan::new("lost", 1, vec![flat(UNIT, DVec2::ZERO, 0.0)]);
    let mut poses = vec![plan.bodies[0].pose];
    poses[0].position.y = f64::NAN;
    assert!(judge(&plan, &poses).max_overlap.is_nan());
}
