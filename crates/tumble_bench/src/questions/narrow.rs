//! What a pair of shapes costs in space, beside `parry3d-f64` on the same pairs.
//!
//! Nanoseconds a pair, the best of several rounds that take turns, because everything else on the machine only adds. `fresh` looks at every pair without memory; `again` hands both sides the manifold of a
//! step before, with poses that moved by some 0.05 mm and 0.1 mrad. The other side then moves its old points along and finds no new ones;
//! `carried` does the same, as soft steps do, where `again` finds exactly the points that a fresh look would.

use std::hint::black_box;
use std::time::Instant;

use glam::{DQuat, DVec3, dvec3};
use parry3d_f64::math::{Pose3, Vec3};
use parry3d_f64::query::{ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};
use parry3d_f64::shape::{ConvexPolyhedron, Cuboid as ParryCuboid, Cylinder as ParryCylinder, Shape};
use tumble_collision::{SpatialManifold, SpatialQuery, collide_spatial};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation};
use tumble_shape::{ConvexHull, Cuboid, Cylinder, SpatialShape};
use tumble_sim::contact::{BodyMotion, CarriedParts, ContactReuse};

const MARGIN: f64 = 0.02;
const PAIRS: usize = 512;
const ROUNDS: usize = 15;

/// A row of pseudo-random numbers in 0..1, the same every time.
struct Noise(u64);

impl Noise {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn vector(&mut self, size: f64) -> DVec3 {
        dvec3(self.number() - 0.5, self.number() - 0.5, self.number() - 0.5) * (2.0 * size)
    }

    fn rotation(&mut self) -> SpatialRotation {
        SpatialRotation::try_from_quaternion(DQuat::from_vec4(self.vector(1.0).extend(self.number() - 0.5)))
            .expect("it is not zero")
    }
}

/// A shape for both sides.
struct Both {
    own: SpatialShape,
    peer: Box<dyn Shape>,
}

fn boxed(half: DVec3) -> Both {
    Both {
        own: Cuboid::with_half_extents(half).expect("it has an extent").into(),
        peer: Box::new(ParryCuboid::new(Vec3::new(half.x, half.y, half.z))),
    }
}

fn hull(noise: &mut Noise, corners: usize) -> Both {
    // About as large as the boxes: corners on a ball of radius 0.6.
    let points: Vec<DVec3> = (0..corners).map(|_| noise.vector(1.0).normalize() * 0.6).collect();
    let peer: Vec<Vec3> = points.iter().map(|p| Vec3::new(p.x, p.y, p.z)).collect();
    Both {
        own: ConvexHull::try_new(&points).expect("random points lie in no plane").into(),
        peer: Box::new(ConvexPolyhedron::from_convex_hull(&peer).expect("random points lie in no plane")),
    }
}

fn cylinder(half_length: f64, radius: f64) -> Both {
    let end = DVec3::Y * half_length;
    Both {
        own: Cylinder::try_new(-end, end, radius).expect("it has a length and a radius").into(),
        peer: Box::new(ParryCylinder::new(half_length, radius)),
    }
}

struct Case {
    poses: Vec<[Pose<Spatial>; 2]>,
    a: Both,
    b: Both,
}

fn peer_pose(pose: &Pose<Spatial>) -> Pose3 {
    let (t, q) = (pose.position, pose.rotation.quaternion());
    Pose3::from_parts(Vec3::new(t.x, t.y, t.z), parry3d_f64::math::Rot3::from_xyzw(q.x, q.y, q.z, q.w))
}

fn nudged(pose: &Pose<Spatial>, noise: &mut Noise) -> Pose<Spatial> {
    Pose { position: pose.position + noise.vector(5e-5), rotation: pose.rotation.turned(noise.vector(1e-4)) }
}

/// Nanoseconds a pair of a run over all pairs.
fn time(mut run: impl FnMut(usize)) -> f64 {
    let start = Instant::now();
    (0..PAIRS).for_each(&mut run);
    start.elapsed().as_secs_f64() * 1e9 / PAIRS as f64
}

fn measure(name: &str, case: &Case, noise: &mut Noise) {
    let later: Vec<[Pose<Spatial>; 2]> = case.poses.iter().map(|[a, b]| [nudged(a, noise), nudged(b, noise)]).collect();
    let own = |poses: &[Pose<Spatial>; 2], previous: Option<&SpatialManifold>| {
        let query = SpatialQuery { margin: MARGIN, flush_tolerance: 0.01, previous };
        collide_spatial(&case.a.own, &poses[0], &case.b.own, &poses[1], &query)
    };
    let before: Vec<SpatialManifold> = case.poses.iter().map(|poses| own(poses, None)).collect();
    let dispatcher = DefaultQueryDispatcher;
    let peer = |poses: &[Pose<Spatial>; 2], manifolds: &mut Vec<ContactManifold<(), ()>>| {
        // Both sides are given poses in the world.
        let between = peer_pose(&poses[0]).inv_mul(&peer_pose(&poses[1]));
        let mut workspace = None;
        let done =
            dispatcher.contact_manifolds(&between, &*case.a.peer, &*case.b.peer, MARGIN, manifolds, &mut workspace);
        black_box(done.is_ok());
    };
    let mut peer_before: Vec<Vec<ContactManifold<(), ()>>> = vec![Vec::new(); PAIRS];
    case.poses.iter().zip(&mut peer_before).for_each(|(poses, manifolds)| peer(poses, manifolds));

    let motions = |poses: &[Pose<Spatial>; 2]| poses.map(BodyMotion::<Spatial>::at_rest);
    let reach = |shape: &SpatialShape| shape.extent_about(DVec3::ZERO).unwrap_or(f64::INFINITY);
    let parts = CarriedParts {
        reaches: [reach(&case.a.own), reach(&case.b.own)],
        radii: [case.a.own.radius(), case.b.own.radius()],
        roll: matches!(case.a.own, SpatialShape::Cylinder(_)),
        length_scale: 1.0,
    };
    let carries: Vec<ContactReuse<Spatial>> = (case.poses.iter().zip(&before))
        .map(|(poses, manifold)| {
            let (mut carry, [a, b]) = (ContactReuse::default(), motions(poses));
            carry.remember(manifold, [&a, &b], &parts, MARGIN);
            carry
        })
        .collect();

    let mut best = [f64::INFINITY; 5];
    for _ in 0..ROUNDS {
        let mut empty: Vec<Vec<ContactManifold<(), ()>>> = (0..PAIRS).map(|_| Vec::with_capacity(1)).collect();
        let mut again = peer_before.clone();
        let mut carried = before.clone();
        let times = [
            time(|i| {
                black_box(own(black_box(&case.poses[i]), None));
            }),
            time(|i| peer(black_box(&case.poses[i]), &mut empty[i])),
            time(|i| {
                black_box(own(black_box(&later[i]), Some(&before[i])));
            }),
            time(|i| {
                let [a, b] = motions(black_box(&later[i]));
                if carries[i].holds([&a, &b], MARGIN) {
                    carries[i].carry(&mut carried[i], [&a, &b]);
                }
                black_box(&carried[i]);
            }),
            time(|i| peer(black_box(&later[i]), &mut again[i])),
        ];
        for (best, time) in best.iter_mut().zip(times) {
            *best = best.min(time);
        }
    }
    let touching = before.iter().filter(|manifold| !manifold.is_empty()).count();
    let points: usize = before.iter().map(|manifold| manifold.points().len()).sum();
    let peer_points: usize = peer_before.iter().flatten().map(|manifold| manifold.points.len()).sum();
    let [own_fresh, peer_fresh, own_again, own_carried, peer_again] = best;
    println!(
        "{name:<28}{own_fresh:>9.0}{peer_fresh:>9.0}{own_again:>9.0}{own_carried:>9.0}{peer_again:>9.0}   {touching} of {PAIRS} touch, {points} and {peer_points} points"
    );
}

/// Prints a line for each kind of pair.
pub fn narrow() {
    println!("{:<28}{:>9}{:>9}{:>9}{:>9}{:>9}", "ns a pair", "fresh", "parry", "again", "carried", "parry");
    let mut noise = Noise(5);
    let half = dvec3(0.5, 0.4, 0.3);
    let stacked = |noise: &mut Noise| {
        let position = dvec3(noise.number() - 0.5, noise.number() - 0.5, 0.598 - 1e-3 * noise.number());
        let turn = dvec3(1e-4 * noise.number(), 1e-4 * noise.number(), 6.0 * noise.number());
        [Pose::default(), Pose { position, rotation: SpatialRotation::from_rotation_vector(turn) }]
    };
    let random = |noise: &mut Noise, distance: f64| {
        let direction = noise.vector(1.0).normalize();
        [
            Pose { position: DVec3::ZERO, rotation: noise.rotation() },
            Pose { position: direction * distance, rotation: noise.rotation() },
        ]
    };
    let mut cases: Vec<(&str, Case)> = Vec::new();
    let poses: Vec<_> = (0..PAIRS).map(|_| stacked(&mut noise)).collect();
    cases.push(("box on box, lying", Case { poses, a: boxed(half), b: boxed(half) }));
    for (name, distance) in [("box, box: overlapping", 0.7), ("box, box: near", 0.9), ("box, box: apart", 1.4)] {
        let poses = (0..PAIRS).map(|_| random(&mut noise, distance)).collect();
        cases.push((name, Case { poses, a: boxed(half), b: boxed(half) }));
    }
    for (name, corners, distance) in [
        ("hull 8, hull 8: overlapping", 8, 0.85),
        ("hull 16, 16: overlapping", 16, 0.95),
        ("hull 16, 16: near", 16, 1.08),
        ("hull 16, 16: apart", 16, 1.4),
        ("hull 32, 32: overlapping", 32, 1.05),
        ("hull 64, 64: overlapping", 64, 1.1),
    ] {
        let poses = (0..PAIRS).map(|_| random(&mut noise, distance)).collect();
        let case = Case { poses, a: hull(&mut noise, corners), b: hull(&mut noise, corners) };
        cases.push((name, case));
    }
    for (name, distance) in [("cylinders: overlapping", 0.7), ("cylinders: near", 0.95), ("cylinders: apart", 1.4)] {
        let poses = (0..PAIRS).map(|_| random(&mut noise, distance)).collect();
        cases.push((name, Case { poses, a: cylinder(0.5, 0.35), b: cylinder(0.5, 0.35) }));
    }
    for (name, case) in &cases {
        measure(name, case, &mut noise);
    }
}
