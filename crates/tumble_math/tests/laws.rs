//! Laws of rotations, inertia and contact frames, in the plane and in space.

use approx::assert_relative_eq;
use glam::{DMat3, DVec2, DVec3, dvec2, dvec3};
use proptest::prelude::*;
use tumble_math::{
    Bounds, Dim, Inertia, Matrix, Planar, PlanarRotation, Pose, Rotation, Spatial, SpatialRotation, SymmetricTensor,
    trig,
};

fn vector2() -> impl Strategy<Value = DVec2> {
    (-10.0..10.0, -10.0..10.0).prop_map(|(x, y)| dvec2(x, y))
}

fn vector3() -> impl Strategy<Value = DVec3> {
    (-10.0..10.0, -10.0..10.0, -10.0..10.0).prop_map(|(x, y, z)| dvec3(x, y, z))
}

/// A positive definite tensor: A Aᵀ + 1.
fn tensor() -> impl Strategy<Value = SymmetricTensor> {
    (vector3(), vector3(), vector3()).prop_map(|(x, y, z)| {
        let a = DMat3::from_cols(x, y, z) * 0.1;
        SymmetricTensor::from_matrix(a * a.transpose() + DMat3::IDENTITY)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    // Tolerances: a few roundings of numbers up to 1e3.

    #[test]
    fn power_is_the_same_through_arm_or_torque(w in -10.0..10.0, r in vector2(), f in vector2()) {
        prop_assert!((Planar::spin(w, r).dot(f) - w * Planar::torque(r, f)).abs() < 1e-11);
    }

    #[test]
    fn power_is_the_same_through_arm_or_torque_in_space(w in vector3(), r in vector3(), f in vector3()) {
        prop_assert!((Spatial::spin(w, r).dot(f) - w.dot(Spatial::torque(r, f))).abs() < 1e-11);
    }

    #[test]
    fn planar_rotation_is_undone(angle in -100.0..100.0, v in vector2()) {
        let rotation = PlanarRotation::from_angle(angle);
        prop_assert!((rotation.unrotate(rotation.rotate(v)) - v).length() < 1e-13);
        prop_assert!((rotation.to_matrix() * v - rotation.rotate(v)).length() < 1e-13);
    }

    #[test]
    fn spatial_rotation_is_undone(angle in vector3(), v in vector3()) {
        let rotation = SpatialRotation::from_rotation_vector(angle);
        prop_assert!((rotation.unrotate(rotation.rotate(v)) - v).length() < 1e-13);
        prop_assert!((rotation.quaternion().length() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_rotation_vector_is_found_again(axis in vector3(), angle in 0.0..3.1, tiny in 0.0..1e-3, start in vector3()) {
        for angle in [angle, tiny] {
            let vector = axis.normalize() * angle;
            let rotation = SpatialRotation::from_rotation_vector(vector);
            // Near a half turn the sine of the half angle is flat.
            prop_assert!((rotation.rotation_vector() - vector).length() < 1e-13);
            let start = SpatialRotation::from_rotation_vector(start);
            prop_assert!((start.turn_to(&start.turned(vector)).rotation_vector() - vector).length() < 1e-13);
        }
    }

    #[test]
    fn turning_about_z_is_the_plane(angle in -3.0..3.0, more in -3.0..3.0, v in vector2()) {
        let planar = PlanarRotation::from_angle(angle).turned(more).rotate(v);
        let spatial = SpatialRotation::from_rotation_vector(DVec3::Z * angle).turned(DVec3::Z * more);
        prop_assert!((spatial.rotate(v.extend(0.0)).truncate() - planar).length() < 1e-13);
    }

    #[test]
    fn small_turns_follow_the_cross_product(w in vector3(), v in vector3()) {
        // exp(h w) v = v + h w × v + O(h²): the second term is below h² |w|² |v| / 2.
        let h = 1e-6;
        let turned = SpatialRotation::IDENTITY.turned(w * h).rotate(v);
        prop_assert!((turned - v - w.cross(v) * h).length() < 0.5 * (h * 18.0) * (h * 18.0) * 18.0 + 1e-14);
    }

    #[test]
    fn inverse_inertia_undoes_inertia(tensor in tensor(), w in vector3()) {
        let inverse = tensor.try_inverse().unwrap();
        prop_assert!((inverse.apply(tensor.apply(w)) - w).length() < 1e-12 * 10.0);
    }

    #[test]
    fn inertia_seen_from_world_axes_is_the_product(tensor in tensor(), angle in vector3(), w in vector3()) {
        let rotation = SpatialRotation::from_rotation_vector(angle);
        let direct = rotation.rotate(tensor.apply(rotation.unrotate(w)));
        prop_assert!((tensor.in_world(&rotation).apply(w) - direct).length() < 1e-11);
    }

    #[test]
    fn contact_frames_are_orthonormal_and_right_handed(v in vector3()) {
        prop_assume!(v.length() > 1e-3);
        let normal = v.normalize();
        let frame = Spatial::contact_frame(normal);
        prop_assert_eq!(frame.column(0), normal);
        prop_assert!((frame.determinant() - 1.0).abs() < 1e-14);
        prop_assert!((frame.apply_transposed(frame.apply(v)) - v).length() < 1e-13);
    }

    #[test]
    fn free_turning_keeps_angular_momentum(tensor in tensor(), angle in vector3(), w in vector3(), dt in 1e-4..0.1) {
        let inverse = tensor.try_inverse().unwrap();
        let start = SpatialRotation::from_rotation_vector(angle);
        let momentum = tensor.in_world(&start).apply(w);
        let (turned, after) = Spatial::turn_freely(start, &tensor, &inverse, w, dt);
        let kept = tensor.in_world(&turned).apply(after);
        // The condition number of these tensors is below 1e2.
        prop_assert!((kept - momentum).length() <= 1e-12 * momentum.length().max(1.0));
    }

    #[test]
    fn midpoint_rate_solves_its_equation(tensor in tensor(), angle in vector3(), w in vector3(), dt in 1e-6..0.1) {
        let inverse = tensor.try_inverse().unwrap();
        let rotation = SpatialRotation::from_rotation_vector(angle);
        let momentum = tensor.in_world(&rotation).apply(w);
        let rate = Spatial::midpoint_rate(rotation, &tensor, &inverse, w, dt);
        let middle = rotation.turned(rate * (0.5 * dt));
        let should = inverse.in_world(&middle).apply(momentum);
        // The condition number of these tensors is below 1e2.
        prop_assert!((rate - should).length() <= 1e-13 * (1.0 + should.length()), "{rate} is not {should}");
    }

    #[test]
    fn midpoint_rate_stays_bounded_in_steps_of_many_turns(tensor in tensor(), w in vector3(), dt in 0.1..100.0) {
        let inverse = tensor.try_inverse().unwrap();
        let rate = Spatial::midpoint_rate(SpatialRotation::IDENTITY, &tensor, &inverse, w, dt);
        // Whatever the rotation, no more than I⁻¹ makes of L: the condition number of these tensors is below 1e2.
        prop_assert!(rate.length() <= 1e2 * w.length(), "{rate} of {w}");
    }

    #[test]
    fn series_of_turning_meet_the_functions(x in 1e-3..10.0_f64) {
        let (sinc, versinc) = trig::sinc_and_versinc(x * x);
        prop_assert!((sinc - trig::sin(x) / x).abs() < 4e-16, "{sinc}");
        let half = trig::sin(0.5 * x);
        prop_assert!((versinc - 2.0 * half * half / (x * x)).abs() < 4e-16, "{versinc}");
    }

    #[test]
    fn bounds_hold_what_they_were_made_around(a in vector2(), b in vector2(), c in vector2()) {
        let all = Bounds::around([a, b, c]);
        prop_assert!(all.contains(&Bounds::around([a, c])));
        prop_assert!(all.overlaps(&Bounds::around([b])));
        prop_assert!(!all.overlaps(&Bounds::around([all.max + dvec2(1e-9, 0.0)])));
    }

    #[test]
    fn poses_undo_themselves(x in vector2(), angle in -10.0..10.0, p in vector2()) {
        let pose = Pose::<Planar> { position: x, rotation: PlanarRotation::from_angle(angle) };
        prop_assert!((pose.inverse_transform_point(pose.transform_point(p)) - p).length() < 1e-13);
    }
}

#[test]
fn planar_tangent_is_the_normal_turned_clockwise() {
    let frame = Planar::contact_frame(dvec2(0.0, 1.0));
    assert_eq!(frame.column(1), dvec2(1.0, 0.0));
}

#[test]
fn planar_angle_accumulates_over_turns() {
    let mut rotation = PlanarRotation::IDENTITY;
    for _ in 0..100 {
        rotation = rotation.turned(1.0);
    }
    // 100 additions of 1 are exact.
    assert_eq!(rotation.angle(), 100.0);
    assert_relative_eq!(rotation.cos(), trig::cos(100.0));
}

#[test]
fn a16_inertia_in_world_axes() {
    let body = SymmetricTensor::from_diagonal(dvec3(6.5, 5.0, 2.5));
    let degrees = |d: f64| d.to_radians();
    let rotation = SpatialRotation::from_rotation_vector(DVec3::X * degrees(40.0)).turned(DVec3::Z * degrees(30.0));
    let world = body.in_world(&rotation);
    // The figures have twelve digits.
    for (is, should) in [
        (world.diagonal.x, 5.86676505552),
        (world.diagonal.y, 4.60029516656),
        (world.diagonal.z, 3.53293977792),
        (world.off_diagonal.z, 1.09679509697),
        (world.off_diagonal.y, -0.615504845633),
        (world.off_diagonal.x, 1.06608566494),
    ] {
        assert!((is - should).abs() < 1e-11, "{is} is not {should}");
    }
}

/// Steps a free body for a while; returns its rate of turn in body axes and the worst relative error of its energy.
fn spin_freely(inertia: DVec3, start: DVec3, dt: f64, duration: f64) -> (DVec3, f64) {
    let inertia = SymmetricTensor::from_diagonal(inertia);
    let inverse = inertia.try_inverse().unwrap();
    let energy = |rotation: &SpatialRotation, w: DVec3| 0.5 * w.dot(inertia.in_world(rotation).apply(w));
    let (mut rotation, mut w) = (SpatialRotation::IDENTITY, start);
    let first = energy(&rotation, w);
    let mut worst: f64 = 0.0;
    for _ in 0..(duration / dt).round() as u64 {
        (rotation, w) = Spatial::turn_freely(rotation, &inertia, &inverse, w, dt);
        worst = worst.max((energy(&rotation, w) / first - 1.0).abs());
    }
    (rotation.unrotate(w), worst)
}

#[test]
fn free_rotation_is_second_order() {
    // G4: a tumbling box, its rate of turn in body axes after 5 s, known to nine digits.
    let inertia = dvec3(0.0433333333333333, 0.0333333333333333, 0.0166666666666667);
    let expected = dvec3(0.280861940815, -2.43226693971, 2.75010148003);
    let error = |dt: f64| (spin_freely(inertia, dvec3(1.0, 2.0, 3.0), dt, 5.0).0 - expected).length();
    let ratio = error(0.01) / error(0.005);
    // Halving the step divides the error of a second-order method by four, up to the next order.
    assert!((ratio - 4.0).abs() < 0.2, "ratio {ratio}");
}

#[test]
fn energy_of_free_rotation_does_not_drift() {
    // Symmetric in time, so the error swings and does not grow: ten times the time, the same bound.
    let inertia = dvec3(1.0, 2.0, 3.0);
    let start = dvec3(0.01, 5.0, 0.01);
    let (_, short) = spin_freely(inertia, start, 0.01, 20.0);
    let (_, long) = spin_freely(inertia, start, 0.01, 200.0);
    assert!(long < 1.5 * short, "{short} grew to {long}");
}
