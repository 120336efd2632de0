//! A mechanism held together by joints. You will see a crank turn and push a piston along its guide, how the crank slows down where the
//! piston is quick, and that neither the joints open nor the energy goes away.

use std::error::Error;

use tumble::math::trig;
use tumble::prelude::*;

/// Lengths of the crank and of the rod between crank and piston [m].
const CRANK: f64 = 0.1;
const ROD: f64 = 0.3;

/// A crank at 10 rad/s, stretched out along x, where the piston is farthest out and at rest.
fn slider_crank() -> Result<Simulation, Box<dyn Error>> {
    let settings =
        Settings { dt: 0.0005, length_scale: CRANK, integrator: Integrator::Ballistic, ..Settings::weightless() };
    let mut simulation = Simulation::new(settings);
    let mut rod = |name: &'static str, centre: f64, length: f64, turning: f64| -> Result<Entity, Box<dyn Error>> {
        let motion = (LinearVelocity(dvec2(0.0, 0.5)), AngularVelocity(turning));
        let body = simulation.spawn((Name::new(name), Position(dvec2(centre, 0.0)), motion));
        let shape = Rod::try_new(dvec2(-0.5 * length, 0.0), dvec2(0.5 * length, 0.0), 0.0)?;
        simulation.attach(body, Part::new(shape, Amount::Mass(1.0)));
        Ok(body)
    };
    // The crank's end moves at 1 m/s, the piston not at all.
    let crank = rod("crank", 0.5 * CRANK, CRANK, 10.0)?;
    let link = rod("link", CRANK + 0.5 * ROD, ROD, -1.0 / ROD)?;
    let piston = simulation.spawn((Name::new("piston"), Position(dvec2(CRANK + ROD, 0.0))));
    simulation.attach(piston, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.03)?, Amount::Mass(0.5)));

    let origin = Anchor::World(dvec2(0.0, 0.0));
    // Anchors are points of body frames, whose origin is the centre of mass.
    let end = |body, x: f64| Anchor::Body(body, dvec2(x, 0.0));
    let guide = JointKind::Prismatic { axis: dvec2(1.0, 0.0) };
    for (a, b, kind) in [
        (origin, end(crank, -0.5 * CRANK), JointKind::Revolute),
        (end(crank, 0.5 * CRANK), end(link, -0.5 * ROD), JointKind::Revolute),
        (end(link, 0.5 * ROD), end(piston, 0.0), JointKind::Revolute),
        (origin, end(piston, 0.0), guide),
    ] {
        simulation.spawn(Joint { a, b, kind });
    }
    Ok(simulation)
}

/// Kinetic energy of all three bodies [J].
fn energy(simulation: &Simulation) -> Result<f64, Box<dyn Error>> {
    let mut sum = 0.0;
    for name in ["crank", "link", "piston"] {
        sum += simulation.body(name)?.kinetic_energy();
    }
    Ok(sum)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = slider_crank()?;
    simulation.prepare()?;
    let given = energy(&simulation)?;
    println!("time [s]   crank [°]   crank [rad/s]   piston [m]   from geometry [m]");
    // A turn takes ∫ dα/ω = 0.8504381022 s, with ω from ½ I(α) ω² = E and I(α) the inertia felt at the crank.
    for step in 0..1701 {
        if step > 0 {
            simulation.step()?;
        }
        let (angle, turning) = (simulation.body("crank")?.angle(), simulation.body("crank")?.angular_velocity());
        let piston = simulation.body("piston")?.position();
        let across = CRANK * trig::sin(angle);
        let geometry = CRANK * trig::cos(angle) + (ROD * ROD - across * across).sqrt();
        if step % 200 == 0 {
            let (time, degrees) = (simulation.time(), angle.to_degrees());
            println!("{time:8.3}   {degrees:9.2}   {turning:13.4}   {:10.6}   {geometry:17.6}", piston.x);
        }
        // Joints hold to round-off, and take nothing; the second order of the step leaves a few parts in a million of the energy.
        assert!((piston.x - geometry).abs() < 1e-9 && piston.y.abs() < 1e-12, "the piston is at {piston}");
        assert!((energy(&simulation)? / given - 1.0).abs() < 1e-5, "{} J of {given} J", energy(&simulation)?);
    }
    // 0.4381 ms short of a turn, at 10 rad/s; the rest is second order in the step.
    let crank = simulation.body("crank")?;
    assert!((trig::sin(crank.angle()) + 0.004381).abs() < 1e-3 && trig::cos(crank.angle()) > 0.0, "{}", crank.angle());
    assert!((crank.angular_velocity() - 10.0).abs() < 0.01, "{} rad/s", crank.angular_velocity());
    println!("\nA turn after 0.8504 s, as ∫ dα/ω says: the crank is back at 10 rad/s.");
    Ok(())
}
