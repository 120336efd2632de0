//! The same models in space: a table on four legs, a ball on a rough floor.

use glam::{DVec3, dvec3};
use tumble_math::{Dim, Spatial, SymmetricTensor};
use tumble_solver::resting_lcp::{Acceleration, Gap, NormalCarrier, RestingLcp, RestingSettings, RestingStatus};
use tumble_solver::velocity_lcp::{Rebound, Restitution, VelocityLcp, VelocitySettings};
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
    for ([x, y], expected) in TABLES {
        let (mut bodies, mut rows) = table(x, y, 0.0);
        bodies[1].velocity = dvec3(0.0, 0.0, -9.81 * dt);
        let report = VelocityLcp::default().filter(&mut bodies, &mut rows, None, &VelocitySettings::default());
        assert_eq!(report.ending, Ending::Converged);
        for (row, force) in rows.iter().zip(expected) {
            // Impulses of 0.04 N·s, to rounding.
            assert!((row.impulse.x - force * dt).abs() < 1e-14, "{} {}", row.impulse, force * dt);
        }
        assert!(bodies[1].velocity.length() < 1e-15 && bodies[1].angular_velocity.length() < 1e-15);
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
