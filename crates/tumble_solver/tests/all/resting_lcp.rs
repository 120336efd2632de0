//! Resting contact: closed forms by their case ids.

use crate::common::{Body, FLOOR, Row, block, body, contact, moving, on_floor, stack, surface};
use glam::{DVec2, dvec2};
use tumble_math::{Planar, trig};
use tumble_solver::joint::{JointBlock, JointEnds, Joints, revolute};
use tumble_solver::resting_lcp::{
    Acceleration, Gap, NormalCarrier, RestingLcp, RestingReport, RestingSettings, RestingStatus,
};
use tumble_solver::velocity_lcp::{VelocityLcp, VelocitySettings};
use tumble_solver::{Ending, Slip, Surface};

const GRAVITY: f64 = 9.81;

/// Accelerations of order ten, solved by pivoting: some ten roundings.
const EXACT: f64 = 1e-13;

/// Forces on bodies in free fall but for an extra acceleration each; all normals belong to body a.
fn solve_with(
    bodies: &[Body],
    extra: &[Acceleration<Planar>],
    rows: &mut [Row],
) -> (Vec<DVec2>, Vec<Acceleration<Planar>>, RestingReport) {
    let mut accelerations: Vec<Acceleration<Planar>> = bodies
        .iter()
        .zip(extra)
        .map(|(body, extra)| {
            let falls = if body.inverse_mass.y > 0.0 { dvec2(0.0, -GRAVITY) } else { DVec2::ZERO };
            Acceleration { linear: falls + extra.linear, angular: extra.angular }
        })
        .collect();
    let gaps: Vec<Gap<Planar>> = rows.iter().map(|row| Gap::corner(row, NormalCarrier::A)).collect();
    let mut forces = Vec::new();
    let settings = RestingSettings::default();
    let report = RestingLcp::default().solve(bodies, &mut accelerations, rows, &gaps, &mut forces, None, &settings);
    (forces, accelerations, report)
}

fn solve(bodies: &[Body], rows: &mut [Row]) -> (Vec<DVec2>, Vec<Acceleration<Planar>>, RestingReport) {
    solve_with(bodies, &vec![Acceleration::default(); bodies.len()], rows)
}

/// Arm of the lower end of a rod that leans to the right, from its centre.
fn lower_end(angle: f64, half_length: f64) -> DVec2 {
    let (sine, cosine) = trig::sin_cos(angle.to_radians());
    -half_length * dvec2(cosine, sine)
}

/// A rod of length 2 and mass 1, its lower end moving at a velocity while it turns.
fn rod(arm: DVec2, end_velocity: DVec2, turning: f64) -> Body {
    moving(body(1.0, 1.0 / 3.0), end_velocity - turning * dvec2(-arm.y, arm.x), turning)
}

#[test]
fn e9_rod_end_on_a_frictionless_floor() {
    for (angle, turning, force) in
        [(30.0, 0.0, 3.01846153846), (30.0, 2.0, 2.40307692308), (60.0, 0.0, 5.60571428571), (60.0, 3.5, 0.0)]
    {
        let arm = lower_end(angle, 1.0);
        let bodies = [FLOOR, rod(arm, DVec2::ZERO, turning)];
        let (forces, _, report) = solve(&bodies, &mut [on_floor(1, arm, Surface::default())]);
        assert_eq!(report.status, RestingStatus::Solved);
        // Printed with twelve digits.
        assert!((forces[0] - dvec2(force, 0.0)).length() < 1e-11, "{angle} {turning}: {}", forces[0]);
    }
}

#[test]
fn e10_box_on_two_corners_pushed_above_its_centre() {
    for (push, height, left, right) in [(0.0, 0.0, 9.81, 9.81), (4.905, 0.5, 7.3575, 12.2625), (15.0, 0.5, 2.31, 17.31)]
    {
        let size = DVec2::ONE;
        let bodies = [FLOOR, block(2.0, size)];
        let pushed =
            Acceleration { linear: dvec2(push / 2.0, 0.0), angular: -push * height * bodies[1].inverse_inertia };
        let mut rows = [-0.5, 0.5].map(|x| on_floor(1, dvec2(x, -0.5), Surface::default()));
        let (forces, _, _) = solve_with(&bodies, &[Acceleration::default(), pushed], &mut rows);
        assert!((forces[0].x - left).abs() < EXACT && (forces[1].x - right).abs() < EXACT, "{push}: {forces:?}");
    }
}

#[test]
fn e3_two_legs_carry_what_their_moments_say() {
    let bodies = [FLOOR, body(10.0, 3.0)];
    let mut rows = [-0.8, 0.3].map(|x| on_floor(1, dvec2(x, -1.0), surface(0.4, 0.0)));
    let (forces, accelerations, report) = solve(&bodies, &mut rows);
    // N₁ a = N₂ b with arms 0.8 and 0.3.
    let weight = 10.0 * GRAVITY;
    assert!(
        (forces[0].x - weight * 0.3 / 1.1).abs() < EXACT * 10.0
            && (forces[1].x - weight * 0.8 / 1.1).abs() < EXACT * 10.0
    );
    assert!(accelerations[1].linear.length() < EXACT && accelerations[1].angular.abs() < EXACT);
    assert_eq!((report.status, report.sticking), (RestingStatus::Solved, 2));
}

#[test]
fn e1_table_on_five_legs_presses_on_each_alike() {
    let bodies = [FLOOR, body(10.0, 3.0)];
    for friction in [0.0, 0.5] {
        let mut rows = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|x| on_floor(1, dvec2(x, -1.0), surface(friction, 0.0)));
        let (forces, _, report) = solve(&bodies, &mut rows);
        assert_eq!(report.status, RestingStatus::Solved);
        assert!(forces.iter().all(|force| (force.x - 2.0 * GRAVITY).abs() < EXACT * 10.0), "{forces:?}");
    }
}

#[test]
fn e4_each_interface_of_a_stack_carries_what_is_above() {
    let (bodies, mut rows) = stack(6, surface(0.5, 0.0));
    let (forces, _, report) = solve(&bodies, &mut rows);
    assert_eq!(report.status, RestingStatus::Solved);
    for (i, pair) in forces.chunks(2).enumerate() {
        let load = f64::from(6 - i as u32) * GRAVITY;
        assert!((pair[0].x + pair[1].x - load).abs() < 10.0 * EXACT, "{i}: {pair:?}");
    }
}

/// A ladder of length 4 and 10 kg at 60° against a smooth wall to its right.
fn ladder(floor_friction: f64) -> (Vec<Body>, [Row; 2]) {
    let foot = lower_end(60.0, 2.0);
    let bodies = vec![FLOOR, body(10.0, 10.0 * 16.0 / 12.0)];
    let wall = contact([0, 1], -DVec2::X, [DVec2::ZERO, -foot], Surface::default());
    (bodies, [on_floor(1, foot, surface(floor_friction, 0.0)), wall])
}

#[test]
fn e5_ladder_leans_on_a_smooth_wall() {
    let (bodies, mut rows) = ladder(0.5);
    let (forces, accelerations, report) = solve(&bodies, &mut rows);
    assert_eq!(report.status, RestingStatus::Solved);
    // Printed with twelve digits.
    assert!((forces[0] - dvec2(98.1, 28.3190307038)).length() < 1e-9, "{}", forces[0]);
    assert!((forces[1].x - 28.3190307038).abs() < 1e-9, "{}", forces[1]);
    assert!(accelerations[1].linear.length() < EXACT);
}

#[test]
fn e5_ladder_holds_exactly_from_its_least_friction_on() {
    let least = 0.288675134595;
    for (friction, holds) in [(least * 1.0001, true), (least * 0.9999, false)] {
        let (bodies, mut rows) = ladder(friction);
        let (_, accelerations, _) = solve(&bodies, &mut rows);
        // A ten-thousandth too little friction lets it go with about g / 10 000.
        assert_eq!(accelerations[1].linear.length() < 1e-9, holds, "{friction}");
        assert_eq!(rows[0].slip, if holds { Slip::Sticking } else { Slip::Sliding });
    }
}

#[test]
fn d3_friction_drops_from_static_to_kinetic_when_the_block_breaks_away() {
    let two = Surface { static_friction: 0.6, kinetic_friction: 0.4, restitution: 0.0 };
    for (push, friction) in [(11.7, -11.7), (11.8, -7.848)] {
        let bodies = [FLOOR, block(2.0, dvec2(1.0, 0.2))];
        let pushed = Acceleration { linear: dvec2(push / 2.0, 0.0), angular: 0.0 };
        let mut rows = [-0.5, 0.5].map(|x| on_floor(1, dvec2(x, -0.1), two));
        let (forces, accelerations, _) = solve_with(&bodies, &[Acceleration::default(), pushed], &mut rows);
        assert!((forces[0].y + forces[1].y - friction).abs() < 10.0 * EXACT, "{push}: {forces:?}");
        assert!((accelerations[1].linear.x - 0.5 * (push + friction)).abs() < 10.0 * EXACT);
    }
}

#[test]
fn sliding_friction_opposes_the_slip_and_not_the_push() {
    let bodies = [FLOOR, moving(block(2.0, dvec2(1.0, 0.2)), dvec2(-1.0, 0.0), 0.0)];
    let mut rows = [-0.5, 0.5].map(|x| on_floor(1, dvec2(x, -0.1), surface(0.3, 0.0)));
    let (_, accelerations, report) = solve(&bodies, &mut rows);
    assert!((accelerations[1].linear - dvec2(0.3 * GRAVITY, 0.0)).length() < EXACT);
    assert_eq!(report.sliding, 2);
}

/// The rod of F2 and F3: half-length 1, tan θ = 2, μ = 1.6, its end sliding at −2 m/s.
fn painleve(turning: f64, friction: f64) -> (Vec<DVec2>, RestingReport, Vec<u32>) {
    let arm = -dvec2(1.0, 2.0) / 5.0_f64.sqrt();
    let bodies = [FLOOR, rod(arm, dvec2(-2.0, 0.0), turning)];
    let mut rows = [on_floor(1, arm, surface(friction, 0.0))];
    let gaps = [Gap::corner(&rows[0], NormalCarrier::A)];
    let mut accelerations = [Acceleration::default(), Acceleration { linear: dvec2(0.0, -GRAVITY), angular: 0.0 }];
    let mut model = RestingLcp::default();
    let mut forces = Vec::new();
    let settings = RestingSettings::default();
    let report = model.solve(&bodies, &mut accelerations, &mut rows, &gaps, &mut forces, None, &settings);
    (forces, report, model.unsolved().to_vec())
}

#[test]
fn f1_friction_below_the_critical_one_has_just_one_solution() {
    let (forces, report, _) = painleve(1.0, 1.33);
    assert_eq!(report.status, RestingStatus::Solved);
    assert!(forces[0].x > 0.0);
    assert_eq!(painleve(1.0, 1.34).1.status, RestingStatus::NoSolution);
}

#[test]
fn f2_inconsistent_rod_has_no_solution_and_says_so() {
    let (forces, report, unsolved) = painleve(1.0, 1.6);
    assert_eq!((report.status, report.no_solution), (RestingStatus::NoSolution, 1));
    assert_eq!((forces[0], unsolved), (DVec2::ZERO, vec![0]));
}

#[test]
fn f3_indeterminate_rod_takes_the_smallest_force_and_says_so() {
    let (forces, report, unsolved) = painleve(4.0, 1.6);
    assert_eq!((report.status, report.not_unique), (RestingStatus::NotUnique, 1));
    assert_eq!((forces[0], unsolved), (DVec2::ZERO, vec![]));
    // The switch between the two.
    let switch = 3.31178402521;
    assert_eq!(painleve(switch * (1.0 - 1e-9), 1.6).1.status, RestingStatus::NoSolution);
    assert_eq!(painleve(switch * (1.0 + 1e-9), 1.6).1.status, RestingStatus::NotUnique);
}

#[test]
fn f5_rod_that_slides_with_enormous_friction_is_inconsistent() {
    let arm = dvec2(1.0, -1.0) * std::f64::consts::FRAC_1_SQRT_2;
    let bodies = [FLOOR, moving(body(1.0, 1.0), dvec2(1.0, 0.0), 0.0)];
    let (_, _, report) = solve(&bodies, &mut [on_floor(1, arm, surface(1000.0, 0.0))]);
    assert_eq!(report.status, RestingStatus::NoSolution);
}

#[test]
fn disc_rolling_on_a_floor_is_carried_by_its_weight_whatever_its_speed() {
    // Centripetal acceleration of the material point must not look like an opening gap.
    let (radius, speed) = (0.5, 7.0);
    let bodies = [FLOOR, moving(body(2.0, 0.25), dvec2(speed, 0.0), -speed / radius)];
    let mut rows = [on_floor(1, dvec2(0.0, -radius), surface(0.5, 0.0))];
    let gap = Gap { feature_a: DVec2::ZERO, feature_b: DVec2::ZERO, carrier: NormalCarrier::A, circles: [None; 2] };
    let mut accelerations = [Acceleration::default(), Acceleration { linear: dvec2(0.0, -GRAVITY), angular: 0.0 }];
    let mut forces = Vec::new();
    let settings = RestingSettings::default();
    RestingLcp::default().solve(&bodies, &mut accelerations, &mut rows, &[gap], &mut forces, None, &settings);
    assert!((forces[0] - dvec2(2.0 * GRAVITY, 0.0)).length() < EXACT * 10.0, "{}", forces[0]);
    assert!(accelerations[1].linear.length() < EXACT && accelerations[1].angular.abs() < EXACT);
}

#[test]
fn bead_sliding_over_a_fixed_disc_leaves_it_where_gravity_no_longer_bends_its_path() {
    // N = m (g cos φ − v²/R), zero when v² = g R cos φ.
    let (radius, angle) = (2.0, 0.5);
    let (sine, cosine) = trig::sin_cos(angle);
    let normal = dvec2(sine, cosine);
    for speed in [0.0, 2.0, 5.0] {
        let bodies = [FLOOR, moving(body(1.5, 1.0), speed * dvec2(cosine, -sine), 0.0)];
        let mut rows = [contact([0, 1], normal, [radius * normal, DVec2::ZERO], Surface::default())];
        let gap =
            Gap { feature_a: DVec2::ZERO, feature_b: DVec2::ZERO, carrier: NormalCarrier::Line, circles: [None; 2] };
        let mut accelerations = [Acceleration::default(), Acceleration { linear: dvec2(0.0, -GRAVITY), angular: 0.0 }];
        let mut forces = Vec::new();
        let settings = RestingSettings::default();
        RestingLcp::default().solve(&bodies, &mut accelerations, &mut rows, &[gap], &mut forces, None, &settings);
        let expected = (1.5 * (GRAVITY * cosine - speed * speed / radius)).max(0.0);
        assert!((forces[0].x - expected).abs() < EXACT * 10.0, "{speed}: {} {expected}", forces[0].x);
    }
}

#[test]
fn pinned_rod_leans_on_a_prop_with_the_force_that_its_moment_says() {
    // Pinned at its left end, propped at three quarters: N · 0.75 = m g · 0.5.
    let bodies = [FLOOR, body(3.0, 0.25)];
    let mut joint_rows = Vec::new();
    let pin = JointEnds::at((0, DVec2::ZERO, DVec2::ZERO), (1, dvec2(0.5, 0.0), dvec2(-0.5, 0.0)));
    revolute::push_rows(&pin, &bodies, &mut joint_rows);
    let mut joints = JointBlock::default();
    joints.prepare(&bodies, &joint_rows);
    let mut rows = [on_floor(1, dvec2(0.25, 0.0), surface(0.3, 0.0))];
    let gaps = [Gap::corner(&rows[0], NormalCarrier::A)];
    let mut accelerations = [Acceleration::default(), Acceleration { linear: dvec2(0.0, -GRAVITY), angular: 0.0 }];
    let (mut forces, mut model) = (Vec::new(), RestingLcp::default());
    let held = Some(Joints { block: &mut joints, rows: &mut joint_rows });
    let settings = RestingSettings::default();
    let report = model.solve(&bodies, &mut accelerations, &mut rows, &gaps, &mut forces, held, &settings);
    assert_eq!(report.status, RestingStatus::Solved);
    let weight = 3.0 * GRAVITY;
    assert!((forces[0].x - weight * 0.5 / 0.75).abs() < 10.0 * EXACT, "{}", forces[0]);
    assert!((model.joint_forces()[1] - weight * (1.0 - 0.5 / 0.75)).abs() < 10.0 * EXACT, "{:?}", model.joint_forces());
    assert!(accelerations[1].linear.length() < EXACT && accelerations[1].angular.abs() < EXACT);
}

#[test]
fn forces_of_the_step_before_are_a_guess_and_no_more() {
    let (bodies, rows) = stack(4, surface(0.5, 0.0));
    let gaps: Vec<Gap<Planar>> = rows.iter().map(|row| Gap::corner(row, NormalCarrier::A)).collect();
    let solve = |forces: &mut Vec<DVec2>| {
        let falls = Acceleration { linear: dvec2(0.0, -GRAVITY), angular: 0.0 };
        let mut accelerations = vec![falls; bodies.len()];
        accelerations[0] = Acceleration::default();
        let settings = RestingSettings::default();
        let mut rows = rows.clone();
        RestingLcp::default().solve(&bodies, &mut accelerations, &mut rows, &gaps, forces, None, &settings)
    };
    let mut forces = Vec::new();
    assert!(solve(&mut forces).iterations > 0);
    let known = forces.clone();
    // Its own answer costs no pivots and does not change.
    assert_eq!(solve(&mut forces).iterations, 0);
    assert_eq!(forces, known);
    for wrong in [vec![dvec2(7.0, -9.0); known.len()], vec![DVec2::NAN; known.len()], vec![DVec2::ONE; 3]] {
        forces.clone_from(&wrong);
        solve(&mut forces);
        // Forces up to 40 N, to rounding.
        assert!(forces.iter().zip(&known).all(|(a, b)| (*a - *b).length() < 1e-11), "{wrong:?}: {forces:?}");
    }
}

/// The largest acceleration of bodies that gravity pulls, by forces, and by one step of the velocity filter [m/s²].
fn unrest(bodies: &[Body], rows: &[Row], gaps: &[Gap<Planar>]) -> [f64; 2] {
    let falls = |body: &Body| if body.inverse_mass.y > 0.0 { dvec2(0.0, -GRAVITY) } else { DVec2::ZERO };
    let mut accelerations: Vec<Acceleration<Planar>> =
        bodies.iter().map(|body| Acceleration { linear: falls(body), angular: 0.0 }).collect();
    let (mut resting, mut forces) = (rows.to_vec(), Vec::new());
    let settings = RestingSettings::default();
    let report =
        RestingLcp::default().solve(bodies, &mut accelerations, &mut resting, gaps, &mut forces, None, &settings);
    assert_eq!(report.status, RestingStatus::Solved);
    let by_forces = accelerations.iter().map(|a| a.linear.length().max(a.angular.abs())).fold(0.0, f64::max);

    let dt = 1e-3;
    let mut filtered: Vec<Body> = bodies.iter().map(|body| moving(*body, falls(body) * dt, 0.0)).collect();
    let settings = VelocitySettings::default();
    let report = VelocityLcp::default().filter(&mut filtered, &mut rows.to_vec(), None, &settings);
    assert_eq!(report.ending, Ending::Converged);
    let by_filter = filtered.iter().map(|b| b.velocity.length().max(b.angular_velocity.abs())).fold(0.0, f64::max);
    [by_forces, by_filter / dt]
}

#[test]
fn e8_two_cards_hold_each_other_from_their_least_friction_on() {
    let least = 0.233153829077;
    for (friction, holds) in [(least * 1.0001, true), (least * 0.9999, false)] {
        let (sine, cosine) = trig::sin_cos(25.0_f64.to_radians());
        let card = body(1.0, 1.0 / 12.0);
        let bodies = [FLOOR, card, card];
        let half = 0.5 * dvec2(sine, cosine);
        let mirrored = dvec2(-half.x, half.y);
        let rows = [
            on_floor(1, -half, surface(friction, 0.0)),
            on_floor(2, -mirrored, surface(friction, 0.0)),
            contact([1, 2], DVec2::X, [half, mirrored], Surface::default()),
        ];
        let gaps = rows.map(|row| Gap::corner(&row, NormalCarrier::A));
        for unrest in unrest(&bodies, &rows, &gaps) {
            // A ten-thousandth too little friction lets them go with about g / 10 000.
            assert_eq!(unrest < 1e-9, holds, "{friction}: {unrest:e}");
        }
    }
}

#[test]
fn e11_cylinder_stays_on_two_others_from_its_least_frictions_on() {
    let (least_between, least_floor) = (0.267949192431, 0.089316397477);
    for (between, floor, holds) in
        [(1.0001, 1.0001, true), (0.9999, 1.0001, false), (1.0001, 0.9999, false), (1.5, 2.0, true)]
    {
        let disc = body(1.0, 0.5);
        let bodies = [FLOOR, disc, disc, disc];
        let surfaces = [surface(between * least_between, 0.0), surface(floor * least_floor, 0.0)];
        let (right_up, left_up) = (dvec2(0.5, 0.75_f64.sqrt()), dvec2(-0.5, 0.75_f64.sqrt()));
        let touch = |ends, normal| contact(ends, normal, [normal, -normal], surfaces[0]);
        let rows = [
            on_floor(1, -DVec2::Y, surfaces[1]),
            on_floor(2, -DVec2::Y, surfaces[1]),
            touch([1, 2], DVec2::X),
            touch([1, 3], right_up),
            touch([2, 3], left_up),
        ];
        let round =
            Gap { feature_a: DVec2::ZERO, feature_b: DVec2::ZERO, carrier: NormalCarrier::Line, circles: [None; 2] };
        for unrest in unrest(&bodies, &rows, &[round; 5]) {
            // A ten-thousandth too little friction lets them go with about g / 10 000.
            assert_eq!(unrest < 1e-9, holds, "{between} {floor}: {unrest:e}");
        }
    }
}

#[test]
fn accelerations_that_are_not_finite_have_no_solution_and_stay_in_their_island() {
    let box_ = block(1.0, DVec2::ONE);
    let bodies = [FLOOR, box_, box_];
    let mut rows: Vec<Row> = [(1, -0.5), (1, 0.5), (2, -0.5), (2, 0.5)]
        .map(|(body, x)| on_floor(body, dvec2(x, -0.5), surface(0.5, 0.0)))
        .to_vec();
    let bad = Acceleration { linear: dvec2(0.0, f64::NAN), angular: 0.0 };
    let (forces, _, report) = solve_with(&bodies, &[Acceleration::default(), bad, Acceleration::default()], &mut rows);
    assert_eq!((report.status, report.no_solution), (RestingStatus::NoSolution, 1));
    assert!((forces[2].x - 0.5 * GRAVITY).abs() < EXACT && (forces[3].x - 0.5 * GRAVITY).abs() < EXACT, "{forces:?}");
}
