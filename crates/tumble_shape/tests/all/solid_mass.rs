//! Mass of solids: closed forms of the validation book (A14 to A16), and laws that hold for every shape.

use crate::common::{cloud, config, pose, solid, vector};
use approx::assert_abs_diff_eq;
use glam::{DMat3, DVec3, dvec3};
use proptest::prelude::{prop_assert, proptest};
use tumble_math::{Inertia, Pose, Spatial, SpatialRotation, SymmetricTensor};
use tumble_shape::{ConvexHull, Cuboid, MassError, MassProperties, SpatialRod, SpatialShape};

fn hull(points: &[(f64, f64, f64)]) -> ConvexHull {
    ConvexHull::try_new(&points.iter().map(|&point| point.into()).collect::<Vec<DVec3>>()).unwrap()
}

fn assert_close(found: DVec3, expected: DVec3, tolerance: f64) {
    assert!(found.distance(expected) <= tolerance, "{found} instead of {expected}");
}

/// Compares with (Ixx, Iyy, Izz, Ixy, Ixz, Iyz) to 1e-12, the tolerance of the validation book.
fn assert_mass(found: MassProperties<Spatial>, mass: f64, centre: DVec3, i: [f64; 6]) {
    assert_abs_diff_eq!(found.mass, mass, epsilon = 1e-12);
    assert_close(found.centre, centre, 1e-12);
    assert_close(found.inertia.diagonal, dvec3(i[0], i[1], i[2]), 1e-12);
    assert_close(found.inertia.off_diagonal, dvec3(i[5], i[4], i[3]), 1e-12);
}

#[test]
fn a14_uniform_solids_have_the_mass_of_their_closed_forms() {
    let rotation = SpatialRotation::IDENTITY;
    let boxed = Cuboid::try_new(dvec3(0.5, 1.0, 1.5), dvec3(0.5, 1.0, 1.5), rotation).unwrap();
    let (middle, diagonal) = (dvec3(0.5, 1.0, 1.5), [6.5, 5.0, 2.5, 0.0, 0.0, 0.0]);
    assert_mass(boxed.mass_properties(1.0), 6.0, middle, diagonal);
    assert_mass(boxed.hull().mass_properties(1.0), 6.0, middle, diagonal);

    let tetrahedron = hull(&[(0., 0., 0.), (1., 0., 0.), (0., 2., 0.), (0., 0., 3.)]);
    assert_mass(tetrahedron.mass_properties(2.0), 2.0, dvec3(0.25, 0.5, 0.75), [0.975, 0.75, 0.375, 0.05, 0.075, 0.15]);

    let octahedron = hull(&[(1., 0., 0.), (-1., 0., 0.), (0., 1., 0.), (0., -1., 0.), (0., 0., 1.), (0., 0., -1.)]);
    let moment = 4.0 / 15.0;
    assert_mass(octahedron.mass_properties(1.0), 4.0 / 3.0, DVec3::ZERO, [moment, moment, moment, 0.0, 0.0, 0.0]);

    let prism = hull(&[(0., 0., 0.), (2., 0., 0.), (0., 1., 0.), (0., 0., 3.), (2., 0., 3.), (0., 1., 3.)]);
    let moments = [29.0 / 12.0, 35.0 / 12.0, 5.0 / 6.0, 1.0 / 6.0, 0.0, 0.0];
    assert_mass(prism.mass_properties(1.0), 3.0, dvec3(2.0 / 3.0, 1.0 / 3.0, 1.5), moments);

    let pyramid = hull(&[(-1., -1., 0.), (1., -1., 0.), (1., 1., 0.), (-1., 1., 0.), (0., 0., 3.)]);
    assert_mass(pyramid.mass_properties(1.0), 4.0, dvec3(0.0, 0.0, 0.75), [2.15, 2.15, 1.6, 0.0, 0.0, 0.0]);
}

#[test]
fn a15_a_regular_tetrahedron_turns_alike_about_every_axis() {
    let s = 0.5_f64.sqrt() / 2.0;
    let tetrahedron = hull(&[(s, s, s), (s, -s, -s), (-s, s, -s), (-s, -s, s)]);
    let mass = 2.0_f64.sqrt() / 12.0;
    let moment = mass / 20.0;
    assert_mass(tetrahedron.mass_properties(1.0), mass, DVec3::ZERO, [moment, moment, moment, 0.0, 0.0, 0.0]);
}

#[test]
fn a16_inertia_of_a_turned_box_is_the_product_r_i_r_transposed() {
    let about = |axis: DVec3, degrees: f64| SpatialRotation::from_rotation_vector(axis * degrees.to_radians());
    let turn =
        SpatialRotation::try_from_quaternion(about(DVec3::Z, 30.0).quaternion() * about(DVec3::X, 40.0).quaternion());
    let turned = Cuboid::try_new(DVec3::ZERO, dvec3(0.5, 1.0, 1.5), turn.unwrap()).unwrap();
    let expected = [5.86676505552, 4.60029516656, 3.53293977792, 1.09679509697, -0.615504845633, 1.06608566494];
    // The book prints twelve digits.
    for properties in [turned.mass_properties(1.0), turned.hull().mass_properties(1.0)] {
        let (d, o) = (properties.inertia.diagonal, properties.inertia.off_diagonal);
        for (found, expected) in [d.x, d.y, d.z, o.z, o.y, o.x].into_iter().zip(expected) {
            assert_abs_diff_eq!(found, expected, epsilon = 5e-12);
        }
        let body = SymmetricTensor::from_diagonal(dvec3(6.5, 5.0, 2.5)).in_world(&turn.unwrap());
        assert_close(d, body.diagonal, 1e-13);
        assert_close(o, body.off_diagonal, 1e-13);
    }
}

/// Mass, centre and inertia by adding up the inside point by point, on a grid of `n`³ cells of the bounds.
fn by_counting(shape: &SpatialShape, inside: impl Fn(DVec3) -> bool, n: u32) -> MassProperties<Spatial> {
    let bounds = shape.bounds(&Pose::default()).unwrap();
    let cell = bounds.size() / f64::from(n);
    let mass = cell.x * cell.y * cell.z;
    let step = |i: u32, axis: DVec3| axis * (f64::from(i) + 0.5);
    let cells = (0..n).flat_map(move |i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k))));
    let points: Vec<MassProperties<Spatial>> = cells
        .map(|(i, j, k)| bounds.min + cell * (step(i, DVec3::X) + step(j, DVec3::Y) + step(k, DVec3::Z)))
        .filter(|&point| inside(point))
        .map(|centre| MassProperties { mass, centre, inertia: SymmetricTensor::default() })
        .collect();
    MassProperties::combine(points).unwrap()
}

#[test]
fn round_solids_weigh_what_counting_their_inside_gives() {
    let (from, to, r) = (dvec3(-0.3, 0.1, 0.2), dvec3(0.9, 0.7, -0.4), 0.5);
    let (along, length) = ((to - from).normalize(), from.distance(to));
    let from_line = move |p: DVec3| {
        let s = along.dot(p - from);
        (s, (p - from - along * s).length())
    };
    let capsule = tumble_shape::Capsule::try_new(from, to, r).unwrap().into();
    let cylinder = tumble_shape::Cylinder::try_new(from, to, r).unwrap().into();
    let cone = tumble_shape::Cone::try_new(from, to, r).unwrap().into();
    let cases: [(SpatialShape, Box<dyn Fn(DVec3) -> bool>); 3] = [
        (capsule, Box::new(move |p| (p - from - along * from_line(p).0.clamp(0.0, length)).length() <= r)),
        (cylinder, Box::new(move |p| (0.0..=length).contains(&from_line(p).0) && from_line(p).1 <= r)),
        (cone, Box::new(move |p| from_line(p).0 >= 0.0 && from_line(p).1 <= r * (1.0 - from_line(p).0 / length))),
    ];
    for (shape, inside) in cases {
        let counted = by_counting(&shape, inside, 90);
        let exact = shape.mass_properties(1.0).unwrap();
        // The surface cells, about one in twenty, are right on average: far below 1 % is left.
        assert_abs_diff_eq!(exact.mass, counted.mass, epsilon = 2e-3 * exact.mass);
        assert_close(exact.centre, counted.centre, 2e-3);
        let scale = 4e-3 * exact.inertia.diagonal.max_element();
        assert_close(exact.inertia.diagonal, counted.inertia.diagonal, scale);
        assert_close(exact.inertia.off_diagonal, counted.inertia.off_diagonal, scale);
    }
}

proptest! {
    #![proptest_config(config(300))]

    // Tolerances: some hundred roundings of numbers up to about 100.

    #[test]
    fn moving_a_shape_moves_its_mass(shape in solid(), by in pose(5.0)) {
        let here = shape.mass_properties(1.3).unwrap();
        let there = shape.posed(&by).mass_properties(1.3).unwrap();
        let expected = here.inertia.in_world(&by.rotation);
        prop_assert!((there.mass - here.mass).abs() < 1e-11);
        prop_assert!(there.centre.distance(by.transform_point(here.centre)) < 1e-11);
        prop_assert!(there.inertia.diagonal.distance(expected.diagonal) < 1e-10);
        prop_assert!(there.inertia.off_diagonal.distance(expected.off_diagonal) < 1e-10);
    }

    #[test]
    fn a_hull_cut_in_two_weighs_as_much_as_its_halves(points in cloud(), normal in vector(1.0)) {
        let whole = ConvexHull::try_new(&points).unwrap();
        let normal = normal.normalize();
        let height = |p: DVec3| normal.dot(p - whole.centre());
        // Each half: the corners on its side, and where the edges pass through the cut.
        let cut = whole.edges().iter().filter_map(|edge| {
            let [p, q] = edge.vertices.map(|i| whole.vertices()[i as usize]);
            let share = height(p) / (height(p) - height(q));
            (height(p) * height(q) < 0.0).then(|| p + (q - p) * share)
        });
        let cut: Vec<DVec3> = cut.collect();
        let half = |sign: f64| {
            let mut corners = cut.clone();
            corners.extend(whole.vertices().iter().filter(|&&p| sign * height(p) >= 0.0));
            ConvexHull::try_new(&corners).unwrap().mass_properties(1.0)
        };
        let sum = MassProperties::combine([half(1.0), half(-1.0)]).unwrap();
        let properties = whole.mass_properties(1.0);
        // Faces are flat to 1e-9 of 2 m; what is cut off there is less than that times the surface.
        prop_assert!((sum.mass - properties.mass).abs() < 1e-7);
        prop_assert!(sum.centre.distance(properties.centre) < 1e-7);
        prop_assert!(sum.inertia.diagonal.distance(properties.inertia.diagonal) < 1e-7);
        prop_assert!(sum.inertia.off_diagonal.distance(properties.inertia.off_diagonal) < 1e-7);
    }

    #[test]
    fn inertia_of_every_shape_is_one_that_matter_can_have(shape in solid()) {
        let properties = shape.mass_properties(2.0).unwrap();
        let [small, middle, large] = properties.inertia.principal_moments();
        // A rod has no moment along its line, to rounding.
        prop_assert!(small > -1e-14 && small + middle >= large * (1.0 - 1e-12));
        let given = MassProperties::try_given(properties.mass, properties.centre, properties.inertia);
        prop_assert!(given.is_ok() || matches!(shape, SpatialShape::SpatialRod(_)));
    }

    #[test]
    fn principal_moments_do_not_depend_on_the_axes(
        moments in (0.1..5.0_f64, 0.1..5.0_f64, 0.1..5.0_f64), by in pose(1.0),
    ) {
        let tensor = SymmetricTensor::from_diagonal(moments.into()).in_world(&by.rotation);
        let mut expected = [moments.0, moments.1, moments.2];
        expected.sort_by(f64::total_cmp);
        for (found, expected) in tensor.principal_moments().into_iter().zip(expected) {
            // A few roundings of numbers below 10.
            prop_assert!((found - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn a_rod_split_in_two_weighs_the_same(ends in (vector(1.0), vector(1.0)), share in 0.1..0.9_f64) {
        let (from, to) = ends;
        let between = from + (to - from) * share;
        let mass = |p, q| SpatialRod::try_new(p, q, 0.0).unwrap().mass_properties(1.7);
        let (whole, sum) = (mass(from, to), MassProperties::combine([mass(from, between), mass(between, to)]).unwrap());
        prop_assert!((whole.mass - sum.mass).abs() < 1e-13 && whole.centre.distance(sum.centre) < 1e-13);
        prop_assert!(whole.inertia.diagonal.distance(sum.inertia.diagonal) < 1e-13);
        prop_assert!(whole.inertia.off_diagonal.distance(sum.inertia.off_diagonal) < 1e-13);
    }

    #[test]
    fn bounds_and_extent_hold_every_shape_tightly(shape in solid(), at in pose(3.0), direction in vector(1.0)) {
        let bounds = shape.bounds(&at).unwrap();
        let posed = shape.posed(&at).bounds(&Pose::default()).unwrap();
        prop_assert!(bounds.min.distance(posed.min) < 1e-13 && bounds.max.distance(posed.max) < 1e-13);
        // Seen from very far away along a direction, the farthest point is the support.
        let far = 1e5;
        let away = shape.extent_about(-direction.normalize() * far).unwrap() - far;
        let centre = shape.mass_properties(1.0).unwrap().centre;
        prop_assert!(away >= direction.normalize().dot(centre) - 1e-4);
        prop_assert!(shape.extent_about(centre).unwrap() <= bounds.size().length());
    }
}

#[test]
fn inertia_given_outright_is_checked() {
    let tensor = |x: f64, y: f64, z: f64| SymmetricTensor::from_diagonal(dvec3(x, y, z));
    let given = |mass: f64, inertia| MassProperties::try_given(mass, DVec3::ZERO, inertia).err();
    assert_eq!(given(1.0, tensor(1.0, 2.0, 3.0)), None);
    assert_eq!(given(0.0, tensor(1.0, 1.0, 1.0)), Some(MassError::MassNotPositive { mass: 0.0 }));
    assert_eq!(given(1.0, tensor(1.0, 0.0, 1.0)), Some(MassError::MomentNotPositive { moment: 0.0 }));
    let too_large = MassError::TriangleInequality { small: 1.0, middle: 1.5, large: 3.0 };
    assert_eq!(given(1.0, tensor(3.0, 1.0, 1.5)), Some(too_large));
    assert_eq!(given(1.0, tensor(f64::NAN, 1.0, 1.0)), Some(MassError::NotFinite));
    // The wrong sign at row 1, column 3 of a tensor makes one that no body has.
    let wrong = DMat3::from_cols(dvec3(1.0, 0.0, 0.9), dvec3(0.0, 1.0, 0.0), dvec3(0.9, 0.0, 0.3));
    assert!(matches!(given(1.0, SymmetricTensor::from_matrix(wrong)), Some(MassError::MomentNotPositive { .. })));
    assert_eq!(
        too_large.to_string(),
        "the principal moments 1, 1.5 and 3 kg·m² belong to no body: the largest is more than the other two together"
    );
}

#[test]
fn solids_come_from_a_strategy_that_makes_them_all() {
    // Guards the property tests above: a strategy that never made a cone would test none.
    use proptest::strategy::{Strategy, ValueTree};
    let mut runner = proptest::test_runner::TestRunner::new(config(1));
    let names: std::collections::BTreeSet<String> = (0..200)
        .map(|_| format!("{:?}", solid().new_tree(&mut runner).unwrap().current()))
        .map(|text| text.split('(').next().unwrap_or_default().to_owned())
        .collect();
    assert_eq!(names.len(), 7, "{names:?}");
}
