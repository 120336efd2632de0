//! Bodies that rest may sleep: they cost nothing, wake when something happens to them, and change nothing for the rest of the world.

use crate::support::{ball, block, body, every, floor, rod, rough, simulation, under};
use glam::dvec2;
use tumble_sim::{
    AngularVelocity, Asleep, BodyKind, ContactModel, LinearVelocity, Rest, Settings, Simulation, SleepSettings,
    Structure,
};

fn sleepy() -> Settings {
    let settings = under(ContactModel::SoftStep, every(1.0 / 60.0));
    Settings { sleep: Some(SleepSettings::default()), ..settings }
}

/// A tower of boxes beginning at some place, named after it.
fn tower(simulation: &mut Simulation, name: &str, x: f64, y: f64, height: u32) {
    for k in 0..height {
        let at = y + 0.5 + f64::from(k);
        block(1.0, 1.0, 1.0).at(x, at).spawn(simulation, &format!("{name}-{k}"));
    }
}

fn sleeps(simulation: &Simulation, name: &str) -> bool {
    let entity = simulation.entity(name).unwrap();
    simulation.world().entity(entity).contains::<Asleep>()
}

fn state(simulation: &Simulation, name: &str) -> [u64; 6] {
    let body = body(simulation, name);
    let (x, v) = (body.position(), body.velocity());
    [x.x, x.y, body.angle(), v.x, v.y, body.angular_velocity()].map(f64::to_bits)
}

#[test]
fn a_tower_that_stands_falls_asleep_and_is_left_alone() {
    let mut simulation = simulation(sleepy(), rough(0.6, 0.6));
    floor(&mut simulation);
    tower(&mut simulation, "box", 0.0, 0.0, 4);
    simulation.run_for(3.0).unwrap();
    assert_eq!(simulation.world().resource::<Rest>().sleeping(), 4);
    let then: Vec<_> = (0..4).map(|k| state(&simulation, &format!("box-{k}"))).collect();
    simulation.run_for(3.0).unwrap();
    let now: Vec<_> = (0..4).map(|k| state(&simulation, &format!("box-{k}"))).collect();
    assert_eq!(then, now);
    // Exactly at rest: a body that sleeps does not creep.
    assert_eq!(body(&simulation, "box-3").velocity(), dvec2(0.0, 0.0));
}

#[test]
fn nothing_sleeps_unless_asked_for_nor_under_other_models() {
    for settings in [Settings { sleep: None, ..sleepy() }, under(ContactModel::Impulse, sleepy())] {
        let mut simulation = simulation(settings, rough(0.6, 0.6));
        floor(&mut simulation);
        tower(&mut simulation, "box", 0.0, 0.0, 2);
        simulation.run_for(3.0).unwrap();
        assert!(!sleeps(&simulation, "box-0"));
    }
}

#[test]
fn a_falling_ball_wakes_the_tower_that_it_hits_and_no_other() {
    let mut simulation = simulation(sleepy(), rough(0.6, 0.6));
    floor(&mut simulation);
    tower(&mut simulation, "hit", 0.0, 0.0, 3);
    tower(&mut simulation, "other", 10.0, 0.0, 3);
    // Falls for two seconds, when both towers sleep.
    ball(0.5, 1.0).at(0.3, 3.5 + 0.5 * 9.81 * 4.0).spawn(&mut simulation, "ball");
    simulation.run_for(1.8).unwrap();
    assert!(sleeps(&simulation, "hit-0") && sleeps(&simulation, "other-0"));
    simulation.run_for(0.3).unwrap();
    assert!((0..3).all(|k| !sleeps(&simulation, &format!("hit-{k}"))), "the whole island wakes at once");
    assert!((0..3).all(|k| sleeps(&simulation, &format!("other-{k}"))));
}

#[test]
fn a_tower_wakes_and_falls_when_its_support_goes() {
    let mut simulation = simulation(sleepy(), rough(0.6, 0.6));
    floor(&mut simulation);
    let shelf = block(4.0, 0.5, 1.0).kind(BodyKind::Static).at(0.0, 4.75).spawn(&mut simulation, "shelf");
    tower(&mut simulation, "box", 0.0, 5.0, 2);
    simulation.run_for(2.0).unwrap();
    assert!(sleeps(&simulation, "box-0"));
    simulation.world_mut().despawn(shelf);
    *simulation.world_mut().resource_mut::<Structure>() = Structure::Changed;
    simulation.run_for(0.5).unwrap();
    let fallen = 5.5 - body(&simulation, "box-0").position().y;
    // ½ g t², and half a step's worth of symplectic Euler.
    assert!((fallen - 0.5 * 9.81 * 0.25).abs() < 0.05, "{fallen}");
}

#[test]
fn a_support_that_begins_to_move_takes_its_load_along() {
    let mut simulation = simulation(sleepy(), rough(0.9, 0.9));
    let belt = block(40.0, 0.5, 1.0).kind(BodyKind::Kinematic).at(0.0, -0.25).spawn(&mut simulation, "belt");
    tower(&mut simulation, "box", 0.0, 0.0, 2);
    simulation.run_for(2.0).unwrap();
    assert!(sleeps(&simulation, "box-0"));
    simulation.world_mut().get_mut::<LinearVelocity<glam::DVec2>>(belt).unwrap().0.x = 0.5;
    simulation.run_for(2.0).unwrap();
    // Friction brings it to the belt's speed, within what softness lets creep.
    assert!((body(&simulation, "box-1").velocity().x - 0.5).abs() < 0.01);
    assert!(!sleeps(&simulation, "box-1"), "what rides on something that moves stays awake");
}

#[test]
fn a_floor_that_tilts_however_slowly_keeps_its_load_awake() {
    let mut simulation = simulation(sleepy(), rough(0.9, 0.9));
    let floor = floor(&mut simulation);
    simulation.world_mut().entity_mut(floor).insert((BodyKind::Kinematic, AngularVelocity(0.01)));
    block(1.0, 1.0, 1.0).at(1.0, 0.5).spawn(&mut simulation, "box");
    simulation.run_for(3.0).unwrap();
    // It moves by 1 cm/s, slower than what may sleep.
    assert!(!sleeps(&simulation, "box"));
    let angle = body(&simulation, "box").angle();
    assert!((angle - 0.03).abs() < 1e-3, "it tilts with the floor: {angle}");
}

#[test]
fn an_edited_body_wakes() {
    let mut simulation = simulation(sleepy(), rough(0.6, 0.6));
    floor(&mut simulation);
    tower(&mut simulation, "box", 0.0, 0.0, 1);
    simulation.run_for(2.0).unwrap();
    assert!(sleeps(&simulation, "box-0"));
    let entity = simulation.entity("box-0").unwrap();
    simulation.world_mut().get_mut::<LinearVelocity<glam::DVec2>>(entity).unwrap().0.y = 3.0;
    simulation.run_for(0.1).unwrap();
    assert!(!sleeps(&simulation, "box-0") && body(&simulation, "box-0").position().y > 0.7);
}

#[test]
fn sleepers_do_not_change_the_bits_of_what_is_awake() {
    let run = |settings: Settings| {
        let mut simulation = simulation(settings, rough(0.5, 0.4));
        floor(&mut simulation);
        tower(&mut simulation, "still", -20.0, 0.0, 6);
        // A heap that keeps moving: rods and balls on a slab that is shaken by its own fall.
        for k in 0..30 {
            let (x, y) = (0.6 * f64::from(k % 5), 1.0 + 1.5 * f64::from(k / 5));
            let shape = if k % 2 == 0 { ball(0.3, 1.0) } else { rod(0.7, 0.5) };
            shape.at(x, y).turned(0.4 * f64::from(k)).spawn(&mut simulation, &format!("loose-{k:02}"));
        }
        let mut states = Vec::new();
        let mut slept = 0;
        for _ in 0..180 {
            simulation.step().unwrap();
            slept = slept.max(simulation.world().resource::<Rest>().sleeping());
            let awake = (0..30).map(|k| format!("loose-{k:02}")).filter(|name| !sleeps(&simulation, name));
            states.push(awake.map(|name| (name.clone(), state(&simulation, &name))).collect::<Vec<_>>());
        }
        (states, slept)
    };
    let (sleeping, slept) = run(sleepy());
    let (awake, _) = run(Settings { sleep: None, ..sleepy() });
    assert!(slept >= 6, "the tower sleeps: {slept}");
    let mut compared = 0;
    for (step, (some, all)) in sleeping.iter().zip(&awake).enumerate() {
        // Until the first of the heap sleeps: its neighbours would feel a body that lies still instead of creeping.
        if some.len() < all.len() {
            break;
        }
        assert_eq!(some, all, "step {step}");
        compared = step;
    }
    assert!(compared > 60, "the tower slept for {compared} steps beside them");
}
