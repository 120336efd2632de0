//! Prints how long the velocity filter takes, for each solver: cold, and warm as in a steady step.
//!
//! `cargo run --release -p tumble_solver --example velocity_cost`

#[path = "../tests/all/common/mod.rs"]
#[allow(dead_code, reason = "an example uses a part of it")]
mod common;

use std::time::Instant;

use common::{Body, Row, accelerate, pyramid, stack, surface};
use glam::dvec2;
use tumble_solver::filter::{FilterSettings, filter_velocities};
use tumble_solver::velocity_lcp::{VelocityLcp, VelocitySettings, VelocitySolver};

fn main() {
    println!(
        "scene, contacts, method: cold µs, warm µs, residual [m/s], islands (known, pivoted, swept, newton), iterations warm"
    );
    let scenes: [(&str, (Vec<Body>, Vec<Row>)); 7] = [
        ("box on floor", stack(1, surface(0.6, 0.0))),
        ("stack of 5", stack(5, surface(0.6, 0.0))),
        ("stack of 10", stack(10, surface(0.6, 0.0))),
        ("stack of 20", stack(20, surface(0.6, 0.0))),
        ("pyramid of 5 rows", pyramid(5, surface(0.6, 0.0))),
        ("pyramid of 10 rows", pyramid(10, surface(0.6, 0.0))),
        ("pyramid of 20 rows", pyramid(20, surface(0.6, 0.0))),
    ];
    for (name, (bodies, rows)) in scenes {
        for solver in
            [VelocitySolver::Auto, VelocitySolver::Pivoting, VelocitySolver::BlockGaussSeidel, VelocitySolver::Newton]
        {
            if rows.len() > 130 && matches!(solver, VelocitySolver::Pivoting | VelocitySolver::Newton) {
                continue;
            }
            measure(name, &bodies, &rows, solver);
        }
        sweeps(name, &bodies, &rows);
    }
}

/// One step's pull.
fn pulled(bodies: &[Body]) -> Vec<Body> {
    let mut bodies = bodies.to_vec();
    accelerate(&mut bodies, dvec2(0.0, -9.81e-3));
    bodies
}

fn repeats(rows: &[Row]) -> u32 {
    (2000 / rows.len() as u32).clamp(1, 300)
}

fn measure(name: &str, bodies: &[Body], rows: &[Row], solver: VelocitySolver) {
    let settings = VelocitySettings { solver, ..VelocitySettings::default() };
    let mut model = VelocityLcp::default();
    let mut solved = rows.to_vec();
    let count = repeats(rows);
    let start = Instant::now();
    for _ in 0..count {
        solved.copy_from_slice(rows);
        model.filter(&mut pulled(bodies), &mut solved, None, &settings);
    }
    let cold = start.elapsed().as_secs_f64() / f64::from(count);
    let start = Instant::now();
    let mut report = Default::default();
    for _ in 0..count {
        report = model.filter(&mut pulled(bodies), &mut solved, None, &settings);
    }
    let warm = start.elapsed().as_secs_f64() / f64::from(count);
    let counts = (report.known, report.pivoted, report.swept, report.newton);
    println!(
        "{name}, {}, {solver:?}: {:.1}, {:.1}, {:.1e}, {counts:?}, {}",
        rows.len(),
        1e6 * cold,
        1e6 * warm,
        report.residual,
        report.iterations
    );
}

fn sweeps(name: &str, bodies: &[Body], rows: &[Row]) {
    let settings = FilterSettings { iterations: 500, tolerance: 1e-12 };
    let mut solved = rows.to_vec();
    let mut scratch = Vec::new();
    let count = repeats(rows);
    let start = Instant::now();
    for _ in 0..count {
        solved.copy_from_slice(rows);
        filter_velocities(&mut pulled(bodies), &mut solved, &mut scratch, &settings);
    }
    let cold = start.elapsed().as_secs_f64() / f64::from(count);
    let start = Instant::now();
    let mut report = Default::default();
    for _ in 0..count {
        report = filter_velocities(&mut pulled(bodies), &mut solved, &mut scratch, &settings);
    }
    let warm = start.elapsed().as_secs_f64() / f64::from(count);
    println!(
        "{name}, {}, accumulated impulses: {:.1}, {:.1}, {:.1e}, {:?}, {}",
        rows.len(),
        1e6 * cold,
        1e6 * warm,
        report.residual,
        report.ending,
        report.iterations
    );
}
