//! One scene under every contact model. You will see a ball bounce, a box slide to a stop and a heavy disc rest, with the exact figure, the
//! answer of each model, and how far off it is.

use std::error::Error;

use tumble::prelude::*;

const SCENE: &str = r#"(
    format: 1, dt: 0.001, duration: 2,
    materials: {
        "wood": (static_friction: 0.4, kinetic_friction: 0.3),
        "rubber": (restitution: 0.7),
    },
    bodies: [
        (name: "floor", kind: Static, material: "wood", parts: [HalfPlane()]),
        (name: "ball", at: (-3, 1.1), material: "rubber", parts: [Disc(radius: 0.1)]),
        (name: "box", at: (0, 0.25), velocity: (3, 0), material: "wood", parts: [Box(size: (0.5, 0.5))]),
        (name: "disc", at: (-6, 0.5), material: "wood", parts: [Disc(radius: 0.5, mass: 100)]),
    ],
)"#;

/// Speed with which the ball leaves the floor, where the box stops, and how deep the disc sinks.
fn figures(contact: ContactModel) -> Result<[f64; 3], Box<dyn Error>> {
    let mut loaded = Scene::parse(SCENE, "models.ron")?;
    loaded.scene.contact = contact.into();
    let mut simulation = Simulation::from_loaded(&loaded)?;
    let mut rebound = 0.0_f64;
    while simulation.time() < loaded.scene.duration {
        simulation.step()?;
        rebound = rebound.max(simulation.body("ball")?.velocity().y);
    }
    let (stop, sunk) = (simulation.body("box")?.position().x, 0.5 - simulation.body("disc")?.position().y);
    Ok([rebound, stop, sunk])
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let g = 9.81_f64;
    let exact = [0.7 * (2.0 * g).sqrt(), 9.0 / (2.0 * 0.3 * g), 0.0];
    println!("model         rebound [m/s]    error     stop [m]    error     sunk [m]");
    println!("exact         {:13.5}            {:9.5}            {:9.6}", exact[0], exact[1], exact[2]);
    for contact in ContactModel::ALL {
        let [rebound, stop, sunk] = figures(contact)?;
        let (off_rebound, off_stop) = ((rebound - exact[0]).abs(), (stop - exact[1]).abs());
        println!(
            "{:12}  {rebound:13.5}  {off_rebound:8.5}    {stop:9.5}  {off_stop:8.5}    {sunk:9.6}",
            contact.word()
        );
        match contact {
            // A step of gravity for the rebound; v Δt/2 for the stop, to first order; nothing sinks.
            ContactModel::Impulse | ContactModel::RestingLcp | ContactModel::VelocityLcp => {
                assert!(off_rebound < 0.011 && off_stop < 0.0016 && sunk.abs() < 1e-9);
            }
            // Two steps of gravity, since it knows an impact up to a substep late; at rest it gives way by g/ω², 0.07 mm at 60 Hz.
            ContactModel::SoftStep => assert!(off_rebound < 0.02 && off_stop < 0.005 && sunk > 0.0 && sunk < 2e-4),
            // Springs: a few percent on impact; friction comes up to full only after the box has sunk in. At default stiffness m g/k
            // depends on Δt alone, about 4 mm at 1 ms.
            ContactModel::Penalty => assert!(off_rebound < 0.2 && off_stop < 0.05 && sunk > 1e-4 && sunk < 0.01),
        }
    }
    println!(
        "\nImpulses are exact where one contact decides, whichever model finds them; springs show the force, and sink."
    );
    Ok(())
}
