//! A force of one's own: wind, as a system. You will see a light leaf and a heavy stone in the same wind, and how each nears its speed.
//!
//! ```text
//! f = c (w − v)     v(t) = w (1 − exp(−c t/m))
//! ```
//!
//! Any system that adds to `Force` or `Torque` is a force. It may read the clock, resources and components of its own.

use std::error::Error;

use tumble::math::trig;
use tumble::prelude::*;

/// Velocity of the air [m/s].
#[derive(Resource)]
struct Wind(DVec2);

/// How much a body catches the wind [N·s/m].
#[derive(Component)]
struct Sail(f64);

/// f += c (w − v).
fn blow(wind: Res<Wind>, mut bodies: Query<(&mut Force<DVec2>, &LinearVelocity<DVec2>, &Sail)>) {
    for (mut force, velocity, sail) in &mut bodies {
        force.0 += (wind.0 - velocity.0) * sail.0;
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings { dt: 0.001, ..Settings::weightless() });
    simulation.world_mut().insert_resource(Wind(dvec2(5.0, 1.0)));
    let bodies = [("leaf", 0.01, 0.02), ("stone", 1.0, 0.1)];
    for (row, (name, mass, sail)) in bodies.into_iter().enumerate() {
        let body = simulation.spawn((Name::new(name), Position(dvec2(0.0, row as f64)), Sail(sail)));
        simulation.attach(body, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.05)?, Amount::Mass(mass)));
    }
    simulation.add_force(blow);

    println!("   t [s]   leaf [m/s]      exact   stone [m/s]      exact");
    for _ in 0..5 {
        simulation.run_for(0.5)?;
        let t = simulation.time();
        print!("{t:8.2}");
        for (name, mass, sail) in bodies {
            let speed = simulation.body(name)?.velocity().x;
            let exact = 5.0 * (1.0 - trig::exp(-sail * t / mass));
            print!("   {speed:10.5}  {exact:9.5}");
            // First order: w (c Δt/2 m) x exp(−x) with x = c t/m, at most 5 · 0.001/e = 0.00184 m/s.
            assert!((speed - exact).abs() < 0.0019, "{name} moves at {speed} m/s");
        }
        println!();
    }
    Ok(())
}
