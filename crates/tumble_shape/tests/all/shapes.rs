//! What shapes refuse, and laws of their geometry and mass.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};
use proptest::prelude::{ProptestConfig, Strategy, prop_assert, proptest};
use proptest::{collection, test_runner::RngSeed};
use tumble_math::{Bounds, Planar, PlanarRotation, Pose, Spatial, SymmetricTensor, trig};
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, MassDim, MassProperties, PlanarShape, Rod, ShapeError};

fn polygon(points: &[(f64, f64)]) -> Result<ConvexPolygon, ShapeError> {
    ConvexPolygon::try_new(points.iter().map(|&point| point.into()).collect::<Vec<DVec2>>())
}

#[test]
fn degenerate_shapes_are_refused_with_the_reason() {
    let (o, x) = (DVec2::ZERO, DVec2::X);
    let nan = DVec2::new(f64::NAN, 0.0);
    assert_eq!(Rod::try_new(x, x, 0.0), Err(ShapeError::CoincidentEnds { x: 1.0, y: 0.0 }));
    assert_eq!(Rod::try_new(o, x, -0.1), Err(ShapeError::NegativeRadius { radius: -0.1 }));
    assert_eq!(Rod::try_new(o, x, f64::INFINITY), Err(ShapeError::NotFinite));
    assert_eq!(Rod::try_new(nan, x, 0.0), Err(ShapeError::NotFinite));
    assert_eq!(Disc::try_new(o, 0.0), Err(ShapeError::RadiusNotPositive { radius: 0.0 }));
    assert_eq!(Disc::try_new(nan, 1.0), Err(ShapeError::NotFinite));
    assert_eq!(HalfPlane::try_new(o, 0.0), Err(ShapeError::ZeroNormal));
    assert_eq!(HalfPlane::try_new(x, f64::NAN), Err(ShapeError::NotFinite));
    let flat = ConvexPolygon::rectangle(o, x, 0.0);
    assert_eq!(flat, Err(ShapeError::HalfExtentNotPositive { x: 1.0, y: 0.0 }));

    assert_eq!(polygon(&[(0.0, 0.0), (1.0, 0.0)]), Err(ShapeError::TooFewPoints { count: 2 }));
    let repeated = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (1.0, 0.0)];
    assert_eq!(polygon(&repeated), Err(ShapeError::RepeatedPoint { first: 1, second: 3 }));
    assert_eq!(polygon(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0), (2.0, 2.0)]), Err(ShapeError::NoArea));
    assert_eq!(polygon(&[(0.0, 0.0), (f64::NAN, 1.0), (3.0, 3.0)]), Err(ShapeError::NotFinite));
    let bow_tie = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
    assert_eq!(polygon(&bow_tie), Err(ShapeError::SelfCrossing { first: 0, second: 2 }));
    let spike = [(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (0.0, 1.0)];
    assert_eq!(polygon(&spike), Err(ShapeError::SelfCrossing { first: 0, second: 1 }));
    let arrow = [(0.0, 0.0), (2.0, 0.0), (0.5, 0.5), (0.0, 2.0)];
    assert_eq!(polygon(&arrow), Err(ShapeError::NotConvex { corner: 2 }));
    let arrow_clockwise = [(0.0, 2.0), (0.5, 0.5), (2.0, 0.0), (0.0, 0.0)];
    assert_eq!(polygon(&arrow_clockwise), Err(ShapeError::NotConvex { corner: 1 }));
}

#[test]
fn a_pentagram_outline_crosses_itself_although_it_always_turns_left() {
    let corner = |k: u32| {
        let angle = TAU * f64::from(2 * k) / 5.0;
        DVec2::new(trig::cos(angle), trig::sin(angle))
    };
    let pentagram = ConvexPolygon::try_new((0..5).map(corner).collect::<Vec<_>>());
    assert!(matches!(pentagram, Err(ShapeError::SelfCrossing { .. })), "{pentagram:?}");
}

#[test]
fn refusals_say_what_is_wrong_in_words() {
    assert_eq!(
        polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]).unwrap_err().to_string(),
        "the polygon crosses itself: the side after point 0 meets the side after point 2"
    );
    assert_eq!(
        Rod::try_new(DVec2::ONE, DVec2::ONE, 0.0).unwrap_err().to_string(),
        "both ends of the rod are at (1, 1), so it has no length"
    );
}

#[test]
fn clockwise_points_are_turned_round_and_straight_corners_dropped() {
    let clockwise = polygon(&[(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.5), (1.0, 0.0), (0.3, 0.0)]).unwrap();
    assert_eq!(clockwise, polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]).unwrap());
    assert_eq!(clockwise.normals(), [DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_X]);
}

#[test]
fn a_half_plane_moves_with_its_pose() {
    let wall = HalfPlane::try_new(DVec2::new(0.0, 2.0), 0.5).unwrap();
    let pose = Pose { position: DVec2::new(3.0, 7.0), rotation: PlanarRotation::from_angle(FRAC_PI_2) };
    let posed = wall.posed(&pose);
    // A right angle by libm, and its rounding times 7.
    assert!(posed.normal().distance(DVec2::NEG_X) < 1e-15 && (posed.offset() + 2.5).abs() < 1e-14);
    assert_eq!(PlanarShape::from(wall).bounds(&pose), None);
}

#[test]
fn a_disc_and_a_box_have_the_mass_of_the_textbook() {
    let disc = PlanarShape::from(Disc::try_new(DVec2::new(1.0, 2.0), 0.5).unwrap());
    let by_mass = disc.mass_properties_of_mass(3.0).unwrap();
    assert_eq!((by_mass.mass, by_mass.centre), (3.0, DVec2::new(1.0, 2.0)));
    // m r²/2, two roundings.
    assert!((by_mass.inertia - 0.375).abs() < 1e-15);

    let half_extents = DVec2::new(1.5, 0.5);
    let boxed = ConvexPolygon::rectangle(DVec2::new(4.0, -2.0), half_extents, 0.6).unwrap().mass_properties(2.0);
    // ρ w h = 6 and m (w² + h²)/12 = 5; a few roundings of numbers up to 20.
    assert!((boxed.mass - 6.0).abs() < 1e-13 && (boxed.inertia - 5.0).abs() < 1e-13, "{boxed:?}");
    assert!(boxed.centre.distance(DVec2::new(4.0, -2.0)) < 1e-14);
}

#[test]
fn nothing_and_massless_parts_have_no_combined_mass() {
    assert_eq!(MassProperties::<Planar>::combine([]), None);
    let rod = Rod::try_new(DVec2::ZERO, DVec2::X, 0.0).unwrap();
    assert_eq!(MassProperties::combine([rod.mass_properties(0.0)]), None);
}

#[test]
fn the_parallel_axis_theorem_holds_in_space() {
    let point = |x: f64, y: f64, z: f64| MassProperties::<Spatial> {
        mass: 1.0,
        centre: DVec3::new(x, y, z),
        inertia: SymmetricTensor::default(),
    };
    // Two unit masses at ±(1, 2, 3): I = 2 (|d|² 1 − d dᵀ), by hand.
    let dumbbell = MassProperties::combine([point(1.0, 2.0, 3.0), point(-1.0, -2.0, -3.0)]).unwrap();
    let by_hand =
        SymmetricTensor { diagonal: DVec3::new(26.0, 20.0, 10.0), off_diagonal: DVec3::new(-12.0, -6.0, -4.0) };
    assert_eq!((dumbbell.mass, dumbbell.centre, dumbbell.inertia), (2.0, DVec3::ZERO, by_hand));
    assert_eq!(Spatial::point_mass_inertia(2.0, DVec3::new(1.0, 2.0, 3.0)), by_hand);
}

/// Points on an ellipse: convex, any number of sides.
fn hull() -> impl Strategy<Value = Vec<DVec2>> {
    (collection::vec(0.3..1.7_f64, 3..12), 0.2..1.0_f64, -3.0..3.0_f64).prop_map(|(gaps, flatness, shift)| {
        let total: f64 = gaps.iter().sum();
        let ends = gaps.iter().scan(0.0, |sum, gap| {
            *sum += TAU * gap / total;
            Some(*sum)
        });
        ends.map(|angle| DVec2::new(shift + trig::cos(angle), flatness * trig::sin(angle))).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default()
    })]

    #[test]
    fn a_polygon_has_the_mass_of_its_triangles(points in hull(), density in 0.1..10.0_f64) {
        let whole = ConvexPolygon::try_new(points.clone()).unwrap().mass_properties(density);
        let triangle = |pair: &[DVec2]| ConvexPolygon::try_new(vec![points[0], pair[0], pair[1]]).unwrap();
        let triangles: Vec<_> = points[1..].windows(2).map(|pair| triangle(pair).mass_properties(density)).collect();
        let sum = MassProperties::combine(triangles).unwrap();
        // A dozen parts, each rounded a few times, shifted by at most 4 m: 1e-14 times the squared shift.
        prop_assert!((whole.mass - sum.mass).abs() < 1e-13 * whole.mass);
        prop_assert!(whole.centre.distance(sum.centre) < 1e-13);
        prop_assert!((whole.inertia - sum.inertia).abs() < 1e-12 * whole.inertia);
    }

    #[test]
    fn mass_of_a_compound_is_the_sum_in_any_grouping(points in hull(), split in 1..10_usize) {
        let rods: Vec<_> = points.windows(2)
            .map(|ends| Rod::try_new(ends[0], ends[1], 0.0).unwrap().mass_properties(1.0)).collect();
        let split = split.min(rods.len() - 1);
        let whole = MassProperties::combine(rods.clone()).unwrap();
        let grouped = [&rods[..split], &rods[split..]].map(|part| MassProperties::combine(part.to_vec()).unwrap());
        let grouped = MassProperties::combine(grouped).unwrap();
        // As above.
        prop_assert!((whole.mass - grouped.mass).abs() < 1e-13 * whole.mass);
        prop_assert!(whole.centre.distance(grouped.centre) < 1e-13);
        prop_assert!((whole.inertia - grouped.inertia).abs() < 1e-12 * whole.inertia);
    }

    #[test]
    fn bounds_and_extent_hold_every_point_and_touch_one(points in hull(), radius in 0.0..0.5_f64, angle in -4.0..4.0_f64) {
        let pose = Pose { position: DVec2::new(2.0, -1.0), rotation: PlanarRotation::from_angle(angle) };
        let polygon: PlanarShape = ConvexPolygon::try_new(points.clone()).unwrap().into();
        let rod: PlanarShape = Rod::try_new(points[0], points[1], radius).unwrap().into();
        for shape in [polygon, rod] {
            let posed = shape.posed(&pose);
            let grown = posed.vertices().iter().map(|&v| Bounds { min: v, max: v }.grown(shape.radius()));
            let around = grown.fold(Bounds::empty(), Bounds::join);
            let bounds = shape.bounds(&pose).unwrap();
            // One rounding of numbers below 8.
            prop_assert!(bounds.min.distance(around.min) < 4e-15 && bounds.max.distance(around.max) < 4e-15);
            let extent = shape.extent_about(DVec2::ONE).unwrap();
            let distances = shape.vertices().iter().map(|v| v.distance(DVec2::ONE) + shape.radius());
            prop_assert!((extent - distances.fold(0.0, f64::max)).abs() < 1e-14);
        }
    }

    #[test]
    fn either_way_round_gives_the_same_polygon(points in hull()) {
        let forth = ConvexPolygon::try_new(points.clone()).unwrap();
        let mut reversed = points;
        reversed[1..].reverse();
        prop_assert!(forth == ConvexPolygon::try_new(reversed).unwrap());
        prop_assert!(forth.area() > 0.0);
        for (i, normal) in forth.normals().iter().enumerate() {
            // No corner lies outside a side, to the rounding of coordinates below 4.
            let outside = |point: &DVec2| normal.dot(*point - forth.points()[i]) > 1e-14;
            prop_assert!(!forth.points().iter().any(outside));
        }
    }
}
