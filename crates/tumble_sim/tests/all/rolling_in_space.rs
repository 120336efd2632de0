//! Wheels, discs, balls and tops on a floor: G7 to G9 of the validation cases, and torsion.

use crate::space_support::{G, RIGID, Start, near, on_a_floor, rough, settings, spawn};
use glam::{DVec3, dvec3};
use tumble_math::{Inertia, Rotation, Spatial, SpatialRotation, SymmetricTensor, trig};
use tumble_shape::{Cone, Cylinder, Sphere};
use tumble_sim::{CentreOverride, ContactModel, InertiaOverride, Simulation};

const RADIUS: f64 = 0.1;

/// A disc of 1 kg with its axis along its y, so thin that it cannot stand.
fn thin_disc() -> Cylinder {
    Cylinder::try_new(DVec3::Y * -5e-7, DVec3::Y * 5e-7, RADIUS).unwrap()
}

#[test]
fn g8_a_tilted_disc_rolls_in_a_circle() {
    for contact in RIGID {
        let mut simulation = on_a_floor(settings(contact, 1e-4), rough(0.5));
        let (sine, cosine) = trig::sin_cos(60_f64.to_radians());
        let (axis, up) = (dvec3(sine, 0.0, cosine), dvec3(-cosine, 0.0, sine));
        let start = Start {
            // Takes y to the axis.
            turned: SpatialRotation::IDENTITY
                .turned(DVec3::Z * -90_f64.to_radians())
                .turned(DVec3::Y * -30_f64.to_radians()),
            velocity: DVec3::Y * (3.4994381451 * 0.3),
            // About the vertical, and −10.4984 rad/s about the axis in all.
            spin: DVec3::Z * 3.4994381451 + axis * (-10.4983144353 - 3.4994381451 * cosine),
            ..Start::at(up * RADIUS + dvec3(0.3 + RADIUS * cosine, 0.0, 5e-7 * cosine))
        };
        near(start.turned.rotate(DVec3::Y), axis, 1e-15);
        let disc = spawn(&mut simulation, "disc", thin_disc(), 1.0, &start);
        let inertia = SymmetricTensor::from_diagonal(dvec3(0.0025, 0.005, 0.0025));
        simulation.world_mut().entity_mut(disc).insert(InertiaOverride(inertia));
        let turn = 2.0 * std::f64::consts::PI / 3.4994381451;
        while simulation.time() < turn {
            simulation.step().unwrap();
            let disc = simulation.body("disc").unwrap();
            let tilt = trig::acos(disc.rotation().rotate(DVec3::Y).z).to_degrees();
            // 1° by the case.
            assert!((tilt - 60.0).abs() < 0.1, "{contact:?}: {tilt}° at {} s", simulation.time());
            let place = disc.position();
            // First order in the step.
            assert!((dvec3(place.x, place.y, 0.0).length() - 0.3).abs() < 3e-3, "{contact:?}: {place}");
        }
        // Round once: 2 % of the way.
        near(simulation.body("disc").unwrap().position(), dvec3(0.3, 0.0, RADIUS * sine), 0.04);
    }
}

/// A wheel of 1 kg that rolls upright along x at a share of the least speed at which it stays upright, with inertia I_a about its axle
/// and I_d = I_a/2 about a diameter [kg·m²]. Also the rate at which its lean grows below that speed, or swings above it [rad/s].
///
/// ```text
/// small lean θ and yaw ψ, Ω = v/R
/// about the contact    (I_d + m R²) θ̈ = m g R θ + (I_a + m R²) Ω ψ̇
/// about the vertical   I_d ψ̈ = −I_a Ω θ̇                               friction sideways is right below the centre
/// upright at first     (I_d + m R²) θ̈ = (m g R − (I_a + m R²) Ω² I_a/I_d) θ
/// ```
///
/// It begins upright with θ̇ = [`LEAN`] · rate, so that θ is `LEAN` sin(rate t), or `LEAN` sinh(rate t).
fn upright_wheel(contact: ContactModel, axial: f64, share: f64) -> (Simulation<Spatial>, f64) {
    let (across, moved) = (0.5 * axial, RADIUS * RADIUS);
    let least_turning = (G * RADIUS * across / (axial * (axial + moved))).sqrt();
    let turning = share * least_turning;
    let rate = (G * RADIUS * (1.0 - share * share).abs() / (across + moved)).sqrt();
    let mut simulation = on_a_floor(settings(contact, 1e-3), rough(0.5));
    let spin = dvec3(LEAN * rate, turning, 0.0);
    let start = Start { spin, velocity: spin.cross(DVec3::Z * RADIUS), ..Start::at(DVec3::Z * RADIUS) };
    // The rim of a cone is a wheel without any width to stand on.
    let shape = Cone::try_new(DVec3::ZERO, DVec3::Y * 0.05, RADIUS).unwrap();
    let wheel = spawn(&mut simulation, "wheel", shape, 1.0, &start);
    let inertia = SymmetricTensor::from_diagonal(dvec3(across, axial, across));
    simulation.world_mut().entity_mut(wheel).insert((CentreOverride(DVec3::ZERO), InertiaOverride(inertia)));
    (simulation, rate)
}

/// Scale of the lean of upright wheels [rad].
const LEAN: f64 = 1e-5;
/// Inertia about the axle of a disc and of a hoop [kg·m²].
const WHEELS: [f64; 2] = [0.5 * RADIUS * RADIUS, RADIUS * RADIUS];

/// Lean of a wheel, in parts of [`LEAN`] [1].
fn lean(simulation: &Simulation<Spatial>) -> f64 {
    simulation.body("wheel").unwrap().rotation().rotate(DVec3::Y).z / LEAN
}

#[test]
fn g7_an_upright_wheel_keeps_rolling_above_its_least_speed() {
    for contact in RIGID {
        for (axial, share) in WHEELS.into_iter().flat_map(|axial| [1.05, 1.01].map(|share| (axial, share))) {
            let (mut simulation, _) = upright_wheel(contact, axial, share);
            let mut most = 0.0_f64;
            while simulation.time() < 4.0 {
                simulation.step().unwrap();
                most = most.max(lean(&simulation).abs());
            }
            // The amplitude is 1, and is reached within 4 s; first order in the step: 0.983 to 0.995.
            assert!((0.97..1.0).contains(&most), "{contact:?}, I {axial}, {share} of the speed: leaned by {most}");
        }
    }
}

#[test]
fn g7_an_upright_wheel_leans_over_below_its_least_speed() {
    let sinh = |x: f64| 0.5 * (trig::exp(x) - trig::exp(-x));
    for contact in RIGID {
        for (axial, share) in WHEELS.into_iter().flat_map(|axial| [0.99, 0.95].map(|share| (axial, share))) {
            let (mut simulation, rate) = upright_wheel(contact, axial, share);
            simulation.run_for(1.0).unwrap();
            let first = lean(&simulation);
            simulation.run_for(2.0).unwrap();
            let grown = 0.5 * trig::ln(lean(&simulation) / first);
            let expected = 0.5 * trig::ln(sinh(3.0 * rate) / sinh(rate));
            // First order in the step: 0.013/s of 1.3/s and 0.012/s of 2.8/s for the disc, less for the hoop.
            let what = format!("{contact:?}, I {axial}, {share} of the speed");
            assert!((grown - expected).abs() < 0.02, "{what}: grows at {grown}/s, not {expected}/s");
        }
    }
}

/// The tippe top of G9, and the arm of its contact point.
fn tippe_top(contact: ContactModel) -> Simulation<Spatial> {
    let settings = tumble_sim::Settings { length_scale: 0.01, ..settings(contact, 1e-4) };
    let mut simulation = on_a_floor(settings, rough(0.3));
    let start = Start {
        turned: SpatialRotation::IDENTITY.turned(DVec3::X * 0.1),
        spin: DVec3::Z * 180.0,
        ..Start::at(dvec3(0.0, 0.0, 0.015))
    };
    let top = spawn(&mut simulation, "top", Sphere::try_new(DVec3::ZERO, 0.015).unwrap(), 0.006, &start);
    simulation.world_mut().entity_mut(top).insert((
        CentreOverride(DVec3::Z * -0.003),
        InertiaOverride(SymmetricTensor::from_diagonal(dvec3(8e-7, 8e-7, 7e-7))),
    ));
    simulation.prepare().unwrap();
    simulation
}

#[test]
fn g9_a_tippe_top_inverts_and_keeps_jelletts_invariant() {
    for contact in RIGID {
        let mut simulation = tippe_top(contact);
        let look = |simulation: &Simulation<Spatial>| {
            let top = simulation.body("top").unwrap();
            let stem = top.rotation().rotate(DVec3::Z);
            let momentum = top.inertia().in_world(&top.rotation()).apply(top.angular_velocity());
            (stem.z, momentum.dot(stem * 0.003 - DVec3::Z * 0.015), top.position().z)
        };
        let (_, before, _) = look(&simulation);
        while simulation.time() < 1.0 {
            simulation.step().unwrap();
            let (_, now, _) = look(&simulation);
            // Friction at a point has no torque about the line to the centre of the ball: first order in a step that turns by 0.018 rad.
            assert!((now / before - 1.0).abs() < 1e-3, "{contact:?}: {} at {} s", now / before, simulation.time());
        }
        let (stem, _, height) = look(&simulation);
        // The stem has gone from 5.7° past 120°, and the centre of mass has risen above that of the ball.
        assert!(stem < -0.5 && height > 0.0165, "{contact:?}: stem {stem}, centre at {height} m");
    }
}

#[test]
fn g9_spun_about_its_own_axis_instead_it_gets_up_and_rolls() {
    // Friction at a point first turns the angular momentum upright, to where rolling needs no more than μ g: ω² e sin θ < μ g, 1.7°.
    let mut simulation = tippe_top(ContactModel::VelocityLcp);
    let top = simulation.entity("top").unwrap();
    let axis = simulation.body("top").unwrap().rotation().rotate(DVec3::Z);
    simulation.world_mut().entity_mut(top).insert(tumble_sim::AngularVelocity(axis * 180.0));
    simulation.run_for(0.5).unwrap();
    let tilt = trig::acos(simulation.body("top").unwrap().rotation().rotate(DVec3::Z).z).to_degrees();
    assert!(tilt < 3.0, "{tilt}°");
}

#[test]
fn friction_at_a_point_does_not_brake_a_spinning_ball() {
    for contact in RIGID {
        let mut simulation = on_a_floor(settings(contact, 1e-3), rough(0.8));
        // One spins on its place, one while it rolls.
        let still = Start { spin: DVec3::Z * 30.0, ..Start::at(DVec3::Z * 0.1) };
        let rolling =
            Start { velocity: dvec3(1.0, 0.0, 0.0), spin: dvec3(0.0, 10.0, 30.0), ..Start::at(dvec3(0.0, 1.0, 0.1)) };
        let ball = Sphere::try_new(DVec3::ZERO, 0.1).unwrap();
        spawn(&mut simulation, "still", ball.clone(), 1.0, &still);
        spawn(&mut simulation, "rolling", ball, 1.0, &rolling);
        simulation.run_for(5.0).unwrap();
        for (name, start) in [("still", still), ("rolling", rolling)] {
            let ball = simulation.body(name).unwrap();
            // Round-off of 5000 steps.
            near(ball.angular_velocity(), start.spin, 1e-9);
            near(ball.position(), start.at + start.velocity * 5.0, 1e-9);
        }
    }
}

#[test]
fn a_cylinder_rolls_fast_under_every_model() {
    for contact in RIGID {
        let mut simulation = on_a_floor(settings(contact, 1e-3), rough(0.4));
        let log = Cylinder::try_new(dvec3(0.0, -0.5, 0.0), dvec3(0.0, 0.5, 0.0), RADIUS).unwrap();
        // ω² r = 250 g.
        let speed = 156.0 * RADIUS;
        let start = Start { velocity: DVec3::X * speed, spin: DVec3::Y * 156.0, ..Start::at(DVec3::Z * RADIUS) };
        spawn(&mut simulation, "log", log, 3.0, &start);
        simulation.run_for(1.0).unwrap();
        let log = simulation.body("log").unwrap();
        near(log.velocity(), start.velocity, 1e-9);
        near(log.angular_velocity(), start.spin, 1e-8);
        assert!((log.position().z - RADIUS).abs() < 1e-9, "{}", log.position());
    }
}

#[test]
fn a_spinning_plate_on_its_edge_presses_with_its_weight_alone() {
    // Upright and spinning about the vertical through its contact. Its two points are 1 µm apart, with friction 0.5: ω̇ = μ g · 5e-7 m/(I/m).
    let mut simulation = on_a_floor(settings(ContactModel::RestingLcp, 1e-3), rough(0.5));
    let start = Start { spin: DVec3::Z * 40.0, ..Start::at(DVec3::Z * RADIUS) };
    let disc = spawn(&mut simulation, "disc", thin_disc(), 1.0, &start);
    let inertia = SymmetricTensor::from_diagonal(dvec3(0.0025, 0.005, 0.0025));
    simulation.world_mut().entity_mut(disc).insert(InertiaOverride(inertia));
    simulation.run_for(0.5).unwrap();
    let disc = simulation.body("disc").unwrap();
    near(disc.position(), start.at, 1e-9);
    near(disc.angular_velocity(), start.spin, 1.1 * 0.5 * 9.81 * 5e-7 / 0.0025 * 0.5);
}
