//! A ball is dropped from one metre and bounces with ε = 0.8. You will see the apex of each bounce: every time it comes back to ε² of
//! the height before.

use std::error::Error;

use tumble::prelude::*;

const RESTITUTION: f64 = 0.8;
const RADIUS: f64 = 0.1;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let settings = Settings { dt: 0.001, integrator: Integrator::Ballistic, ..Settings::default() };
    let mut simulation = Simulation::new(settings);
    let rubber = simulation.materials_mut().set("rubber", Surface { restitution: RESTITUTION, ..Surface::default() });
    let floor = simulation.spawn((Name::new("floor"), BodyKind::Static, Position(dvec2(0.0, 0.0))));
    simulation.attach(floor, Part::new(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?, Amount::Density(0.0)));
    let ball = simulation.spawn((Name::new("ball"), Position(dvec2(0.0, 1.0 + RADIUS))));
    let disc = Disc::try_new(dvec2(0.0, 0.0), RADIUS)?;
    simulation.attach(ball, Part::new(disc, Amount::Mass(1.0)).material(rubber));

    println!("bounce   apex [m]   ε²ⁿ · 1 m");
    let mut exact = 1.0;
    for bounce in 1..=5 {
        // Down until it rises again, then up to the apex.
        let height =
            |simulation: &Simulation| Ok::<f64, Box<dyn Error>>(simulation.body("ball")?.position().y - RADIUS);
        while simulation.body("ball")?.velocity().y <= 0.0 {
            simulation.step()?;
        }
        let mut apex = 0.0_f64;
        while simulation.body("ball")?.velocity().y > 0.0 {
            apex = apex.max(height(&simulation)?);
            simulation.step()?;
        }
        apex = apex.max(height(&simulation)?);
        exact *= RESTITUTION * RESTITUTION;
        println!("{bounce:6}   {apex:8.5}   {exact:8.5}");

        // Samples miss the apex by at most g Δt²/8, and a rebound begins on the floor at the end of its step, not within it: half of
        // Δt counted in or out, g Δt²/2.
        assert!((apex - exact).abs() < 9.81 * 1e-6, "the apex is {apex} m");
    }
    Ok(())
}
