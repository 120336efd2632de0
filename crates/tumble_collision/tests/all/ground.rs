//! Meshes and height fields: nothing catches on inner edges, and what is touched is touched once.

use crate::spatial::{boxed, config, query, rod, sphere, turned, vector};
use glam::{DVec2, DVec3, dvec2, dvec3};
use proptest::prelude::{prop_assert, proptest};
use tumble_collision::{SpatialManifold, collide_spatial};
use tumble_math::{Pose, Spatial};
use tumble_shape::{MeshError, SpatialShape, TriangleMesh};

fn facets(mesh: &TriangleMesh) -> Vec<SpatialShape> {
    mesh.facets().map(SpatialShape::from).collect()
}

/// Every contact of a shape with the facets of a mesh at the origin.
fn contacts(mesh: &[SpatialShape], shape: &SpatialShape, pose: &Pose<Spatial>, flush: f64) -> Vec<SpatialManifold> {
    let each = mesh.iter().map(|facet| collide_spatial(facet, &Pose::default(), shape, pose, &query(0.05, flush)));
    each.filter(|manifold| !manifold.is_empty()).collect()
}

fn flat() -> Vec<SpatialShape> {
    facets(&TriangleMesh::from_heights(dvec2(0.7, 0.9), 8, &[0.0; 64], 1.0).unwrap())
}

/// Two slopes that meet in a line along y at x = 1: a ridge for a positive height, a valley for a negative one.
fn roof(height: f64) -> Vec<SpatialShape> {
    let heights = [0.0, height, 0.0, 0.0, height, 0.0];
    facets(&TriangleMesh::from_heights(dvec2(1.0, 4.0), 3, &heights, 1.0).unwrap())
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn flat_ground_is_a_plane_wherever_something_touches_it(x in 1.5..3.4_f64, y in 1.5..4.8_f64, turn in vector(3.0), depth in 0.0..0.004_f64) {
        let mesh = flat();
        for shape in [sphere(0.4), rod(0.8, 0.1), rod(0.8, 0.0), boxed(0.3, 0.4, 0.5)] {
            let lowest = shape.bounds(&turned(DVec3::ZERO, turn)).unwrap().min.z;
            let pose = turned(dvec3(x, y, -lowest - depth), turn);
            let found = contacts(&mesh, &shape, &pose, 0.01);
            prop_assert!(!found.is_empty());
            prop_assert!(found.iter().all(|manifold| manifold.normal.distance(DVec3::Z) < 1e-9), "{found:#?}");
            let deepest = found.iter().filter_map(SpatialManifold::deepest_separation).fold(f64::INFINITY, f64::min);
            // Some ten roundings of numbers below 10.
            prop_assert!((deepest + depth).abs() < 1e-12, "{deepest} {depth}");
        }
    }
}

#[test]
fn a_ball_rolls_over_a_ridge_with_a_normal_that_turns_steadily() {
    let mesh = roof(0.3);
    let ball = sphere(0.2);
    let slope = dvec3(-0.3, 0.0, 1.0).normalize();
    let mut before: Option<DVec3> = None;
    for i in 0..=2000 {
        // Along the left slope, round the ridge, and down the right one, 1 mm above the ground.
        let s = f64::from(i) / 1000.0 - 1.0;
        let ridge = dvec3(1.0, 2.0, 0.3);
        let angle = 0.6 * s;
        let lean = tumble_math::trig::atan2(0.3, 1.0);
        let (sin, cos) = tumble_math::trig::sin_cos(angle.clamp(-lean, lean));
        let out = dvec3(sin, 0.0, cos);
        let along = dvec3(cos, 0.0, -sin) * (angle - angle.clamp(-lean, lean));
        let found = contacts(&mesh, &ball, &turned(ridge + along + out * 0.201, DVec3::ZERO), 0.01);
        assert!(!found.is_empty(), "{i}");
        for manifold in &found {
            assert!(manifold.normal.distance(out) < 1e-9, "{i} {out} {manifold:#?}");
            assert!((manifold.points()[0].separation - 1e-3).abs() < 1e-9);
        }
        assert!(before.is_none_or(|before| before.distance(found[0].normal) < 2e-3));
        before = Some(found[0].normal);
    }
    assert!(before.unwrap().distance(dvec3(-slope.x, 0.0, slope.z)) < 1e-12);
}

#[test]
fn a_ball_in_a_valley_touches_both_slopes_and_no_edge() {
    let found = contacts(&roof(-0.3), &sphere(0.5), &turned(dvec3(1.0, 2.0, -0.3 + 0.52), DVec3::ZERO), 0.01);
    let mut leaning: Vec<f64> = found.iter().map(|manifold| manifold.normal.x).collect();
    leaning.sort_by(f64::total_cmp);
    leaning.dedup_by(|one, other| (*one - *other).abs() < 1e-12);
    let lean = 0.3 / 1.09_f64.sqrt();
    assert!(
        leaning.len() == 2 && (leaning[0] + lean).abs() < 1e-12 && (leaning[1] - lean).abs() < 1e-12,
        "{leaning:?}"
    );
}

#[test]
fn meshes_that_make_no_ground_are_refused_with_the_reason() {
    let square = [DVec3::ZERO, DVec3::X, dvec3(1.0, 1.0, 0.0), DVec3::Y];
    let mesh = |triangles: &[[u32; 3]]| TriangleMesh::try_new(square, triangles, 1.0).err();
    assert_eq!(mesh(&[[0, 1, 2], [0, 2, 3]]), None);
    assert_eq!(mesh(&[]), Some(MeshError::Empty));
    assert_eq!(mesh(&[[0, 1, 4]]), Some(MeshError::MissingVertex { triangle: 0, vertex: 4, count: 4 }));
    assert_eq!(mesh(&[[0, 1, 2], [0, 0, 3]]), Some(MeshError::NoArea { triangle: 1 }));
    let turned_over = MeshError::SharedSide { first: 0, second: 1, from: 2, to: 0 };
    assert_eq!(mesh(&[[0, 1, 2], [3, 2, 0]]), Some(turned_over));
    let thin = TriangleMesh::try_new(square, [[0, 1, 2]], 0.0).err();
    assert_eq!(thin, Some(MeshError::ThicknessNotPositive { thickness: 0.0 }));
    let rows = TriangleMesh::from_heights(DVec2::ONE, 3, &[0.0; 7], 1.0).err();
    assert_eq!(rows, Some(MeshError::Rows { count: 7, columns: 3 }));
    let nowhere = TriangleMesh::from_heights(DVec2::ONE, 2, &[f64::NAN; 4], 1.0).err();
    assert_eq!(nowhere, Some(MeshError::NotFinite));
}
