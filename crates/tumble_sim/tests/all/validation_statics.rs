//! Rest and its forces: cases E1 to E6, E9, E10 and E14 in the plane.

use crate::support::{
    G, assert_near, assert_vector_near, block, body, complementarity, contact_force, contact_forces, direction, every,
    floor, kinetic_energy, material, rigid, rod, rough, simulation, under, wall,
};
use bevy_ecs::name::Name;
use glam::{DVec2, dvec2};
use tumble_math::{Planar, trig};
use tumble_shape::Rod;
use tumble_sim::{Amount, AppliedForce, Axes, BodyKind, ContactModel, Course, Part, Position, Settings, Simulation};
use tumble_solver::Surface;

/// A beam of 10 kg that lies on the tips of upright rods.
fn beam(settings: Settings, tips: &[f64], centre: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(0.5, 0.4));
    for (k, x) in tips.iter().enumerate() {
        let leg = simulation.spawn((Name::new(format!("leg-{k}")), Position(DVec2::ZERO), BodyKind::Static));
        let rod = Rod::try_new(dvec2(*x, -1.0), dvec2(*x, 0.0), 0.0).unwrap();
        simulation.attach(leg, Part::new(rod, Amount::Density(0.0)));
    }
    block(2.5, 0.1, 10.0).at(centre, 0.05).spawn(&mut simulation, "beam");
    simulation
}

/// What each leg carries [N].
fn loads(simulation: &mut Simulation, legs: usize) -> Vec<f64> {
    (0..legs).map(|k| contact_force(simulation, &format!("leg-{k}"), "beam").y).collect()
}

/// The forces of least norm with sum `weight` and no moment about `centre`, where none of them is negative: α + β (x − centre).
fn least_norm(tips: &[f64], centre: f64, weight: f64) -> Vec<f64> {
    let arms = tips.iter().map(|x| x - centre);
    let (first, second) = arms.fold((0.0, 0.0), |(sum, squares), arm| (sum + arm, squares + arm * arm));
    let determinant = tips.len() as f64 * second - first * first;
    tips.iter().map(|x| weight * (second - first * (x - centre)) / determinant).collect()
}

const LEGS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

#[test]
fn e1_e2_beam_on_many_legs_presses_on_them_by_least_norm() {
    let stiff = under(ContactModel::Penalty, every(1e-3));
    // Round-off of 98.1 N over Δt. Equal springs share by least norm as well; their beam has turned by some 5e-3 rad, which moves the
    // points on its underside by 5e-2 m times that under its centre: 98.1 N · 2.5e-4 m over a base of 2 m.
    let models = complementarity(every(0.01)).map(|settings| (settings, 1e-9)).chain([(stiff, 0.012)]);
    for (settings, within) in models {
        for centre in [0.0, 0.2] {
            let expected = least_norm(&LEGS, centre, 10.0 * G);
            assert!(expected.iter().all(|load| *load > 0.0));
            let mut simulation = beam(settings, &LEGS, centre);
            simulation.run_for(5.0).unwrap();
            for (load, expected) in loads(&mut simulation, LEGS.len()).into_iter().zip(expected) {
                assert_near(load, expected, within);
            }
        }
    }
}

#[test]
fn e1_e2_known_limit_impulses_share_by_the_order_of_their_sweeps() {
    for centre in [0.0, 0.2] {
        let mut simulation = beam(every(0.01), &LEGS, centre);
        simulation.run_for(5.0).unwrap();
        let loads = loads(&mut simulation, LEGS.len());
        // Sum and moment are right, to the filter's 1e-12 m/s times m/Δt.
        assert_near(loads.iter().sum(), 10.0 * G, 1e-8);
        assert_near(loads.iter().zip(LEGS).map(|(load, x)| load * (x - centre)).sum(), 0.0, 1e-8);
        // The shares are not those of least norm.
        let off = loads.iter().zip(least_norm(&LEGS, centre, 10.0 * G)).map(|(load, least)| (load - least).abs());
        let off = off.fold(0.0, f64::max);
        assert!(loads.iter().all(|load| *load >= 0.0) && off > 1.0 && off < 30.0, "{loads:?}: {off}");
    }
}

#[test]
fn e1_indeterminate_beam_lies_still_and_its_forces_are_the_same_every_time() {
    for settings in rigid(every(0.01)) {
        let run = || {
            let mut simulation = beam(settings, &LEGS, 0.2);
            simulation.run_for(2.0).unwrap();
            // (1e-10 m/s)²: the tolerance of the sweeps.
            assert!(kinetic_energy(&simulation) < 1e-19);
            loads(&mut simulation, LEGS.len())
        };
        assert_eq!(run(), run());
    }
}

#[test]
fn e3_two_legs_carry_what_their_moments_say() {
    let stiff = under(ContactModel::Penalty, every(1e-3));
    // Round-off and the tolerance of sweeps times m/Δt. On springs the beam has turned by some 5e-3 rad, which moves its underside by
    // 2.5e-4 m under its centre: 98.1 N · 2.5e-4 m over a base of 1.1 m.
    let models = rigid(every(0.01)).map(|settings| (settings, 1e-8)).chain([(stiff, 0.025)]);
    for (settings, within) in models {
        let mut simulation = beam(settings, &[-0.8, 0.3], 0.0);
        simulation.run_for(5.0).unwrap();
        let loads = loads(&mut simulation, 2);
        assert_near(loads[0], 10.0 * G * 0.3 / 1.1, within);
        assert_near(loads[1], 10.0 * G * 0.8 / 1.1, within);
    }
}

/// Boxes of 1 × 0.5 m on each other, from the floor up.
fn stack(settings: Settings, masses: &[f64]) -> Simulation {
    let mut simulation = simulation(settings, rough(0.5, 0.4));
    floor(&mut simulation);
    for (k, mass) in masses.iter().enumerate() {
        block(1.0, 0.5, *mass).at(0.0, 0.25 + 0.5 * k as f64).spawn(&mut simulation, &format!("box-{k}"));
    }
    simulation
}

/// What each box of a stack rests on with [N].
fn carried(simulation: &mut Simulation, boxes: usize) -> Vec<DVec2> {
    let below = |k: usize| k.checked_sub(1).map_or("floor".to_owned(), |k| format!("box-{k}"));
    (0..boxes).map(|k| contact_force(simulation, &below(k), &format!("box-{k}"))).collect()
}

#[test]
fn e4_each_interface_of_a_stack_carries_what_is_above_it() {
    // Impulses of a step over Δt: the filter's tolerance 1e-12 m/s times five masses over Δt, and a few sweeps' worth of it.
    let models = rigid(every(0.01)).map(|settings| (settings, 1e-7));
    // Springs and dampers come to rest within tenfold per second: 1.5e-8 N are left after 10 s.
    for (settings, within) in models.chain([(under(ContactModel::Penalty, every(1e-3)), 1e-6)]) {
        let mut simulation = stack(settings, &[2.0; 5]);
        simulation.run_for(10.0).unwrap();
        for (k, force) in carried(&mut simulation, 5).into_iter().enumerate() {
            assert_vector_near(force, dvec2(0.0, (5 - k) as f64 * 2.0 * G), within);
        }
    }
}

#[test]
fn e4_known_limit_penalty_stack_sinks_and_falls_in_on_itself_at_a_large_step() {
    // The default stiffness fits Δt: at 0.001 s the top of five half-metre boxes sinks by 7 cm. At 0.01 s springs are a hundred times
    // softer, 7 m in all: the boxes sink into each other until nothing pushes them apart.
    for (dt, height) in [(0.001, 2.1785), (0.01, 0.2774)] {
        let mut simulation = stack(under(ContactModel::Penalty, every(dt)), &[2.0; 5]);
        simulation.run_for(10.0).unwrap();
        // The figures measured, to their last digit.
        assert_near(body(&simulation, "box-4").position().y, height, 1e-4);
    }
}

#[test]
fn e14_ten_tonnes_rest_on_a_kilogram() {
    for settings in complementarity(every(0.01)) {
        for masses in [[1.0, 1e4], [1e4, 1.0]] {
            let mut simulation = stack(settings, &masses);
            simulation.run_for(5.0).unwrap();
            let forces = carried(&mut simulation, 2);
            // A pivoting solver's own bar, 1e-12 of the accelerations that 1e5 N give to 1 kg, on 10 t.
            assert_vector_near(forces[0], dvec2(0.0, 10_001.0 * G), 1e-3);
            assert_vector_near(forces[1], dvec2(0.0, masses[1] * G), 1e-3);
            let drift = (body(&simulation, "box-1").position() - dvec2(0.0, 0.75)).length();
            assert!(drift < 1e-9, "drift {drift}");
        }
    }
}

#[test]
fn e14_known_limit_sweeps_and_springs_do_not_carry_ten_tonnes_on_a_kilogram() {
    let sunk = |settings: Settings, mass: f64| {
        let mut simulation = stack(settings, &[1.0, mass]);
        simulation.run_for(5.0).unwrap();
        let sunk = 0.75 - body(&simulation, "box-1").position().y;
        (sunk, simulation.notices().unconverged_steps().is_some())
    };
    // The figures measured. Sweeps from a cold start: what they leave in the first steps overlaps. Beyond a thousandfold the light box is
    // overrun, to where the heavy one stands on the floor.
    for (mass, expected, within) in [(100.0, 1.49e-4, 1e-6), (1e3, 5.147e-3, 1e-5), (1e4, 0.5, 0.05)] {
        let (sunk, unconverged) = sunk(every(0.01), mass);
        assert!(unconverged, "and the run says so");
        assert_near(sunk, expected, within);
    }
    // The default stiffness of a pair is that of its lighter body.
    let (sunk, _) = sunk(under(ContactModel::Penalty, every(1e-3)), 1e4);
    assert_near(sunk, 0.5, 0.01);
}

/// A ladder of length 2 and 10 kg against a smooth wall.
fn ladder(settings: Settings, friction: f64, degrees: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    let smooth = material(&mut simulation, "smooth", 0.0);
    floor(&mut simulation);
    let smooth_wall = wall(&mut simulation, "wall", dvec2(1.0, 0.0));
    let part = simulation.world().get::<tumble_sim::Parts>(smooth_wall).unwrap();
    let part = bevy_ecs::relationship::RelationshipTarget::iter(part).next().unwrap();
    let changed = simulation.world().get::<Part<Planar>>(part).unwrap().clone().material(smooth);
    simulation.world_mut().entity_mut(part).insert(changed);
    let angle = std::f64::consts::PI - degrees.to_radians();
    let up = direction(angle);
    rod(2.0, 10.0).at(-up.x, up.y).turned(angle).spawn(&mut simulation, "ladder");
    simulation
}

#[test]
fn e5_ladder_leans_on_a_smooth_wall() {
    for settings in rigid(every(0.01)) {
        let mut simulation = ladder(settings, 0.4, 60.0);
        simulation.run_for(5.0).unwrap();
        // The filter's tolerance of 1e-12 m/s times m/Δt, and round-off.
        assert_vector_near(contact_force(&mut simulation, "wall", "ladder"), dvec2(28.3190307038, 0.0), 1e-8);
        assert_vector_near(contact_force(&mut simulation, "floor", "ladder"), dvec2(-28.3190307038, 98.1), 1e-8);
        assert_near(body(&simulation, "ladder").velocity().length(), 0.0, 1e-10);
    }
}

#[test]
fn e5_ladder_holds_from_half_the_cotangent_on() {
    for settings in rigid(every(0.01)) {
        for (friction, holds) in [(0.288675134595 * 1.001, true), (0.288675134595 * 0.999, false)] {
            let mut simulation = ladder(settings, friction, 60.0);
            let start = body(&simulation, "ladder").position();
            simulation.run_for(5.0).unwrap();
            let moved = (body(&simulation, "ladder").position() - start).length();
            // Below, a thousandth of the friction is missing: 0.03 N on 10 kg grow to centimetres, and faster, in 5 s.
            assert_eq!(moved < 1e-6, holds, "μ = {friction}: moved {moved}");
        }
    }
}

#[test]
fn e5_known_limit_ladder_under_penalty_creeps_away() {
    let mut simulation = ladder(under(ContactModel::Penalty, every(1e-3)), 0.4, 60.0);
    let foot = |simulation: &Simulation| body(simulation, "ladder").point(dvec2(-1.0, 0.0)).x;
    simulation.run_for(1.0).unwrap();
    let before = foot(&simulation);
    simulation.run_for(1.0).unwrap();
    // Friction never gives more in a step than what stops the slip: F Δt = slip / K. So it takes a slip of F K Δt for a friction of F,
    // with K = 1/m + r_y²/I of the foot, and the foot creeps away by 9 mm/s.
    let force = contact_force(&mut simulation, "floor", "ladder");
    let compliance = 0.1 + 0.75 / (10.0 / 3.0);
    assert_near(foot(&simulation) - before, -force.x * compliance * 1e-3, 3e-4);
}

#[test]
fn e6_frictionless_ladder_leaves_the_wall_at_two_thirds_of_its_height() {
    for settings in rigid(every(1e-3)) {
        let mut simulation = ladder(settings, 0.0, 70.0);
        let mut last = None;
        while simulation.time() < 0.65 {
            simulation.step().unwrap();
            // Leaving is smooth: the force has fallen to 1 N within 5 ms of its end.
            if contact_force(&mut simulation, "wall", "ladder").x > 1e-3 {
                let ladder = body(&simulation, "ladder");
                last = Some((simulation.time(), std::f64::consts::PI - ladder.angle(), ladder.angular_velocity()));
            }
        }
        let (time, angle, spin) = last.unwrap();
        // 5e-3 relative at h = 1e-3, as the case says.
        assert_near(time, 0.597527805947, 5e-3 * 0.6);
        assert_near(angle, 38.7895564164_f64.to_radians(), 5e-3 * 0.677);
        assert_near(spin, 2.14690295658, 5e-3 * 2.147);
        assert_near(trig::sin(angle), 2.0 / 3.0 * trig::sin(70.0_f64.to_radians()), 5e-3);
    }
}

#[test]
fn e9_resting_force_on_the_end_of_a_turning_rod_is_exact() {
    let cases = [(30.0, 0.0, 3.01846153846), (30.0, 2.0, 2.40307692308), (60.0, 0.0, 5.60571428571), (60.0, 3.5, 0.0)];
    for (degrees, spin, force) in cases {
        let mut simulation = simulation(under(ContactModel::RestingLcp, every(1e-3)), Surface::default());
        floor(&mut simulation);
        let centre = direction(f64::to_radians(degrees));
        // The end slides along the floor.
        rod(2.0, 1.0)
            .at(centre.x, centre.y)
            .turned(f64::to_radians(degrees))
            .moving(0.0, spin * centre.x)
            .spinning(spin)
            .spawn(&mut simulation, "rod");
        simulation.step().unwrap();
        // Printed with twelve digits.
        assert_vector_near(contact_force(&mut simulation, "floor", "rod"), dvec2(0.0, force), 1e-11);
    }
}

#[test]
fn e10_resting_forces_on_two_corners_of_a_pushed_box_are_exact() {
    for (push, height, left, right) in [(0.0, 0.0, 9.81, 9.81), (4.905, 0.5, 7.3575, 12.2625), (15.0, 0.5, 2.31, 17.31)]
    {
        let mut simulation = simulation(under(ContactModel::RestingLcp, every(1e-3)), Surface::default());
        floor(&mut simulation);
        let pushed = block(1.0, 1.0, 2.0).at(0.0, 0.5).spawn(&mut simulation, "box");
        simulation.spawn(AppliedForce::<Planar> {
            body: pushed,
            point: dvec2(0.0, height),
            force: dvec2(push, 0.0),
            torque: 0.0,
            axes: Axes::World,
            course: Course::default(),
        });
        simulation.step().unwrap();
        let forces = contact_forces(&mut simulation, "floor", "box");
        // Some ten roundings of 20 N.
        assert_vector_near(forces[0].1, dvec2(0.0, left), 1e-12);
        assert_vector_near(forces[1].1, dvec2(0.0, right), 1e-12);
    }
}
