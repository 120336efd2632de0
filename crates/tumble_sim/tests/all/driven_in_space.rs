//! Bodies of space that are driven: by torques, whose integrator has an order, and along keyframes.

use crate::space_support::{RIGID, Start, near, on_a_floor, rough, settings, spawn};
use bevy_ecs::name::Name;
use glam::{DVec3, dvec3};
use tumble_math::{Rotation, Spatial, SpatialRotation};
use tumble_shape::{Cuboid, SpatialShape, Sphere};
use tumble_sim::{
    Amount, AngularVelocity, AppliedForce, Axes, BodyKind, ContactModel, Course, Integrator, Keyframe, Keyframes,
    Orientation, Part, Position, Settings, Simulation,
};

fn cuboid(size: DVec3) -> Cuboid {
    Cuboid::with_half_extents(size * 0.5).unwrap()
}

/// Where a box of three different sides has its corners after 2 s under a torque, in steps of `dt`.
fn driven(integrator: Integrator, axes: Axes, dt: f64) -> [DVec3; 2] {
    let settings = Settings { integrator, ..Settings::<Spatial>::weightless() };
    let mut simulation = Simulation::with_settings(Settings { dt, ..settings });
    let start = Start { spin: dvec3(0.7, -0.4, 1.1), ..Start::at(DVec3::ZERO) };
    let body = spawn(&mut simulation, "box", cuboid(dvec3(0.3, 0.6, 1.2)), 2.0, &start);
    simulation.spawn(AppliedForce::<Spatial> {
        body,
        point: DVec3::ZERO,
        force: DVec3::ZERO,
        torque: dvec3(0.2, 0.1, -0.15),
        axes,
        course: Course::lines([(0.0, 1.0), (2.0, 0.3)]),
    });
    if axes == Axes::Body {
        // A thruster off the centre: its torque turns with the body.
        simulation.spawn(AppliedForce::<Spatial> {
            body,
            point: dvec3(0.1, 0.2, 0.0),
            force: dvec3(0.5, 0.0, 1.0),
            torque: DVec3::ZERO,
            axes,
            course: Course::default(),
        });
    }
    simulation.run_for(2.0).unwrap();
    let body = simulation.body("box").unwrap();
    [DVec3::X, DVec3::Y].map(|corner| body.position() + body.rotation().rotate(corner))
}

#[test]
fn torque_on_an_asymmetric_body_is_integrated_to_the_order_of_the_integrator() {
    for axes in [Axes::World, Axes::Body] {
        for (integrator, order) in [(Integrator::SymplecticEuler, 2.0), (Integrator::Ballistic, 4.0)] {
            let [coarse, middle, fine] = [4e-3, 2e-3, 1e-3].map(|dt| driven(integrator, axes, dt));
            let apart =
                |one: [DVec3; 2], other: [DVec3; 2]| (one[0] - other[0]).length() + (one[1] - other[1]).length();
            let ratio = apart(coarse, middle) / apart(middle, fine);
            // Halving twice shows the order up to the next term, of one step in a hundred.
            assert!((ratio / order - 1.0).abs() < 0.05, "{integrator:?}, {axes:?}: {ratio}");
        }
    }
}

#[test]
fn a_body_follows_keyframes_in_space_under_both_integrators() {
    for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
        let mut simulation = Simulation::with_settings(Settings { integrator, ..Settings::<Spatial>::weightless() });
        let arm = simulation.spawn((Name::new("arm"), Position(DVec3::ZERO), BodyKind::Kinematic));
        simulation.attach(arm, Part::new(SpatialShape::from(cuboid(DVec3::ONE)), Amount::Density(0.0)));
        let turned = |vector: DVec3| SpatialRotation::from_rotation_vector(vector);
        let (middle, end) = (turned(dvec3(0.0, 0.0, 2.0)), turned(dvec3(0.5, -1.0, 0.3)));
        let frame = |time, x, rotation| Keyframe { time, position: DVec3::X * x, rotation };
        let path = vec![frame(0.0, 0.0, SpatialRotation::IDENTITY), frame(0.5, 1.0, middle), frame(1.0, 1.0, end)];
        simulation.world_mut().entity_mut(arm).insert(Keyframes(path));
        for (time, x, rotation) in [
            (0.25, 0.5, turned(dvec3(0.0, 0.0, 1.0))),
            (0.25, 1.0, middle),
            // Half of the turn from one to the other, about one axis.
            (0.25, 1.0, middle.turned(middle.angle_to(&end) * 0.5)),
            (0.25, 1.0, end),
            (0.5, 1.0, end),
        ] {
            simulation.run_for(time).unwrap();
            let arm = simulation.body("arm").unwrap();
            // Round-off of a few dozen steps.
            near(arm.position(), DVec3::X * x, 1e-12);
            near(arm.rotation().angle_to(&rotation), DVec3::ZERO, 1e-12);
        }
        near(simulation.body("arm").unwrap().angular_velocity(), DVec3::ZERO, 1e-12);
    }
}

#[test]
fn a_turntable_on_keyframes_carries_what_stands_on_it() {
    let mut simulation = on_a_floor(settings(ContactModel::VelocityLcp, 2e-3), rough(0.9));
    let table = simulation.spawn((
        Name::new("table"),
        Position(DVec3::Z * 0.5),
        Orientation(SpatialRotation::IDENTITY),
        BodyKind::Kinematic,
    ));
    simulation.attach(table, Part::new(SpatialShape::from(cuboid(dvec3(2.0, 2.0, 0.2))), Amount::Density(0.0)));
    let frame = |time, angle: f64| Keyframe {
        time,
        position: DVec3::Z * 0.5,
        rotation: SpatialRotation::from_rotation_vector(DVec3::Z * angle),
    };
    simulation.world_mut().entity_mut(table).insert(Keyframes(vec![frame(0.0, 0.0), frame(2.0, 1.5)]));
    let start = Start { velocity: DVec3::Y * 0.375, spin: DVec3::Z * 0.75, ..Start::at(dvec3(0.5, 0.0, 0.65)) };
    spawn(&mut simulation, "load", cuboid(dvec3(0.2, 0.2, 0.1)), 1.0, &start);
    simulation.run_for(2.0).unwrap();
    let load = simulation.body("load").unwrap();
    // Carried round with the table, outwards by what its velocity's tangent adds: ½ ω² r Δt² a step, in all 0.3 mm.
    let expected = SpatialRotation::from_rotation_vector(DVec3::Z * 1.5).rotate(start.at);
    near(load.position(), expected, 1e-3);
}

#[test]
fn d11_a_ball_on_a_turntable_circles_at_two_sevenths_of_its_rate() {
    for contact in RIGID {
        let mut simulation = on_a_floor(settings(contact, 1e-3), rough(0.9));
        let rate = 3.5;
        let table = simulation.spawn((
            Name::new("table"),
            Position(DVec3::Z),
            AngularVelocity(DVec3::Z * rate),
            BodyKind::Kinematic,
        ));
        simulation.attach(table, Part::new(SpatialShape::from(cuboid(dvec3(4.0, 4.0, 0.2))), Amount::Density(0.0)));
        let (radius, from_axis) = (0.1, dvec3(0.5, 0.0, 0.0));
        // Rolls from the start: v − R ω × z = W z × r with v = 2/7 W z × r.
        let start = Start {
            velocity: DVec3::Z.cross(from_axis) * (rate * 2.0 / 7.0),
            spin: from_axis * (5.0 / 7.0 * rate / radius),
            ..Start::at(from_axis + DVec3::Z * 1.2)
        };
        spawn(&mut simulation, "ball", Sphere::try_new(DVec3::ZERO, radius).unwrap(), 1.0, &start);
        // Half of the circle, at 1 rad/s: half a per cent of its length.
        simulation.run_for(std::f64::consts::PI).unwrap();
        let expected = dvec3(-0.5, 0.0, 1.2);
        near(simulation.body("ball").unwrap().position(), expected, 0.005 * 0.5 * std::f64::consts::PI);
    }
}
