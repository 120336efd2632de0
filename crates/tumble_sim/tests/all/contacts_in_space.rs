//! Contacts in space: the same step, the same models, three dimensions.

use crate::support;
use crate::support::{G, assert_near, body, bouncing, direction, floor, simulation};
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use glam::{DVec3, dvec2, dvec3};
use tumble_math::{Planar, Rotation, Spatial, SpatialRotation, SymmetricTensor, trig};
use tumble_shape::{Cuboid, Cylinder, HalfSpace, SpatialRod, SpatialShape, Sphere};
use tumble_sim::{
    Amount, AngularVelocity, BodyKind, ContactModel, InertiaOverride, LinearVelocity, Orientation, Part, Position,
    Settings, Simulation,
};
use tumble_solver::Surface;

const RIGID: [ContactModel; 3] = [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp];

fn settings(contact: ContactModel, dt: f64) -> Settings<Spatial> {
    Settings { dt, contact, gravity: dvec3(0.0, 0.0, -G), ..Settings::weightless() }
}

/// A world with a floor at height 0.
fn on_a_floor(settings: Settings<Spatial>, surface: Surface) -> Simulation<Spatial> {
    let mut simulation = Simulation::with_settings(settings);
    simulation.materials_mut().set("default", surface);
    let floor = simulation.spawn((Name::new("floor"), Position(DVec3::ZERO), BodyKind::Static));
    let half_space = HalfSpace::try_new(DVec3::Z, 0.0).unwrap();
    simulation.attach(floor, Part::new(SpatialShape::from(half_space), Amount::Density(0.0)));
    simulation
}

struct Start {
    at: DVec3,
    turned: SpatialRotation,
    velocity: DVec3,
    spin: DVec3,
}

impl Start {
    fn at(at: DVec3) -> Self {
        Self { at, turned: SpatialRotation::IDENTITY, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }
}

fn spawn(
    simulation: &mut Simulation<Spatial>,
    name: &str,
    shape: impl Into<SpatialShape>,
    mass: f64,
    start: &Start,
) -> Entity {
    let entity = simulation.spawn((
        Name::new(name.to_owned()),
        Position(start.at),
        Orientation(start.turned),
        LinearVelocity(start.velocity),
        AngularVelocity(start.spin),
    ));
    simulation.attach(entity, Part::new(shape.into(), Amount::Mass(mass)));
    entity
}

fn cuboid(size: DVec3) -> Cuboid {
    Cuboid::with_half_extents(size * 0.5).unwrap()
}

fn sphere(radius: f64) -> Sphere {
    Sphere::try_new(DVec3::ZERO, radius).unwrap()
}

fn near(measured: DVec3, expected: DVec3, tolerance: f64) {
    assert!((measured - expected).length() <= tolerance, "{measured} is not {expected} ± {tolerance:e}");
}

#[test]
fn a_box_rests_where_it_is_put() {
    for contact in RIGID {
        let rough = Surface { static_friction: 0.5, kinetic_friction: 0.5, restitution: 0.0 };
        let mut simulation = on_a_floor(settings(contact, 0.01), rough);
        spawn(&mut simulation, "box", cuboid(dvec3(1.0, 0.6, 0.4)), 2.0, &Start::at(dvec3(0.0, 0.0, 0.2)));
        simulation.run_for(10.0).unwrap();
        let resting = simulation.body("box").unwrap();
        // Round-off of a thousand steps.
        near(resting.position(), dvec3(0.0, 0.0, 0.2), 1e-11);
        near(resting.velocity(), DVec3::ZERO, 1e-11);
        near(resting.angular_velocity(), DVec3::ZERO, 1e-11);
    }
}

#[test]
fn c8_box_on_its_corner_rebounds_by_the_closed_form() {
    for contact in [ContactModel::Impulse, ContactModel::VelocityLcp] {
        let dt = 1e-9;
        let mut simulation = on_a_floor(Settings { gravity: DVec3::ZERO, ..settings(contact, dt) }, bouncing(0.5));
        let turned = SpatialRotation::IDENTITY
            .turned(dvec3(0.0, 0.4, 0.0))
            .turned(dvec3(0.6, 0.0, 0.0))
            .turned(dvec3(0.0, 0.0, 0.5));
        let lowest = [-0.5, 0.5]
            .iter()
            .flat_map(|&x| [-0.3, 0.3].map(|y| (x, y)))
            .flat_map(|(x, y)| [-0.2, 0.2].map(|z| turned.rotate(dvec3(x, y, z))))
            .min_by(|one, other| one.z.total_cmp(&other.z))
            .unwrap();
        near(lowest, dvec3(0.351934736761, 0.153923883258, -0.482130043893), 1e-11);
        let start = Start { turned, velocity: dvec3(0.0, 0.0, -2.0), ..Start::at(dvec3(0.0, 0.0, -lowest.z)) };
        spawn(&mut simulation, "box", cuboid(dvec3(1.0, 0.6, 0.4)), 2.0, &start);
        simulation.step().unwrap();
        let after = simulation.body("box").unwrap();
        assert_near(after.velocity().z, -0.864739164562, 1e-11);
        // Free rotation changes ω by some 20 rad/s² in the step that follows the impact.
        near(after.angular_velocity(), dvec3(0.448259439994, -5.10248390761, 0.290766217888), 1e-7);
        let corner = after.velocity() + after.angular_velocity().cross(lowest);
        assert_near(corner.z, 1.0, 1e-7);
    }
}

#[test]
fn c10_sphere_hits_a_rough_floor() {
    for (friction, tangential) in [(0.1, 2.66), (0.5, 15.0 / 7.0)] {
        for contact in [ContactModel::Impulse, ContactModel::VelocityLcp] {
            let surface = Surface { static_friction: friction, kinetic_friction: friction, restitution: 0.7 };
            let mut simulation = on_a_floor(Settings { gravity: DVec3::ZERO, ..settings(contact, 1e-6) }, surface);
            // Askew to the axes: friction knows no direction of its own.
            let along = dvec3(trig::cos(0.4), trig::sin(0.4), 0.0);
            let start = Start { velocity: along * 3.0 - DVec3::Z * 2.0, ..Start::at(dvec3(0.0, 0.0, 0.1)) };
            spawn(&mut simulation, "ball", sphere(0.1), 1.0, &start);
            simulation.step().unwrap();
            let after = simulation.body("ball").unwrap();
            near(after.velocity(), along * tangential + DVec3::Z * 1.4, 1e-12);
            // L about the point of contact stays: ω R = (3 − v_t)/c with c = 2/5.
            let spin = DVec3::Z.cross(along) * ((3.0 - tangential) / 0.4 / 0.1);
            near(after.angular_velocity(), spin, 1e-10);
        }
    }
}

#[test]
fn d6_sphere_slips_and_then_rolls() {
    let surface = Surface { static_friction: 0.2, kinetic_friction: 0.2, restitution: 0.0 };
    for contact in RIGID {
        let mut simulation = on_a_floor(settings(contact, 1e-3), surface);
        let start = Start { velocity: dvec3(3.0, 4.0, 0.0), ..Start::at(dvec3(0.0, 0.0, 0.1)) };
        spawn(&mut simulation, "ball", sphere(0.1), 1.0, &start);
        simulation.run_for(1.5).unwrap();
        let rolling = simulation.body("ball").unwrap();
        // v₀/(1 + c) once it rolls, whatever the direction; the step in which slipping ends shares its friction out exactly.
        near(rolling.velocity(), dvec3(0.6, 0.8, 0.0) * 3.57142857143, 1e-9);
        near(rolling.angular_velocity(), dvec3(-0.8, 0.6, 0.0) * 35.7142857143, 1e-7);
    }
}

#[test]
fn d8_sliding_is_alike_in_every_direction() {
    for contact in RIGID {
        let distances = [0.0, 15.0, 30.0, 45.0_f64].map(|degrees| {
            let surface = Surface { static_friction: 0.4, kinetic_friction: 0.4, restitution: 0.0 };
            let mut simulation = on_a_floor(settings(contact, 1e-3), surface);
            let heading = direction(degrees.to_radians());
            let along = dvec3(heading.x, heading.y, 0.0);
            let start = Start { velocity: along * 2.0, ..Start::at(dvec3(0.0, 0.0, 0.05)) };
            spawn(&mut simulation, "block", cuboid(dvec3(0.5, 0.5, 0.1)), 1.0, &start);
            simulation.run_for(0.6).unwrap();
            let block = simulation.body("block").unwrap();
            assert!(block.velocity().length() < 1e-9, "{contact:?} at {degrees}°: {}", block.velocity());
            let way = block.position() - start.at;
            // A straight line.
            assert!(way.cross(along).length() < 1e-9, "{contact:?} at {degrees}°: {way}");
            way.dot(along)
        });
        // v²/(2 μ g), short of it by v₀ h/2 for symplectic Euler.
        assert_near(distances[0], 0.509683995923, 1.1e-3);
        for distance in distances {
            assert_near(distance, distances[0], 1e-9);
        }
    }
}

#[test]
fn a_rod_of_the_plane_moves_alike_in_space() {
    let surface = Surface { static_friction: 0.3, kinetic_friction: 0.2, restitution: 0.6 };
    let mut plane = simulation(Settings::<Planar> { dt: 1e-3, ..Settings::default() }, surface);
    floor(&mut plane);
    support::rod(1.0, 1.0).at(0.0, 1.0).turned(0.5).moving(0.7, 0.0).spinning(0.9).spawn(&mut plane, "rod");

    let mut space = on_a_floor(settings(ContactModel::Impulse, 1e-3), surface);
    let rod = SpatialRod::try_new(dvec3(-0.5, 0.0, 0.0), dvec3(0.5, 0.0, 0.0), 0.0).unwrap();
    // Counter-clockwise from x to z is about −y.
    let start = Start {
        turned: SpatialRotation::IDENTITY.turned(dvec3(0.0, -0.5, 0.0)),
        velocity: dvec3(0.7, 0.0, 0.0),
        spin: dvec3(0.0, -0.9, 0.0),
        ..Start::at(dvec3(0.0, 0.0, 1.0))
    };
    let rod = spawn(&mut space, "rod", rod, 1.0, &start);
    // A line of mass has no inertia about itself; what it is given there never matters.
    let inertia = SymmetricTensor::from_diagonal(dvec3(1e-3, 1.0 / 12.0, 1.0 / 12.0));
    space.world_mut().entity_mut(rod).insert(InertiaOverride(inertia));
    for _ in 0..1000 {
        plane.step().unwrap();
        space.step().unwrap();
        let (flat, deep) = (body(&plane, "rod"), space.body("rod").unwrap());
        let seen = dvec2(deep.position().x, deep.position().z);
        // Quaternions and angles round differently, and each of the few impacts multiplies that.
        assert!((flat.position() - seen).length() < 1e-9, "{} and {seen} at {} s", flat.position(), plane.time());
        assert!(deep.position().y.abs() < 1e-12);
    }
}

#[test]
fn a_cylinder_stands_on_a_table_and_another_one_on_it() {
    for contact in RIGID {
        let rough = Surface { static_friction: 0.5, kinetic_friction: 0.5, restitution: 0.0 };
        let mut simulation = on_a_floor(settings(contact, 0.01), rough);
        spawn(&mut simulation, "table", cuboid(dvec3(2.0, 2.0, 0.4)), 20.0, &Start::at(dvec3(0.0, 0.0, 0.2)));
        for (name, height, mass) in [("lower", 0.8, 2.0), ("upper", 1.6, 5.0)] {
            let can = Cylinder::try_new(dvec3(0.0, 0.0, -0.4), dvec3(0.0, 0.0, 0.4), 0.25).unwrap();
            spawn(&mut simulation, name, can, mass, &Start::at(dvec3(0.3, 0.1, height)));
        }
        simulation.run_for(5.0).unwrap();
        for (name, height) in [("lower", 0.8), ("upper", 1.6)] {
            let can = simulation.body(name).unwrap();
            // One-by-one impulses settle first, to their tolerance; then all that is left is round-off.
            let tolerance = if contact == ContactModel::Impulse { 1e-6 } else { 1e-12 };
            near(can.position(), dvec3(0.3, 0.1, height), tolerance);
            near(can.angular_velocity(), DVec3::ZERO, tolerance);
        }
    }
}

#[test]
fn d7_a_cylinder_rolls_down_a_plank() {
    let surface = Surface { static_friction: 0.4, kinetic_friction: 0.4, restitution: 0.0 };
    for contact in RIGID {
        let mut simulation = Simulation::with_settings(settings(contact, 1e-3));
        simulation.materials_mut().set("default", surface);
        let turned = SpatialRotation::IDENTITY.turned(dvec3(0.0, 30f64.to_radians(), 0.0));
        let plank =
            simulation.spawn((Name::new("plank"), Position(DVec3::ZERO), Orientation(turned), BodyKind::Static));
        simulation.attach(plank, Part::new(SpatialShape::from(cuboid(dvec3(20.0, 4.0, 0.2))), Amount::Density(0.0)));
        let down = turned.rotate(DVec3::X);
        let log = Cylinder::try_new(dvec3(0.0, -0.5, 0.0), dvec3(0.0, 0.5, 0.0), 0.1).unwrap();
        let start = Start { turned, ..Start::at(turned.rotate(dvec3(-5.0, 0.0, 0.2))) };
        spawn(&mut simulation, "log", log, 3.0, &start);
        simulation.run_for(1.0).unwrap();
        let log = simulation.body("log").unwrap();
        // g sin θ/(1 + ½); symplectic Euler is half a step ahead in the way.
        near(log.velocity(), down * 3.27, 1e-6);
        near(log.position() - start.at, down * 1.635, 2e-3);
        near(log.angular_velocity(), DVec3::Y * 32.7, 1e-5);
    }
}
