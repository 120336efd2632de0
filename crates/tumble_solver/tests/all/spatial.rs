//! The same models in space: a table on four legs, a ball on a rough floor, joints that hold directions.

use glam::{DMat3, DVec3, dvec3};
use proptest::prelude::*;
use tumble_math::{Dim, Inertia, Rotation, Spatial, SpatialRotation, SymmetricTensor};
use tumble_solver::joint::{JointBlock, JointEnds, JointRow, revolute, spatial};
use tumble_solver::resting_lcp::{
    Acceleration, Gap, NormalCarrier, RestingLcp, RestingReport, RestingSettings, RestingStatus,
};
use tumble_solver::velocity_lcp::{Rebound, Restitution, VelocityLcp, VelocitySettings, VelocitySolver};
use tumble_solver::{ContactRow, Ending, Slip, SolverBody, Surface};

type Body = SolverBody<Spatial>;
type Row = ContactRow<Spatial>;

fn body(mass: f64, inertia: DVec3) -> Body {
    Body {
        inverse_mass: DVec3::splat(1.0 / mass),
        inverse_inertia: SymmetricTensor::from_diagonal(inertia.recip()),
        ..Body::default()
    }
}

fn on_floor(arm: DVec3, friction: f64, restitution: f64) -> Row {
    Row {
        a: 0,
        b: 1,
        frame: Spatial::contact_frame(DVec3::Z),
        arm_a: DVec3::ZERO,
        arm_b: arm,
        separation: 0.0,
        allowance: 0.0,
        surface: Surface { static_friction: friction, kinetic_friction: friction, restitution },
        impulse: DVec3::ZERO,
        slip: Slip::Sticking,
    }
}

/// A table of 10 kg with feet at (±0.5, ±0.5) and its centre of mass at (x, y), in the order of E2.
fn table(x: f64, y: f64, friction: f64) -> ([Body; 2], [Row; 4]) {
    let feet = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let rows = feet.map(|(foot_x, foot_y)| on_floor(dvec3(foot_x - x, foot_y - y, -1.0), friction, 0.0));
    ([Body::default(), body(10.0, dvec3(2.0, 3.0, 4.0))], rows)
}

/// Centre of mass and the forces of least norm [N].
const TABLES: [([f64; 2], [f64; 4]); 2] = [([0.0, 0.0], [24.525; 4]), ([0.2, 0.1], [9.81, 29.43, 39.24, 19.62])];

#[test]
fn e1_e2_impulses_under_a_table_are_of_least_norm() {
    let dt = 1e-3;
    let exact = [VelocitySolver::Auto, VelocitySolver::Pivoting, VelocitySolver::Newton];
    for (solver, ([x, y], expected)) in exact.into_iter().flat_map(|solver| TABLES.map(|table| (solver, table))) {
        let (mut bodies, mut rows) = table(x, y, 0.0);
        bodies[1].velocity = dvec3(0.0, 0.0, -9.81 * dt);
        let settings = VelocitySettings { solver, ..VelocitySettings::default() };
        let report = VelocityLcp::default().filter(&mut bodies, &mut rows, None, &settings);
        assert_eq!(report.ending, Ending::Converged);
        for (row, force) in rows.iter().zip(expected) {
            // Impulses of 0.04 N·s, to rounding.
            assert!((row.impulse.x - force * dt).abs() < 1e-14, "{solver:?}: {} {}", row.impulse, force * dt);
        }
        assert!(bodies[1].velocity.length() < 1e-15 && bodies[1].angular_velocity.length() < 1e-15);
    }
}

#[test]
fn e1_e2_sweeps_hold_a_table_by_some_shares() {
    let dt = 1e-3;
    for ([x, y], _) in TABLES {
        let (mut bodies, mut rows) = table(x, y, 0.0);
        bodies[1].velocity = dvec3(0.0, 0.0, -9.81 * dt);
        let settings = VelocitySettings { solver: VelocitySolver::BlockGaussSeidel, ..VelocitySettings::default() };
        let report = VelocityLcp::default().filter(&mut bodies, &mut rows, None, &settings);
        assert_eq!(report.ending, Ending::Converged);
        // The tolerance of speeds, 1e-12 m/s, times the mass.
        let sum: f64 = rows.iter().map(|row| row.impulse.x).sum();
        assert!((sum - 98.1 * dt).abs() < 1e-10 && rows.iter().all(|row| row.impulse.x >= 0.0), "{sum}");
        let moment: DVec3 = rows.iter().map(|row| row.arm_b.cross(DVec3::Z * row.impulse.x)).sum();
        assert!(moment.length() < 1e-10, "{moment}");
    }
}

#[test]
fn e1_e2_forces_under_a_table_are_of_least_norm() {
    for ([x, y], expected) in TABLES {
        let (bodies, mut rows) = table(x, y, 0.0);
        let gaps: Vec<Gap<Spatial>> = rows.iter().map(|row| Gap::corner(row, NormalCarrier::A)).collect();
        let falls = Acceleration { linear: dvec3(0.0, 0.0, -9.81), angular: DVec3::ZERO };
        let mut accelerations = [Acceleration::default(), falls];
        let mut forces = Vec::new();
        let settings = RestingSettings::default();
        let report =
            RestingLcp::default().solve(&bodies, &mut accelerations, &mut rows, &gaps, &mut forces, None, &settings);
        assert_eq!(report.status, RestingStatus::Solved);
        for (force, expected) in forces.iter().zip(expected) {
            assert!((force.x - expected).abs() < 1e-12, "{forces:?}");
        }
    }
}

#[test]
fn c10_ball_slides_or_sticks_on_a_rough_floor() {
    let (radius, restitution) = (0.5, 0.7);
    for (friction, speed, turning) in [(0.1, 2.66, 0.85), (0.5, 15.0 / 7.0, 15.0 / 7.0)] {
        for law in [Restitution::Poisson, Restitution::Newton] {
            // Sliding askew to the tangents, which must not show.
            let heading = dvec3(0.6, 0.8, 0.0);
            let mut bodies = [Body::default(), body(2.0, DVec3::splat(0.4 * 2.0 * radius * radius))];
            bodies[1].velocity = 3.0 * heading - 2.0 * DVec3::Z;
            let row = on_floor(dvec3(0.0, 0.0, -radius), friction, restitution);
            let rebounds = [Rebound { restitution, speed: 2.0 * restitution, ..Rebound::default() }];
            let settings = VelocitySettings { restitution: law, ..VelocitySettings::default() };
            VelocityLcp::default().impact(&mut bodies, &[row], &rebounds, &mut Vec::new(), None, &settings);
            let expected = speed * heading + 1.4 * DVec3::Z;
            // Exact but for rounding.
            assert!((bodies[1].velocity - expected).length() < 1e-14, "{friction}: {}", bodies[1].velocity);
            assert!((bodies[1].angular_velocity.length() * radius - turning).abs() < 1e-14);
        }
    }
}

#[test]
fn d8_friction_of_a_sliding_block_is_the_same_in_every_direction() {
    let dt = 1e-3;
    for degrees in [0.0_f64, 15.0, 22.5, 45.0, 80.0] {
        let (sine, cosine) = tumble_math::trig::sin_cos(degrees.to_radians());
        let heading = dvec3(cosine, sine, 0.0);
        // Flat enough that braking shifts little weight.
        let feet = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        let mut rows = feet.map(|(x, y)| on_floor(dvec3(x, y, -0.05), 0.4, 0.0));
        let mut bodies = [Body::default(), body(2.0, dvec3(0.3, 0.3, 0.5))];
        bodies[1].velocity = 2.0 * heading - 9.81 * dt * DVec3::Z;
        let report = VelocityLcp::default().filter(&mut bodies, &mut rows, None, &VelocitySettings::default());
        assert_eq!((report.ending, report.sliding), (Ending::Converged, 4));
        let expected = (2.0 - 0.4 * 9.81 * dt) * heading;
        assert!((bodies[1].velocity - expected).length() < 1e-12, "{degrees}: {}", bodies[1].velocity);
    }
}

/// Two bodies with a constant velocity and rate of turn, each with its copy of a frame, seen at a time.
struct Motion {
    velocities: [DVec3; 2],
    rates: [DVec3; 2],
    arms: [DVec3; 2],
    /// Wrong from the start, by some tenths of a radian.
    frames: [SpatialRotation; 2],
}

impl Motion {
    fn bodies(&self) -> [Body; 2] {
        [0, 1].map(|i| Body {
            velocity: self.velocities[i],
            angular_velocity: self.rates[i],
            ..body(2.0, dvec3(0.3, 0.5, 0.7))
        })
    }

    fn rows(&self, t: f64) -> Vec<JointRow<Spatial>> {
        let arm = |i: usize| SpatialRotation::from_rotation_vector(self.rates[i] * t).rotate(self.arms[i]);
        let ends = JointEnds::at(
            (0, self.velocities[0] * t, arm(0)),
            (1, dvec3(0.2, 0.3, -0.4) + self.velocities[1] * t, arm(1)),
        );
        let [of_a, of_b] = [0, 1].map(|i| self.frames[i].turned(self.rates[i] * t).to_matrix());
        let (frames, bodies, mut rows) = ([&of_a, &of_b], self.bodies(), Vec::new());
        spatial::revolute::push_rows(&ends, frames, &bodies, &mut rows);
        spatial::fixed::push_rows(&ends, frames, &bodies, &mut rows);
        spatial::prismatic::push_rows(&ends, frames, &bodies, &mut rows);
        rows
    }
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| dvec3(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn speed_and_drift_are_the_derivatives_of_the_error(
        arms in (vector(1.0), vector(1.0)),
        velocities in (vector(1.0), vector(1.0)),
        rates in (vector(1.0), vector(1.0)),
        frames in (vector(3.0), vector(0.3)),
    ) {
        let of_a = SpatialRotation::from_rotation_vector(frames.0);
        let motion = Motion {
            velocities: [velocities.0, velocities.1],
            rates: [rates.0, rates.1],
            arms: [arms.0, arms.1],
            frames: [of_a, of_a.turned(frames.1)],
        };
        let h = 1e-4;
        let (before, now, after) = (motion.rows(-h), motion.rows(0.0), motion.rows(h));
        for ((b, n), a) in before.iter().zip(&now).zip(&after) {
            // Central differences: h² of higher derivatives (a few tens), and rounding / h² = 1e-8 in the second.
            prop_assert!((n.speed(&motion.bodies()) - (a.error - b.error) / (2.0 * h)).abs() < 1e-6);
            prop_assert!((n.drift - (a.error - 2.0 * n.error + b.error) / (h * h)).abs() < 1e-5);
        }
    }

    #[test]
    fn joints_in_space_keep_momentum_and_take_energy(
        velocities in (vector(3.0), vector(3.0)),
        rates in (vector(3.0), vector(3.0)),
        turned in vector(3.0),
        point in vector(1.0),
    ) {
        let places = [DVec3::ZERO, dvec3(1.0, 0.2, 0.1)];
        let frame = SpatialRotation::from_rotation_vector(turned).to_matrix();
        let kinds: [fn(&JointEnds<Spatial>, [&DMat3; 2], &[Body], &mut Vec<JointRow<Spatial>>); 4] = [
            |ends, _, bodies, rows| revolute::push_rows(ends, bodies, rows),
            spatial::revolute::push_rows,
            spatial::fixed::push_rows,
            spatial::prismatic::push_rows,
        ];
        for push in kinds {
            let mut bodies = [(velocities.0, rates.0), (velocities.1, rates.1)].map(|(velocity, angular_velocity)| {
                Body { velocity, angular_velocity, ..body(2.0, dvec3(0.3, 0.5, 0.7)) }
            });
            let momenta = |bodies: &[Body]| {
                let own = |body: &Body| body.inverse_inertia.try_inverse().unwrap().apply(body.angular_velocity);
                let angular = |body: &Body, at: DVec3| own(body) + at.cross(body.velocity * 2.0);
                let energy = |body: &Body| body.velocity.length_squared() + 0.5 * body.angular_velocity.dot(own(body));
                (
                    (bodies[0].velocity + bodies[1].velocity) * 2.0,
                    angular(&bodies[0], places[0]) + angular(&bodies[1], places[1]),
                    energy(&bodies[0]) + energy(&bodies[1]),
                )
            };
            let (p, l, energy) = momenta(&bodies);
            let ends = JointEnds::at((0, places[0], point), (1, places[1], point - places[1]));
            let mut rows = Vec::new();
            push(&ends, [&frame, &frame], &bodies, &mut rows);
            let mut block = JointBlock::default();
            block.prepare(&bodies, &rows);
            let report = block.stop(&mut bodies, &mut rows);
            prop_assert_eq!(report.redundant, 0);
            // Speeds and momenta of some units, to rounding.
            prop_assert!(report.residual < 1e-13);
            let (p_after, l_after, energy_after) = momenta(&bodies);
            prop_assert!((p_after - p).length() < 1e-12 && (l_after - l).length() < 1e-12);
            prop_assert!(energy_after <= energy * (1.0 + 1e-14));
        }
    }
}

#[test]
fn a_second_hinge_in_line_is_redundant_and_one_askew_is_named() {
    let bodies = [Body::default(), body(10.0, dvec3(2.0, 3.0, 4.0))];
    let mut rows = Vec::new();
    let frame = DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y);
    for height in [-0.5, 0.5] {
        let ends = JointEnds::at((0, DVec3::ZERO, DVec3::Z * height), (1, DVec3::X, dvec3(-1.0, 0.0, height)));
        spatial::revolute::push_rows(&ends, [&frame, &frame], &bodies, &mut rows);
    }
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let mut moving = bodies;
    moving[1].velocity = dvec3(0.3, 2.0, -1.0);
    let report = block.stop(&mut moving, &mut rows);
    // A door: it keeps its turning about the vertical and nothing else.
    assert_eq!(report.redundant, 5);
    assert!(report.residual < 1e-14 && report.unreachable < 1e-14, "{report:?}");
    assert!((moving[1].velocity - DVec3::Z.cross(DVec3::X) * moving[1].angular_velocity.z).length() < 1e-14);
    // The upper one wants to be 0.2 m further along y than the door reaches: a row of it says so.
    rows[6].error += 0.2;
    let mut displacements = bodies;
    let report = block.correct(&mut displacements, &rows);
    assert!(report.unreachable_row.is_some_and(|row| row >= 5), "{report:?}");
    assert!(report.unreachable > 0.05, "{report:?}");
    assert!(displacements.iter().all(|d| d.velocity.is_finite() && d.angular_velocity.is_finite()));
}

/// Acceleration of a body of 35 kg on four feet whose friction is 0.4 at rest and μ_k in motion, pulled sideways, and how it was found.
fn pulled(heading: DVec3, pull: f64, kinetic_friction: f64) -> (DVec3, RestingReport) {
    let feet = [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)];
    let mut rows = feet.map(|(x, y)| on_floor(dvec3(x, y, -0.5), 0.4, 0.0));
    rows.iter_mut().for_each(|row| row.surface.kinetic_friction = kinetic_friction);
    let bodies = [Body::default(), body(35.0, dvec3(500.0, 500.0, 900.0))];
    let gaps: Vec<Gap<Spatial>> = rows.iter().map(|row| Gap::corner(row, NormalCarrier::A)).collect();
    let linear = heading * (pull / 35.0) - DVec3::Z * 9.81;
    let mut accelerations = [Acceleration::default(), Acceleration { linear, angular: DVec3::ZERO }];
    let (settings, forces) = (RestingSettings::default(), &mut Vec::new());
    let report = RestingLcp::default().solve(&bodies, &mut accelerations, &mut rows, &gaps, forces, None, &settings);
    assert!(accelerations[1].angular.length() < 1e-9, "{}", accelerations[1].angular);
    (accelerations[1].linear, report)
}

#[test]
fn d9_friction_at_rest_holds_alike_in_every_direction() {
    // Weight 343.35 N, of which 0.4 hold 137.34 N.
    for degrees in [0.0_f64, 30.0, 45.0, 60.0, 100.0] {
        let (sine, cosine) = tumble_math::trig::sin_cos(degrees.to_radians());
        let heading = dvec3(cosine, sine, 0.0);
        for (pull, kinetic_friction, left) in
            [(137.33, 0.4, 0.0), (150.0, 0.4, 150.0 - 137.34), (150.0, 0.2, 150.0 - 68.67)]
        {
            let (acceleration, report) = pulled(heading, pull, kinetic_friction);
            assert_eq!(report.status, RestingStatus::Solved);
            // The tolerance of accelerations, of 10 m/s².
            let off = acceleration - heading * (left / 35.0);
            assert!(off.length() < 1e-9, "{degrees}°, {pull} N: off by {off}");
        }
    }
}

#[test]
fn resting_points_in_space_take_few_iterations() {
    // Newton's method, to begin with and again with μ_k; pivoting took one for each row.
    let (_, report) = pulled(DVec3::X, 150.0, 0.2);
    assert!(report.iterations <= 20, "{report:?}");
}
