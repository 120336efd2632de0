use super::*;

#[test]
fn each_outcome_is_one_line() {
    let mut recording = recording();
    recording.samples[20].states[BOX].as_mut().unwrap().velocity.x = 5.6693;
    recording.audit[7].total = 10.000_000_1;
    recording.audit[8].deepest_overlap = 0.005_000_000_1;
    recording.touches.push(touch(5, BOX, FLOOR, TouchPhase::Begin));
    let verdict = verdict(
        &recording,
        r#"
        Speed(of: "box", at: 2.0, is: 6.94, within: 0.02, because: "g (sin θ − μ cos θ) t"),
        Position(of: "box", at: 0.34, is: (1, -1.2), within: 0.01),
        X(of: "crate", always: true, above: 0.5, below: 1.5, because: "they stand"),
        Angle(of: "box", from: 0.5, until: 1.0, is_degrees: 30, within_degrees: 30),
        Y(of: "box", at: 3.0, above: 0.0),
        VelocityX(of: "crate-0", at: 1.0, is: 0.0, within: 1e-9, under: [Penalty]),
        AtRest(from: 1.0, drift_below: 0.01),
        EnergyNeverRises(slack: 1e-6),
        EnergyKept(within: 1e-9),
        MomentumKept(within: 0.1),
        Depth(below: 0.005),
        Depth(below: 0.005, at: 0.8),
        ContactForceSum(on: "box", by: "floor", from: 1.0, is: Weight, within: 0.01),
        FrictionForce(on: "box", at: 1.0, is: 3.0, within: 0.1, because: "μ m g"),
        Order(events: [Touch("box", "floor"), Part("box", "floor")]),
        Happens(event: Touch("box", "floor"), at: 0.5, within: 0.01),
        Happens(event: Touch("box", "floor"), occurrence: 2, at: 0.5, within: 0.01),
        Never(event: Touch("box", "floor")),
        Never(event: Touch("box", "crate-1")),
        Fingerprint(is: "00000000000000000000000000000000"),
        "#,
    );
    insta::assert_snapshot!(verdict, @r#"
    ok      Speed of "box" at 2 s: 6.9384 m/s, expected 6.94 ± 0.02 (g (sin θ − μ cos θ) t)
    FAILED  Position of "box" at 0.34 s: (0.9, -1.2) m at 0.3 s, expected (1, -1.2) ± 0.01
    FAILED  X of "crate" always: 2 m of "crate-1" at 0 s, expected above 0.5 and below 1.5 (they stand)
    ok      Angle of "box" from 0.5 s until 1 s: 57.296 degrees at 1 s, expected 30 ± 30
    FAILED  Y of "box" at 3 s: not reached, the recording ends at 2 s, expected above 0
    skipped VelocityX of "crate-0" at 1 s: not claimed for this contact model, expected 0 ± 1e-9
    FAILED  AtRest of every dynamic body from 1 s: 6.9384 m/s, 1 rad/s, drift 5 m of "box" at 2 s, expected below 0.001 m/s, below 0.001 rad/s, drift below 0.01 m
    ok      EnergyNeverRises: 1e-7 J at 0.7 s, expected at most 1e-6
    FAILED  EnergyKept: 10.0000001 J at 0.7 s, expected 10 ± 1e-9
    ok      MomentumKept: (0, 0) kg·m/s at 0 s, expected (0, 0) ± 0.1
    FAILED  Depth always: 0.0050000001 m at 0.8 s, expected at most 0.005
    FAILED  Depth at 0.8 s: 0.0050000001 m, expected at most 0.005
    FAILED  ContactForceSum on "box" by "floor" from 1 s: (3, 19.62) N, expected (0, 19.62) ± 0.01
    ok      FrictionForce on "box" at 1 s: 3 N, expected 3 ± 0.1 (μ m g)
    FAILED  Order of Touch("box", "floor"), Part("box", "floor"): 0.5 s, never, expected in this order
    ok      Happens Touch("box", "floor"): 0.5 s, expected 0.5 ± 0.01
    FAILED  Happens Touch("box", "floor") number 2: not reached, it happened only 1×, expected 0.5 ± 0.01
    FAILED  Never Touch("box", "floor"): 0.5 s, expected never
    ok      Never Touch("box", "crate-1"): never, expected never
    FAILED  Fingerprint: 5e08455c060af830ed42fde143405020, expected 00000000000000000000000000000000
    "#);
}
