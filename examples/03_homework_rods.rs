//! The homework: bodies made of rods fall on a floor that pushes back like a spring, but only on the way down (docs/physics.md, R1 to R9).
//! You will see the mass of an L, a T and a star beside the figures worked out by hand, and how each of them falls and comes to rest.

use std::error::Error;

use tumble::prelude::*;

/// A body of rods of 1 kg/m, by the ends of each.
fn rods(
    simulation: &mut Simulation,
    name: &'static str,
    at: DVec2,
    ends: &[(DVec2, DVec2)],
) -> Result<(), Box<dyn Error>> {
    let body = simulation.spawn((Name::new(name), Position(at), AngularVelocity(1.0)));
    for &(from, to) in ends {
        simulation.attach(body, Part::new(Rod::try_new(from, to, 0.0)?, Amount::Density(1.0)));
    }
    Ok(())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let penalty = PenaltySettings { law: PenaltyLaw::Lecture { stiffness: 2000.0, viscosity: 5.0 } };
    let settings = Settings { dt: 0.002, contact: ContactModel::Penalty, penalty, ..Settings::default() };
    let mut simulation = Simulation::new(settings);
    let floor = simulation.spawn((Name::new("floor"), BodyKind::Static, Position(dvec2(0.0, 0.0))));
    simulation.attach(floor, Part::new(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?, Amount::Density(0.0)));
    let origin = dvec2(0.0, 0.0);
    rods(&mut simulation, "L", dvec2(-4.0, 3.0), &[(origin, dvec2(2.0, 0.0)), (origin, dvec2(0.0, 1.0))])?;
    rods(&mut simulation, "T", dvec2(0.0, 4.0), &[(dvec2(-1.0, 0.0), dvec2(1.0, 0.0)), (origin, dvec2(0.0, -1.5))])?;
    let spokes = [90.0_f64, 162.0, 234.0, 306.0, 18.0].map(|degrees| {
        let rotation = PlanarRotation::from_degrees(degrees);
        (origin, dvec2(rotation.cos(), rotation.sin()))
    });
    rods(&mut simulation, "star", dvec2(4.0, 5.0), &spokes)?;
    simulation.prepare()?;

    // Parallel axes, by hand: each rod brings m L²/12 about its middle and m d² for the middle's distance d from the common centre.
    let by_hand = [
        ("L", 3.0, 8.0 / 12.0 + 1.0 / 12.0 + 2.0 * (1.0 / 9.0 + 1.0 / 36.0) + (4.0 / 9.0 + 1.0 / 9.0)),
        ("T", 3.5, 8.0 / 12.0 + 3.375 / 12.0 + (2.0 * 1.5 / 3.5) * 0.5625),
        ("star", 5.0, 5.0 / 3.0),
    ];
    println!("body   mass [kg]   inertia [kg·m²]   by hand");
    for (name, mass, inertia) in by_hand {
        let body = simulation.body(name)?;
        println!("{name:5}  {:9.4}   {:15.6}   {inertia:7.6}", body.mass(), body.inertia());
        assert!((body.mass() - mass).abs() < 1e-12 && (body.inertia() - inertia).abs() < 1e-12);
    }

    simulation.record(10)?;
    println!("\n   t [s]     L: y [m]     T: y [m]  star: y [m]   fastest [m/s]");
    let mut fastest = 0.0_f64;
    for _ in 0..10 {
        simulation.run_for(1.0)?;
        let bodies = [simulation.body("L")?, simulation.body("T")?, simulation.body("star")?];
        fastest = bodies.iter().map(|body| body.velocity().length()).fold(0.0, f64::max);
        let [l, t, star] = bodies.map(|body| body.position().y);
        println!("{:8.1}   {l:10.4}   {t:10.4}   {star:10.4}   {fastest:13.4}", simulation.time());
    }
    let recording = simulation.take_recording().ok_or("nothing was recorded")?;
    let highest = recording.audit.iter().map(|row| row.total).fold(f64::NEG_INFINITY, f64::max);
    let start = recording.audit[0].total;
    println!(
        "\nenergy: {start:.3} J at the start, never above {highest:.3} J, {:.3} J at the end",
        recording.audit.last().map_or(0.0, |row| row.total)
    );

    // The floor pushes only against motion, so it takes energy and gives none. A step's own error is m g² Δt²/2 = 2 mJ for all of them.
    assert!(highest <= start + 0.01, "energy rose to {highest} J");
    // Every end is kicked up by at most a few g Δt = 0.02 m/s.
    assert!(fastest < 0.1, "something still moves at {fastest} m/s");
    Ok(())
}
