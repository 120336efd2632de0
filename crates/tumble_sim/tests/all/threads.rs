//! However many threads share a step, and in whatever order bodies are spawned: the same bits.

use crate::support::{block, body, every, floor, rod, rough, simulation, under};
use tumble_sim::{ContactModel, Simulation};

const ROWS: u32 = 56;

/// A pyramid of boxes with rods falling on it: more than four thousand contacts, so that threads share all that they can.
fn pyramid(threads: usize, order: impl Fn(&mut Vec<(f64, f64, u64)>)) -> Simulation {
    let mut simulation = simulation(under(ContactModel::SoftStep, every(1.0 / 60.0)), rough(0.6, 0.5));
    simulation.set_threads(threads).unwrap();
    floor(&mut simulation);
    let mut places = Vec::new();
    for row in 0..ROWS {
        for k in row..ROWS {
            let (x, y) = (f64::from(2 * k - row) * 0.5, f64::from(row) + 0.5);
            places.push((x, y, 100 + places.len() as u64));
        }
    }
    order(&mut places);
    for (x, y, id) in places {
        block(1.0, 1.0, 1.0).at(x, y).id(id).spawn(&mut simulation, &format!("box-{id}"));
    }
    for k in 0..20_u64 {
        let x = 1.4 * k as f64;
        rod(1.5, 2.0)
            .at(2.0 * x, 58.0)
            .turned(0.3 * k as f64)
            .moving(0.0, -9.0)
            .id(5000 + k)
            .spawn(&mut simulation, &format!("rod-{k}"));
    }
    simulation
}

/// All bodies in the order of their names, bit by bit.
fn run(mut simulation: Simulation) -> Vec<[u64; 5]> {
    for _ in 0..50 {
        simulation.step().unwrap();
    }
    let mut names = crate::support::names(&simulation);
    names.sort();
    let of = |name: &String| {
        let body = body(&simulation, name);
        let (x, v) = (body.position(), body.velocity());
        [x.x, x.y, body.angle(), v.x, v.y].map(f64::to_bits)
    };
    names.iter().map(of).collect()
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let alone = run(pyramid(1, |_| {}));
    for threads in 2..=4 {
        assert!(run(pyramid(threads, |_| {})) == alone, "{threads} threads");
    }
}

#[test]
fn the_order_of_spawning_changes_no_bit() {
    let in_order = run(pyramid(1, |_| {}));
    assert!(run(pyramid(2, |places| places.reverse())) == in_order);
    // Every seventh first, then the rest.
    assert!(run(pyramid(3, |places| places.sort_by_key(|place| (place.2 % 7, place.2)))) == in_order);
}
