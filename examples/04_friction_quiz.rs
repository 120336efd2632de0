//! The lecture's quiz (docs/physics.md, L12): a block is pushed harder and harder; what does friction do? You will see it grow with the push, drop
//! when the block breaks away, and stay: the static ramp, μ_s m g, and the kinetic plateau, μ_k m g.

use std::error::Error;

use tumble::prelude::*;

const MASS: f64 = 2.0;
const STATIC_FRICTION: f64 = 0.6;
const KINETIC_FRICTION: f64 = 0.4;
/// How fast the push grows [N/s].
const GROWTH: f64 = 2.0;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = Simulation::new(Settings { dt: 0.001, ..Settings::default() });
    let surface = Surface { static_friction: STATIC_FRICTION, kinetic_friction: KINETIC_FRICTION, restitution: 0.0 };
    let wood = simulation.materials_mut().set("wood", surface);
    let floor = simulation.spawn((Name::new("floor"), BodyKind::Static, Position(dvec2(0.0, 0.0))));
    let ground = HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?;
    simulation.attach(floor, Part::new(ground, Amount::Density(0.0)).material(wood));
    let block = simulation.spawn((Name::new("block"), Position(dvec2(0.0, 0.2))));
    let rectangle = ConvexPolygon::rectangle(dvec2(0.0, 0.0), dvec2(0.4, 0.2), 0.0)?;
    simulation.attach(block, Part::new(rectangle, Amount::Mass(MASS)).material(wood));
    simulation.spawn(AppliedForce::<Planar> {
        body: block,
        point: dvec2(0.0, 0.0),
        force: dvec2(GROWTH, 0.0),
        torque: 0.0,
        axes: Axes::World,
        course: Course::lines([(0.0, 0.0), (10.0, 10.0)]),
    });
    simulation.record(1)?;
    simulation.run_for(10.0)?;

    let weight = MASS * simulation.settings().gravity.length();
    let recording = simulation.take_recording().ok_or("nothing was recorded")?;
    let friction = &"friction_force:block".parse::<Channel>()?.series(&recording)?[0];
    let speed = &"speed:block".parse::<Channel>()?.series(&recording)?[0];
    println!("   t [s]   push [N]   friction [N]   expected [N]   speed [m/s]");
    for t in [1.0_f64, 2.0, 4.0, 5.5, 5.88, 5.9, 7.0, 10.0] {
        let step = (t / recording.dt).round() as usize;
        let push = GROWTH * t;
        let expected = if push <= STATIC_FRICTION * weight { push } else { KINETIC_FRICTION * weight };
        let (friction, speed) = (friction.values[step].abs(), speed.values[step]);
        println!("{t:8.2}   {push:8.3}   {friction:12.6}   {expected:12.6}   {speed:11.6}");
        // The velocity filter stops when no speed changes by 1e-12 m/s, which is 2e-9 N on 2 kg in a step of 1 ms.
        assert!((friction - expected).abs() < 1e-8, "friction is {friction} N");
    }
    Ok(())
}
