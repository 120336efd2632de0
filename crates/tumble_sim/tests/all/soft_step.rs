//! The soft-step model in whole simulations: what it keeps exactly, and how near it comes to the exact models.

use crate::support::{
    G, assert_near, ball, block, body, bouncing, contact_force, deepest_overlap, direction, every, farthest, floor,
    incline, names, rod, rough, simulation, under, wall,
};
use bevy_ecs::name::Name;
use glam::{DVec2, DVec3, dvec2, dvec3};
use tumble_math::{Spatial, SpatialRotation};
use tumble_shape::{Capsule, Cuboid, Cylinder, HalfSpace, SpatialShape, Sphere};
use tumble_sim::{
    Amount, Anchor, AngularVelocity, BodyKind, ContactModel, Joint, JointKind, LinearVelocity, Orientation, Part,
    Position, Settings, Simulation, SoftModel, StepError,
};
use tumble_solver::Surface;
use tumble_solver::soft_step::{SoftSettings, Width};

fn soft(dt: f64) -> Settings {
    under(ContactModel::SoftStep, every(dt))
}

/// Position, angle and velocities of all bodies, bit by bit.
fn bits(simulation: &Simulation) -> Vec<[u64; 6]> {
    let of = |name: &String| {
        let body = body(simulation, name);
        let (x, v) = (body.position(), body.velocity());
        [x.x, x.y, body.angle(), v.x, v.y, body.angular_velocity()].map(f64::to_bits)
    };
    names(simulation).iter().map(of).collect()
}

/// Balls, boxes and rods that fall between two walls.
fn pile(width: Width) -> Simulation {
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.4, restitution: 0.3 };
    let mut simulation = simulation(soft(1.0 / 60.0), surface);
    floor(&mut simulation);
    wall(&mut simulation, "left", DVec2::X);
    for k in 0..60 {
        let at = dvec2(0.7 + 0.8 * f64::from(k % 6), 0.6 + 0.8 * f64::from(k / 6));
        let shape = match k % 3 {
            0 => ball(0.3, 1.0),
            1 => block(0.5, 0.6, 2.0),
            _ => rod(0.7, 0.5),
        };
        shape.at(at.x, at.y).turned(0.3 * f64::from(k)).spawn(&mut simulation, &format!("body-{k:02}"));
    }
    simulation.world_mut().resource_mut::<SoftModel<tumble_math::Planar>>().set_width(width);
    simulation
}

#[test]
fn eight_lanes_and_one_lane_run_a_pile_to_the_same_bits() {
    let (mut wide, mut plain) = (pile(Width::Widest), pile(Width::Plain));
    for _ in 0..150 {
        wide.step().unwrap();
        plain.step().unwrap();
    }
    assert_eq!(bits(&wide), bits(&plain));
}

#[test]
fn a_free_body_moves_to_the_same_bits_as_under_any_model() {
    let run = |contact| {
        let mut simulation = simulation(under(contact, every(0.01)), Surface::default());
        floor(&mut simulation);
        rod(1.0, 1.0).at(0.0, 100.0).moving(3.0, 0.1).spinning(2.0).spawn(&mut simulation, "rod");
        simulation.run_for(1.0).unwrap();
        bits(&simulation)
    };
    assert_eq!(run(ContactModel::SoftStep), run(ContactModel::Impulse));
}

#[test]
fn a_block_at_rest_stays_and_is_carried_by_its_weight() {
    let mut simulation = simulation(soft(0.01), rough(0.5, 0.5));
    floor(&mut simulation);
    block(1.0, 1.0, 2.0).at(0.0, 0.5).spawn(&mut simulation, "block");
    // One block sinks by what a spring of 60 Hz and damping ratio 10 gives way in the substeps: micrometres.
    assert!(farthest(&mut simulation, 5.0, 1.0) < 1e-4);
    let force = contact_force(&mut simulation, "floor", "block");
    // Single precision, over two points and four substeps.
    assert_near(force.y, 2.0 * G, 1e-4);
}

#[test]
fn static_and_kinetic_friction_decide_on_a_slope() {
    for (degrees, sticks) in [(24.0_f64, true), (29.0, false)] {
        let angle = degrees.to_radians();
        // Static friction holds up to 26.6°; kinetic friction of 0.3 lets a block slide that has let go.
        let mut simulation = simulation(soft(0.005), rough(0.5, 0.3));
        incline(&mut simulation, angle);
        let at = direction(angle).perp() * 0.25;
        block(1.0, 0.5, 1.0).at(at.x, at.y).turned(angle).spawn(&mut simulation, "block");
        simulation.run_for(1.0).unwrap();
        let speed = body(&simulation, "block").velocity().length();
        if sticks {
            // What a step's round-off leaves.
            assert!(speed < 1e-4, "{speed}");
        } else {
            // Until it slips faster than gravity makes it in a substep, the block is held back by static friction.
            let acceleration = |friction: f64| G * direction(angle).dot(dvec2(-friction, 1.0));
            let slow = G * 0.005 / 4.0;
            let expected = slow + acceleration(0.3) * (1.0 - slow / acceleration(0.5));
            // Friction is known a substep late, and the block tilts into its softer lower edge: one per cent.
            assert_near(speed, expected, 0.01 * expected);
        }
    }
}

#[test]
fn a_ball_gives_back_its_restitution() {
    for restitution in [0.0, 0.5, 0.8] {
        let mut simulation = simulation(soft(1e-3), bouncing(restitution));
        floor(&mut simulation);
        ball(0.1, 1.0).at(0.0, 1.1).spawn(&mut simulation, "ball");
        let mut highest = 0.0_f64;
        let mut bounced = false;
        for _ in 0..1000 {
            simulation.step().unwrap();
            let ball = body(&simulation, "ball");
            bounced |= ball.velocity().y > 0.0;
            if bounced {
                highest = highest.max(ball.position().y - 0.1);
            }
        }
        // First order in Δt: the impact is found up to a step late, g Δt = 0.01 of 4.4 m/s.
        assert_near(highest, restitution * restitution, 0.01);
    }
}

#[test]
fn a_tower_and_a_pyramid_stand() {
    let mut tower = simulation(soft(1.0 / 60.0), rough(0.5, 0.5));
    floor(&mut tower);
    for k in 0..10 {
        block(1.0, 1.0, 1.0).at(0.0, 0.5 + f64::from(k)).spawn(&mut tower, &format!("box-{k}"));
    }
    // Contacts give way under the weight above: of the order of the slop each.
    assert!(farthest(&mut tower, 10.0, 1.0) < 0.05);
    assert!(deepest_overlap(&mut tower) < 0.01);

    let mut pyramid = simulation(soft(1.0 / 60.0), rough(0.6, 0.6));
    floor(&mut pyramid);
    for row in 0..10 {
        for k in 0..10 - row {
            let x = f64::from(k) - 0.5 * f64::from(9 - row);
            let name = format!("box-{row}-{k}");
            block(1.0, 1.0, 1.0).at(x, 0.5 + f64::from(row)).spawn(&mut pyramid, &name);
        }
    }
    assert!(farthest(&mut pyramid, 10.0, 1.0) < 0.05);
}

#[test]
fn joints_hold_and_a_pendulum_keeps_its_swing() {
    let mut simulation = simulation(soft(0.005), Surface::default());
    let bob = rod(1.0, 1.0).at(0.5, 0.0).spawn(&mut simulation, "bob");
    let end = Anchor::Body(bob, dvec2(-0.5, 0.0));
    simulation.spawn(Joint { a: Anchor::World(DVec2::ZERO), b: end, kind: JointKind::Revolute });
    let (mut lowest, mut highest) = (0.0_f64, -1.0_f64);
    for step in 0..4000 {
        simulation.step().unwrap();
        let bob = body(&simulation, "bob");
        let pin = bob.position() - direction(bob.angle()) * 0.5;
        assert!(pin.length() < 1e-9, "the pin is off by {}", pin.length());
        lowest = lowest.min(bob.position().y);
        if step > 3000 {
            highest = highest.max(bob.position().y);
        }
    }
    assert_near(lowest, -0.5, 1e-3);
    // After eight swings it comes back to the height it was let go from, but for a first-order part.
    assert_near(highest, 0.0, 0.02);
}

#[test]
fn too_much_is_survived() {
    // A hundred bodies in one place, a step of a second, and a mass ratio of a million.
    let mut crowd = simulation(soft(1.0), rough(0.5, 0.5));
    floor(&mut crowd);
    for k in 0..100 {
        let mass = if k % 2 == 0 { 1e-3 } else { 1e3 };
        block(1.0, 1.0, mass).at(1e-3 * f64::from(k % 7), 0.5).spawn(&mut crowd, &format!("box-{k:02}"));
    }
    for _ in 0..50 {
        crowd.step().unwrap();
    }
    for name in names(&crowd) {
        assert!(glam::DVec2::is_finite(body(&crowd, &name).position()));
    }
}

#[test]
fn a_crowd_that_fits_into_no_memory_is_refused() {
    // A hundred thousand bodies in one place are five thousand million pairs.
    let mut crowd = simulation(soft(0.01), rough(0.5, 0.5));
    for k in 0..100_000 {
        ball(0.5, 1.0).at(1e-6 * f64::from(k % 7), 0.0).spawn(&mut crowd, &format!("ball-{k:05}"));
    }
    let mistake = crowd.step().unwrap_err();
    assert!(matches!(&mistake, StepError::Crowded { body, .. } if body.starts_with("ball-")), "{mistake}");
    // The bodies are where they were, and may be taken away.
    assert_eq!(body(&crowd, "ball-00003").position(), dvec2(3e-6, 0.0));
}

/// A floor and a heap of spheres, boxes and capsules in space.
fn heap(width: Width) -> Simulation<Spatial> {
    let settings = Settings {
        dt: 1.0 / 60.0,
        contact: ContactModel::SoftStep,
        gravity: dvec3(0.0, -G, 0.0),
        ..Settings::weightless()
    };
    let mut simulation = Simulation::<Spatial>::with_settings(settings);
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.5, restitution: 0.2 };
    simulation.materials_mut().set("default", surface);
    let floor = simulation.spawn((Name::new("floor"), Position(DVec3::ZERO), BodyKind::Static));
    let half_space = HalfSpace::try_new(DVec3::Y, 0.0).unwrap();
    simulation.attach(floor, Part::new(SpatialShape::from(half_space), Amount::Density(0.0)));
    for k in 0..48 {
        let layer = f64::from(k / 9);
        let at = dvec3(0.6 * f64::from(k % 3) + 0.05 * layer, 0.5 + 0.7 * layer, 0.6 * f64::from(k / 3 % 3));
        let turned = SpatialRotation::from_rotation_vector(dvec3(0.3, 0.5, 0.8) * f64::from(k));
        let body = simulation.spawn((Name::new(format!("body-{k:02}")), Position(at), Orientation(turned)));
        let shape: SpatialShape = match k % 3 {
            0 => Sphere::try_new(DVec3::ZERO, 0.25).unwrap().into(),
            1 => Cuboid::with_half_extents(dvec3(0.25, 0.2, 0.3)).unwrap().into(),
            _ => Capsule::try_new(DVec3::X * -0.2, DVec3::X * 0.2, 0.15).unwrap().into(),
        };
        simulation.attach(body, Part::new(shape, Amount::Mass(1.0)));
    }
    simulation.world_mut().resource_mut::<SoftModel<Spatial>>().set_width(width);
    simulation
}

#[test]
fn a_heap_in_space_comes_to_rest_and_has_the_same_bits_at_any_width() {
    let (mut wide, mut plain) = (heap(Width::Widest), heap(Width::Plain));
    for step in 0..400 {
        wide.step().unwrap();
        if step < 120 {
            plain.step().unwrap();
        }
        if step == 119 {
            for k in 0..48 {
                let name = format!("body-{k:02}");
                let (one, other) = (wide.body(&name).unwrap(), plain.body(&name).unwrap());
                assert_eq!(one.position(), other.position(), "{name}");
                assert_eq!(one.velocity(), other.velocity(), "{name}");
                assert_eq!(one.angular_velocity(), other.angular_velocity(), "{name}");
            }
        }
    }
    for k in 0..48 {
        let body = wide.body(&format!("body-{k:02}")).unwrap();
        assert!(body.position().y > 0.1, "nothing fell through the floor");
        // Nothing brakes rolling: what is round may roll away, all else rests.
        if k % 3 == 1 {
            assert!(body.velocity().length() < 0.1, "body-{k:02} moves at {}", body.velocity());
        }
    }
}

#[test]
fn what_rolls_keeps_rolling() {
    // Points that lag behind the body would brake it: 2 cm behind a radius of 0.2 m, by a tenth of g.
    let radius = 0.2;
    let shapes: [SpatialShape; 3] = [
        Sphere::try_new(DVec3::ZERO, radius).unwrap().into(),
        Capsule::try_new(DVec3::Z * -0.3, DVec3::Z * 0.3, radius).unwrap().into(),
        Cylinder::try_new(DVec3::Z * -0.3, DVec3::Z * 0.3, radius).unwrap().into(),
    ];
    let settings = Settings { contact: ContactModel::SoftStep, gravity: dvec3(0.0, -G, 0.0), ..Settings::weightless() };
    let mut simulation = Simulation::<Spatial>::with_settings(settings);
    simulation.materials_mut().set("default", rough(0.5, 0.5));
    let ground = simulation.spawn((Name::new("ground"), Position(DVec3::ZERO), BodyKind::Static));
    let half_space = HalfSpace::try_new(DVec3::Y, 0.0).unwrap();
    simulation.attach(ground, Part::new(SpatialShape::from(half_space), Amount::Density(0.0)));
    for (k, shape) in (0..).zip(shapes) {
        let body = simulation.spawn((
            Name::new(format!("body-{k}")),
            Position(dvec3(0.0, radius, 2.0 * f64::from(k))),
            LinearVelocity(dvec3(2.0, 0.0, 0.0)),
            AngularVelocity(dvec3(0.0, 0.0, -2.0 / radius)),
        ));
        simulation.attach(body, Part::new(shape, Amount::Mass(1.0)));
    }
    simulation.run_for(2.0).unwrap();
    for (k, within) in [1e-3, 1e-3, 0.02].into_iter().enumerate() {
        let body = simulation.body(&format!("body-{k}")).unwrap();
        let (v, w) = (body.velocity(), body.angular_velocity());
        assert!((v - dvec3(2.0, 0.0, 0.0)).length() < 2.0 * within, "body-{k} rolls at {v}");
        assert!((w.z * radius + v.x).abs() < 2.0 * within, "body-{k} slips: {w}");
    }
}

#[test]
fn contacts_give_way_like_springs_of_their_frequency() {
    let sunk = |frequency: f64| {
        let settings =
            Settings { soft_step: SoftSettings { substeps: 16, frequency, ..SoftSettings::default() }, ..soft(0.02) };
        let mut tower = simulation(settings, rough(0.5, 0.5));
        floor(&mut tower);
        for k in 0..8 {
            block(1.0, 1.0, 1.0).at(0.0, 0.5 + f64::from(k)).spawn(&mut tower, &format!("box-{k}"));
        }
        tower.run_for(6.0).unwrap();
        7.5 - body(&tower, "box-7").position().y
    };
    let (loose, tight) = (sunk(20.0), sunk(40.0));
    // At rest a spring gives way by g/ω² for every mass above: a quarter for twice the frequency, once sweeps have settled.
    assert!((3.5..4.5).contains(&(loose / tight)), "the top sinks by {loose}, and by {tight} with twice the frequency");
}
