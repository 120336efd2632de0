//! What collision detection costs: time per pair of the narrow phase, growth of the broad phase.
//!
//! `cargo bench -p tumble_collision` prints two tables. The best of several rounds is shown, because everything else on the
//! machine only adds.

use std::hint::black_box;
use std::time::Instant;

use glam::DVec2;
use tumble_collision::{BroadPhase, PairChanges, PlanarManifold, PlanarQuery, Volume, collide};
use tumble_math::{Bounds, Planar, PlanarRotation, Pose};
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, PlanarShape, Rod};

fn main() {
    narrow_phase();
    broad_phase();
}

/// Shortest time of one call over rounds of many calls [ns].
fn best_ns(calls: u32, mut call: impl FnMut(u32)) -> f64 {
    let rounds = (0..7).map(|_| {
        let start = Instant::now();
        (0..calls).for_each(&mut call);
        start.elapsed().as_secs_f64() * 1e9 / f64::from(calls)
    });
    rounds.fold(f64::INFINITY, f64::min)
}

fn narrow_phase() {
    let rod: PlanarShape = Rod::try_new(DVec2::new(-0.5, 0.0), DVec2::new(0.5, 0.0), 0.0).unwrap().into();
    let disc: PlanarShape = Disc::try_new(DVec2::ZERO, 0.5).unwrap().into();
    let boxed: PlanarShape = ConvexPolygon::rectangle(DVec2::ZERO, DVec2::splat(0.5), 0.0).unwrap().into();
    let floor: PlanarShape = HalfPlane::try_new(DVec2::Y, 0.0).unwrap().into();
    let cases = [
        ("half-plane, rod", &floor, &rod, 0.0, 0.0),
        ("half-plane, box", &floor, &boxed, 0.5, 0.0),
        ("disc, disc", &disc, &disc, 1.0, 0.0),
        ("disc on box", &boxed, &disc, 1.0, 0.0),
        ("rod end on rod", &rod, &rod, 0.5, 1.57),
        ("rod flush on rod", &rod, &rod, 0.0, 0.0),
        ("rod end on box", &boxed, &rod, 1.0, 1.57),
        ("box flush on box", &boxed, &boxed, 1.0, 0.0),
        ("box apart from box, corners", &boxed, &boxed, 1.8, 0.785),
        ("box out of reach", &boxed, &boxed, 3.0, 0.0),
    ];
    println!("{:<30}{:>12}{:>16}", "pair", "ns", "with memory ns");
    for (name, a, b, height, angle) in cases {
        let pose_a = Pose::<Planar> { position: DVec2::ZERO, rotation: PlanarRotation::from_angle(0.0) };
        let poses: Vec<Pose<Planar>> = (0..64)
            .map(|i| {
                let position = DVec2::new(0.1 * f64::from(i % 5), height + 1e-4 * f64::from(i % 7));
                Pose { position, rotation: PlanarRotation::from_angle(angle + 1e-4 * f64::from(i % 3)) }
            })
            .collect();
        let run = |previous: Option<&PlanarManifold>| {
            let query = PlanarQuery { margin: 1.0, flush_tolerance: 0.005, previous };
            best_ns(100_000, |i| {
                let pose_b = &poses[i as usize % poses.len()];
                black_box(collide(black_box(a), &pose_a, black_box(b), pose_b, &query));
            })
        };
        let before =
            collide(a, &pose_a, b, &poses[0], &PlanarQuery { margin: 1.0, flush_tolerance: 0.005, previous: None });
        println!("{name:<30}{:>12.0}{:>16.0}", run(None), run(Some(&before)));
    }
}

/// A row of pseudo-random numbers in 0..1, the same every time.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn broad_phase() {
    println!(
        "\n{:<10}{:>10}{:>14}{:>14}{:>14}{:>16}",
        "boxes", "pairs", "build µs", "step µs", "ns per box", "rebuilt/step"
    );
    for count in [1_000_u32, 10_000, 100_000] {
        // The same density for every count: on average one box in four square metres.
        let side = (4.0 * f64::from(count)).sqrt();
        let mut noise = Noise(7);
        let mut centres: Vec<DVec2> = (0..count).map(|_| DVec2::new(noise.next(), noise.next()) * side).collect();
        let velocities: Vec<DVec2> = (0..count).map(|_| (DVec2::new(noise.next(), noise.next()) - 0.5) * 2.0).collect();
        let volume =
            |centre: DVec2| Volume::Box(Bounds { min: centre - DVec2::splat(0.5), max: centre + DVec2::splat(0.5) });

        let mut changes = PairChanges::default();
        let mut broad_phase = BroadPhase::new();
        let start = Instant::now();
        broad_phase.insert(count, Volume::HalfSpace { normal: DVec2::Y, offset: 0.0 }, 0.1);
        centres.iter().enumerate().for_each(|(id, &centre)| broad_phase.insert(id as u32, volume(centre), 0.1));
        broad_phase.update_pairs(|_, _| true, &mut changes);
        let build = start.elapsed().as_secs_f64() * 1e6;

        // Speeds up to 1 m/s in each direction at 1/60 s, margin 0.1 m.
        let (rounds, steps) = (8, 15);
        let mut rebuilt = 0;
        let mut step = f64::INFINITY;
        for _ in 0..rounds {
            let start = Instant::now();
            for _ in 0..steps {
                for (id, centre) in centres.iter_mut().enumerate() {
                    *centre += velocities[id] * (1.0 / 60.0);
                    let before = broad_phase.fat_volume(id as u32);
                    broad_phase.update(id as u32, volume(*centre), 0.1);
                    rebuilt += usize::from(before != broad_phase.fat_volume(id as u32));
                }
                broad_phase.update_pairs(|_, _| true, &mut changes);
            }
            step = step.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(steps));
        }
        println!(
            "{count:<10}{:>10}{build:>14.0}{step:>14.0}{:>14.1}{:>16.0}",
            broad_phase.pairs().len(),
            1e3 * step / f64::from(count),
            rebuilt as f64 / f64::from(rounds * steps)
        );
    }
}
