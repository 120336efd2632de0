//! Coulomb friction on bodies that turn: rolling, tipping, grazing, braking. Section D of the validation cases, under every model that
//! keeps contacts rigid.

use crate::support;
use crate::support::{
    G, assert_near, assert_vector_near, ball, block, body, contact_force, direction, every, floor, incline, momentum,
    rigid, rough, simulation, weightless,
};
use glam::{DVec2, dvec2};
use tumble_math::trig;
use tumble_shape::Disc;
use tumble_sim::{Amount, Part, Settings, Simulation};
use tumble_solver::Surface;

/// c = I/(m R²) of sphere, disc, shell and hoop.
const ROLLING: [f64; 4] = [0.4, 0.5, 2.0 / 3.0, 1.0];

#[test]
fn d6_slip_becomes_roll() {
    for settings in rigid(every(1e-3)) {
        for c in ROLLING {
            let mut simulation = simulation(settings, rough(0.2, 0.2));
            floor(&mut simulation);
            ball(0.25, 2.0).inertia(c * 2.0 * 0.0625).at(0.0, 0.25).moving(5.0, 0.0).spawn(&mut simulation, "ball");
            let time = 5.0 / (0.2 * G * (1.0 + 1.0 / c));
            let way = 5.0 * time - 0.1 * G * time * time;
            let speed = 5.0 / (1.0 + c);
            let mut rolls_from = None;
            while simulation.time() < 2.0 {
                simulation.step().unwrap();
                let ball = body(&simulation, "ball");
                let slip = ball.velocity().x + 0.25 * ball.angular_velocity();
                if slip.abs() < 1e-9 && rolls_from.is_none() {
                    rolls_from = Some((simulation.time(), ball.position().x));
                }
            }
            let (found_time, found_way) = rolls_from.unwrap();
            // Rolling begins within a step; ways are g h t/2-like off: 1e-3 relative, as the case says.
            assert_near(found_time, time, 1e-3 + 1e-9);
            assert_near(found_way, way + speed * (found_time - time), 1e-3 * way);
            // The rolling speed follows from angular momentum about the contact alone: round-off.
            assert_near(body(&simulation, "ball").velocity().x, speed, 1e-10);
        }
    }
}

#[test]
fn d7_wheel_rolls_or_slips_down_the_slope() {
    let angle = 30.0_f64.to_radians();
    for settings in rigid(every(1e-3)) {
        for c in ROLLING {
            let critical = trig::tan(angle) / (1.0 + 1.0 / c);
            for friction in [critical * 1.001, critical * 0.999, 0.5 * critical] {
                let mut simulation = simulation(settings, rough(friction, friction));
                incline(&mut simulation, angle);
                let start = 0.25 * direction(angle).perp();
                ball(0.25, 2.0).inertia(c * 2.0 * 0.0625).at(start.x, start.y).spawn(&mut simulation, "ball");
                simulation.run_for(1.0).unwrap();
                let ball = body(&simulation, "ball");
                let speed = -ball.velocity().dot(direction(angle));
                let (expected, spin) = if friction > critical {
                    let a = G * trig::sin(angle) / (1.0 + c);
                    (a, a / 0.25)
                } else {
                    (G * (trig::sin(angle) - friction * trig::cos(angle)), friction * G * trig::cos(angle) / (c * 0.25))
                };
                // Constant accelerations: round-off of 1000 steps of the filter.
                assert_near(speed, expected, 1e-9);
                assert_near(ball.angular_velocity(), spin, 1e-8);
            }
        }
    }
}

#[test]
fn d12_box_slides_or_tips_whichever_comes_first() {
    let angle = |degrees: f64| degrees.to_radians();
    for settings in rigid(every(0.01)) {
        // Width over height 0.5: tips at 26.565° unless it slides before.
        for (friction, first) in [(0.4, "slides"), (0.6, "tips")] {
            let limit = trig::atan(if first == "slides" { friction } else { 0.5 }).to_degrees();
            for (degrees, happens) in [(limit - 0.05, false), (limit + 0.05, true)] {
                let mut simulation = simulation(settings, rough(friction, friction));
                incline(&mut simulation, angle(degrees));
                let start = 0.5 * direction(angle(degrees)).perp();
                block(0.5, 1.0, 1.0).at(start.x, start.y).turned(angle(degrees)).spawn(&mut simulation, "block");
                simulation.run_for(5.0).unwrap();
                let block = body(&simulation, "block");
                let turned = (block.angle() - angle(degrees)).abs();
                let way = -block.position().dot(direction(angle(degrees)));
                assert_eq!(turned > 1e-6, happens && first == "tips", "μ {friction}, {degrees}°: turned by {turned}");
                assert_eq!(way > 1e-6, happens, "μ {friction}, {degrees}°: moved by {way}");
            }
        }
    }
}

#[test]
fn d13_work_of_friction_is_force_times_slip() {
    let h = 0.01;
    for settings in rigid(every(h)) {
        let mut simulation = simulation(settings, rough(0.4, 0.4));
        floor(&mut simulation);
        block(1.0, 0.25, 3.0).at(0.0, 0.125).moving(4.0, 0.0).spawn(&mut simulation, "block");
        let mut work = 0.0;
        for _ in 0..90 {
            let before = body(&simulation, "block").velocity().x;
            simulation.step().unwrap();
            let force = contact_force(&mut simulation, "floor", "block");
            assert_near(force.x, -0.4 * force.y, 1e-9);
            // The work of an impulse is its product with the mean of the velocities before and after.
            work += force.x * h * 0.5 * (before + body(&simulation, "block").velocity().x);
        }
        let lost = 24.0 - body(&simulation, "block").kinetic_energy();
        // Round-off of 90 steps of 24 J.
        assert_near(work, -lost, 1e-11);
    }
}

/// Two discs in flight that graze each other after a gap along the line of their centres.
fn grazing(settings: Settings, gap: f64) -> Simulation {
    let surface = Surface { static_friction: 0.5, kinetic_friction: 0.3, restitution: 0.4 };
    let mut simulation = simulation(settings, surface);
    let centre = dvec2(0.6, 0.8) * (1.0 + gap);
    ball(0.5, 1.0).moving(3.0, 0.5).spinning(5.0).spawn(&mut simulation, "one");
    ball(0.5, 2.0).at(centre.x, centre.y).moving(-1.0, 0.0).spinning(-2.0).spawn(&mut simulation, "other");
    simulation
}

/// Momentum and angular momentum of the two discs at the start.
const BEFORE_GRAZING: (DVec2, f64) = (dvec2(1.0, 0.5), 1.6 + 0.125 * 5.0 - 0.25 * 2.0);

#[test]
fn d13_friction_between_two_free_bodies_keeps_momentum_and_angular_momentum() {
    for settings in rigid(weightless(1e-6)) {
        let mut simulation = grazing(settings, 0.0);
        simulation.step().unwrap();
        assert!((body(&simulation, "one").velocity() - dvec2(3.0, 0.5)).length() > 0.1, "they met");
        // Round-off.
        assert_vector_near(momentum(&simulation), BEFORE_GRAZING.0, 1e-12);
        assert_near(support::angular_momentum(&simulation), BEFORE_GRAZING.1, 1e-12);
    }
}

#[test]
fn d13_known_limit_setting_down_within_a_step_moves_angular_momentum_to_first_order() {
    let errors = [1e-3, 5e-4, 2.5e-4].map(|h| {
        // The discs approach at 2.8 m/s along the normal: half a step of overshoot for every h.
        let mut simulation = grazing(weightless(h), 2.8 * 2.5 * h);
        for _ in 0..5 {
            simulation.step().unwrap();
        }
        assert_vector_near(momentum(&simulation), BEFORE_GRAZING.0, 1e-12);
        let start = BEFORE_GRAZING.1 + 1.6 * 2.8 * 2.5 * h;
        (support::angular_momentum(&simulation) - start).abs()
    });
    // Bodies are pushed back onto each other's surface along the normal while they also pass each other: Δx × m v.
    assert_near(errors[0] / errors[1], 2.0, 0.2);
    assert_near(errors[1] / errors[2], 2.0, 0.2);
    // Reduced mass 2/3 kg, half a step of 2.8 m/s, slip of 3.2 m/s.
    assert!(errors[0] < 2.0 / 3.0 * 0.5 * 2.8e-3 * 3.5);
}

/// A car of 1000 kg that skids at 20 m/s: locked wheels where it brakes, and where it does not wheels that roll without resistance,
/// which is a foot without friction. Axles 1.5 m before and 1 m behind the centre, which is `height` above the road.
fn skidding_car(settings: Settings, friction: f64, height: f64, brakes: [bool; 2]) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    let rolling = simulation.materials_mut().set("rolling", Surface::default());
    let standard = simulation.materials_mut().find("default").unwrap();
    simulation.materials_mut().set_pair(rolling, standard, Surface::default());
    floor(&mut simulation);
    let car = block(4.0, 0.2, 1000.0).at(0.0, height).moving(20.0, 0.0).inertia(2000.0).spawn(&mut simulation, "car");
    for (x, brakes) in AXLES.into_iter().zip(brakes) {
        let wheel = Disc::try_new(dvec2(x, 0.25 - height), 0.25).unwrap();
        let wheel = Part::new(wheel, Amount::Mass(1e-9));
        simulation.attach(car, if brakes { wheel } else { wheel.material(rolling) });
    }
    simulation
}

/// Where the axles are, from the centre: rear, front [m].
const AXLES: [f64; 2] = [-1.0, 1.5];

#[test]
fn d14_braking_shifts_the_load_to_the_front_axle() {
    let (friction, height, base) = (0.8, 0.5, AXLES[1] - AXLES[0]);
    // With deceleration a: N_f L = m (g b + a h) and N_r L = m (g f − a h), b and f the ways from the centre to the rear and front axles;
    // m a = μ N of the axles that brake.
    let (front, rear) = (AXLES[1], -AXLES[0]);
    let cases = [
        ([true, true], friction * G),
        ([false, true], friction * G * rear / (base - friction * height)),
        ([true, false], friction * G * front / (base + friction * height)),
    ];
    for settings in rigid(every(1e-3)) {
        for (brakes, deceleration) in cases {
            let mut simulation = skidding_car(settings, friction, height, brakes);
            simulation.run_for(1.0).unwrap();
            // Constant forces, exact for symplectic Euler: round-off of 1000 steps and the weight of the wheels, 1e-12 of the car's.
            assert_near(body(&simulation, "car").velocity().x, 20.0 - deceleration, 1e-9);
            let forces = support::contact_forces(&mut simulation, "floor", "car");
            let [rear_load, front_load] = [forces[0].1.y, forces[1].1.y];
            assert_near(front_load, 1000.0 * (G * rear + deceleration * height) / base, 1e-6);
            assert_near(rear_load, 1000.0 * (G * front - deceleration * height) / base, 1e-6);
        }
    }
}

#[test]
fn d14_braking_car_tips_over_its_front_wheels_from_friction_times_height_on() {
    // The rear axle lifts off where a h = μ g h > g f: μ = 1.5 at a height of 1 m.
    for settings in rigid(every(1e-3)) {
        for (friction, tips) in [(1.5 * 0.999, false), (1.5 * 1.001, true)] {
            let mut simulation = skidding_car(settings, friction, 1.0, [true, true]);
            simulation.run_for(1.0).unwrap();
            let angle = body(&simulation, "car").angle();
            // Too much friction by a thousandth: 15 N·m, or more, on an inertia of 4250 kg·m² about the front wheels, 1.7 mrad in 1 s.
            assert_eq!(angle < -1e-3, tips, "μ {friction}: turned by {angle}");
            assert!(tips || angle.abs() < 1e-9, "μ {friction}: turned by {angle}");
        }
    }
}
