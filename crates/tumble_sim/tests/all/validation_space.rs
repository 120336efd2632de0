//! Joints of space against closed forms, and tops (section G of the validation cases).

use crate::support::{G, assert_near, direction};
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use glam::{DMat3, DQuat, DVec3, dvec3};
use tumble_math::{Inertia, Rotation, Spatial, SpatialRotation, SymmetricTensor};
use tumble_shape::{Cuboid, SpatialShape, Sphere};
use tumble_sim::{
    Amount, Anchor, AngularVelocity, ContactModel, InertiaOverride, Integrator, Joint, JointProblem, Ledger,
    LinearVelocity, Orientation, Part, Position, Settings, Simulation, SpatialJointKind,
};

const RIGID: [ContactModel; 3] = [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp];
const INTEGRATORS: [Integrator; 2] = [Integrator::SymplecticEuler, Integrator::Ballistic];

fn settings(contact: ContactModel, integrator: Integrator, dt: f64) -> Settings<Spatial> {
    Settings { dt, contact, integrator, gravity: dvec3(0.0, 0.0, -G), ..Settings::weightless() }
}

/// Every rigid model with every integrator. A test that fails shows the last one it was in.
fn rigid(dt: f64) -> impl Iterator<Item = Settings<Spatial>> {
    RIGID.into_iter().flat_map(move |contact| INTEGRATORS.map(|integrator| (contact, integrator))).map(
        move |(contact, integrator)| {
            println!("under {} with {integrator:?}", contact.word());
            settings(contact, integrator, dt)
        },
    )
}

/// A body of a shape and a mass, at a place in a rotation.
fn spawn(
    simulation: &mut Simulation<Spatial>,
    name: &str,
    shape: impl Into<SpatialShape>,
    mass: f64,
    at: DVec3,
    turned: SpatialRotation,
) -> Entity {
    let entity = simulation.spawn((Name::new(name.to_owned()), Position(at), Orientation(turned)));
    simulation.attach(entity, Part::new(shape.into(), Amount::Mass(mass)));
    entity
}

fn cuboid(size: DVec3) -> Cuboid {
    Cuboid::with_half_extents(size * 0.5).unwrap()
}

fn hold(simulation: &mut Simulation<Spatial>, name: &str, a: Anchor<DVec3>, b: Anchor<DVec3>, kind: SpatialJointKind) {
    simulation.spawn((Name::new(name.to_owned()), Joint { a, b, kind }));
}

/// The rotation that takes one right-handed frame to another.
fn from_to(from: DMat3, to: DMat3) -> SpatialRotation {
    SpatialRotation::try_from_quaternion(DQuat::from_mat3(&(to * from.transpose()))).unwrap()
}

fn angular_momentum_about_origin(simulation: &Simulation<Spatial>, name: &str) -> DVec3 {
    let body = simulation.body(name).unwrap();
    let own = body.inertia().in_world(&body.rotation()).apply(body.angular_velocity());
    body.position().cross(body.velocity() * body.mass()) + own
}

/// Force and torque of the only joint in the last step, on its second body, about that body's centre of mass [N], [N·m].
fn wrench(simulation: &Simulation<Spatial>) -> (DVec3, DVec3) {
    let (impulse, angular) = simulation.world().resource::<JointProblem<Spatial>>().given(0);
    (impulse / simulation.clock().dt, angular / simulation.clock().dt)
}

/// A box of 2 kg on a level hinge through its body-frame axis (1, 2, 2), 0.4 m from its centre, 45° from hanging.
struct PhysicalPendulum {
    simulation: Simulation<Spatial>,
    /// Along the hinge, world axes.
    axis: DVec3,
    /// Period of its swings of 45° [s].
    period: f64,
}

impl PhysicalPendulum {
    fn new(settings: Settings<Spatial>) -> Self {
        let mut simulation = Simulation::with_settings(settings);
        let (axis_body, to_anchor) = (dvec3(1.0, 2.0, 2.0) / 3.0, dvec3(2.0, 1.0, -2.0) / 3.0);
        let level = direction(0.7);
        let axis = dvec3(level.x, level.y, 0.0);
        let hangs = SpatialRotation::IDENTITY.turned(axis * 45f64.to_radians()).rotate(-DVec3::Z);
        let frame = |axis: DVec3, down: DVec3| DMat3::from_cols(axis, down, axis.cross(down));
        let turned = from_to(frame(axis_body, -to_anchor), frame(axis, hangs));
        let shape = cuboid(dvec3(0.3, 0.5, 0.9));
        let bob = spawn(&mut simulation, "bob", shape, 2.0, hangs * 0.4, turned);
        let (a, b) = (Anchor::World(DVec3::ZERO), Anchor::Body(bob, to_anchor * 0.4));
        // Axes of any length.
        hold(&mut simulation, "hinge", a, b, SpatialJointKind::Revolute { axis: axis * 3.0 });
        simulation.prepare().unwrap();
        let inertia = simulation.body("bob").unwrap().inertia().apply(axis_body).dot(axis_body);
        // B6 has the period of a point mass at 1 m.
        let effective_length = (inertia / 2.0 + 0.16) / 0.4;
        Self { simulation, axis, period: 2.08625587261 * effective_length.sqrt() }
    }

    /// Horizontal place of the centre, across the hinge [m].
    fn aside(&self) -> f64 {
        self.simulation.body("bob").unwrap().position().dot(DVec3::Z.cross(self.axis))
    }

    /// Time between two passages through the vertical in the same direction, by interpolation [s].
    fn measured_period(&mut self) -> f64 {
        let (mut passages, mut before) = (Vec::new(), self.aside());
        while passages.len() < 2 {
            self.simulation.step().unwrap();
            let now = self.aside();
            if before > 0.0 && now <= 0.0 {
                passages.push(self.simulation.time() - self.simulation.clock().dt * now / (now - before));
            }
            before = now;
        }
        passages[1] - passages[0]
    }
}

#[test]
fn b6_physical_pendulum_on_a_hinge_askew_keeps_its_period_and_its_plane() {
    for settings in rigid(1e-3) {
        let mut pendulum = PhysicalPendulum::new(settings);
        let (axis, expected) = (pendulum.axis, pendulum.period);
        let held = pendulum.simulation.body("bob").unwrap().rotation().unrotate(axis);
        let measured = pendulum.measured_period();
        // As in the plane: second order, 1e-4 at 1e-3 s.
        assert_near(measured / expected, 1.0, 1e-4);
        for _ in 0..3000 {
            pendulum.simulation.step().unwrap();
            let bob = pendulum.simulation.body("bob").unwrap();
            let turned_off = bob.rotation().rotate(held).cross(axis).length();
            // The hinge's axis is no principal axis: it has to bear centrifugal torques all the time. Round-off of each step.
            assert!(bob.position().dot(axis).abs() < 1e-13 && turned_off < 1e-13, "{} {turned_off}", bob.position());
            if settings.integrator == Integrator::Ballistic {
                // Velocities belong to the end of the step, and the hinge holds them as well.
                assert!(bob.angular_velocity().cross(axis).length() < 1e-12);
            }
        }
    }
}

#[test]
fn energy_on_a_hinge_does_not_drift() {
    for settings in rigid(5e-3) {
        let mut pendulum = PhysicalPendulum::new(settings);
        let energy = |pendulum: &PhysicalPendulum| {
            let bob = pendulum.simulation.body("bob").unwrap();
            bob.kinetic_energy() + 2.0 * G * bob.position().z
        };
        let start = energy(&pendulum);
        let (mut early, mut late): (f64, f64) = (0.0, 0.0);
        for step in 0..8_000 {
            pendulum.simulation.step().unwrap();
            let part = if step < 1_000 { &mut early } else { &mut late };
            *part = part.max((energy(&pendulum) - start).abs());
        }
        // Symmetric in time: after 40 s the error is what it was in the first 5 s.
        assert!(late <= 1.1 * early, "{early} J, later {late} J");
    }
}

#[test]
fn books_close_with_joints_of_space() {
    for contact in ContactModel::ALL {
        for integrator in INTEGRATORS {
            let mut pendulum = PhysicalPendulum::new(settings(contact, integrator, 2e-3));
            pendulum.simulation.keep_ledger();
            for step in 0..1000 {
                pendulum.simulation.step().unwrap();
                let ledger = *pendulum.simulation.world().resource::<Ledger>();
                // Round-off of energies of some ten joules; soft steps sum impulses in single precision.
                let round_off = if contact == ContactModel::SoftStep { 1e-5 } else { 1e-12 };
                assert!(ledger.error.abs() < round_off, "{contact:?} {integrator:?}, step {step}: {ledger:?}");
            }
        }
    }
}

#[test]
fn weld_to_the_world_carries_the_weight_and_its_moment() {
    for settings in rigid(0.01) {
        let mut simulation = Simulation::with_settings(settings);
        let turned = SpatialRotation::from_rotation_vector(dvec3(0.3, -0.2, 0.9));
        let shelf = spawn(&mut simulation, "shelf", cuboid(dvec3(1.0, 0.6, 0.1)), 3.0, dvec3(0.5, 0.0, 2.0), turned);
        let (a, b) =
            (Anchor::World(dvec3(0.5, 0.0, 2.0) + turned.rotate(dvec3(-0.5, 0.1, 0.0))), dvec3(-0.5, 0.1, 0.0));
        hold(&mut simulation, "weld", a, Anchor::Body(shelf, b), SpatialJointKind::Fixed);
        for _ in 0..500 {
            simulation.step().unwrap();
        }
        let shelf = simulation.body("shelf").unwrap();
        // Round-off of 500 steps.
        assert!((shelf.position() - dvec3(0.5, 0.0, 2.0)).length() < 1e-13, "{}", shelf.position());
        assert!(shelf.rotation().turn_to(&turned).rotation_vector().length() < 1e-13);
        let (force, about_centre) = wrench(&simulation);
        assert!((force - DVec3::Z * 3.0 * G).length() < 1e-10, "{force}");
        assert!(about_centre.length() < 1e-10, "{about_centre}");
    }
}

#[test]
fn a_slider_on_an_incline_slides_down_it() {
    for contact in RIGID {
        let mut simulation = Simulation::with_settings(settings(contact, Integrator::SymplecticEuler, 0.01));
        let turned = SpatialRotation::from_rotation_vector(dvec3(0.5, 1.0, -0.4));
        let carriage = spawn(&mut simulation, "carriage", cuboid(dvec3(0.3, 0.2, 0.6)), 1.5, DVec3::ZERO, turned);
        // The rail does not pass through the centre of mass, so the weight would turn the body.
        let (anchor, rail) = (dvec3(0.1, 0.2, -0.3), dvec3(2.0, 1.0, -1.0).normalize());
        let a = Anchor::World(turned.rotate(anchor) - rail * 0.7);
        hold(&mut simulation, "rail", a, Anchor::Body(carriage, anchor), SpatialJointKind::Prismatic { axis: rail });
        for _ in 0..100 {
            simulation.step().unwrap();
        }
        let carriage = simulation.body("carriage").unwrap();
        // Free fall's recurrence with g along the rail: h² n (n + 1)/2 = 0.505. Round-off of metres.
        let along = -G * rail.z * rail;
        assert!((carriage.position() - along * 0.505).length() < 1e-12, "{}", carriage.position());
        assert!((carriage.velocity() - along).length() < 1e-12, "{}", carriage.velocity());
        assert!(carriage.rotation().turn_to(&turned).rotation_vector().length() < 1e-13);
    }
}

/// Two boxes of 1 and 3 kg thrown and spinning, welded or of one piece, after 1 s: the place of the second, and a point of it.
fn thrown(settings: Settings<Spatial>, welded: bool) -> [DVec3; 2] {
    let mut simulation = Simulation::with_settings(settings);
    let (small, large) = (cuboid(dvec3(0.4, 0.3, 0.2)), cuboid(dvec3(0.5, 0.2, 0.8)));
    let offset = dvec3(0.3, 0.25, 0.1);
    let (velocity, spin) = (dvec3(1.0, 2.0, 3.0), dvec3(2.0, -1.0, 3.0));
    let from = SpatialRotation::from_rotation_vector(dvec3(0.1, 0.2, 0.3));
    let launch = |simulation: &mut Simulation<Spatial>, body: Entity, arm: DVec3| {
        let velocity = velocity + spin.cross(from.rotate(arm));
        simulation.world_mut().entity_mut(body).insert((LinearVelocity(velocity), AngularVelocity(spin)));
    };
    let centre = offset * 0.75;
    if welded {
        let first = spawn(&mut simulation, "first", small, 1.0, DVec3::ZERO, from);
        let second = spawn(&mut simulation, "second", large, 3.0, from.rotate(offset), from);
        launch(&mut simulation, first, -centre);
        launch(&mut simulation, second, offset - centre);
        let (a, b) = (Anchor::Body(first, offset * 0.5), Anchor::Body(second, offset * -0.5));
        hold(&mut simulation, "weld", a, b, SpatialJointKind::Fixed);
    } else {
        let both = spawn(&mut simulation, "both", small, 1.0, DVec3::ZERO, from);
        simulation.attach(both, Part::new(SpatialShape::from(large).translated(offset), Amount::Mass(3.0)));
        simulation.prepare().unwrap();
        launch(&mut simulation, both, DVec3::ZERO);
    }
    simulation.run_for(1.0).unwrap();
    let (body, at) = match welded {
        true => (simulation.body("second").unwrap(), DVec3::ZERO),
        false => (simulation.body("both").unwrap(), offset - centre),
    };
    let point = |point: DVec3| body.position() + body.rotation().rotate(point);
    [point(at), point(at + DVec3::X)]
}

#[test]
fn welded_boxes_move_like_one_body() {
    for contact in RIGID {
        for integrator in INTEGRATORS {
            let error = |dt: f64| {
                let settings = settings(contact, integrator, dt);
                let [welded, whole] = [true, false].map(|welded| thrown(settings, welded));
                (0..2).map(|i| (welded[i] - whole[i]).length()).fold(0.0, f64::max)
            };
            let (coarse, fine) = (error(2e-3), error(1e-3));
            // Two midpoint rules that are coupled are not the midpoint rule of the whole, but both are of second order.
            assert!(fine < 1e-5, "{contact:?} {integrator:?}: {fine}");
            assert_near(coarse / fine, 4.0, 0.2);
        }
    }
}

/// The top of G5 and G6: a disc of 0.5 kg and radius 0.1 m on a massless axle, 0.15 m above its pivot.
fn top(settings: Settings<Spatial>, tilt: f64, precession: f64, spin: f64) -> Simulation<Spatial> {
    let mut simulation = Simulation::with_settings(settings);
    let turned = SpatialRotation::from_rotation_vector(DVec3::Y * tilt.to_radians());
    let axle = turned.rotate(DVec3::Z);
    let disc = spawn(&mut simulation, "disc", Sphere::try_new(DVec3::ZERO, 0.1).unwrap(), 0.5, axle * 0.15, turned);
    let rate = DVec3::Z * precession + axle * (spin - precession * axle.z);
    simulation.world_mut().entity_mut(disc).insert((
        // I₁ = 0.0125 about the pivot, 0.15² · 0.5 more than about the centre.
        InertiaOverride(SymmetricTensor::from_diagonal(dvec3(0.00125, 0.00125, 0.0025))),
        LinearVelocity(rate.cross(axle * 0.15)),
        AngularVelocity(rate),
    ));
    let (a, b) = (Anchor::World(DVec3::ZERO), Anchor::Body(disc, DVec3::Z * -0.15));
    hold(&mut simulation, "pivot", a, b, SpatialJointKind::Spherical);
    simulation.prepare().unwrap();
    simulation
}

/// Runs a top for a second; returns its least and largest tilt and how far it went round the vertical, both in degrees.
fn watch(simulation: &mut Simulation<Spatial>) -> ([f64; 2], f64) {
    let (mut least, mut largest, mut round) = (f64::INFINITY, 0.0, 0.0);
    let mut before = DVec3::X;
    while simulation.time() < 1.0 - 1e-9 {
        simulation.step().unwrap();
        let axle = simulation.body("disc").unwrap().rotation().rotate(DVec3::Z);
        let level = dvec3(axle.x, axle.y, 0.0).normalize();
        let tilt = tumble_math::trig::atan2(dvec3(axle.x, axle.y, 0.0).length(), axle.z).to_degrees();
        (least, largest) = (f64::min(least, tilt), f64::max(largest, tilt));
        round += tumble_math::trig::atan2(before.cross(level).z, before.dot(level)).to_degrees();
        before = level;
    }
    ([least, largest], round)
}

#[test]
fn g5_steady_top_precesses_at_its_rate() {
    for settings in rigid(1e-4) {
        let mut simulation = top(settings, 60.0, 1.49961039158, 200.0);
        let before = angular_momentum_about_origin(&simulation, "disc");
        let (tilts, round) = watch(&mut simulation);
        // It hardly nods: by the half step that velocities run ahead. It goes round at its rate, of second order in the step.
        assert!(tilts.iter().all(|tilt| (tilt - 60.0).abs() < 5e-3), "{tilts:?}");
        assert_near(round.to_radians(), 1.49961039158, 1e-4 * 1.5);
        let after = angular_momentum_about_origin(&simulation, "disc");
        // Neither weight nor pivot turn it about the vertical: round-off of 10 000 steps.
        assert_near(after.z, before.z, 1e-12);
        let bob = simulation.body("disc").unwrap();
        let pivot = bob.position() - bob.rotation().rotate(DVec3::Z) * 0.15;
        assert!(pivot.length() < 1e-12, "{pivot}");
    }
}

#[test]
fn g6_released_top_nods_between_its_limits() {
    for settings in rigid(1e-4) {
        let (tilts, round) = watch(&mut top(settings, 30.0, 0.0, 200.0));
        assert_near(tilts[0], 30.0, 1e-2);
        assert_near(tilts[1], 32.3299247143, 1e-2);
        // 1 % by the case.
        assert_near(round / 87.762542776, 1.0, 2e-3);
    }
}

#[test]
fn a_penalty_hinge_swings_the_same() {
    let mut pendulum = PhysicalPendulum::new(settings(ContactModel::Penalty, Integrator::SymplecticEuler, 1e-4));
    let measured = pendulum.measured_period();
    // Springs and dampers give a little: first order in the step.
    assert_near(measured / pendulum.period, 1.0, 2e-3);
    let along = pendulum.simulation.body("bob").unwrap().position().dot(pendulum.axis);
    assert!(along.abs() < 1e-5, "{along}");
}

#[test]
fn a_door_on_two_hinges_shares_its_weight_and_swings_freely() {
    for settings in rigid(0.01) {
        let mut simulation = Simulation::with_settings(settings);
        let door = spawn(
            &mut simulation,
            "door",
            cuboid(dvec3(1.0, 0.04, 2.0)),
            20.0,
            dvec3(0.5, 0.0, 1.0),
            SpatialRotation::IDENTITY,
        );
        simulation.world_mut().entity_mut(door).insert((LinearVelocity(DVec3::Y * 0.5), AngularVelocity(DVec3::Z)));
        for (name, height) in [("lower", -0.7), ("upper", 0.7)] {
            let (a, b) = (dvec3(0.0, 0.0, 1.0 + height), dvec3(-0.5, 0.0, height));
            hold(
                &mut simulation,
                name,
                Anchor::World(a),
                Anchor::Body(door, b),
                SpatialJointKind::Revolute { axis: DVec3::Z },
            );
        }
        // Ten rows of which five say everything: no contradiction, no drift, no friction.
        for _ in 0..1000 {
            simulation.step().unwrap();
        }
        let door = simulation.body("door").unwrap();
        // Symplectic Euler moves along chords: its rates are off by (ω Δt)²/8.
        assert!((door.angular_velocity() - DVec3::Z).length() < 1.3e-5, "{}", door.angular_velocity());
        let turned = direction(10.0) * 0.5;
        // So is the turn of 10 s: by 1.3e-4 rad at most, at an arm of half a metre.
        assert!((door.position() - dvec3(turned.x, turned.y, 1.0)).length() < 1e-4, "{}", door.position());
        let joints = simulation.world().resource::<JointProblem<Spatial>>();
        let weight = (joints.given(0).0 + joints.given(1).0).z / 0.01;
        assert_near(weight, 20.0 * G, 1e-9);
    }
}

#[test]
fn axes_without_direction_are_refused_by_name() {
    for axis in [DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::X * 1e-320] {
        for kind in [SpatialJointKind::Revolute { axis }, SpatialJointKind::Prismatic { axis }] {
            let mut simulation =
                Simulation::with_settings(settings(ContactModel::Impulse, Integrator::SymplecticEuler, 1e-3));
            let bob = spawn(&mut simulation, "bob", cuboid(DVec3::ONE), 1.0, DVec3::ZERO, SpatialRotation::IDENTITY);
            hold(&mut simulation, "guide", Anchor::World(DVec3::ZERO), Anchor::Body(bob, DVec3::ZERO), kind);
            let error = simulation.step().unwrap_err().to_string();
            let expected = format!("axis of joint \"guide\" is {}; it must be positive and finite", axis.length());
            assert_eq!(error, expected);
        }
    }
}
