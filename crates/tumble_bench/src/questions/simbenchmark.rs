//! Four tests of SimBenchmark with our rows beside the published ones.
//!
//! Set-ups and measures are those of its sources (leggedrobotics/SimBenchmark; Kang and Hwangbo 2018), the numbers of other engines those of the sample
//! data in its repository: engines of about 2018, with position correction off. Measures are means of squares over the steps, taken before each.
//! Random numbers are our own, so the two tests of 216 spheres begin within a millimetre of theirs.

use std::error::Error;

use bevy_ecs::entity::Entity;
use glam::{DVec3, dvec3};
use tumble_math::Spatial;
use tumble_scene::format::{ContactModel, Integrator, Scene};
use tumble_scene::shipped::Shipped;
use tumble_scene::{AnyLoaded, FromScene, Loaded};
use tumble_sim::{BodyKind, BodyTable, Position, Simulation};

const G: f64 = 9.81;

/// A test of SimBenchmark.
struct Test {
    /// What is measured, with its unit.
    title: &'static str,
    /// The shipped scene.
    scene: &'static str,
    /// Simulated time [s].
    duration: f64,
    /// What heads each column of figures.
    columns: &'static [&'static str],
    /// Time step of each column [s], and the direction of the scene's force, if it has one.
    runs: &'static [(f64, Option<DVec3>)],
    ways: &'static [Way],
    /// Names and figures of other engines.
    published: &'static [(&'static str, &'static [f64])],
    measure: fn(&Bodies, f64) -> f64,
}

/// How we answer a test.
struct Way {
    name: &'static str,
    contact: ContactModel,
    integrator: Integrator,
    cut: bool,
}

const fn euler(name: &'static str, contact: ContactModel) -> Way {
    Way { name, contact, integrator: Integrator::SymplecticEuler, cut: false }
}

const fn ballistic(name: &'static str, contact: ContactModel) -> Way {
    Way { name, contact, integrator: Integrator::Ballistic, cut: false }
}

const fn cut(name: &'static str, contact: ContactModel) -> Way {
    Way { name, contact, integrator: Integrator::Ballistic, cut: true }
}

const PLAIN: [Way; 4] = [
    euler("tumble impulse", ContactModel::Impulse),
    euler("tumble resting-lcp", ContactModel::RestingLcp),
    euler("tumble velocity-lcp", ContactModel::VelocityLcp),
    euler("tumble penalty", ContactModel::Penalty),
];

const ELASTIC: [Way; 9] = [
    cut("tumble impulse, cut at impacts", ContactModel::Impulse),
    cut("tumble resting-lcp, cut at impacts", ContactModel::RestingLcp),
    cut("tumble velocity-lcp, cut at impacts", ContactModel::VelocityLcp),
    ballistic("tumble impulse, ballistic", ContactModel::Impulse),
    ballistic("tumble resting-lcp, ballistic", ContactModel::RestingLcp),
    ballistic("tumble velocity-lcp, ballistic", ContactModel::VelocityLcp),
    euler("tumble impulse", ContactModel::Impulse),
    euler("tumble velocity-lcp", ContactModel::VelocityLcp),
    euler("tumble penalty", ContactModel::Penalty),
];

const STEPS: [&str; 3] = ["h = 1e-4 s", "h = 1e-3 s", "h = 1e-2 s"];
const STEP_RUNS: [(f64, Option<DVec3>); 3] = [(1e-4, None), (1e-3, None), (1e-2, None)];

const ALONG: DVec3 = DVec3::Z;
const ASKEW: DVec3 = dvec3(0.5, 0.0, 0.866_025_403_784_438_6);

const TESTS: [Test; 4] = [
    Test {
        title: "rolling: mean of |Δv_ball|² + |Δv_box|² [m²/s²], h = 1e-3 s, 4 s",
        scene: "pulled_board",
        duration: 4.0,
        columns: &["force along an axis", "force at 60°"],
        runs: &[(1e-3, Some(ALONG)), (1e-3, Some(ASKEW))],
        ways: &PLAIN,
        published: &[
            ("Bullet, sequential impulse, ≥ 400 iterations", &[7.3e-28, 3.9e-27]),
            ("ODE quick", &[7.6e-9, 3.14497]),
            ("RaiSim, bisection", &[4.08e-7, 4.09e-7]),
            ("Bullet, 10 iterations", &[8.6e-7, 1.7e-6]),
            ("MuJoCo Newton, RK4", &[3.2e-3, 2.6e-3]),
            ("MuJoCo Newton, Euler", &[9.2e-3, 7.1e-3]),
            ("DART Dantzig", &[0.426, 3.14497]),
        ],
        measure: rolling_error,
    },
    Test {
        title: "bouncing: mean squared energy error [J²] of 24034.5 J, 20 s",
        scene: "bouncing_49",
        duration: 20.0,
        columns: &STEPS,
        runs: &STEP_RUNS,
        ways: &ELASTIC,
        published: &[
            ("RaiSim", &[1.86e-6, 1.86e-2, 186.0]),
            ("ODE, both solvers", &[1.85, 185.0, 1.88e4]),
            ("DART", &[483.0, 7.23e4, 7.38e6]),
            ("Bullet", &[752.0, 7.52e4, 7.41e6]),
        ],
        measure: energy_error,
    },
    Test {
        title: "666: mean of the summed squared overlaps [m²], 10 s",
        scene: "spheres_666",
        duration: 10.0,
        columns: &STEPS,
        runs: &STEP_RUNS,
        ways: &PLAIN,
        published: &[
            ("DART Dantzig", &[1.98e-7, 2.82e-4, 215.0]),
            ("ODE Dantzig", &[1.55e-6, 1.55e-4, 1.61e-2]),
            ("ODE quick", &[1.59e-6, 1.57e-4, 1.62e-2]),
            ("RaiSim", &[1.64e-6, 1.35e-4, 1.53e-2]),
            ("Bullet", &[3.53e-3, 0.382, 37.4]),
            ("MuJoCo Newton", &[1.13e-2, 9.50e-2, 0.934]),
            ("DART PGS", &[f64::INFINITY, f64::INFINITY, f64::INFINITY]),
        ],
        measure: squared_overlaps,
    },
    Test {
        title: "elastic 666: mean squared energy error [J²] of 3.45e4 J, 10 s",
        scene: "elastic_666",
        duration: 10.0,
        columns: &STEPS,
        runs: &STEP_RUNS,
        ways: &ELASTIC,
        published: &[
            ("RaiSim", &[1.10e-3, 8.37, 5.18e6]),
            ("ODE Dantzig", &[1.10, 112.0, 8.56e6]),
            ("Bullet", &[168.0, 4.15e4, 9.86e6]),
            ("DART PGS", &[2.41e3, 3.46e5, f64::NAN]),
            ("DART Dantzig", &[2.44e3, 3.47e5, 1.29e10]),
        ],
        measure: energy_error,
    },
];

/// Prints the four tables, or those whose scene is named, with steps no smaller than `smallest` [s].
pub fn simbenchmark(only: Option<&str>, smallest: f64) -> Result<(), Box<dyn Error>> {
    for test in TESTS.iter().filter(|test| only.is_none_or(|only| only == test.scene)) {
        println!("{}", test.title);
        println!("{:44} {}", "", test.columns.iter().map(|head| format!("{head:>20}")).collect::<String>());
        let AnyLoaded::Spatial(loaded) = Shipped::named(test.scene).ok_or("no such scene")?.load_any()? else {
            return Err("a scene of space was expected".into());
        };
        for way in test.ways {
            print!("{:44} ", way.name);
            for (dt, force) in test.runs {
                print!(
                    "{:>20}",
                    if *dt < smallest { "–".to_owned() } else { figure(run(test, &loaded, way, *dt, *force)) }
                );
                std::io::Write::flush(&mut std::io::stdout())?;
            }
            println!();
        }
        for (name, figures) in test.published {
            println!("{name:44} {}", figures.iter().map(|f| format!("{:>20}", figure(Ok(*f)))).collect::<String>());
        }
        println!();
    }
    Ok(())
}

fn figure(measured: Result<f64, Box<dyn Error>>) -> String {
    match measured {
        Ok(measured) => format!("{measured:.2e}"),
        Err(_) => "stopped".to_owned(),
    }
}

/// The mean of a test's measure over a run.
fn run(test: &Test, loaded: &Loaded<Spatial>, way: &Way, dt: f64, force: Option<DVec3>) -> Result<f64, Box<dyn Error>> {
    let mut loaded = loaded.clone();
    let scene: &mut Scene<Spatial> = &mut loaded.scene;
    (scene.dt, scene.contact, scene.integrator, scene.time_of_impact) = (dt, way.contact, way.integrator, way.cut);
    if let Some(direction) = force {
        scene.forces.iter_mut().for_each(|entry| entry.force = direction * 150.0);
    }
    let mut simulation = Simulation::from_loaded(&loaded)?;
    simulation.prepare()?;
    let entities = simulation.world().resource::<BodyTable>().entries().iter().map(|entry| entry.entity).collect();
    let mut bodies = Bodies { entities, simulation, along: force.unwrap_or(DVec3::ZERO), start: 0.0 };
    bodies.start = bodies.energy();
    let steps = (test.duration / dt).round() as u64;
    let mut sum = 0.0;
    for step in 0..steps {
        sum += (test.measure)(&bodies, step as f64 * dt);
        bodies.simulation.step()?;
    }
    Ok(sum / steps as f64)
}

/// What the measures look at.
struct Bodies {
    simulation: Simulation<Spatial>,
    entities: Vec<Entity>,
    /// Direction of the pull.
    along: DVec3,
    /// Energy at the start [J].
    start: f64,
}

impl Bodies {
    /// Centres of the bodies that move [m].
    fn centres(&self) -> Vec<DVec3> {
        let body = |entity: &Entity| self.simulation.world().entity(*entity);
        let moves = self.entities.iter().map(body).filter(|body| body.get::<BodyKind>() == Some(&BodyKind::Dynamic));
        moves.filter_map(|body| body.get::<Position<DVec3>>()).map(|position| position.0).collect()
    }

    /// Kinetic and potential energy of all bodies [J].
    fn energy(&self) -> f64 {
        let table = self.simulation.world().resource::<BodyTable>();
        let bodies = table.entries().iter().filter_map(|entry| self.simulation.body(&entry.name).ok());
        bodies.map(|body| body.kinetic_energy() + body.mass() * G * body.position().y).sum()
    }
}

/// |Δv_ball|² + |Δv_box|² of the first ball, against the closed form of validation D9.
fn rolling_error(bodies: &Bodies, time: f64) -> f64 {
    let velocity = |name: &str| bodies.simulation.body(name).map_or(DVec3::NAN, |body| body.velocity());
    let ball = velocity("ball-0-0-0") - bodies.along * (0.211 * time);
    let board = velocity("board") - bodies.along * (0.7385 * time);
    ball.length_squared() + board.length_squared()
}

fn energy_error(bodies: &Bodies, _: f64) -> f64 {
    let error = bodies.energy() - bodies.start;
    error * error
}

/// Squared overlaps of all spheres with each other and with the floor, summed.
fn squared_overlaps(bodies: &Bodies, _: f64) -> f64 {
    const RADIUS: f64 = 0.1;
    let centres = bodies.centres();
    let mut sum = 0.0;
    for (i, one) in centres.iter().enumerate() {
        let into_floor = (RADIUS - one.y).max(0.0);
        sum += into_floor * into_floor;
        for other in &centres[i + 1..] {
            let apart = (*one - *other).length_squared();
            if apart < 4.0 * RADIUS * RADIUS {
                let overlap = 2.0 * RADIUS - apart.sqrt();
                sum += overlap * overlap;
            }
        }
    }
    sum
}
