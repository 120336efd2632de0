//! The same bits in every run, whatever the order of a file or of spawning, in debug and in release.
//!
//! The golden fingerprints must come out of both profiles: `cargo test` and `cargo test --release -p tumble --test determinism`.

use std::error::Error;

use tumble::prelude::*;

/// The state after so many steps.
fn state_after(steps: u32, simulation: &mut Simulation) -> Result<Fingerprint, Box<dyn Error>> {
    simulation.record(steps)?;
    for _ in 0..steps {
        simulation.step()?;
    }
    let recording = simulation.take_recording().ok_or("nothing was recorded")?;
    Ok(recording.fingerprint(recording.samples.last().ok_or("no sample")?))
}

fn run_shipped(name: &str, steps: u32, edit: impl FnOnce(&mut Scene)) -> Result<Fingerprint, Box<dyn Error>> {
    let mut loaded = Shipped::named(name).ok_or("no such scene")?.load()?;
    edit(&mut loaded.scene);
    state_after(steps, &mut Simulation::from_loaded(&loaded)?)
}

/// Six boxes fall on each other, spawned in a given order, under ids that say who is who.
fn heap(order: [u64; 7]) -> Result<Fingerprint, Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings::default());
    let surface = Surface { static_friction: 0.5, kinetic_friction: 0.4, restitution: 0.3 };
    let wood = simulation.materials_mut().set("wood", surface);
    for id in order {
        if id == 0 {
            let floor = simulation.spawn((BodyId(0), BodyKind::Static, Position(dvec2(0.0, 0.0))));
            let ground = HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?;
            simulation.attach(floor, Part::new(ground, Amount::Density(0.0)).material(wood));
            continue;
        }
        let height = id as f64;
        let turned = Orientation(PlanarRotation::from_angle(0.3 * height));
        let body = simulation.spawn((
            BodyId(id),
            Position(dvec2(0.11 * (height * height - 3.0 * height), 1.2 * height)),
            turned,
        ));
        let shape = ConvexPolygon::rectangle(dvec2(0.0, 0.0), dvec2(0.5, 0.3), 0.0)?;
        simulation.attach(body, Part::new(shape, Amount::Density(1.0)).material(wood));
    }
    state_after(300, &mut simulation)
}

#[test]
fn two_runs_give_the_same_bits() -> Result<(), Box<dyn Error>> {
    for name in ["homework_rods_impulse", "rod_pile", "dominoes"] {
        assert_eq!(run_shipped(name, 200, |_| ())?, run_shipped(name, 200, |_| ())?, "{name}");
    }
    Ok(())
}

#[test]
fn order_of_the_bodies_in_a_file_does_not_matter() -> Result<(), Box<dyn Error>> {
    for name in ["homework_rods_impulse", "rod_pile", "newtons_cradle"] {
        let as_written = run_shipped(name, 200, |_| ())?;
        assert_eq!(as_written, run_shipped(name, 200, |scene| scene.bodies.reverse())?, "{name} from the end");
        assert_eq!(
            as_written,
            run_shipped(name, 200, |scene| scene.bodies.rotate_left(1))?,
            "{name} from the second on"
        );
    }
    Ok(())
}

#[test]
fn order_of_spawning_does_not_matter_under_the_same_ids() -> Result<(), Box<dyn Error>> {
    let sorted = heap([0, 1, 2, 3, 4, 5, 6])?;
    assert_eq!(sorted, heap([6, 5, 4, 3, 2, 1, 0])?);
    assert_eq!(sorted, heap([3, 0, 5, 1, 6, 2, 4])?);
    Ok(())
}

#[test]
fn fingerprint_sees_a_change_of_one_bit() -> Result<(), Box<dyn Error>> {
    let nudge = |scene: &mut Scene| {
        let body = scene.bodies.iter_mut().find(|body| body.name == "star").expect("there is a star");
        body.at.x = body.at.x.next_up();
    };
    assert_ne!(run_shipped("homework_rods", 200, |_| ())?, run_shipped("homework_rods", 200, nudge)?);
    Ok(())
}

/// Whoever changes how things move writes the new figures here, and says in the changelog under **Motion** what moved and why.
#[test]
fn motion_is_what_it_was_in_both_profiles() -> Result<(), Box<dyn Error>> {
    let golden = [
        ("homework_rods", 1000, "4a2cfbf414794f56a1126c30749e6224"),
        ("box_stack", 300, "d60ca001ff099f06f83f7a946f18c91b"),
    ];
    for (name, steps, fingerprint) in golden {
        assert_eq!(run_shipped(name, steps, |_| ())?.to_string(), fingerprint, "{name} after {steps} steps");
    }
    Ok(())
}
