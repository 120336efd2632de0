//! Solids and clouds of points in few words.

use glam::{DQuat, DVec3};
use proptest::collection;
use proptest::prelude::{ProptestConfig, Strategy, prop_oneof};
use proptest::test_runner::RngSeed;
use tumble_math::{Pose, Spatial, SpatialRotation};
use tumble_shape::{Capsule, Cone, ConvexHull, Cuboid, Cylinder, SpatialRod, SpatialShape, Sphere};

/// Same cases every time.
pub fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

pub fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(DVec3::from)
}

pub fn rotation() -> impl Strategy<Value = SpatialRotation> {
    (vector(1.0), -1.0..1.0_f64).prop_filter_map("no direction", |(v, w)| {
        SpatialRotation::try_from_quaternion(DQuat::from_xyzw(v.x, v.y, v.z, w))
    })
}

pub fn pose(size: f64) -> impl Strategy<Value = Pose<Spatial>> {
    (vector(size), rotation()).prop_map(|(position, rotation)| Pose { position, rotation })
}

pub fn cloud() -> impl Strategy<Value = Vec<DVec3>> {
    collection::vec(vector(1.0), 4..40)
}

pub fn solid() -> impl Strategy<Value = SpatialShape> {
    let size = || 0.1..2.0_f64;
    prop_oneof![
        (vector(1.0), size()).prop_map(|(centre, r)| Sphere::try_new(centre, r).unwrap().into()),
        (vector(1.0), vector(1.0)).prop_map(|(p, q)| SpatialRod::try_new(p, q, 0.0).unwrap().into()),
        (vector(1.0), vector(1.0), size()).prop_map(|(p, q, r)| Capsule::try_new(p, q, r).unwrap().into()),
        (vector(1.0), vector(1.0), size()).prop_map(|(p, q, r)| Cylinder::try_new(p, q, r).unwrap().into()),
        (vector(1.0), vector(1.0), size()).prop_map(|(p, q, r)| Cone::try_new(p, q, r).unwrap().into()),
        (vector(1.0), size(), size(), size(), rotation()).prop_map(|(at, x, y, z, turn)| Cuboid::try_new(
            at,
            DVec3::new(x, y, z),
            turn
        )
        .unwrap()
        .into()),
        cloud().prop_map(|points| ConvexHull::try_new(&points).unwrap().into()),
    ]
}
