//! The ledger: every step's energy is accounted for, under every model and integrator.

use crate::support::{assert_near, ball, block, body, every, floor, rod, simulation};
use glam::{DVec2, dvec2};
use tumble_sim::{
    Anchor, ContactModel, Integrator, Joint, JointKind, Ledger, LinearDrag, Settings, Simulation, Spring,
};
use tumble_solver::Surface;

/// A box that slides, a ball that bounces, a rod that hangs on a pin, a weight on a damped spring, all with drag.
fn everything(contact: ContactModel, integrator: Integrator) -> Simulation {
    let surface = Surface { static_friction: 0.5, kinetic_friction: 0.4, restitution: 0.6 };
    let mut simulation = simulation(Settings { contact, integrator, ..every(0.005) }, surface);
    floor(&mut simulation);
    block(1.0, 0.25, 2.0).at(-3.0, 0.125).moving(2.0, 0.0).spawn(&mut simulation, "slider");
    ball(0.2, 1.0).at(0.0, 1.0).moving(0.5, 0.0).spinning(3.0).spawn(&mut simulation, "ball");
    let pendulum = rod(1.0, 1.0).at(3.5, 3.0).spawn(&mut simulation, "pendulum");
    let weight = ball(0.2, 2.0).at(8.0, 3.0).spawn(&mut simulation, "weight");
    for name in ["slider", "ball", "pendulum"] {
        let entity = simulation.entity(name).unwrap();
        simulation.world_mut().entity_mut(entity).insert(LinearDrag { translation: 0.1, rotation: 0.01 });
    }
    let pin = Anchor::Body(pendulum, dvec2(-0.5, 0.0));
    simulation.spawn(Joint { a: Anchor::World(dvec2(3.0, 3.0)), b: pin, kind: JointKind::Revolute });
    simulation.spawn(Spring {
        a: Anchor::World(dvec2(8.0, 5.0)),
        b: Anchor::Body(weight, DVec2::ZERO),
        stiffness: 80.0,
        damping: 1.0,
        rest_length: 1.0,
    });
    simulation.keep_ledger();
    simulation
}

#[test]
fn the_books_close_under_every_model_and_integrator() {
    for contact in ContactModel::ALL {
        for integrator in [Integrator::SymplecticEuler, Integrator::Ballistic] {
            let mut simulation = everything(contact, integrator);
            let mut sum = Ledger::default();
            for step in 0..600 {
                simulation.step().unwrap();
                let ledger = *simulation.world().resource::<Ledger>();
                // Round-off of energies of some hundred joules; soft steps sum impulses in single precision.
                let round_off = if contact == ContactModel::SoftStep { 1e-4 } else { 1e-10 };
                assert!(ledger.error.abs() < round_off, "{contact:?} {integrator:?}, step {step}: {ledger:?}");
                sum.work_friction += ledger.work_friction;
                sum.work_user += ledger.work_user;
                sum.work_impacts += ledger.work_impacts;
                sum.work_springs += ledger.work_springs;
                sum.work_gravity += ledger.work_gravity;
                sum.integrator_defect += ledger.integrator_defect;
            }
            // Friction stops a box of 2 kg at 2 m/s, drag and impacts take energy, and every line has something on it.
            assert!(
                sum.work_friction < -1.0 && sum.work_user < -0.1 && sum.work_impacts < -0.1,
                "{contact:?}: {sum:?}"
            );
            assert!(sum.work_springs.abs() > 0.1 && sum.work_gravity > 1.0, "{contact:?}: {sum:?}");
        }
    }
}

#[test]
fn friction_does_the_work_that_the_slip_asks_for() {
    for contact in [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp] {
        let surface = Surface { static_friction: 0.3, kinetic_friction: 0.3, restitution: 0.0 };
        let mut simulation = simulation(Settings { contact, ..every(0.01) }, surface);
        floor(&mut simulation);
        block(1.0, 0.25, 1.0).at(0.0, 0.125).moving(3.0, 0.0).spawn(&mut simulation, "block");
        simulation.keep_ledger();
        let (mut friction, mut normal) = (0.0, 0.0);
        for _ in 0..200 {
            simulation.step().unwrap();
            let ledger = simulation.world().resource::<Ledger>();
            friction += ledger.work_friction;
            // Gravity pulls for a step before the floor takes it back: the two lines cancel.
            normal += ledger.work_impacts + ledger.work_gravity;
        }
        // All of ½ m v², to round-off; at the end the block sticks. In the step in which it stops it nods, by microjoules that the
        // normal forces take back.
        assert_near(friction + normal, -4.5, 1e-12);
        assert_near(friction, -4.5, 1e-5);
        let ledger = *simulation.world().resource::<Ledger>();
        assert_eq!((ledger.sticking, ledger.sliding), (2, 0), "{contact:?}");
        assert!(ledger.normal_violation < 1e-12 && ledger.tangent_violation < 1e-12, "{contact:?}: {ledger:?}");
        assert_near(body(&simulation, "block").velocity().x, 0.0, 1e-12);
    }
}

#[test]
fn symplectic_euler_has_a_defect_of_its_own_in_free_fall() {
    let mut simulation = Simulation::new(every(0.01));
    ball(0.1, 2.0).spawn(&mut simulation, "ball");
    simulation.keep_ledger();
    for _ in 0..10 {
        simulation.step().unwrap();
        // It moves by v₁ Δt where the work was m g ½ (v₀ + v₁) Δt: the potential loses ½ m g² Δt² more.
        let ledger = simulation.world().resource::<Ledger>();
        assert_near(ledger.integrator_defect, -0.5 * 2.0 * 9.81 * 9.81 * 1e-4, 1e-13);
        assert_near(ledger.error, 0.0, 1e-13);
    }
}
