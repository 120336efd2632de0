//! Convex hulls: closed, convex, around every point, and refused with a reason when there is no volume.

use crate::common::{cloud, config, pose, rotation, vector};
use glam::{DVec3, dvec3};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use proptest::{collection, sample};
use tumble_math::{Rotation, SpatialRotation};
use tumble_shape::{ConvexHull, Cuboid, Cylinder, SpatialShapeError, Sphere};

/// Asserts what makes a polyhedron a convex hull of points, to a distance [m].
fn assert_hull(hull: &ConvexHull, points: &[DVec3], tolerance: f64) {
    let (vertices, faces, edges) = (hull.vertices(), hull.faces(), hull.edges());
    assert_eq!(vertices.len() + faces.len(), edges.len() + 2, "Euler");
    for face in faces {
        assert!((face.normal.length() - 1.0).abs() < 1e-15 * 4.0, "{face:?}");
        for point in points {
            assert!(face.normal.dot(*point) <= face.offset + tolerance, "{point} is outside {face:?}");
        }
        let sides = hull.sides(face);
        assert!(sides.len() >= 3);
        for side in sides {
            // Corners of a face lie in its plane, and inside of all its sides.
            let corner = vertices[side.vertex as usize];
            assert!((face.normal.dot(corner) - face.offset).abs() <= tolerance, "{corner} {face:?}");
            for (i, other) in sides.iter().enumerate() {
                // The direction of a side of a few tolerances is noise.
                let length =
                    vertices[other.vertex as usize].distance(vertices[sides[(i + 1) % sides.len()].vertex as usize]);
                if length < 1e3 * tolerance {
                    continue;
                }
                assert!(other.outward.dot(corner) <= other.offset + 4.0 * tolerance, "{corner} {other:?}");
            }
        }
    }
    for (i, edge) in edges.iter().enumerate() {
        for (face, forward) in edge.faces.iter().zip([true, false]) {
            let sides = hull.sides(&faces[*face as usize]);
            let at =
                sides.iter().position(|side| side.edge == i as u32).expect("the faces of an edge have it as a side");
            let ends = [sides[at].vertex, sides[(at + 1) % sides.len()].vertex];
            assert_eq!(ends, if forward { edge.vertices } else { [edge.vertices[1], edge.vertices[0]] });
        }
    }
    assert!(hull.inner_radius() > 0.0 && hull.outer_radius() >= hull.inner_radius());
    assert!(vertices.iter().all(|vertex| points.contains(vertex)));
}

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn a_hull_is_closed_and_convex_and_holds_every_point(points in cloud()) {
        // 1e-9 of a cloud of size 2.
        assert_hull(&ConvexHull::try_new(&points).unwrap(), &points, 4e-9);
    }

    #[test]
    fn points_on_a_coarse_lattice_make_hulls_too(
        cells in collection::vec((0..4_i32, 0..4_i32, 0..4_i32), 4..60), turn in rotation(), noise in sample::select(vec![0.0, 1e-16, 1e-12, 1e-10, 1e-9, 1e-8]),
    ) {
        // Many coplanar, collinear and repeated points, with noise below, about and above the tolerance.
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / 16_777_216.0 - 0.5
        };
        let points: Vec<DVec3> = cells
            .iter()
            .map(|&(x, y, z)| turn.rotate(dvec3(x.into(), y.into(), z.into())) + dvec3(random(), random(), random()) * noise)
            .collect();
        match ConvexHull::try_new(&points) {
            Ok(hull) => assert_hull(&hull, &points, 5e-8),
            Err(error) => {
                let flat = |normal: DVec3| {
                    let heights: Vec<f64> = points.iter().map(|p| turn.unrotate(*p).dot(normal)).collect();
                    let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
                    high - low < 1e-6
                };
                // Refused only for what is flat: some plane through three lattice points holds all.
                let places: Vec<DVec3> = cells.iter().map(|&(x, y, z)| dvec3(x.into(), y.into(), z.into())).collect();
                let planes = places.iter().flat_map(|p| places.iter().map(move |q| (p, q)))
                    .flat_map(|(p, q)| places.iter().map(move |r| (*q - *p).cross(*r - *p)))
                    .filter(|normal| *normal != DVec3::ZERO);
                let some_plane = planes.map(DVec3::normalize).any(flat);
                let line = matches!(error, SpatialShapeError::OneLine { .. } | SpatialShapeError::OnePlace { .. });
                prop_assert!(some_plane || line, "{error}");
            }
        }
    }

    #[test]
    fn moving_and_scaling_a_cloud_keeps_its_hull(points in cloud(), by in pose(2.0), scale in -4..4_i32) {
        let hull = ConvexHull::try_new(&points).unwrap();
        let factor = 10.0_f64.powi(scale);
        let moved: Vec<DVec3> = points.iter().map(|&p| by.transform_point(p) * factor).collect();
        let there = ConvexHull::try_new(&moved).unwrap();
        prop_assert_eq!(there.vertices().len(), hull.vertices().len());
        let volume = hull.volume() * factor * factor * factor;
        prop_assert!((there.volume() - volume).abs() < 1e-9 * volume + 1e-9 * factor * factor * factor);
        assert_hull(&hull.posed(&by), &points.iter().map(|&p| by.transform_point(p)).collect::<Vec<_>>(), 4e-9);
    }

    #[test]
    fn points_inside_change_nothing(points in cloud(), weights in collection::vec(collection::vec(0.0..1.0_f64, 4), 1..20)) {
        let hull = ConvexHull::try_new(&points).unwrap();
        let inside = weights.iter().map(|w| {
            let total: f64 = w.iter().sum::<f64>() + 1e-3;
            // A mean of some of the points, drawn to the middle.
            let mean = w.iter().zip(&points).fold(DVec3::ZERO, |sum, (w, p)| sum + (*p - hull.centre()) * (w / total));
            hull.centre() + mean * 0.999
        });
        let more: Vec<DVec3> = points.iter().copied().chain(inside).collect();
        let again = ConvexHull::try_new(&more).unwrap();
        prop_assert_eq!(again.vertices(), hull.vertices());
        prop_assert_eq!(again.faces().len(), hull.faces().len());
    }

    #[test]
    fn a_turned_box_with_many_points_on_its_faces_has_six_of_them(
        turn in rotation(), at in vector(3.0), on in collection::vec((0..3_usize, 0..2_u8, -1.0..1.0_f64, -1.0..1.0_f64), 0..60),
    ) {
        let half = dvec3(0.5, 1.0, 1.5);
        let boxed = Cuboid::try_new(at, half, turn).unwrap();
        let on_faces = on.iter().map(|&(axis, side, u, v)| {
            let mut point = DVec3::ZERO;
            point[axis] = if side == 0 { -1.0 } else { 1.0 };
            point[(axis + 1) % 3] = u;
            point[(axis + 2) % 3] = v;
            at + turn.rotate(point * half)
        });
        let points: Vec<DVec3> = on_faces.chain(boxed.hull().vertices().iter().copied()).collect();
        let hull = ConvexHull::try_new(&points).unwrap();
        prop_assert_eq!((hull.vertices().len(), hull.faces().len(), hull.edges().len()), (8, 6, 12));
        assert_hull(&hull, &points, 2e-8);
        prop_assert!((hull.volume() - 6.0).abs() < 1e-7);
    }

    #[test]
    fn nearly_round_clouds_make_hulls(count in 50..400_usize, seed in 1..1000_u64) {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let points: Vec<DVec3> = (0..count).map(|_| dvec3(random(), random(), random()).normalize()).collect();
        let hull = ConvexHull::try_new(&points).unwrap();
        assert_hull(&hull, &points, 4e-9);
        prop_assert_eq!(hull.vertices().len(), count);
    }
}

#[test]
fn clouds_without_volume_are_refused_with_the_reason() {
    let hull = |points: &[DVec3]| ConvexHull::try_new(points).err();
    assert_eq!(hull(&[DVec3::ZERO, DVec3::X, DVec3::Y]), Some(SpatialShapeError::TooFewPoints { count: 3 }));
    assert!(matches!(hull(&[DVec3::ONE; 7]), Some(SpatialShapeError::OnePlace { .. })));
    let line: Vec<DVec3> = (0..9).map(|i| dvec3(1.0, 2.0, 3.0) * f64::from(i) / 3.0).collect();
    assert!(matches!(hull(&line), Some(SpatialShapeError::OneLine { .. })));
    let third = 1.0 / 3.0;
    let plane: Vec<DVec3> = (0..9)
        .map(|i| dvec3(1.0, 2.0, 3.0) * f64::from(i) * third + dvec3(-1.0, 0.7, 0.1) * f64::from(i * i))
        .collect();
    assert!(matches!(hull(&plane), Some(SpatialShapeError::OnePlane { .. })));
    assert_eq!(hull(&[DVec3::NAN; 4]), Some(SpatialShapeError::NotFinite));
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    assert_eq!(ConvexHull::try_with_tolerance(&corners, 0.5), Err(SpatialShapeError::Tolerance { tolerance: 0.5 }));
    assert_eq!(hull(&plane).unwrap().to_string().split(',').next(), Some("all points of the hull lie in one plane"));
}

#[test]
fn a_wider_tolerance_joins_faces_rounded_to_single_precision() {
    let turn = SpatialRotation::from_rotation_vector(dvec3(0.3, -0.8, 0.5));
    let boxed = Cuboid::try_new(DVec3::ZERO, dvec3(1.0, 2.0, 3.0), turn).unwrap();
    let rounded: Vec<DVec3> = boxed.hull().vertices().iter().map(|p| p.as_vec3().as_dvec3()).collect();
    assert!(ConvexHull::try_new(&rounded).unwrap().faces().len() > 6);
    assert_eq!(ConvexHull::try_with_tolerance(&rounded, 1e-6).unwrap().faces().len(), 6);
}

#[test]
fn the_box_of_unit_sides_has_exact_planes() {
    let boxed = Cuboid::with_half_extents(DVec3::splat(0.5)).unwrap();
    let normals: Vec<DVec3> = boxed.hull().faces().iter().map(|face| face.normal).collect();
    assert_eq!(normals, [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y, DVec3::NEG_Z, DVec3::Z]);
    assert!(boxed.hull().faces().iter().all(|face| face.offset == 0.5));
    assert_eq!(boxed.hull().centre(), DVec3::ZERO);
    assert_hull(boxed.hull(), boxed.hull().vertices(), 0.0);
}

#[test]
fn degenerate_solids_are_refused_with_the_reason() {
    use SpatialShapeError as E;
    let (o, x) = (DVec3::ZERO, DVec3::X);
    assert_eq!(Sphere::try_new(o, 0.0), Err(E::RadiusNotPositive { shape: "sphere", radius: 0.0 }));
    let same = E::CoincidentEnds { shape: "cylinder", x: 1.0, y: 0.0, z: 0.0 };
    assert_eq!(Cylinder::try_new(x, x, 1.0), Err(same));
    assert_eq!(same.to_string(), "both ends of the cylinder are at (1, 0, 0), so it has no length");
    let flat = E::HalfExtentNotPositive { x: 1.0, y: 0.0, z: 0.0 };
    assert_eq!(Cuboid::with_half_extents(x).err(), Some(flat));
    assert_eq!(tumble_shape::HalfSpace::try_new(o, 1.0), Err(E::ZeroNormal));
    assert_eq!(tumble_shape::SpatialRod::try_new(o, x, -1.0), Err(E::NegativeRadius { radius: -1.0 }));
}
