//! Shapes, poses and queries in few words.

use glam::DVec2;
use proptest::prelude::{ProptestConfig, Strategy, prop_oneof};
use proptest::test_runner::RngSeed;
use proptest::{arbitrary::any, collection};
use tumble_collision::{PlanarManifold, PlanarQuery};
use tumble_math::{Planar, PlanarRotation, Pose, trig};
use tumble_shape::{ConvexPolygon, Disc, PlanarShape, Rod};

/// Same cases every time.
pub fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

pub fn at(x: f64, y: f64, angle: f64) -> Pose<Planar> {
    Pose { position: DVec2::new(x, y), rotation: PlanarRotation::from_angle(angle) }
}

pub fn query(margin: f64, flush_tolerance: f64) -> PlanarQuery<'static> {
    PlanarQuery { margin, flush_tolerance, previous: None }
}

/// A rod along x around the origin.
pub fn rod(length: f64, radius: f64) -> PlanarShape {
    Rod::try_new(DVec2::new(-0.5 * length, 0.0), DVec2::new(0.5 * length, 0.0), radius).unwrap().into()
}

pub fn thin(length: f64) -> PlanarShape {
    rod(length, 0.0)
}

/// A thin rod off its body's centre.
pub fn bar(y: f64) -> PlanarShape {
    Rod::try_new(DVec2::new(-0.3, y), DVec2::new(0.3, y), 0.0).unwrap().into()
}

pub fn disc(radius: f64) -> PlanarShape {
    Disc::try_new(DVec2::ZERO, radius).unwrap().into()
}

pub fn boxed(half_width: f64, half_height: f64) -> PlanarShape {
    ConvexPolygon::rectangle(DVec2::ZERO, DVec2::new(half_width, half_height), 0.0).unwrap().into()
}

/// Polygons on an ellipse: convex, any number of sides, given either way round.
pub fn hull() -> impl Strategy<Value = PlanarShape> {
    (collection::vec(0.3..1.7_f64, 3..9), 0.4..1.0_f64, any::<bool>()).prop_map(|(gaps, flatness, clockwise)| {
        let total: f64 = gaps.iter().sum();
        let mut angle = 0.0;
        let mut points: Vec<DVec2> = Vec::new();
        for gap in gaps {
            angle += std::f64::consts::TAU * gap / total;
            points.push(DVec2::new(trig::cos(angle), flatness * trig::sin(angle)));
        }
        if clockwise {
            points.reverse();
        }
        ConvexPolygon::try_new(points).unwrap().into()
    })
}

pub fn shape() -> impl Strategy<Value = PlanarShape> {
    let place = || (-0.5..0.5_f64, -0.5..0.5_f64).prop_map(DVec2::from);
    let rods = (place(), place(), prop_oneof![0.0..=0.0, 0.01..0.3_f64])
        .prop_filter_map("coincident ends", |(from, to, radius)| Rod::try_new(from, to, radius).ok().map(Into::into));
    let discs = (place(), 0.1..0.8_f64).prop_map(|(centre, radius)| Disc::try_new(centre, radius).unwrap().into());
    prop_oneof![rods, discs, hull()]
}

/// The contact seen after all was moved by a pose.
pub fn moved(manifold: &PlanarManifold, by: &Pose<Planar>) -> Vec<(DVec2, DVec2, f64)> {
    listed(manifold)
        .into_iter()
        .map(|(normal, point, separation)| (by.transform_vector(normal), by.transform_point(point), separation))
        .collect()
}

/// Normal, place and separation of every point.
pub fn listed(manifold: &PlanarManifold) -> Vec<(DVec2, DVec2, f64)> {
    manifold.points().iter().map(|point| (manifold.normal, point.point, point.separation)).collect()
}

/// Asserts that two lists hold the same contact, in any order of points, to a tolerance [m].
pub fn assert_same_contact(one: impl Listed, other: impl Listed, tolerance: f64) {
    let (one, other) = (one.list(), other.list());
    assert_eq!(one.len(), other.len(), "{one:?} {other:?}");
    for (normal, point, separation) in &one {
        let same = |(n, p, s): &(DVec2, DVec2, f64)| {
            n.distance(*normal) < tolerance && p.distance(*point) < tolerance && (s - separation).abs() < tolerance
        };
        assert!(other.iter().any(same), "{one:?} {other:?}");
    }
}

/// Something that holds contact points.
pub trait Listed {
    fn list(self) -> Vec<(DVec2, DVec2, f64)>;
}

impl Listed for &PlanarManifold {
    fn list(self) -> Vec<(DVec2, DVec2, f64)> {
        listed(self)
    }
}

impl Listed for Vec<(DVec2, DVec2, f64)> {
    fn list(self) -> Self {
        self
    }
}
