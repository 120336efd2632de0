//! Every shipped scene runs, and keeps what it promises: under its own contact model, and under every other for which it claims anything.

use std::error::Error;

use tumble::prelude::*;
use tumble::scene::format::ContactModel;
use tumble::scene::shipped::SHIPPED;
use tumble::scene::{AnyLoaded, Loaded, SceneDim};

/// Runs a scene under each model that it says something about.
fn keeps_its_promises(name: &str) -> Result<(), Box<dyn Error>> {
    match Shipped::named(name).ok_or("no such scene")?.load_any()? {
        AnyLoaded::Planar(loaded) => keeps_promises(name, &loaded),
        AnyLoaded::Spatial(loaded) => keeps_promises(name, &loaded),
    }
}

fn keeps_promises<D: SceneDim>(name: &str, loaded: &Loaded<D>) -> Result<(), Box<dyn Error>> {
    assert!(!loaded.scene.expect.is_empty(), "a shipped scene promises something");
    for model in ContactModel::ALL {
        let own = loaded.scene.contact == model;
        if !own && !loaded.scene.expect.iter().any(|expectation| expectation.is_claimed_under(model)) {
            continue;
        }
        let mut loaded = loaded.clone();
        loaded.scene.contact = model;
        let mut simulation = Simulation::from_loaded(&loaded)?;
        simulation.run_scene()?;
        let verdict = simulation.check();
        assert!(verdict.passed(), "{name} under {}:\n{verdict}", model.word());
        assert!(!own || verdict.count(Status::Met) > 0, "{name} claims nothing under its own model");
    }
    Ok(())
}

macro_rules! scenes {
    ($($name:ident),* $(,)?) => {
        $(
            #[test]
            fn $name() -> Result<(), Box<dyn Error>> {
                keeps_its_promises(stringify!($name))
            }
        )*

        #[test]
        fn no_scene_is_left_out() {
            let shipped: Vec<&str> = SHIPPED.iter().map(|scene| scene.name).collect();
            assert_eq!(shipped, [$(stringify!($name)),*]);
        }
    };
}

scenes! {
    angle_of_repose,
    arch,
    beam_many_legs,
    bouncing_ball,
    bouncing_rod,
    box_stack,
    braking,
    card_house,
    dominoes,
    double_pendulum,
    drag_terminal_velocity,
    hanging_chain,
    head_on,
    homework_rods,
    homework_rods_impulse,
    jammed_bracket,
    ladder,
    mass_ratio,
    newtons_cradle,
    overhang,
    painleve,
    pinned_rod_pendulum,
    quiz_pushed_block,
    rocking_block,
    rod_hits_floor_at_angle,
    rod_pile,
    rolling_disc,
    slider_crank,
    spring_pendulum,
    stick_slip,
    stopping_distance,
    three_discs,
    thrown_uphill,
    wedge,
    bouncing_49,
    box_corner_impact,
    box_stack_3d,
    card_house_3d,
    domino_spiral,
    edge_edge,
    elastic_666,
    gyroscope,
    incline_3d,
    opening_pile,
    pulled_board,
    rattleback,
    rolling_ball,
    slip_to_roll,
    spheres_666,
    symmetric_precession,
    t_handle,
    table_four_legs,
    tippe_top,
    vertex_face,
}
