//! Components and integrating systems are shared by plane and space: free bodies in space through the same systems. Free rotation, G1–G4.

use bevy_ecs::prelude::*;
use glam::{DVec3, dvec3};
use tumble_math::{Inertia, Rotation, Spatial, SpatialRotation, SymmetricTensor, trig};
use tumble_sim::contact::PositionCorrections;
use tumble_sim::fault::Fault;
use tumble_sim::force::{apply_gravity, apply_linear_drag};
use tumble_sim::integrate::{clear_forces, compute_accelerations, integrate_velocities, update_positions};
use tumble_sim::*;

/// A world with the phases that need no shapes.
fn world(gravity: DVec3, dt: f64) -> (World, bevy_ecs::schedule::Schedule) {
    let mut world = World::new();
    world.insert_resource(Settings::<Spatial> { gravity, dt, ..Settings::weightless() });
    world.insert_resource(Clock::new(dt));
    world.init_resource::<Fault>();
    world.init_resource::<PositionCorrections<Spatial>>();
    let mut schedule = bevy_ecs::schedule::Schedule::default();
    schedule.add_systems(
        (
            clear_forces::<Spatial>,
            apply_gravity::<Spatial>,
            apply_linear_drag::<Spatial>,
            compute_accelerations::<Spatial>,
            integrate_velocities::<Spatial>,
            update_positions::<Spatial>,
        )
            .chain(),
    );
    (world, schedule)
}

/// Mass components of a free body.
fn mass(mass: f64, inertia: DVec3) -> impl Bundle {
    let inertia = SymmetricTensor::from_diagonal(inertia);
    (
        Mass(mass),
        InverseMass(DVec3::splat(1.0 / mass)),
        BodyInertia(inertia),
        InverseInertia(inertia.try_inverse().unwrap()),
    )
}

#[test]
fn b1_free_fall_in_space_follows_the_recurrence() {
    let (mut world, mut schedule) = world(dvec3(0.0, 0.0, -9.81), 0.01);
    let body = world.spawn((Position(dvec3(1.0, 2.0, 10.0)), mass(2.0, DVec3::ONE))).id();
    for _ in 0..100 {
        schedule.run(&mut world);
    }
    let position = world.get::<Position<DVec3>>(body).unwrap().0;
    // Round-off of 100 additions.
    assert!((position - dvec3(1.0, 2.0, 5.04595)).length() < 1e-12, "{position}");
}

/// A free body that starts with its axes along the world's.
struct Spinning {
    world: World,
    schedule: bevy_ecs::schedule::Schedule,
    body: Entity,
}

impl Spinning {
    fn new(inertia: DVec3, spin: DVec3, dt: f64) -> Self {
        let (mut world, schedule) = world(DVec3::ZERO, dt);
        let body = world.spawn((Position(DVec3::ZERO), AngularVelocity(spin), mass(1.0, inertia))).id();
        Self { world, schedule, body }
    }

    fn step(&mut self) {
        self.schedule.run(&mut self.world);
    }

    fn rotation(&self) -> SpatialRotation {
        self.world.get::<Orientation<SpatialRotation>>(self.body).unwrap().0
    }

    fn inertia(&self) -> SymmetricTensor {
        self.world.get::<BodyInertia<SymmetricTensor>>(self.body).unwrap().0
    }

    /// Rate of turn in body axes [rad/s].
    fn spin_in_body(&self) -> DVec3 {
        self.rotation().unrotate(self.world.get::<AngularVelocity<DVec3>>(self.body).unwrap().0)
    }

    /// L in world axes [kg·m²/s].
    fn momentum(&self) -> DVec3 {
        self.rotation().rotate(self.inertia().apply(self.spin_in_body()))
    }

    /// ½ ω · I ω [J].
    fn energy(&self) -> f64 {
        0.5 * self.spin_in_body().dot(self.inertia().apply(self.spin_in_body()))
    }

    /// Times at which a component of the rate of turn in body axes changes its sign, by interpolation [s].
    fn sign_changes(&mut self, axis: usize, dt: f64, steps: u64) -> Vec<f64> {
        let (mut times, mut before) = (Vec::new(), self.spin_in_body()[axis]);
        for step in 1..=steps {
            self.step();
            let now = self.spin_in_body()[axis];
            if before * now < 0.0 {
                times.push(dt * (step as f64 - now / (now - before)));
            }
            before = now;
        }
        times
    }
}

#[test]
fn g1_symmetric_body_precesses_at_its_rates() {
    let dt = 1e-3;
    let mut body = Spinning::new(dvec3(0.04, 0.04, 0.02), dvec3(2.0, 0.0, 5.0), dt);
    let up = body.momentum().normalize();
    let (mut round, mut before) = (0.0, None);
    for _ in 0..5000 {
        body.step();
        let axle = body.rotation().rotate(DVec3::Z);
        // A symmetric body keeps its tilt: round-off of 5000 steps.
        let tilt = trig::atan2(up.cross(axle).length(), up.dot(axle)).to_degrees();
        assert!((tilt - 38.6598082541).abs() < 1e-9, "{tilt}");
        let level = (axle - up * up.dot(axle)).normalize();
        let from = before.replace(level).unwrap_or(level);
        round += trig::atan2(up.dot(from.cross(level)), from.dot(level));
    }
    // The midpoint rule turns by 2 tan(½ a) in place of a: (5.4 Δt)²/12 = 2.4e-6 of the rate. 4999 steps are counted.
    assert!((round / 4.999 / 3.20156211872 - 1.0).abs() < 1e-5, "{}", round / 4.999);
    // In body axes the rate of turn goes round with −2.5 rad/s.
    let spin = body.spin_in_body();
    let expected = dvec3(2.0 * trig::cos(-2.5 * 5.0), 2.0 * trig::sin(-2.5 * 5.0), 5.0);
    assert!((spin - expected).length() < 2e-4, "{spin}");
}

#[test]
fn g2_body_about_its_middle_axis_flips_in_time() {
    let dt = 1e-3;
    let mut body = Spinning::new(dvec3(1.0, 2.0, 3.0), dvec3(0.01, 5.0, 0.01), dt);
    let times = body.sign_changes(1, dt, 40_000);
    // The case: 0.5 % for a method of second order. Each flip starts the next one from a smaller disturbance, so errors do not add up.
    assert!((times[0] / 2.741068 - 1.0).abs() < 5e-3, "{times:?}");
    assert_eq!(times.len(), 8);
    for pair in times.windows(2) {
        assert!(((pair[1] - pair[0]) / 5.02592913816 - 1.0).abs() < 5e-3, "{times:?}");
    }
}

#[test]
fn g2_a_million_steps_keep_momentum_energy_and_flips() {
    let dt = 1e-2;
    let start = dvec3(0.01, 5.0, 0.01);
    let mut body = Spinning::new(dvec3(1.0, 2.0, 3.0), start, dt);
    let (momentum, energy) = (body.momentum(), body.energy());
    let (mut worst_early, mut worst): (f64, f64) = (0.0, 0.0);
    let (mut flips, mut flips_late, mut before) = (0, 0, 5.0);
    for step in 0..1_000_000_u32 {
        body.step();
        worst = worst.max((body.energy() / energy - 1.0).abs());
        let now = body.spin_in_body().y;
        if before * now < 0.0 {
            flips += 1;
            flips_late += u32::from(step >= 900_000);
        }
        before = now;
        if step == 10_000 {
            worst_early = worst;
        }
    }
    // Each step rounds 10 kg·m²/s a few times, by up to 2e-15 each and not quite at random.
    assert!((body.momentum() - momentum).length() < 2e-8, "{}", body.momentum());
    let length = body.rotation().quaternion().length();
    assert!((length - 1.0).abs() < 4.0 * f64::EPSILON, "{length}");
    // It swings with the flips and does not grow.
    assert!(worst < 1.01 * worst_early, "{worst_early:e}, later {worst:e}");
    // As many flips at the end as in any other tenth: it settles on no axis.
    assert!((f64::from(flips_late) / f64::from(flips) - 0.1).abs() < 1e-3, "{flips_late} of {flips}");
}

#[test]
fn g3_t_handle_turns_over_in_its_period() {
    let dt = 1e-3;
    let mut body = Spinning::new(dvec3(1.0, 10.0, 11.0), dvec3(0.0, 2.0, 1e-4), dt);
    let times = body.sign_changes(1, dt, 60_000);
    assert!(times.len() >= 4, "{times:?}");
    // Twice over makes a period; 1 % by the case.
    assert!(((times[2] - times[0]) / 24.7407977779 - 1.0).abs() < 1e-2, "{times:?}");
}

#[test]
fn g4_tumbling_box_is_where_it_should_be() {
    let dt = 1e-3;
    let inertia = dvec3(0.13, 0.1, 0.05) / 3.0;
    let mut body = Spinning::new(inertia, dvec3(1.0, 2.0, 3.0), dt);
    let mut errors = Vec::new();
    for (steps, expected) in [
        (1000, dvec3(1.08610044297, -1.90431156111, 3.04634175835)),
        (4000, dvec3(0.280861940815, -2.43226693971, 2.75010148003)),
        (5000, dvec3(-1.44147976178, 1.32591216921, 3.26825147283)),
    ] {
        (0..steps).for_each(|_| body.step());
        errors.push((body.spin_in_body() - expected).length());
        if errors.len() == 2 {
            let q = body.rotation().quaternion();
            let expected = glam::DQuat::from_xyzw(0.0235633573426, 0.021262001052, -0.930519824913, -0.364863742987);
            let error = (q - expected).length().min((q + expected).length());
            assert!(error < 1e-5, "{error:e}");
        }
    }
    // Second order: (ω Δt)² of a rate of 3 rad/s, times the radians turned.
    assert!(errors[0] < 1e-5 && errors[1] < 5e-5 && errors[2] < 1e-4, "{errors:?}");
}

#[test]
fn drag_slows_a_body_in_space() {
    let (mut world, mut schedule) = world(DVec3::ZERO, 1e-3);
    let drag = LinearDrag { translation: 0.5, rotation: 0.0 };
    let velocity = LinearVelocity(dvec3(3.0, -1.0, 2.0));
    let body = world.spawn((Position(DVec3::ZERO), velocity, drag, mass(2.0, DVec3::ONE))).id();
    for _ in 0..3000 {
        schedule.run(&mut world);
    }
    let slowed = world.get::<LinearVelocity<DVec3>>(body).unwrap().0;
    let expected = velocity.0 * tumble_math::trig::exp(-0.5 / 2.0 * 3.0);
    // First order: relative error c Δt t / (2 m) · c/m = 1e-4 at this step.
    assert!((slowed - expected).length() < 1e-4 * expected.length(), "{slowed} is not {expected}");
}
