//! Bodies that hold each other up, or jam: cases E7, E8, E11, E14, E16 and E17.

use crate::support;
use crate::support::{
    G, assert_near, ball, block, body, card, every, farthest, floor, material, polygon, rigid, rough, simulation,
};
use glam::{DVec2, dvec2};
use tumble_math::{Planar, trig};
use tumble_shape::Disc;
use tumble_sim::{
    Amount, AppliedForce, Axes, BodyKind, ContactModel, Course, Lock, LockedAxes, Part, Settings, Simulation,
};

/// How far a body that stands may get [m]. Complementarity: rounding. Sweeps: a cold start ends at their cap for some steps.
fn still(settings: Settings) -> f64 {
    if settings.contact == ContactModel::Impulse { 1e-3 } else { 1e-9 }
}

/// How far one that falls gets, at least [m].
const FALLEN: f64 = 0.01;

/// Blocks of 1 × 0.25 m stacked over the edge of a table; the k-th from the top stands out by `part` of 1/(2k) over the next.
fn overhang(settings: Settings, blocks: usize, part: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(0.5, 0.5));
    block(4.0, 1.0, 1.0).at(-2.0, -0.5).kind(BodyKind::Static).spawn(&mut simulation, "table");
    let mut right = 0.0;
    for k in 0..blocks {
        right += part * 0.5 / (blocks - k) as f64;
        block(1.0, 0.25, 1.0).at(right - 0.5, 0.125 + 0.25 * k as f64).spawn(&mut simulation, &format!("block-{k}"));
    }
    simulation
}

#[test]
fn e7_overhang_stands_up_to_half_the_harmonic_sum() {
    for settings in rigid(every(0.01)) {
        for blocks in 1..=7 {
            for (part, stands) in [(0.98, true), (1.02, false)] {
                let mut simulation = overhang(settings, blocks, part);
                let way = farthest(&mut simulation, 1.0, FALLEN);
                assert!(if stands { way < still(settings) } else { way >= FALLEN }, "{blocks} blocks, {part}: {way}");
            }
        }
    }
}

/// Half the angle between two cards that lean against each other, and the radius of their edges [rad], [m].
const LEAN: (f64, f64) = (25.0 * std::f64::consts::PI / 180.0, 0.01);

/// Two cards of 1 m that lean against each other, the lower edges on a floor at a height.
fn lean_cards(simulation: &mut Simulation, x: f64, height: f64, name: &str) {
    let (sine, cosine) = trig::sin_cos(LEAN.0);
    for (side, half) in [(-1.0, "left"), (1.0, "right")] {
        let foot = dvec2(x + side * (LEAN.1 + sine), height + LEAN.1);
        let top = dvec2(x + side * LEAN.1, height + LEAN.1 + cosine);
        card(foot, top, LEAN.1, 1.0).spawn(simulation, &format!("{name}-{half}"));
    }
}

#[test]
fn e8_two_cards_hold_each_other_from_their_least_friction_on() {
    // Moments about a foot, edges of radius r: the push H of the other card has the arm L cos α + r, the weight ½ L sin α. Thin cards
    // need tan(25°)/2 = 0.233153829077.
    let (sine, cosine) = trig::sin_cos(LEAN.0);
    let least = 0.5 * sine / (cosine + LEAN.1);
    for settings in rigid(every(0.01)) {
        for (friction, holds) in [(1.01 * least, true), (0.99 * least, false)] {
            let mut simulation = simulation(settings, rough(friction, friction));
            floor(&mut simulation);
            lean_cards(&mut simulation, 0.0, 0.0, "card");
            let way = farthest(&mut simulation, 2.0, FALLEN);
            // Round-off, and the tolerance of the sweeps.
            assert!(if holds { way < 1e-9 } else { way >= FALLEN }, "μ {friction}: {way}");
        }
    }
}

#[test]
fn e14_card_house_of_three_storeys_stands() {
    let (sine, cosine) = trig::sin_cos(LEAN.0);
    let (pitch, storey) = (2.0 * sine + 5.0 * LEAN.1, cosine + 4.0 * LEAN.1);
    for settings in rigid(every(0.01)) {
        let mut simulation = simulation(settings, rough(0.7, 0.7));
        floor(&mut simulation);
        for row in 0..3 {
            let (pairs, height) = (3 - row, f64::from(row) * storey);
            for k in 0..pairs {
                let x = pitch * (f64::from(k) - 0.5 * f64::from(pairs - 1));
                lean_cards(&mut simulation, x, height, &format!("storey-{row}-{k}"));
            }
            let half = 0.5 * pitch * f64::from(pairs - 1);
            let level = height + storey - LEAN.1;
            if row < 2 {
                let ends = [-1.0, 1.0].map(|side| dvec2(side * (half + 0.2), level));
                card(ends[0], ends[1], LEAN.1, f64::from(pairs)).spawn(&mut simulation, &format!("ceiling-{row}"));
            }
        }
        let way = farthest(&mut simulation, 30.0, FALLEN);
        // Round-off, and the tolerance of the sweeps.
        assert!(way < 1e-9, "{way}");
    }
}

#[test]
fn e11_disc_stays_on_two_others_from_its_least_frictions_on() {
    // tan 15° between the discs, and a third of it under them.
    let least = [0.267949192431, 0.089316397477];
    for settings in rigid(every(0.01)) {
        for (disc, ground, holds) in [(1.02, 5.0, true), (0.98, 5.0, false), (2.0, 1.02, true), (2.0, 0.98, false)] {
            let mut simulation = simulation(settings, rough(disc * least[0], disc * least[0]));
            let earth = material(&mut simulation, "earth", ground * least[1]);
            let floor = block(10.0, 1.0, 1.0).at(0.0, -0.5).kind(BodyKind::Static);
            floor.spawn_with(&mut simulation, "ground", |part| part.material(earth));
            ball(0.5, 1.0).at(-0.5, 0.5).spawn(&mut simulation, "left");
            ball(0.5, 1.0).at(0.5, 0.5).spawn(&mut simulation, "right");
            ball(0.5, 1.0).at(0.0, 0.5 + 0.75_f64.sqrt()).spawn(&mut simulation, "top");
            let way = farthest(&mut simulation, 2.0, FALLEN);
            // Round-off, and the tolerance of the sweeps.
            assert!(if holds { way < 1e-9 } else { way >= FALLEN }, "{disc}, {ground}: {way}");
        }
    }
}

/// A wedge of 30° and 1 kg under a block of 10 kg that only moves up and down, and a push on the wedge's thick end.
fn wedge(settings: Settings, friction: f64, push: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    floor(&mut simulation);
    let slope = trig::tan(30.0_f64.to_radians());
    let wedge = polygon(&[dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, slope)]).mass(1.0);
    let wedge = wedge.spawn(&mut simulation, "wedge");
    let block = polygon(&[dvec2(0.3, 0.3 * slope), dvec2(0.7, 0.7 * slope), dvec2(0.7, 1.0), dvec2(0.3, 1.0)]);
    let block = block.mass(10.0).spawn(&mut simulation, "block");
    simulation
        .world_mut()
        .entity_mut(block)
        .insert(LockedAxes { translation: dvec2(1.0, 0.0), rotation: Lock::Locked });
    simulation.spawn(AppliedForce::<Planar> {
        body: wedge,
        point: DVec2::ZERO,
        force: dvec2(-push, 0.0),
        torque: 0.0,
        axes: Axes::World,
        course: Course::default(),
    });
    simulation
}

#[test]
fn e16_wedge_under_a_block_holds_or_is_squeezed_out() {
    // The block presses the wedge out with W tan(α − φ), φ = atan μ; the floor holds it with μ (W + w): it holds from
    // 1.1 tan α μ² + 2.1 μ = tan α on.
    let slope = trig::tan(30.0_f64.to_radians());
    let least = ((2.1_f64 * 2.1 + 4.4 * slope * slope).sqrt() - 2.1) / (2.2 * slope);
    for settings in rigid(every(0.01)) {
        for friction in [1.001 * least, 0.999 * least, 0.1] {
            let mut simulation = wedge(settings, friction, 0.0);
            simulation.run_for(0.2).unwrap();
            let speed = body(&simulation, "wedge").velocity().x;
            // While it slides by x the block sinks by x tan α: a (w + W tan α (s − μ)) = g (W (s − μ) − μ w) with s = tan(α − φ).
            let pressed = trig::tan(30.0_f64.to_radians() - trig::atan(friction)) - friction;
            let acceleration = G * (10.0 * pressed - friction) / (1.0 + 10.0 * slope * pressed);
            // Constant forces, exact for symplectic Euler: twenty steps of round-off, and the tolerance of the sweeps.
            assert_near(speed, 0.2 * acceleration.max(0.0), 1e-9);
            assert_near(body(&simulation, "block").velocity().y, -slope * speed, 1e-9);
        }
    }
}

#[test]
fn e16_wedge_is_driven_in_from_its_least_push_on() {
    // Both frictions turned round: W tan(α + φ) + μ (W + w).
    let friction = 0.3;
    let least = G * (10.0 * trig::tan(30.0_f64.to_radians() + trig::atan(friction)) + friction * 11.0);
    for settings in rigid(every(0.01)) {
        for (push, moves) in [(0.999 * least, false), (1.001 * least, true)] {
            let mut simulation = wedge(settings, friction, push);
            simulation.run_for(0.5).unwrap();
            let speed = body(&simulation, "wedge").velocity().x;
            // A thousandth of the push, 0.137 N, on a wedge that also lifts the block: 7.7 mm/s in 0.5 s.
            assert!(if moves { speed < -1e-3 } else { speed.abs() < 1e-9 }, "{push}: {speed}");
        }
    }
}

/// A bracket on a pole: two pads 0.4 m apart in height on both sides of it, 10 kg at a distance from its axis, and a torque.
fn bracket(settings: Settings, friction: f64, load: f64, torque: f64) -> Simulation {
    let mut simulation = simulation(settings, rough(friction, friction));
    block(0.1, 8.0, 1.0).kind(BodyKind::Static).spawn(&mut simulation, "pole");
    let bracket = block(0.1, 0.1, 10.0).at(load, 0.0).spawn(&mut simulation, "bracket");
    for side in [-1.0, 1.0] {
        let pad = Disc::try_new(dvec2(0.1 * side - load, -0.2 * side), 0.05).unwrap();
        simulation.attach(bracket, Part::new(pad, Amount::Mass(1e-9)));
    }
    simulation.spawn(AppliedForce::<Planar> {
        body: bracket,
        point: DVec2::ZERO,
        force: DVec2::ZERO,
        torque,
        axes: Axes::World,
        course: Course::default(),
    });
    simulation
}

#[test]
fn e17_tilted_bracket_jams_on_its_pole_from_half_its_height_over_friction_on() {
    // Pads h apart in height press with N h = W x + T, and hold up to 2 μ N.
    let (friction, torque, weight) = (0.5, 1.0, 10.0 * G);
    let least = 0.4 / (2.0 * friction) - torque / weight;
    for settings in rigid(every(0.01)) {
        for (part, jams) in [(1.01, true), (0.99, false)] {
            let mut simulation = bracket(settings, friction, part * least, -torque);
            simulation.run_for(0.5).unwrap();
            let speed = body(&simulation, "bracket").velocity().y;
            // Sliding, moments about its centre: N (h − 2 μ x) = T.
            let press = torque / (0.4 - 2.0 * friction * part * least);
            let expected = if jams { 0.0 } else { -0.5 * (G - 2.0 * friction * press / 10.0) };
            // Constant forces: round-off and the tolerance of the sweeps, which the near jam magnifies a hundredfold. The pads weigh 2e-10
            // of the bracket.
            assert_near(speed, expected, 5e-8);
        }
    }
}

#[test]
fn e17_whether_an_untilted_bracket_jams_is_open_and_resting_contact_says_so() {
    // Without a torque both falling freely and hanging satisfy all conditions, where it can hang. The smallest forces are none.
    for settings in rigid(every(0.01)) {
        for (part, open) in [(1.001, true), (0.999, false)] {
            let mut simulation = bracket(settings, 0.5, part * 0.4, 0.0);
            simulation.run_for(0.5).unwrap();
            assert_near(body(&simulation, "bracket").velocity().y, -0.5 * G, 1e-9);
            let ambiguous = simulation.notices().ambiguous_steps().is_some();
            assert_eq!(ambiguous, open && settings.contact == ContactModel::RestingLcp);
        }
    }
}

#[test]
fn e7_e8_known_limit_penalty_gives_way_before_the_threshold() {
    let settings = support::under(ContactModel::Penalty, every(1e-3));
    // Blocks tilt on their springs and so stand out further: four fall at 0.9 of the step that rigid ones bear, and stand at 0.8.
    for (part, stands) in [(0.8, true), (0.9, false)] {
        let way = farthest(&mut overhang(settings, 4, part), 2.0, 0.5);
        assert_eq!(way < 0.5, stands, "{part}: {way}");
    }
    // Cards hold each other, but creep down: their centres by 4.5 mm/s (measured), for both frictions.
    for friction in [0.26, 0.4] {
        let mut simulation = simulation(settings, rough(friction, friction));
        floor(&mut simulation);
        lean_cards(&mut simulation, 0.0, 0.0, "card");
        simulation.run_for(1.0).unwrap();
        assert_near(farthest(&mut simulation, 1.0, 0.5), 4.5e-3, 1e-4);
    }
}
