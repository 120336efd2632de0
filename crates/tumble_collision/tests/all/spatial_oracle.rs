//! Distances, depths and normals in space against `parry3d-f64`, and against looking at every axis.

use crate::spatial::{Noise, best_separation, config, polyhedron, pose, query, shape};
use glam::DVec3;
use parry3d_f64::math::{Pose3, Vec3};
use parry3d_f64::query as parry;
use parry3d_f64::shape::{Ball, ConvexPolyhedron, Segment, Shape};
use proptest::prelude::{prop_assert, prop_assume, proptest};
use tumble_collision::{SpatialManifold, collide_spatial};
use tumble_math::{Pose, Spatial};
use tumble_shape::{Capsule, ConvexHull, Cuboid, SpatialShape, Sphere};

fn to_parry(v: DVec3) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

/// A shape for parry, in world axes: the core, and the radius that is to be taken off; of spheres half of it.
struct Peer {
    shape: Box<dyn Shape>,
    pose: Pose3,
    radius: f64,
}

impl Peer {
    fn new(shape: &SpatialShape, pose: &Pose<Spatial>) -> Self {
        let place = |v: &DVec3| to_parry(pose.transform_point(*v));
        let identity = Pose3::IDENTITY;
        match shape {
            SpatialShape::Sphere(sphere) => {
                let centre = Pose3::from_translation(place(&sphere.centre()));
                let half = 0.5 * sphere.radius();
                Self { shape: Box::new(Ball::new(half)), pose: centre, radius: half }
            }
            SpatialShape::SpatialRod(_) | SpatialShape::Capsule(_) => {
                let [from, to] = shape.vertices() else { unreachable!("a segment has two ends") };
                let segment = Segment::new(place(from), place(to));
                Self { shape: Box::new(segment), pose: identity, radius: shape.radius() }
            }
            _ => {
                let points: Vec<Vec3> = shape.vertices().iter().map(place).collect();
                let polyhedron = ConvexPolyhedron::from_convex_hull(&points).unwrap();
                Self { shape: Box::new(polyhedron), pose: identity, radius: 0.0 }
            }
        }
    }

    /// Distance of the two shapes; below zero only by the radii.
    fn distance(&self, other: &Self) -> f64 {
        let cores = parry::distance(&self.pose, &*self.shape, &other.pose, &*other.shape).unwrap();
        cores.distance - self.radius - other.radius
    }
}

/// By how much b would have to move along the normal to be free of a, made negative [m].
fn separation_along(
    normal: DVec3,
    a: &SpatialShape,
    pose_a: &Pose<Spatial>,
    b: &SpatialShape,
    pose_b: &Pose<Spatial>,
) -> f64 {
    let heights = |shape: &SpatialShape, pose: &Pose<Spatial>| -> Vec<f64> {
        shape.vertices().iter().map(|&vertex| normal.dot(pose.transform_point(vertex))).collect()
    };
    let top_of_a = heights(a, pose_a).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let bottom_of_b = heights(b, pose_b).into_iter().fold(f64::INFINITY, f64::min);
    bottom_of_b - top_of_a - a.radius() - b.radius()
}

/// What is wrong with a manifold of two shapes, compared with the oracle, if anything is.
fn complaint(
    a: &SpatialShape,
    pose_a: &Pose<Spatial>,
    b: &SpatialShape,
    pose_b: &Pose<Spatial>,
    manifold: &SpatialManifold,
) -> Option<String> {
    let (peer_a, peer_b) = (Peer::new(a, pose_a), Peer::new(b, pose_b));
    let distance = peer_a.distance(&peer_b);
    let deepest = manifold.deepest_separation()?;
    let along = separation_along(manifold.normal, a, pose_a, b, pose_b);
    // Cores apart: the distance, which parry finds to about 1e-10 or, with its own tolerance, 1e-8.
    if distance > 1e-6 - peer_a.radius - peer_b.radius {
        if (deepest - distance).abs() > 1e-8 {
            return Some(format!("distance {distance}, found {deepest}"));
        }
        if (along - distance).abs() > 1e-8 {
            return Some(format!("distance {distance}, but {along} along the normal"));
        }
        return None;
    }
    // Overlapping polyhedra: the least depth over all directions.
    if a.hull().is_some() && b.hull().is_some() {
        let exact = best_separation(a, pose_a, b, pose_b);
        // A dozen roundings of numbers below 10, amplified by nearly parallel edges.
        if (along - exact).abs() > 1e-11 || (deepest - exact).abs() > 1e-11 {
            return Some(format!("depth {exact}, found {deepest}, {along} along the normal"));
        }
        let contact = parry::contact(&peer_a.pose, &*peer_a.shape, &peer_b.pose, &*peer_b.shape, 0.0).unwrap();
        // EPA stops at about 1e-10. In some 3 of 100 000 pairs it gives up early and claims less depth than its own normal has.
        if let Some(contact) = contact {
            let normal = DVec3::new(contact.normal1.x, contact.normal1.y, contact.normal1.z);
            let claimed = contact.dist.min(separation_along(normal, a, pose_a, b, pose_b));
            if claimed > along + 1e-8 {
                return Some(format!("depth of parry {claimed}, found {along}"));
            }
        }
    }
    None
}

proptest! {
    #![proptest_config(config(3000))]

    #[test]
    fn smallest_separation_of_separated_shapes_is_their_distance(a in shape(), b in shape(), pose_a in pose(1.0), pose_b in pose(2.5)) {
        let manifold = collide_spatial(&a, &pose_a, &b, &pose_b, &query(100.0, 0.0));
        prop_assert!(!manifold.is_empty());
        let complaint = complaint(&a, &pose_a, &b, &pose_b, &manifold);
        prop_assert!(complaint.is_none(), "{complaint:?} {manifold:#?}");
    }

    #[test]
    fn depth_of_overlapping_polyhedra_is_the_least(a in polyhedron(), b in polyhedron(), pose_a in pose(0.3), pose_b in pose(0.7)) {
        let manifold = collide_spatial(&a, &pose_a, &b, &pose_b, &query(0.0, 0.0));
        prop_assume!(!manifold.is_empty());
        let complaint = complaint(&a, &pose_a, &b, &pose_b, &manifold);
        prop_assert!(complaint.is_none(), "{complaint:?} {manifold:#?}");
    }
}

/// Two million pairs take minutes, most of them the oracles'. `PAIRS` sets another number:
/// `PAIRS=100000 cargo test --release -p tumble_collision --test all millions -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes; the same comparison runs with fewer pairs above"]
fn millions_of_random_pairs_agree_with_the_oracle() {
    let count: u32 = std::env::var("PAIRS").ok().and_then(|text| text.parse().ok()).unwrap_or(2_000_000);
    let mut noise = Noise(11);
    let mut shapes: Vec<SpatialShape> = Vec::new();
    for i in 0..400 {
        let shape = match i % 8 {
            0 => Sphere::try_new(noise.vector(0.5), 0.05 + noise.number()).unwrap().into(),
            1 => Capsule::try_new(noise.vector(1.0), noise.vector(1.0), 0.05 + 0.5 * noise.number()).unwrap().into(),
            2..5 => {
                let half = DVec3::splat(0.1) + noise.vector(0.9).abs();
                Cuboid::try_new(noise.vector(0.3), half, noise.pose(1.0).rotation).unwrap().into()
            }
            _ => {
                let points: Vec<DVec3> = (0..4 + i % 40).map(|_| noise.vector(1.0)).collect();
                ConvexHull::try_new(&points).unwrap().into()
            }
        };
        shapes.push(shape);
    }
    let (mut apart, mut overlapping) = (0_u32, 0_u32);
    let mut complaints = Vec::new();
    for i in 0..count {
        let mut pick = || &shapes[(noise.number() * shapes.len() as f64) as usize];
        let (a, b) = (pick(), pick());
        let (pose_a, pose_b) = (noise.pose(0.5), noise.pose(if i % 2 == 0 { 2.5 } else { 0.8 }));
        let manifold = collide_spatial(a, &pose_a, b, &pose_b, &query(100.0, 0.0));
        if manifold.deepest_separation().is_some_and(|separation| separation > 0.0) {
            apart += 1;
        } else {
            overlapping += 1;
        }
        if let Some(complaint) = complaint(a, &pose_a, b, &pose_b, &manifold) {
            complaints.push((i, complaint, a.clone(), b.clone()));
        }
    }
    println!("{apart} pairs apart, {overlapping} overlapping, {} complaints", complaints.len());
    for (i, complaint, a, b) in complaints.iter().take(20) {
        println!("{i}: {complaint} {} {}", a.vertices().len(), b.vertices().len());
    }
    assert!(complaints.is_empty());
}
