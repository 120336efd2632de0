//! How gaps of space accelerate without contact forces: against the second difference of the gap itself.

use glam::{DMat3, DVec3, dvec3};
use tumble_math::{Dim, Rotation, Spatial, SpatialRotation};
use tumble_solver::resting_lcp::{Gap, NormalCarrier};
use tumble_solver::{ContactRow, Slip, SolverBody, Surface};

/// Step of the differences [s]: its square times the fourth derivative and round-off over its square are both near 1e-6.
const STEP: f64 = 1e-4;

/// A body that moves evenly and turns with a constant rate, seen at a time.
#[derive(Clone, Copy)]
struct Course {
    at: DVec3,
    velocity: DVec3,
    spin: DVec3,
}

impl Course {
    const STILL: Self = Self { at: DVec3::ZERO, velocity: DVec3::ZERO, spin: DVec3::ZERO };

    fn position(&self, time: f64) -> DVec3 {
        self.at + self.velocity * time
    }

    /// A vector that is carried along.
    fn carried(&self, vector: DVec3, time: f64) -> DVec3 {
        SpatialRotation::from_rotation_vector(self.spin * time).rotate(vector)
    }

    fn body(&self) -> SolverBody<Spatial> {
        SolverBody { velocity: self.velocity, angular_velocity: self.spin, ..SolverBody::default() }
    }
}

/// The drift of the gap of a point, with arms from the two courses' centres.
fn opening(
    courses: [Course; 2],
    normal: DVec3,
    point: DVec3,
    gap: impl Fn(&ContactRow<Spatial>) -> Gap<Spatial>,
) -> f64 {
    let row = ContactRow {
        a: 0,
        b: 1,
        frame: Spatial::contact_frame(normal),
        arm_a: point - courses[0].at,
        arm_b: point - courses[1].at,
        separation: 0.0,
        allowance: 0.0,
        surface: Surface::default(),
        impulse: DVec3::ZERO,
        slip: Slip::Sticking,
    };
    gap(&row).drift(&row, &courses.map(|course| course.body()))[0]
}

/// d²/dt² of a gap at time 0 by differences.
fn bend(gap: impl Fn(f64) -> f64) -> f64 {
    (gap(STEP) - 2.0 * gap(0.0) + gap(-STEP)) / (STEP * STEP)
}

fn assert_alike(drift: f64, measured: f64) {
    assert!((drift - measured).abs() < 1e-5 * (1.0 + measured.abs()), "{drift} by formula, {measured} by differences");
}

#[test]
fn the_rim_of_a_turning_disc_over_a_turning_plane() {
    for (tilt, spins) in [
        (0.0, [DVec3::ZERO, dvec3(0.0, 7.0, 0.0)]),
        (0.0, [DVec3::ZERO, dvec3(1.5, 7.0, -2.0)]),
        (0.6, [DVec3::ZERO, dvec3(1.5, 7.0, -2.0)]),
        (0.6, [dvec3(0.5, -0.8, 0.3), dvec3(1.5, 7.0, -2.0)]),
    ] {
        let (sine, cosine) = tumble_math::trig::sin_cos(tilt);
        let (axis, radius) = (dvec3(0.0, cosine, sine), 0.3);
        // The lowest point of the rim is at the origin, the centre of mass beside the middle of the disc.
        let middle = dvec3(0.0, -sine, cosine) * radius;
        let disc = Course { at: middle + axis * 0.1, velocity: dvec3(0.4, -0.3, 0.2), spin: spins[1] };
        let plane = Course { at: dvec3(0.2, 0.1, -0.5), velocity: dvec3(0.1, 0.2, -0.1), spin: spins[0] };
        let gap = |time: f64| {
            let normal = plane.carried(DVec3::Z, time);
            let middle = disc.position(time) + disc.carried(middle - disc.at, time);
            let along = normal.dot(disc.carried(axis, time));
            let top = plane.position(time) + plane.carried(-plane.at, time);
            normal.dot(middle - top) - radius * (1.0 - along * along).sqrt()
        };
        assert!(gap(0.0).abs() < 1e-15);
        let drift = opening([plane, disc], DVec3::Z, DVec3::ZERO, |row| Gap {
            feature_b: middle - disc.at,
            circles: [None, Some(axis)],
            ..Gap::corner(row, NormalCarrier::A)
        });
        assert_alike(drift, bend(gap));
    }
}

#[test]
fn two_edges_that_cross_while_both_turn() {
    for spins in [[DVec3::ZERO, dvec3(0.0, 3.0, 0.0)], [dvec3(1.0, -2.0, 0.5), dvec3(-0.7, 1.2, 2.0)]] {
        let edges = [DVec3::X, dvec3(0.6, 0.8, 0.0)];
        let lower = Course { at: dvec3(0.1, -0.2, -0.4), velocity: dvec3(0.2, 0.0, 0.1), spin: spins[0] };
        let upper = Course { at: dvec3(-0.3, 0.2, 0.5), velocity: dvec3(0.0, 0.3, -0.2), spin: spins[1] };
        let gap = |time: f64| {
            let [along_a, along_b] = [lower.carried(edges[0], time), upper.carried(edges[1], time)];
            let normal = along_a.cross(along_b).normalize();
            let on = |course: &Course, point: DVec3| course.position(time) + course.carried(point - course.at, time);
            normal.dot(on(&upper, DVec3::ZERO) - on(&lower, DVec3::ZERO))
        };
        let carrier = NormalCarrier::Edges(edges[0], edges[1]);
        let drift = opening([lower, upper], DVec3::Z, DVec3::ZERO, |row| Gap::corner(row, carrier));
        assert_alike(drift, bend(gap));
    }
}

#[test]
fn a_rolling_cylinder_neither_presses_nor_slips_by_turning() {
    let (axis, radius) = (DVec3::Y, 0.1);
    let log = Course { at: dvec3(0.0, 0.2, radius), velocity: DVec3::X * 15.6, spin: DVec3::Y * 156.0 };
    let row = ContactRow {
        a: 0,
        b: 1,
        frame: DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
        arm_a: DVec3::ZERO,
        arm_b: -log.at,
        separation: 0.0,
        allowance: 0.0,
        surface: Surface::default(),
        impulse: DVec3::ZERO,
        slip: Slip::Sticking,
    };
    let gap = Gap { feature_b: DVec3::Y * -0.2, circles: [None, Some(axis)], ..Gap::corner(&row, NormalCarrier::A) };
    let drift = gap.drift(&row, &[Course::STILL.body(), log.body()]);
    // ω² r is 2434 m/s²: rounding of that.
    assert!(drift.length() < 1e-11, "{drift}");
}
