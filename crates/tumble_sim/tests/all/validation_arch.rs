//! A masonry arch of wedge-shaped stones: cases E12, E13 and E14, by stepping. E12 for many stones is in `validation_arch_forces.rs`.

use crate::support::{direction, every, farthest, floor, polygon, rigid, rough, simulation};
use tumble_sim::{ContactModel, Settings, Simulation};

/// A semicircular arch of mean radius 1 m with radial joints on a floor.
fn arch(settings: Settings, stones: usize, thickness: f64, friction: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    floor(&mut simulation);
    let corner = |radius: f64, k: usize| radius * direction(std::f64::consts::PI * k as f64 / stones as f64);
    let [inner, outer] = [1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness];
    for k in 0..stones {
        let corners = [corner(inner, k), corner(outer, k), corner(outer, k + 1), corner(inner, k + 1)];
        polygon(&corners).mass(1.0).spawn(&mut simulation, &format!("stone-{k:02}"));
    }
    simulation
}

/// How far a stone of an arch that stands may get [m]. Complementarity: rounding. Sweeps: a cold start ends at their cap for some steps.
fn still(settings: Settings) -> f64 {
    if settings.contact == ContactModel::Impulse { 1e-3 } else { 1e-9 }
}

/// Friction enough for any of the arches [1].
const AMPLE: f64 = 0.8;

/// How far a stone of an arch that falls gets, at least [m].
const FALLEN: f64 = 2e-3;

#[test]
fn e12_arch_of_few_stones_stands_from_its_least_thickness_on() {
    for settings in rigid(every(0.005)) {
        for (stones, least) in [(5, 0.0949796), (7, 0.0957034)] {
            for (part, stands) in [(1.02, true), (0.98, false)] {
                let way = farthest(&mut arch(settings, stones, part * least, AMPLE), 1.0, FALLEN);
                assert!(if stands { way < still(settings) } else { way >= FALLEN }, "{stones} stones, {part}: {way}");
            }
        }
    }
}

#[test]
fn e13_arch_of_ample_thickness_stands_from_its_least_friction_on() {
    for settings in rigid(every(0.005)) {
        for (stones, least) in [(7, 0.299827), (9, 0.308988)] {
            for (part, stands) in [(1.03, true), (0.97, false)] {
                let way = farthest(&mut arch(settings, stones, 0.2, part * least), 1.0, FALLEN);
                assert!(if stands { way < still(settings) } else { way >= FALLEN }, "{stones} stones, {part}: {way}");
            }
        }
    }
}

#[test]
fn e14_arch_of_seventeen_stones_stands() {
    for settings in rigid(every(0.01)) {
        let mut arch = arch(settings, 17, 0.2, 0.6);
        let way = farthest(&mut arch, 10.0, FALLEN);
        assert!(way < still(settings), "{way}");
    }
}
