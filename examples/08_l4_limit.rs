//! The limit of stiff springs (docs/physics.md, L4). You will see a ball and a flat rod land at 1 m/s on ever stiffer springs, and what impulses say.
//!
//! With one contact, both agree in the limit: the ball leaves with ε. With two contacts at once the springs tend to the *simultaneous* answer,
//! v_y = ε and no spin. Impulses, one by one, end elsewhere: v_y = 0.3359375 and ω = ∓0.0703125, whichever end is first (validation C9).

use std::error::Error;

use tumble::math::trig;
use tumble::prelude::*;

const RESTITUTION: f64 = 0.5;

/// A shape of 1 kg that touches the floor and falls on it at 1 m/s.
fn landing(shape: impl Into<PlanarShape>, height: f64, settings: Settings) -> Result<Simulation, Box<dyn Error>> {
    let mut simulation = Simulation::new(settings);
    let rubber = simulation.materials_mut().set("rubber", Surface { restitution: RESTITUTION, ..Surface::default() });
    let floor = simulation.spawn((Name::new("floor"), BodyKind::Static, Position(dvec2(0.0, 0.0))));
    let ground = HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?;
    simulation.attach(floor, Part::new(ground, Amount::Density(0.0)).material(rubber));
    let state = (Position(dvec2(0.0, height)), LinearVelocity(dvec2(0.0, -1.0)));
    let body = simulation.spawn((Name::new("body"), state));
    simulation.attach(body, Part::new(shape.into(), Amount::Mass(1.0)).material(rubber));
    Ok(simulation)
}

/// Springs of a stiffness, a damping, and steps of a two-thousandth of 1/ω.
fn springs(stiffness: f64, damping: Option<f64>) -> Settings {
    let law = SpringDamperSettings { stiffness: Some(stiffness), damping, ..SpringDamperSettings::default() };
    Settings {
        dt: 0.0005 / stiffness.sqrt(),
        contact: ContactModel::Penalty,
        penalty: PenaltySettings { law: PenaltyLaw::SpringDamper(law) },
        ..Settings::default()
    }
}

/// Velocity and rate of turn when the body has left the floor [m/s, rad/s].
fn rebound(mut simulation: Simulation, height: f64) -> Result<(f64, f64), Box<dyn Error>> {
    for _ in 0..100_000 {
        simulation.step()?;
        let body = simulation.body("body")?;
        if body.velocity().y > 0.0 && body.position().y > height {
            return Ok((body.velocity().y, body.angular_velocity()));
        }
    }
    Err("the body never left the floor".into())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let disc = Disc::try_new(dvec2(0.0, 0.0), 0.1)?;
    let rod = Rod::try_new(dvec2(-1.0, 0.0), dvec2(1.0, 0.0), 0.0)?;
    // Damping ratio that gives back ε: ζ = −ln ε/√(π² + ln² ε). By default each point is damped as if it were alone, c = 2 ζ √(k m_point);
    // on two springs at once the rod's own c is ζ √(2 k m).
    let ln = trig::ln(RESTITUTION);
    let ratio = -ln / (std::f64::consts::PI * std::f64::consts::PI + ln * ln).sqrt();

    println!("   k [N/m]   ball v_y   rod v_y   rod ω    (springs)");
    let mut last = (0.0, 0.0, 0.0);
    for stiffness in [1e4, 1e5, 1e6, 1e7, 1e8] {
        let (ball, _) = rebound(landing(disc.clone(), 0.1, springs(stiffness, None))?, 0.1)?;
        let damping = ratio * (2.0 * stiffness).sqrt();
        let (flat, spin) = rebound(landing(rod.clone(), 0.0, springs(stiffness, Some(damping)))?, 0.0)?;
        println!("{stiffness:10.0e}   {ball:8.5}   {flat:7.5}   {spin:5.3}");
        last = (ball, flat, spin);
    }

    let impulse = |shape: PlanarShape, height| -> Result<(f64, f64), Box<dyn Error>> {
        let mut simulation = landing(shape, height, Settings::weightless())?;
        simulation.step()?;
        let body = simulation.body("body")?;
        Ok((body.velocity().y, body.angular_velocity()))
    };
    let (ball, _) = impulse(disc.into(), 0.1)?;
    let (flat, spin) = impulse(rod.into(), 0.0)?;
    println!("{:>10}   {ball:8.5}   {flat:7.5}   {spin:5.3}    (one-by-one impulses)", "–");
    println!("{:>10}   {RESTITUTION:8.5}   {RESTITUTION:7.5}   {:5.3}    (simultaneous)", "–", 0.0);

    // The weight shifts the spring by g/k against a depth of v/ω: g/(v ω) = 0.001 of the speed. The last step leaves the spring late by half
    // of ω Δt = 0.0005.
    assert!(
        (last.0 - RESTITUTION).abs() < 0.0015 && (last.1 - RESTITUTION).abs() < 0.0015 && last.2.abs() < 1e-9,
        "{last:?}"
    );
    // Exact in binary up to rounding.
    assert!((ball - RESTITUTION).abs() < 1e-12);
    assert!((flat - 0.3359375).abs() < 1e-12 && (spin.abs() - 0.0703125).abs() < 1e-12, "{flat} {spin}");
    Ok(())
}
