//! Mass, centre and inertia of rod bodies against closed forms: cases A1–A13 of `docs/validation.md`.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use tumble_math::{Planar, PlanarRotation, Pose, trig};
use tumble_shape::{MassProperties, PlanarShape, Rod};

type Mass = MassProperties<Planar>;

/// A rod and its line density [kg/m].
type Part = (PlanarShape, f64);

fn part(from: (f64, f64), to: (f64, f64), density: f64) -> Part {
    (Rod::try_new(from.into(), to.into(), 0.0).unwrap().into(), density)
}

/// Rods of density 1 through points in order.
fn path(points: &[(f64, f64)]) -> Vec<Part> {
    points.windows(2).map(|ends| part(ends[0], ends[1], 1.0)).collect()
}

/// Corner k of a regular polygon on a circle, the first one straight up [m].
fn on_circle(radius: f64, k: u32, count: u32) -> (f64, f64) {
    let angle = 0.5 * PI + TAU * f64::from(k) / f64::from(count);
    (radius * trig::cos(angle), radius * trig::sin(angle))
}

fn mass_of(parts: &[Part]) -> Mass {
    MassProperties::combine(parts.iter().map(|(rod, density)| rod.mass_properties(*density).unwrap())).unwrap()
}

/// Exact results, so the tolerance of the book (1e-13, where not said otherwise) is round-off alone.
fn assert_mass(parts: &[Part], mass: f64, centre: (f64, f64), inertia: f64, tolerance: f64) {
    let found = mass_of(parts);
    assert!((found.mass - mass).abs() <= tolerance * mass, "{found:?}");
    assert!(found.centre.distance(centre.into()) <= tolerance, "{found:?}");
    assert!((found.inertia - inertia).abs() <= tolerance * inertia, "{found:?}");
}

#[test]
fn a1_rod() {
    assert_mass(&[part((-1.0, 0.0), (1.0, 0.0), 1.5)], 3.0, (0.0, 0.0), 1.0, 1e-13);
}

#[test]
fn a2_l_of_two_rods() {
    let parts = [part((0.0, 0.0), (2.0, 0.0), 1.0), part((0.0, 0.0), (0.0, 1.0), 1.0)];
    assert_mass(&parts, 3.0, (2.0 / 3.0, 1.0 / 6.0), 19.0 / 12.0, 1e-13);
}

#[test]
fn a3_t_of_two_rods() {
    let parts = [part((-1.0, 0.0), (1.0, 0.0), 1.0), part((0.0, 0.0), (0.0, -1.5), 1.0)];
    // Steiner by hand: 2·4/12 + 1.5·2.25/12 + (2·1.5/3.5)·0.75² = 1.43005952381.
    assert_mass(&parts, 3.5, (0.0, -9.0 / 28.0), 8.0 / 12.0 + 3.375 / 12.0 + 27.0 / 56.0, 1e-13);
}

#[test]
fn a4_triangle_of_sides_3_4_5() {
    assert_mass(&path(&[(0.0, 0.0), (3.0, 0.0), (0.0, 4.0), (0.0, 0.0)]), 12.0, (1.0, 1.5), 33.0, 1e-13);
}

#[test]
fn a5_equilateral_frame() {
    let height = 0.75_f64.sqrt();
    assert_mass(&path(&[(0.0, 0.0), (1.0, 0.0), (0.5, height), (0.0, 0.0)]), 3.0, (0.5, height / 3.0), 0.5, 1e-13);
}

#[test]
fn a6_square_frame() {
    let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)];
    assert_mass(&path(&corners), 8.0, (1.0, 1.0), 32.0 / 3.0, 1e-13);
}

#[test]
fn a7_star_of_five_spokes() {
    let spokes: Vec<Part> = (0..5).map(|k| part((0.0, 0.0), on_circle(1.0, k, 5), 1.0)).collect();
    assert_mass(&spokes, 5.0, (0.0, 0.0), 5.0 / 3.0, 1e-13);
}

#[test]
fn a8_pentagram() {
    let corners: Vec<(f64, f64)> = (0..6).map(|k| on_circle(1.0, 2 * k, 5)).collect();
    // The book gives twelve digits.
    assert_mass(&path(&corners), 9.51056516295, (0.0, 0.0), 3.77564049432, 1e-12);
}

#[test]
fn a9_regular_hexagon_frame() {
    // A hexagon of side 1 has circumradius 1; m a² (1 + 3 cot²(π/n))/12 = 6 (1 + 9)/12.
    let corners: Vec<(f64, f64)> = (0..7).map(|k| on_circle(1.0, k, 6)).collect();
    assert_mass(&path(&corners), 6.0, (0.0, 0.0), 5.0, 1e-13);
}

#[test]
fn a10_plus() {
    let parts = [part((-1.0, 0.0), (1.0, 0.0), 1.0), part((0.0, -0.5), (0.0, 0.5), 1.0)];
    assert_mass(&parts, 3.0, (0.0, 0.0), 0.75, 1e-13);
}

#[test]
fn a11_u_of_three_rods() {
    assert_mass(&path(&[(0.0, 2.0), (0.0, 0.0), (1.0, 0.0), (1.0, 2.0)]), 5.0, (0.5, 0.8), 193.0 / 60.0, 1e-13);
}

#[test]
fn a12_t_of_two_densities() {
    let parts = [part((-1.0, 0.0), (1.0, 0.0), 2.0), part((0.0, 0.0), (0.0, -3.0), 0.5)];
    // Steiner by hand: 4·4/12 + 1.5·9/12 + (4·1.5/5.5)·1.5².
    assert_mass(&parts, 5.5, (0.0, -9.0 / 22.0), 4.0 / 3.0 + 1.125 + 27.0 / 11.0, 1e-13);
}

#[test]
fn a13_turning_shifting_and_splitting_change_neither_mass_nor_inertia() {
    let bodies: [Vec<Part>; 4] = [
        path(&[(0.0, 0.0), (3.0, 0.0), (0.0, 4.0), (0.0, 0.0)]),
        path(&[(0.0, 2.0), (0.0, 0.0), (1.0, 0.0), (1.0, 2.0)]),
        (0..5).map(|k| part((0.0, 0.0), on_circle(1.0, k, 5), 1.0)).collect(),
        vec![part((-1.0, 0.0), (1.0, 0.0), 2.0), part((0.0, 0.0), (0.0, -3.0), 0.5)],
    ];
    let pose = Pose::<Planar> { position: DVec2::new(100.0, -50.0), rotation: PlanarRotation::from_angle(1.0) };
    for parts in bodies {
        let original = mass_of(&parts);
        let halves = parts.iter().flat_map(|(rod, density)| {
            let &[from, to] = rod.vertices() else { unreachable!("a rod has two ends") };
            let middle = (from + to) * 0.5;
            [(from, middle), (middle, to)].map(|(from, to)| (Rod::try_new(from, to, 0.0).unwrap().into(), *density))
        });
        let moved: Vec<Part> = halves.map(|(rod, density): Part| (rod.posed(&pose), density)).collect();
        let centre = pose.transform_point(original.centre);
        // At 100 m from the origin, rounding of the ends is 1e-14 m: the book allows 1e-11.
        assert_mass(&moved, original.mass, centre.into(), original.inertia, 1e-11);
    }
}
