//! Speed in space: a pile against real time, and growth with contacts.

use glam::{DVec3, dvec3};
use tumble_math::Spatial;
use tumble_scene::format::Scene;
use tumble_scene::shipped::Shipped;
use tumble_scene::{AnyLoaded, FromScene};
use tumble_shape::{Cuboid, HalfSpace};
use tumble_sim::{Amount, BodyKind, ContactManifold, Part, Position, Settings, Simulation, StepError};
use tumble_solver::Surface;

use super::measure::{Timing, time_steps};

/// Boxes on each other in a stack.
const STORIES: usize = 5;
/// Steps until stacks carry their weight.
const SETTLING: u32 = 50;

/// Prints both answers.
pub fn space(rounds: u32) -> Result<(), StepError> {
    pile(rounds)?;
    growth(rounds)
}

fn pile(rounds: u32) -> Result<(), StepError> {
    let Some(Ok(AnyLoaded::Spatial(loaded))) = Shipped::named("opening_pile").map(Shipped::load_any) else {
        return Ok(());
    };
    let scene: &Scene<Spatial> = &loaded.scene;
    let steps = (scene.duration / scene.dt).round() as usize;
    // Every round takes the same steps: the fastest time of each one counts.
    let mut fastest = vec![f64::INFINITY; steps];
    for _ in 0..rounds {
        let Ok(mut pile) = Simulation::from_loaded(&loaded) else { return Ok(()) };
        for fastest in &mut fastest {
            let started = std::time::Instant::now();
            pile.step()?;
            *fastest = fastest.min(started.elapsed().as_secs_f64());
        }
    }
    let wall: f64 = fastest.iter().sum();
    let slowest = fastest.iter().copied().fold(0.0, f64::max);
    println!(
        "opening_pile: {:.2} s simulated in {wall:.2} s: {:.2} × real time (aim: above 1); {:.2} ms a step, slowest {:.1} ms",
        scene.duration,
        scene.duration / wall,
        wall / steps as f64 * 1e3,
        slowest * 1e3
    );
    Ok(())
}

fn growth(rounds: u32) -> Result<(), StepError> {
    let (mut small, mut large) = (stacks(1_000)?, stacks(10_000)?);
    let (mut few, mut many) = (Timing::SLOWEST, Timing::SLOWEST);
    // In turn, so that both see the same moods of the machine.
    for _ in 0..rounds {
        few = few.faster(time_steps(&mut small, 40, 1)?);
        many = many.faster(time_steps(&mut large, 4, 1)?);
    }
    let [few, many] = [(few, &mut small), (many, &mut large)].map(|(timing, stacks)| {
        let contacts = contacts(stacks);
        let each = timing.microseconds / contacts as f64;
        println!("stacks of boxes in space, {contacts:5} contacts  {each:8.4} µs a step and contact");
        each
    });
    println!("    growth of the cost of a contact: {:.2}", many / few);
    Ok(())
}

/// Stacks of boxes at rest on a floor, with about so many contact points.
fn stacks(points: usize) -> Result<Simulation<Spatial>, StepError> {
    let gravity = dvec3(0.0, -9.81, 0.0);
    let mut simulation = Simulation::<Spatial>::with_settings(Settings { gravity, ..Settings::weightless() });
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.5, restitution: 0.0 };
    simulation.materials_mut().set("default", surface);
    let floor = simulation.spawn((Position(DVec3::ZERO), BodyKind::Static));
    let plane = HalfSpace::try_new(DVec3::Y, 0.0).expect("the normal is not zero");
    simulation.attach(floor, Part::new(plane, Amount::Density(0.0)));
    // Four points under each box.
    let count = points / (4 * STORIES);
    let columns = count.isqrt();
    for stack in 0..count {
        for story in 0..STORIES {
            let at = dvec3((stack % columns) as f64 * 1.5, story as f64 + 0.5, (stack / columns) as f64 * 1.5);
            let body = simulation.spawn(Position(at));
            let cube = Cuboid::with_half_extents(DVec3::splat(0.5)).expect("it has an extent");
            simulation.attach(body, Part::new(cube, Amount::Mass(1.0)));
        }
    }
    for _ in 0..SETTLING {
        simulation.step()?;
    }
    Ok(simulation)
}

fn contacts(simulation: &mut Simulation<Spatial>) -> usize {
    let tolerance = simulation.settings().touch_tolerance();
    let world = simulation.world_mut();
    let mut manifolds = world.query::<&ContactManifold<Spatial>>();
    let points = manifolds.iter(world).flat_map(|manifold| manifold.0.points().iter());
    points.filter(|point| point.separation <= tolerance).count()
}
