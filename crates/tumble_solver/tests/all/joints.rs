//! Joints on plain slices: their rows against finite differences, and the block against mechanics.

use crate::common::{Body, FLOOR, body, contact, kinetic_energy, on_floor, surface};
use glam::{DVec2, dvec2};
use proptest::prelude::*;
use tumble_math::{Dim, Planar};
use tumble_solver::filter::{FilterSettings, filter_velocities_and_joints};
use tumble_solver::impact::{Approach, ImpactSettings, resolve_one_by_one_with_joints};
use tumble_solver::joint::{JointBlock, JointEnds, JointError, JointRow, Joints, distance, fixed, prismatic, revolute};
use tumble_solver::velocity_lcp::{Rebound, VelocityLcp, VelocitySettings};
use tumble_solver::{ContactRow, Ending, Slip, Surface};

type Row = JointRow<Planar>;

fn turned(v: DVec2, angle: f64) -> DVec2 {
    let (sine, cosine) = tumble_math::trig::sin_cos(angle);
    dvec2(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y)
}

/// Two bodies with a constant velocity and rate of turn, seen at a time.
struct Motion {
    places: [DVec2; 2],
    velocities: [DVec2; 2],
    rates: [f64; 2],
    arms: [DVec2; 2],
}

impl Motion {
    fn bodies(&self) -> [Body; 2] {
        [0, 1].map(|i| Body { velocity: self.velocities[i], angular_velocity: self.rates[i], ..body(2.0, 0.5) })
    }

    fn ends(&self, t: f64) -> JointEnds<Planar> {
        let place = |i: usize| self.places[i] + self.velocities[i] * t;
        let arm = |i: usize| turned(self.arms[i], self.rates[i] * t);
        JointEnds::at((0, place(0), arm(0)), (1, place(1), arm(1)))
    }

    /// Rows of all kinds at a time.
    fn rows(&self, t: f64) -> Vec<Row> {
        let (ends, bodies) = (self.ends(t), self.bodies());
        let angle = (self.rates[1] - self.rates[0]) * t;
        let mut rows = Vec::new();
        revolute::push_rows(&ends, &bodies, &mut rows);
        distance::push_rows(&ends, 0.7, &bodies, &mut rows).unwrap();
        fixed::push_rows(&ends, angle, &bodies, &mut rows);
        let axis = turned(dvec2(0.6, 0.8), self.rates[0] * t);
        prismatic::push_rows(&ends, axis, angle, &bodies, &mut rows).unwrap();
        rows
    }
}

fn vector(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(|(x, y)| dvec2(x, y))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn speed_and_drift_are_the_derivatives_of_the_error(
        arms in (vector(1.0), vector(1.0)),
        velocities in (vector(1.0), vector(1.0)),
        rates in (-1.0..1.0_f64, -1.0..1.0_f64),
    ) {
        let motion = Motion {
            // Far enough apart for the distance joint to have a direction throughout.
            places: [DVec2::ZERO, dvec2(4.0, 1.0)],
            velocities: [velocities.0, velocities.1],
            rates: [rates.0, rates.1],
            arms: [arms.0, arms.1],
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
    fn stopping_keeps_momentum_and_takes_energy(
        arms in prop::collection::vec(vector(1.0), 6),
        velocities in prop::collection::vec((vector(3.0), -3.0..3.0_f64), 4),
        masses in prop::collection::vec(0.1..10.0_f64, 4),
    ) {
        let mut bodies: Vec<Body> = masses.iter().zip(&velocities)
            .map(|(m, (v, w))| Body { velocity: *v, angular_velocity: *w, ..body(*m, 0.3 * m) })
            .collect();
        let places: Vec<DVec2> = (0..4).map(|i| dvec2(f64::from(i), 0.0)).collect();
        let mut rows = Vec::new();
        for i in 0..3 {
            // Anchors at one point each, so that the row's forces have no torque between them.
            let point = places[i] + arms[i];
            let ends = JointEnds::at((i as u32, places[i], arms[i]), (i as u32 + 1, places[i + 1], point - places[i + 1]));
            revolute::push_rows(&ends, &bodies, &mut rows);
        }
        let momentum = |bodies: &[Body]| bodies.iter().map(|b| b.velocity / b.inverse_mass.x).sum::<DVec2>();
        let angular = |bodies: &[Body]| bodies.iter().zip(&places)
            .map(|(b, x)| b.angular_velocity / b.inverse_inertia + Planar::torque(*x, b.velocity / b.inverse_mass.x)).sum::<f64>();
        let (p, l, energy) = (momentum(&bodies), angular(&bodies), kinetic_energy(&bodies));
        let mut block = JointBlock::default();
        block.prepare(&bodies, &rows);
        let report = block.stop(&mut bodies, &mut rows);
        prop_assert_eq!(report.redundant, 0);
        // Speeds of a few m/s, solved twice: a few roundings.
        prop_assert!(report.residual < 1e-14, "{}", report.residual);
        prop_assert!((momentum(&bodies) - p).length() < 1e-12 && (angular(&bodies) - l).abs() < 1e-12);
        prop_assert!(kinetic_energy(&bodies) <= energy * (1.0 + 1e-14));
    }

    #[test]
    fn impacts_on_a_chain_keep_its_joints_and_take_energy(
        velocities in prop::collection::vec((vector(3.0), -3.0..3.0_f64), 5),
        contacts in prop::collection::vec((1..6_u32, vector(0.6), vector(1.0), 0.0..1.0_f64, 0.0..1.0_f64), 1..6),
    ) {
        let (mut bodies, mut rows) = chain(5);
        for (body, (velocity, turning)) in bodies[1..].iter_mut().zip(velocities) {
            (body.velocity, body.angular_velocity) = (velocity, turning);
        }
        let contacts: Vec<ContactRow<Planar>> = contacts.into_iter().map(|(body, arm, normal, friction, restitution)| {
            let normal = normal.try_normalize().unwrap_or(DVec2::Y);
            contact([0, body], normal, [DVec2::ZERO, arm], surface(friction, restitution))
        }).collect();
        let mut block = JointBlock::default();
        block.prepare(&bodies, &rows);
        block.stop(&mut bodies, &mut rows);
        let before = kinetic_energy(&bodies);
        let rebounds: Vec<Rebound> =
            contacts.iter().map(|row| Rebound { restitution: row.surface.restitution, speed: 0.0, ..Rebound::default() }).collect();
        let joints = Joints { block: &mut block, rows: &mut rows };
        let settings = VelocitySettings::default();
        let report =
            VelocityLcp::default().impact(&mut bodies, &contacts, &rebounds, &mut Vec::new(), Some(joints), &settings);
        // Speeds of some m/s, to rounding.
        prop_assert!(rows.iter().all(|row| row.speed(&bodies).abs() < 1e-13));
        // Speeds are solved to 1e-11 of themselves.
        prop_assert!(kinetic_energy(&bodies) <= before * (1.0 + 1e-10));
        // Random contacts may jam, so that no method solves them; then the report says so.
        let approach = contacts.iter().map(|row| -row.separating_speed(&bodies)).fold(0.0, f64::max);
        prop_assert!(report.ending == Ending::NotConverged || approach < 1e-9, "{approach:e}");
    }
}

#[test]
fn l5_impulse_on_a_pinned_rod_turns_it_about_its_pin() {
    // A uniform rod of length 1 and mass 3 pinned at its end has I = m L²/3 about the pin.
    let rod = body(3.0, 0.25);
    let mut bodies = [FLOOR, rod];
    bodies[1].apply_impulse(dvec2(0.5, 0.0), dvec2(0.0, 2.0));
    let ends = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, dvec2(0.5, 0.0), dvec2(-0.5, 0.0)));
    let mut rows = Vec::new();
    revolute::push_rows(&ends, &bodies, &mut rows);
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    block.stop(&mut bodies, &mut rows);
    // ω = J L / (m L²/3) = 2; the pin gives m ω L/2 − J = 1. Exact but for rounding.
    assert!((bodies[1].angular_velocity - 2.0).abs() < 1e-15);
    assert!((rows[1].impulse - 1.0).abs() < 1e-15 && rows[0].impulse.abs() < 1e-15);
}

#[test]
fn contact_on_a_pinned_rod_yields_like_a_body_about_its_pin() {
    let bodies = [FLOOR, body(3.0, 0.25), FLOOR];
    let ends = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, dvec2(0.5, 0.0), dvec2(-0.5, 0.0)));
    let mut rows = Vec::new();
    revolute::push_rows(&ends, &bodies, &mut rows);
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let contact = ContactRow::<Planar> {
        a: 1,
        b: 2,
        frame: Planar::contact_frame(-DVec2::Y),
        arm_a: dvec2(0.5, 0.0),
        arm_b: DVec2::ZERO,
        separation: 0.0,
        allowance: 0.0,
        surface: Surface::default(),
        impulse: DVec2::ZERO,
        slip: Slip::Sticking,
    };
    let k = block.compliance(&rows, &contact);
    // Along the normal L²/(m L²/3) = 1; along the rod nothing yields.
    assert!((k.x_axis.x - 1.0).abs() < 1e-15 && k.x_axis.y.abs() < 1e-15 && k.y_axis.y.abs() < 1e-15);
    // Asked again, it has forgotten the first answer.
    assert_eq!(block.compliance(&rows, &contact), k);
}

/// Rods of length 1 hanging in a row from the origin along x, pinned together.
fn chain(rods: u32) -> (Vec<Body>, Vec<Row>) {
    let bodies: Vec<Body> = std::iter::once(FLOOR).chain((0..rods).map(|_| body(1.0, 1.0 / 12.0))).collect();
    let mut rows = Vec::new();
    for i in 0..rods {
        let (centre, before) = (dvec2(f64::from(i) + 0.5, 0.0), dvec2(f64::from(i) - 0.5, 0.0));
        let a = if i == 0 { (0, DVec2::ZERO, DVec2::ZERO) } else { (i, before, dvec2(0.5, 0.0)) };
        revolute::push_rows(&JointEnds::at(a, (i + 1, centre, dvec2(-0.5, 0.0))), &bodies, &mut rows);
    }
    (bodies, rows)
}

#[test]
fn first_acceleration_of_a_released_rod_is_three_quarters_of_g_at_its_centre() {
    let (mut bodies, rows) = chain(1);
    // Accelerations in place of velocities.
    bodies[1].velocity = dvec2(0.0, -9.81);
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let mut forces = vec![0.0; rows.len()];
    block.accelerate(&mut bodies, &rows, &mut forces);
    // α = (m g L/2) / (m L²/3) = 3g/2L; the pin carries a quarter of the weight.
    assert!((bodies[1].velocity.y + 0.75 * 9.81).abs() < 1e-14);
    assert!((forces[1] - 0.25 * 9.81).abs() < 1e-14);
}

#[test]
fn chain_of_forty_rods_stops_to_rounding() {
    let (mut bodies, mut rows) = chain(40);
    for (i, body) in bodies.iter_mut().enumerate().skip(1) {
        body.velocity = dvec2(0.3 * i as f64, -1.0);
        body.angular_velocity = 2.0 - 0.1 * i as f64;
    }
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let report = block.stop(&mut bodies, &mut rows);
    assert_eq!(report.redundant, 0);
    // Speeds up to 12 m/s: a rounding is 2e-15.
    assert!(report.residual < 1e-13, "{:e}", report.residual);
}

#[test]
fn a_pin_given_twice_is_redundant_and_harmless() {
    let (mut bodies, mut rows) = chain(2);
    rows.extend(rows[2..].to_vec());
    bodies[2].velocity = dvec2(1.0, 2.0);
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let report = block.stop(&mut bodies, &mut rows);
    assert_eq!(report.redundant, 2);
    assert!(report.residual < 1e-14 && report.unreachable < 1e-14, "{report:?}");
}

#[test]
fn joints_that_contradict_each_other_are_named() {
    let (bodies, mut rows) = chain(1);
    // The same pin again, 0.2 m further right.
    rows.extend(rows.clone());
    rows[2].error += 0.2;
    let mut displacements = bodies.clone();
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let report = block.correct(&mut displacements, &rows);
    assert_eq!((report.redundant, report.unreachable_row), (2, Some(2)));
    assert!((report.unreachable - 0.2).abs() < 1e-15);
    assert!(displacements.iter().all(|d| d.velocity.is_finite() && d.angular_velocity.is_finite()));
}

#[test]
fn joint_between_bodies_that_cannot_move_is_named_when_it_is_apart() {
    let bodies = [FLOOR, FLOOR];
    let ends = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, dvec2(0.0, 0.1), DVec2::ZERO));
    let mut rows = Vec::new();
    revolute::push_rows(&ends, &bodies, &mut rows);
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let report = block.correct(&mut bodies.clone(), &rows);
    assert_eq!((report.redundant, report.unreachable_row, report.unreachable), (2, Some(1), 0.1));
}

#[test]
fn slider_crank_has_independent_rows_and_one_correction_closes_it() {
    // Crank 0.1 at 45°, rod 0.3, slider on the x axis; the rod's far end is 1e-3 off.
    let (r, l) = (0.1, 0.3);
    let pin = dvec2(r, r) * std::f64::consts::FRAC_1_SQRT_2;
    let slider = dvec2(0.362_258_272_861, 0.0);
    let along = slider - pin;
    let off = dvec2(1e-3, -5e-4);
    let bodies = [FLOOR, body(1.0, 1.0 * r * r / 12.0), body(1.0, l * l / 12.0), body(0.5, 1.0)];
    let mut rows = Vec::new();
    let crank = 0.5 * pin;
    let rod = pin + 0.5 * along + off;
    revolute::push_rows(&JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, crank, -crank)), &bodies, &mut rows);
    revolute::push_rows(&JointEnds::at((1, crank, crank), (2, rod, -0.5 * along)), &bodies, &mut rows);
    revolute::push_rows(&JointEnds::at((2, rod, 0.5 * along), (3, slider, DVec2::ZERO)), &bodies, &mut rows);
    let rail = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (3, slider, DVec2::ZERO));
    prismatic::push_rows(&rail, DVec2::X, 0.0, &bodies, &mut rows).unwrap();
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let mut moved = bodies;
    let report = block.correct(&mut moved, &rows);
    // Eight rows on nine freedoms: the mechanism keeps its one, and no row is left over.
    assert_eq!(report.redundant, 0);
    assert!(report.residual < 1e-16, "{:e}", report.residual);
}

#[test]
fn distance_joint_without_a_direction_is_refused() {
    let bodies = [FLOOR, body(1.0, 1.0)];
    let ends = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, DVec2::ZERO, DVec2::ZERO));
    let mut rows = Vec::new();
    assert_eq!(distance::push_rows(&ends, 1.0, &bodies, &mut rows), Err(JointError::NoDirection { a: 0, b: 1 }));
    let bad = distance::push_rows(&ends, f64::NAN, &bodies, &mut rows);
    assert_eq!(bad, Err(JointError::BadParameter { a: 0, b: 1, quantity: "length" }));
    assert!(rows.is_empty());
}

/// A rod of length 1 and mass 3 pinned at the origin, lying along x, and a point of it on the floor at a distance from the pin.
fn pinned_rod_on_floor(at: f64, turning: f64) -> ([Body; 2], Vec<Row>, [ContactRow<Planar>; 1]) {
    let velocity = dvec2(0.0, 0.5 * turning);
    let bodies = [FLOOR, Body { velocity, angular_velocity: turning, ..body(3.0, 0.25) }];
    let mut rows = Vec::new();
    let pin = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, dvec2(0.5, 0.0), dvec2(-0.5, 0.0)));
    revolute::push_rows(&pin, &bodies, &mut rows);
    (bodies, rows, [on_floor(1, dvec2(at - 0.5, 0.0), surface(0.4, 0.5))])
}

#[test]
fn impact_of_a_pinned_rod_is_that_of_a_body_turning_about_its_pin() {
    // j = (1 + ε) |ω| I_pin / r, with I_pin = m L²/3 = 1; the pin's impulse is what moves the centre besides.
    for at in [0.4, 2.0 / 3.0, 1.0] {
        let exact = 1.5 * 2.0 / at;
        let pin_impulse = 3.0 * 0.5 * (1.0 + 2.0) - exact;
        let one_by_one = |bodies: &mut [Body], contacts: &[ContactRow<Planar>], joints: Joints<'_, Planar>| {
            let mut given = Vec::new();
            let settings = ImpactSettings { colliding_above: 1e-9, impulses_per_contact: 10 };
            let approaches = &mut [Approach::default()];
            resolve_one_by_one_with_joints(bodies, contacts, approaches, &mut given, joints, &settings);
            given[0].x
        };
        let at_once = |bodies: &mut [Body], contacts: &[ContactRow<Planar>], joints: Joints<'_, Planar>| {
            let mut given = Vec::new();
            let rebounds = [Rebound { restitution: 0.5, speed: 0.0, ..Rebound::default() }];
            let settings = VelocitySettings::default();
            VelocityLcp::default().impact(bodies, contacts, &rebounds, &mut given, Some(joints), &settings);
            given[0].x
        };
        type Solver<'a> = &'a dyn Fn(&mut [Body], &[ContactRow<Planar>], Joints<'_, Planar>) -> f64;
        for solve in [&one_by_one as Solver, &at_once] {
            let (mut bodies, mut rows, contacts) = pinned_rod_on_floor(at, -2.0);
            let mut block = JointBlock::default();
            block.prepare(&bodies, &rows);
            let impulse = solve(&mut bodies, &contacts, Joints { block: &mut block, rows: &mut rows });
            // Exact but for rounding.
            assert!((impulse - exact).abs() < 1e-14, "{at}: {impulse}");
            assert!((bodies[1].angular_velocity - 1.0).abs() < 1e-14);
            assert!((rows[1].impulse - pin_impulse).abs() < 1e-14, "{at}: {}", rows[1].impulse);
        }
    }
}

#[test]
fn filters_hold_a_pinned_rod_on_its_prop_and_agree() {
    // One step of gravity, 9.81e-3 m/s: the prop at 3/4 takes 2/3 of the weight, the pin the rest.
    let pull = 9.81e-3;
    let (bodies, rows, contacts) = pinned_rod_on_floor(0.75, 0.0);
    let fallen = [FLOOR, Body { velocity: dvec2(0.0, -pull), ..bodies[1] }];
    let mut block = JointBlock::default();
    block.prepare(&bodies, &rows);
    let check = |bodies: [Body; 2], contact: &ContactRow<Planar>, rows: &[Row], tolerance: f64| {
        assert!((contact.impulse.x - 3.0 * pull * 2.0 / 3.0).abs() < tolerance, "{}", contact.impulse.x);
        assert!((rows[1].impulse - 3.0 * pull / 3.0).abs() < tolerance, "{}", rows[1].impulse);
        assert!(bodies[1].velocity.length() < tolerance && bodies[1].angular_velocity.abs() < tolerance);
    };

    let (mut exact, mut exact_contacts, mut exact_rows) = (fallen, contacts, rows.clone());
    let joints = Joints { block: &mut block, rows: &mut exact_rows };
    VelocityLcp::default().filter(&mut exact, &mut exact_contacts, Some(joints), &VelocitySettings::default());
    check(exact, &exact_contacts[0], &exact_rows, 1e-16);

    let (mut swept, mut swept_contacts, mut swept_rows) = (fallen, contacts, rows);
    let settings = FilterSettings { iterations: 500, tolerance: 1e-13 };
    let joints = Joints { block: &mut block, rows: &mut swept_rows };
    let report = filter_velocities_and_joints(&mut swept, &mut swept_contacts, joints, &mut Vec::new(), &settings);
    assert_eq!(report.ending, Ending::Converged);
    // The sweeps' tolerance over their rate of convergence.
    check(swept, &swept_contacts[0], &swept_rows, 1e-11);

    // From its own answer it needs one sweep.
    let mut again = fallen;
    let joints = Joints { block: &mut block, rows: &mut swept_rows };
    let report = filter_velocities_and_joints(&mut again, &mut swept_contacts, joints, &mut Vec::new(), &settings);
    assert_eq!(report.iterations, 1);
}
