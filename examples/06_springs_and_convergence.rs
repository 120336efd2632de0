//! A weight on a spring, and a rod that swings on a pin. You will see how the error of each integrator falls when Δt is halved, twice for first
//! order and four times for second, and the period of a pendulum against the elliptic integral.

use std::error::Error;

use tumble::math::trig;
use tumble::prelude::*;

/// Where a weight of 1 kg on a spring of 100 N/m is after one second, released at rest at 1 m [m].
fn oscillator(integrator: Integrator, dt: f64) -> Result<f64, Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings { dt, integrator, ..Settings::weightless() });
    let weight = simulation.spawn((Name::new("weight"), Position(dvec2(1.0, 0.0))));
    simulation.attach(weight, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.1)?, Amount::Mass(1.0)));
    let (a, b) = (Anchor::World(dvec2(-2.0, 0.0)), Anchor::Body(weight, dvec2(0.0, 0.0)));
    simulation.spawn(Spring { a, b, stiffness: 100.0, damping: 0.0, rest_length: 2.0 });
    simulation.run_for(1.0)?;
    Ok(simulation.body("weight")?.position().x)
}

/// Period of a uniform rod of 1 m that swings about one end, released at an angle [s].
fn period(released_degrees: f64) -> Result<f64, Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings { dt: 0.0002, ..Settings::default() });
    let turned = Orientation(PlanarRotation::from_degrees(released_degrees));
    let rod = simulation.spawn((Name::new("rod"), Position(dvec2(0.0, 0.0)), turned));
    simulation.attach(rod, Part::new(Rod::try_new(dvec2(0.0, 0.0), dvec2(0.0, -1.0), 0.0)?, Amount::Density(1.0)));
    simulation.prepare()?;
    // A stiff spring of no length is the pin.
    let pin = simulation.body("rod")?.from_part_frame(dvec2(0.0, 0.0));
    let (a, b) = (Anchor::World(dvec2(0.0, 0.0)), Anchor::Body(rod, pin));
    simulation.spawn(Spring { a, b, stiffness: 1e6, damping: 0.0, rest_length: 0.0 });

    // From one passage through the vertical to the next but one; the instant by linear interpolation.
    let mut passages = Vec::new();
    while passages.len() < 3 {
        let before = simulation.body("rod")?.angle();
        simulation.step()?;
        let after = simulation.body("rod")?.angle();
        if before * after <= 0.0 {
            passages.push(simulation.time() - simulation.clock().dt * after / (after - before));
        }
    }
    Ok(passages[2] - passages[0])
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let exact = trig::cos(10.0);
    for (integrator, order) in [(Integrator::SymplecticEuler, 1.0), (Integrator::Ballistic, 2.0)] {
        println!("{integrator:?}:   Δt [s]   error [m]   ratio");
        let mut coarser: Option<f64> = None;
        for dt in [0.004, 0.002, 0.001, 0.0005] {
            let error = (oscillator(integrator, dt)? - exact).abs();
            let ratio = coarser.map(|coarser| coarser / error);
            println!("{dt:25.4}   {error:.3e}   {}", ratio.map_or("–".into(), |ratio| format!("{ratio:.3}")));
            // The next term of the error is smaller by ω Δt ≤ 0.04, so the ratio is 2^order to a few percent.
            assert!(ratio.is_none_or(|ratio| (ratio / trig::pow(2.0, order) - 1.0).abs() < 0.06), "{ratio:?}");
            coarser = Some(error);
        }
        println!();
    }

    println!("released at   period [s]   4 √(2 L/3 g) K(sin²(θ₀/2)) [s]");
    for (degrees, exact) in [(5.0, 1.63872653101), (45.0, 1.70342078693), (90.0, 1.93333485437)] {
        let measured = period(degrees)?;
        println!("{degrees:10}°   {measured:10.6}   {exact:10.6}");
        // The spring gives by 0.01 mm, which lengthens the pendulum by 1e-5 of it; Δt is 1e-4 of a period.
        assert!((measured / exact - 1.0).abs() < 2e-4, "the period is {measured} s");
    }
    Ok(())
}
