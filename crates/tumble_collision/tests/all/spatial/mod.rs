//! Shapes of space, poses and queries in few words.

use glam::{DQuat, DVec3, dvec3};
use proptest::prelude::{ProptestConfig, Strategy, prop_oneof};
use proptest::{collection, test_runner::RngSeed};
use tumble_collision::{SpatialManifold, SpatialQuery};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation};
use tumble_shape::{Capsule, ConvexHull, Cuboid, HalfSpace, SpatialRod, SpatialShape, Sphere};

/// Same cases every time.
pub fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

pub fn query(margin: f64, flush_tolerance: f64) -> SpatialQuery<'static> {
    SpatialQuery { margin, flush_tolerance, previous: None }
}

pub fn at(x: f64, y: f64, z: f64) -> Pose<Spatial> {
    Pose { position: dvec3(x, y, z), rotation: SpatialRotation::IDENTITY }
}

pub fn turned(position: DVec3, turn: DVec3) -> Pose<Spatial> {
    Pose { position, rotation: SpatialRotation::from_rotation_vector(turn) }
}

pub fn boxed(x: f64, y: f64, z: f64) -> SpatialShape {
    Cuboid::with_half_extents(dvec3(x, y, z)).unwrap().into()
}

pub fn sphere(radius: f64) -> SpatialShape {
    Sphere::try_new(DVec3::ZERO, radius).unwrap().into()
}

/// A rod along x around the origin.
pub fn rod(length: f64, radius: f64) -> SpatialShape {
    let end = dvec3(0.5 * length, 0.0, 0.0);
    SpatialRod::try_new(-end, end, radius).unwrap().into()
}

/// Solid below z = 0.
pub fn floor() -> SpatialShape {
    HalfSpace::try_new(DVec3::Z, 0.0).unwrap().into()
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

pub fn cuboid() -> impl Strategy<Value = SpatialShape> {
    let half = || 0.2..1.0_f64;
    (vector(0.3), half(), half(), half(), rotation())
        .prop_map(|(at, x, y, z, turn)| Cuboid::try_new(at, dvec3(x, y, z), turn).unwrap().into())
}

pub fn hull() -> impl Strategy<Value = SpatialShape> {
    collection::vec(vector(1.0), 4..24).prop_map(|points| ConvexHull::try_new(&points).unwrap().into())
}

/// Shapes with sharp corners and an inside.
pub fn polyhedron() -> impl Strategy<Value = SpatialShape> {
    prop_oneof![cuboid(), hull()]
}

pub fn shape() -> impl Strategy<Value = SpatialShape> {
    let radius = || 0.05..0.5_f64;
    prop_oneof![
        polyhedron(),
        (vector(0.5), radius()).prop_map(|(centre, r)| Sphere::try_new(centre, r).unwrap().into()),
        (vector(1.0), vector(1.0), radius()).prop_map(|(p, q, r)| Capsule::try_new(p, q, r).unwrap().into()),
        (vector(1.0), vector(1.0)).prop_map(|(p, q)| SpatialRod::try_new(p, q, 0.0).unwrap().into()),
    ]
}

/// Normal, place and separation of every point.
pub type Listed = Vec<(DVec3, DVec3, f64)>;

pub fn listed(manifold: &SpatialManifold) -> Listed {
    manifold.points().iter().map(|point| (manifold.normal, point.point, point.separation)).collect()
}

/// The contact seen after all was moved by a pose.
pub fn moved(manifold: &SpatialManifold, by: &Pose<Spatial>) -> Listed {
    let list = listed(manifold).into_iter();
    list.map(|(normal, point, separation)| (by.transform_vector(normal), by.transform_point(point), separation))
        .collect()
}

/// The contact with a and b in each other's place.
pub fn swapped(manifold: &SpatialManifold) -> Listed {
    listed(manifold).into_iter().map(|(normal, point, separation)| (-normal, point, separation)).collect()
}

/// Asserts that two lists hold the same contact, in any order of points, to a tolerance [m].
pub fn assert_same(one: &Listed, other: &Listed, tolerance: f64) {
    assert_eq!(one.len(), other.len(), "{one:#?} {other:#?}");
    for (normal, point, separation) in one {
        let same = |(n, p, s): &(DVec3, DVec3, f64)| {
            n.distance(*normal) < tolerance && p.distance(*point) < tolerance && (s - separation).abs() < tolerance
        };
        assert!(other.iter().any(same), "{one:#?} {other:#?}");
    }
}

/// Oracle: the largest separation over all faces and all pairs of edges of two polyhedra, each measured over all vertices.
pub fn best_separation(a: &SpatialShape, pose_a: &Pose<Spatial>, b: &SpatialShape, pose_b: &Pose<Spatial>) -> f64 {
    let (hull_a, hull_b) = (a.hull().unwrap().posed(pose_a), b.hull().unwrap().posed(pose_b));
    let low = |hull: &ConvexHull, n: DVec3| hull.vertices().iter().map(|v| n.dot(*v)).fold(f64::INFINITY, f64::min);
    let along = |n: DVec3| low(&hull_b, n) + low(&hull_a, -n);
    let directions = |hull: &ConvexHull| -> Vec<DVec3> {
        hull.edges()
            .iter()
            .map(|edge| hull.vertices()[edge.vertices[1] as usize] - hull.vertices()[edge.vertices[0] as usize])
            .collect()
    };
    let mut best = f64::NEG_INFINITY;
    for face in hull_a.faces() {
        best = best.max(along(face.normal));
    }
    for face in hull_b.faces() {
        best = best.max(along(-face.normal));
    }
    for e in directions(&hull_a) {
        for f in directions(&hull_b) {
            let across = e.cross(f);
            if across.length_squared() > 1e-14 * e.length_squared() * f.length_squared() {
                best = best.max(along(across.normalize())).max(along(-across.normalize()));
            }
        }
    }
    best
}

/// Pseudo-random numbers in 0..1, the same every time.
pub struct Noise(pub u64);

impl Noise {
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Each coordinate from −size to size.
    pub fn vector(&mut self, size: f64) -> DVec3 {
        dvec3(self.number() - 0.5, self.number() - 0.5, self.number() - 0.5) * (2.0 * size)
    }

    pub fn pose(&mut self, size: f64) -> Pose<Spatial> {
        let quaternion = DQuat::from_vec4(self.vector(1.0).extend(self.number() - 0.5));
        Pose { position: self.vector(size), rotation: SpatialRotation::try_from_quaternion(quaternion).unwrap() }
    }
}

/// One pose after another: first `inner`, then `outer`.
pub fn after(outer: &Pose<Spatial>, inner: &Pose<Spatial>) -> Pose<Spatial> {
    let quaternion = outer.rotation.quaternion() * inner.rotation.quaternion();
    Pose {
        position: outer.position + outer.rotation.rotate(inner.position),
        rotation: SpatialRotation::try_from_quaternion(quaternion).unwrap(),
    }
}
