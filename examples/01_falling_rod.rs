//! A rod is thrown and falls freely. You will see its height over one second beside the closed form, for both integrators.
//!
//! ```text
//! exact               y = y₀ − ½ g t²
//! symplectic Euler    y = y₀ − ½ g t (t + Δt)       the velocity of the end of each step moves the rod
//! ballistic           exact
//! ```

use std::error::Error;

use tumble::prelude::*;

const G: f64 = 9.81;

/// A rod of 1 m and 1 kg, 10 m up, thrown sideways and spinning.
fn thrown_rod(integrator: Integrator) -> Result<Simulation, Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings { integrator, ..Settings::default() });
    let state = (Position(dvec2(0.0, 10.0)), LinearVelocity(dvec2(2.0, 0.0)), AngularVelocity(0.5));
    let rod = simulation.spawn((Name::new("rod"), state));
    simulation.attach(rod, Part::new(Rod::try_new(dvec2(-0.5, 0.0), dvec2(0.5, 0.0), 0.0)?, Amount::Density(1.0)));
    Ok(simulation)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut euler = thrown_rod(Integrator::SymplecticEuler)?;
    let mut ballistic = thrown_rod(Integrator::Ballistic)?;
    println!("   t [s]   exact y [m]   symplectic Euler   ballistic");
    for _ in 0..5 {
        euler.run_for(0.2)?;
        ballistic.run_for(0.2)?;
        let (t, dt) = (euler.time(), euler.clock().dt);
        let exact = 10.0 - 0.5 * G * t * t;
        let (y_euler, y_ballistic) = (euler.body("rod")?.position().y, ballistic.body("rod")?.position().y);
        println!("{t:8.2}   {exact:11.6}   {y_euler:16.6}   {y_ballistic:9.6}");

        // Both are exact sums, so only rounding is left.
        assert!((y_euler - (10.0 - 0.5 * G * t * (t + dt))).abs() < 1e-12);
        assert!((y_ballistic - exact).abs() < 1e-12);
    }
    let rod = ballistic.body("rod")?;
    println!("\nafter 1 s it is at x = {:.6} m and has turned by {:.6} rad", rod.position().x, rod.angle());
    assert!((rod.position().x - 2.0).abs() < 1e-12 && (rod.angle() - 0.5).abs() < 1e-12);
    Ok(())
}
