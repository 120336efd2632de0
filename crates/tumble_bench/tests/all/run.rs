//! Runs of an engine made for the purpose, whose end is known.

use glam::{DVec2, dvec2};
use tumble_bench::run::{Run, run};
use tumble_bench::{Body, BodyState, Engine, Kind, Plan, PlanarShape};
use tumble_math::{Planar, Pose};
use tumble_record::FingerprintHasher;

/// Moves every dynamic body upwards, 0.25 m each step at 2 m/s.
struct Lift(Vec<(Kind, BodyState<Planar>)>);

impl Lift {
    fn new(plan: &Plan<Planar>) -> Result<Self, String> {
        let state = |pose: Pose<Planar>| BodyState { pose, velocity: DVec2::ZERO, angular_velocity: 0.0 };
        Ok(Self(plan.bodies.iter().map(|body| (body.kind, state(body.pose))).collect()))
    }
}

impl Engine<Planar> for Lift {
    type Error = String;

    fn step(&mut self) -> Result<(), String> {
        for (_, state) in self.0.iter_mut().filter(|(kind, _)| *kind == Kind::Dynamic) {
            state.pose.position.y += 0.25;
            state.velocity.y = 2.0;
        }
        if self.0[1].1.pose.position.y > 100.0 { Err("out of the world".to_owned()) } else { Ok(()) }
    }

    fn states(&self) -> Vec<BodyState<Planar>> {
        self.0.iter().map(|(_, state)| *state).collect()
    }
}

const NOTHING: Run<'_> = Run { engine: "lift", version: "1", threads: 3, steps: Some(4), held_bytes: || 0 };

fn plan() -> Plan<Planar> {
    let block = |kind, x, y| Body::simple(kind, dvec2(x, y), PlanarShape::block(0.5, 0.25));
    Plan::new(
        "by hand",
        8,
        vec![block(Kind::Static, 0.0, 2.0), block(Kind::Dynamic, 0.0, 0.7), block(Kind::Dynamic, 5.0, 0.5)],
    )
}

#[test]
fn a_run_tells_what_became_of_the_bodies() {
    let line = run(&plan(), &NOTHING, Lift::new).expect("the bodies stay low");
    assert_eq!((line.scene.as_str(), line.bodies, line.threads, line.steps), ("by hand", 3, 3, 4));
    assert_eq!(line.top_drift, 1.0, "four steps of a quarter, both exact in binary");
    assert_eq!(line.kinetic_energy, 2.0, "two bodies of half a kilogram at 2 m/s");
    assert_eq!(line.contacts, 1);
    // Tops and bottoms are sums of decimal fractions: 1.7 + 0.25 above 2 − 0.25.
    assert!((line.max_overlap - 0.2).abs() < 1e-15);
    assert!(line.ms_median <= line.ms_p95 && line.ms_mean > 0.0);
    assert_eq!(line.bytes_per_contact, Some(0.0));
}

#[test]
fn a_run_of_no_given_length_takes_the_steps_of_its_plan() {
    let line = run(&plan(), &Run { steps: None, ..NOTHING }, Lift::new).expect("the bodies stay low");
    assert_eq!((line.steps, line.top_drift), (8, 2.0));
}

#[test]
fn an_engine_that_gives_up_ends_the_run() {
    let steps = Some(1000);
    assert_eq!(run(&plan(), &Run { steps, ..NOTHING }, Lift::new), Err("out of the world".to_owned()));
}

#[test]
fn fingerprints_are_made_as_those_of_recordings_are() {
    let line = run(&plan(), &NOTHING, Lift::new).expect("the bodies stay low");
    let mut hasher = FingerprintHasher::new(4);
    for (id, [x, y, speed]) in [[0.0, 2.0, 0.0], [0.0, 1.7, 2.0], [5.0, 1.5, 2.0]].into_iter().enumerate() {
        hasher.body(id as u64, &[x, y, 0.0, 0.0, speed, 0.0]);
    }
    assert_eq!(line.fingerprint, hasher.finish().0);
}
