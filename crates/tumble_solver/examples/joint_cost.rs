//! Prints how long joints and resting contact take: a chain of rods, and boxes at rest.
//!
//! `cargo run --release -p tumble_solver --example joint_cost`

#[path = "../tests/all/common/mod.rs"]
#[allow(dead_code, reason = "an example uses a part of it")]
mod common;

use std::time::Instant;

use common::{Body, FLOOR, body, stack, surface};
use glam::{DVec2, dvec2};
use tumble_math::Planar;
use tumble_solver::joint::{JointBlock, JointEnds, JointRow, revolute};
use tumble_solver::resting_lcp::{Acceleration, Gap, NormalCarrier, RestingLcp, RestingSettings};

fn main() {
    for rods in [2, 10, 40, 200] {
        let (bodies, rows) = chain(rods);
        let mut block = JointBlock::default();
        let prepare = time(|| block.prepare(&bodies, &rows));
        let mut residual = 0.0;
        let stop = time(|| {
            let (mut bodies, mut rows) = (bodies.clone(), rows.clone());
            residual = block.stop(&mut bodies, &mut rows).residual;
        });
        println!("chain of {rods} rods: prepare {prepare:.1} µs, stop {stop:.1} µs, residual {residual:.0e} m/s");
    }
    for boxes in [1, 5, 12, 25] {
        for friction in [0.0, 0.5] {
            let (bodies, rows) = stack(boxes, surface(friction, 0.0));
            let gaps: Vec<Gap<Planar>> = rows.iter().map(|row| Gap::corner(row, NormalCarrier::A)).collect();
            let mut model = RestingLcp::default();
            let mut forces = Vec::new();
            let mut report = Default::default();
            let taken = time(|| {
                let pull = Acceleration { linear: dvec2(0.0, -9.81), angular: 0.0 };
                let mut accelerations = vec![pull; bodies.len()];
                accelerations[0] = Acceleration::default();
                let (mut rows, settings) = (rows.clone(), RestingSettings::default());
                report = model.solve(&bodies, &mut accelerations, &mut rows, &gaps, &mut forces, None, &settings);
            });
            println!("resting stack of {boxes}, friction {friction}: {taken:.1} µs, {report:?}");
        }
    }
}

/// Microseconds per call.
fn time(mut call: impl FnMut()) -> f64 {
    let (start, mut calls) = (Instant::now(), 0);
    while start.elapsed().as_secs_f64() < 0.1 {
        call();
        calls += 1;
    }
    1e6 * start.elapsed().as_secs_f64() / f64::from(calls)
}

/// Rods of length 1 in a row, pinned together, in motion.
fn chain(rods: u32) -> (Vec<Body>, Vec<JointRow<Planar>>) {
    let rod =
        |i: u32| Body { velocity: dvec2(0.3 * f64::from(i), -1.0), angular_velocity: 2.0, ..body(1.0, 1.0 / 12.0) };
    let bodies: Vec<Body> = std::iter::once(FLOOR).chain((0..rods).map(rod)).collect();
    let mut rows = Vec::new();
    for i in 0..rods {
        let (centre, before) = (dvec2(f64::from(i) + 0.5, 0.0), dvec2(f64::from(i) - 0.5, 0.0));
        let a = if i == 0 { (0, DVec2::ZERO, DVec2::ZERO) } else { (i, before, dvec2(0.5, 0.0)) };
        revolute::push_rows(&JointEnds::at(a, (i + 1, centre, dvec2(-0.5, 0.0))), &bodies, &mut rows);
    }
    (bodies, rows)
}
