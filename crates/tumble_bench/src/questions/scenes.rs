//! Scenes to measure, built in code.

use glam::{DVec2, dvec2};
use tumble_math::{Linear, Planar, PlanarRotation};
use tumble_shape::{ConvexPolygon, HalfPlane, Rod};
use tumble_sim::{
    Amount, AngularVelocity, BodyKind, ContactManifold, ContactModel, ContactPair, LinearVelocity, Orientation, Part,
    Position, Settings, Simulation,
};
use tumble_solver::Surface;

fn rod(from: DVec2, to: DVec2) -> Part<Planar> {
    let rod = Rod::try_new(from, to, 0.0).expect("the ends of these rods differ");
    Part::new(rod, Amount::Density(1.0))
}

fn half_plane(simulation: &mut Simulation, normal: DVec2, offset: f64) {
    let body = simulation.spawn((Position(DVec2::ZERO), BodyKind::Static));
    let plane = HalfPlane::try_new(normal, offset).expect("the normal is not zero");
    simulation.attach(body, Part::new(plane, Amount::Density(0.0)));
}

/// One rod that turns in free fall.
pub fn free_rod() -> Simulation {
    let mut simulation = Simulation::new(Settings { dt: 1e-4, ..Settings::default() });
    let body = simulation.spawn((Position(DVec2::ZERO), AngularVelocity(0.5)));
    simulation.attach(body, rod(dvec2(-0.5, 0.0), dvec2(0.5, 0.0)));
    simulation
}

/// One rod at rest on a floor.
pub fn resting_rod() -> Simulation {
    let mut simulation = Simulation::new(Settings::default());
    half_plane(&mut simulation, DVec2::Y, 0.0);
    let body = simulation.spawn(Position(DVec2::ZERO));
    simulation.attach(body, rod(dvec2(-0.5, 0.0), dvec2(0.5, 0.0)));
    simulation
}

/// Rods far from each other, each with a motion of its own.
pub fn spread(count: usize) -> Simulation {
    let mut simulation = Simulation::new(Settings { gravity: DVec2::ZERO, ..Settings::default() });
    let columns = count.isqrt();
    for i in 0..count {
        let (column, row) = (i % columns, i / columns);
        let at = dvec2(column as f64, row as f64) * 4.0;
        let phase = i as f64 * 0.7;
        let velocity = LinearVelocity(dvec2((phase % 1.3) - 0.65, (phase % 1.7) - 0.85) * 0.5);
        let body = simulation.spawn((Position(at), velocity, AngularVelocity((phase % 2.0) - 1.0)));
        simulation.attach(body, rod(dvec2(-0.5, 0.0), dvec2(0.5, 0.0)));
    }
    simulation
}

/// Bodies of three crossed rods that fall between two walls on a floor.
pub fn settle(count: usize, contact: ContactModel) -> Simulation {
    let mut simulation = Simulation::new(Settings { dt: 1.0 / 60.0, contact, ..Settings::default() });
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.5, restitution: 0.0 };
    simulation.materials_mut().set("default", surface);
    let columns = 50;
    let width = columns as f64 * 1.2;
    half_plane(&mut simulation, DVec2::Y, 0.0);
    half_plane(&mut simulation, DVec2::X, -1.2);
    half_plane(&mut simulation, DVec2::NEG_X, -width);
    for i in 0..count {
        let (column, row) = (i % columns, i / columns);
        let shift = 0.3 * ((row * 7 + column * 3) % 5) as f64 / 5.0;
        let at = dvec2(column as f64 * 1.2 + shift, 1.0 + row as f64 * 1.2);
        let turn = PlanarRotation::from_angle((i as f64 * 0.37) % 3.0);
        let body = simulation.spawn((Position(at), Orientation(turn)));
        for k in 0..3 {
            let spoke = PlanarRotation::from_angle(f64::from(k) * std::f64::consts::PI / 3.0);
            let half = dvec2(spoke.cos(), spoke.sin()) * 0.5;
            simulation.attach(body, rod(-half, half));
        }
    }
    simulation
}

/// A pyramid of boxes of 1 m, so many in its lowest row, at rest on a floor; neighbours in a row do not touch.
pub fn pyramid(rows: u32, settings: Settings) -> Simulation {
    let mut simulation = Simulation::new(settings);
    let surface = Surface { static_friction: 0.6, kinetic_friction: 0.5, restitution: 0.0 };
    simulation.materials_mut().set("default", surface);
    half_plane(&mut simulation, DVec2::Y, 0.0);
    let corners = [dvec2(-0.5, -0.5), dvec2(0.5, -0.5), dvec2(0.5, 0.5), dvec2(-0.5, 0.5)];
    for row in 0..rows {
        let count = rows - row;
        for k in 0..count {
            let x = 1.5 * (f64::from(k) - 0.5 * f64::from(count - 1));
            let body = simulation.spawn(Position(dvec2(x, f64::from(row) + 0.5)));
            let square = ConvexPolygon::try_new(corners).expect("a square is convex");
            simulation.attach(body, Part::new(square, Amount::Mass(1.0)));
        }
    }
    simulation
}

/// Overlap that a pile should not show at many points: twice the slop [m].
pub const DEEP: f64 = 0.01;

/// What a pile looks like.
pub struct PileFigures {
    /// Pairs of parts that are near each other.
    pub pairs: usize,
    /// Touching points.
    pub touching: usize,
    /// Deepest overlap [m].
    pub deepest_overlap: f64,
    /// Points that overlap by more than [`DEEP`].
    pub deep: usize,
    /// Speed of the fastest body [m/s].
    pub fastest: f64,
}

/// Looks at a pile.
pub fn pile_figures(simulation: &mut Simulation) -> PileFigures {
    let tolerance = simulation.settings().touch_tolerance();
    let world = simulation.world_mut();
    let mut pairs = world.query::<(&ContactPair, &ContactManifold<Planar>)>();
    let separations: Vec<f64> = pairs
        .iter(world)
        .flat_map(|(_, manifold)| manifold.0.points().iter().map(|point| point.separation))
        .filter(|separation| *separation <= tolerance)
        .collect();
    let mut velocities = world.query::<&LinearVelocity<DVec2>>();
    let fastest = velocities.iter(world).map(|velocity| Linear::length(velocity.0)).fold(0.0, f64::max);
    PileFigures {
        pairs: pairs.iter(world).len(),
        touching: separations.len(),
        deepest_overlap: separations.iter().map(|separation| -separation).fold(0.0, f64::max),
        deep: separations.iter().filter(|separation| **separation < -DEEP).count(),
        fastest,
    }
}
