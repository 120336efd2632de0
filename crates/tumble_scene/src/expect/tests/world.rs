use super::*;

#[test]
fn rise_of_energy_is_counted_from_the_lowest_so_far() {
    let mut recording = recording();
    // Falls to 6, rises to 7: never above the start, yet a rise of 1.
    for row in &mut recording.audit[5..] {
        row.total = 6.0;
    }
    recording.audit[15].total = 7.0;
    met(&recording, "EnergyNeverRises(slack: 1.0)");
    let risen = failed(&recording, "EnergyNeverRises(slack: 0.9)");
    assert_measured(&risen, 1.0);
    assert!((risen.time.unwrap() - 1.5).abs() <= ROUNDING);
    // The lowest is the lowest *so far*: falling after a peak is no rise.
    recording.audit[15].total = 6.0;
    assert_measured(&met(&recording, "EnergyNeverRises(slack: 0.0)"), 0.0);
}

#[test]
fn kept_quantities_are_compared_with_the_start() {
    let mut recording = recording();
    recording.audit[4].total = 10.5;
    recording.audit[5].momentum = dvec2(0.3, 0.4);
    recording.audit[6].angular_momentum = -0.25;
    for (kind, difference, step) in [("EnergyKept", 0.5, 4), ("MomentumKept", 0.5, 5), ("AngularMomentumKept", 0.25, 6)]
    {
        met(&recording, &format!("{kind}(within: {difference})"));
        let failed = failed(&recording, &format!("{kind}(within: {})", 0.99 * difference));
        assert!((failed.time.unwrap() - DT * f64::from(step)).abs() <= ROUNDING);
    }
    let energy = met(&recording, "EnergyKept(within: 1.0)");
    assert_measured(&energy, 10.5);
    assert_eq!(energy.expected.unwrap().number(), Some(10.0));
}

#[test]
fn depth_is_the_deepest_of_the_window() {
    let mut recording = sampled_every(7);
    // Step 9 was not sampled, but audits are of every step.
    recording.audit[9].deepest_overlap = 0.02;
    met(&recording, "Depth(below: 0.02, always: true)");
    assert_measured(&failed(&recording, "Depth(below: 0.019)"), 0.02);
    failed(&recording, "Depth(below: 0.01, at: 0.9)");
    failed(&recording, "Depth(below: 0.01, from: 0.5, until: 0.9)");
    assert_measured(&met(&recording, "Depth(below: 0.01, at: 1.0)"), 0.0);
    met(&recording, "Depth(below: 0.01, from: 1.0)");
    met(&recording, "Depth(below: 0.01, until: 0.8)");
    let between = failed(&recording, "Depth(below: 0.01, from: 0.81, until: 0.82)");
    assert_eq!(between.obstacle, Some(NotMeasured::EmptyWindow));
}

#[test]
fn depth_of_zero_means_no_overlap_at_all() {
    let mut recording = recording();
    met(&recording, "Depth(below: 0)");
    recording.audit[9].deepest_overlap = 1e-300;
    failed(&recording, "Depth(below: 0)");
}

const ALL: [&str; 5] = [
    "EnergyNeverRises(slack: 1000)",
    "EnergyKept(within: 1000)",
    "MomentumKept(within: 1000)",
    "AngularMomentumKept(within: 1000)",
    "Depth(below: 1000)",
];

#[test]
fn not_a_number_fails_wherever_it_stands() {
    for step in [0, 7, STEPS as usize] {
        let mut recording = recording();
        let row = &mut recording.audit[step];
        (row.total, row.momentum, row.angular_momentum) = (f64::NAN, DVec2::NAN, f64::NAN);
        row.deepest_overlap = f64::NAN;
        for expectation in ALL {
            failed(&recording, expectation);
        }
    }
}

#[test]
fn missing_audits_and_early_ends_have_failed() {
    let (mut without, mut torn) = (recording(), recording());
    without.audit.clear();
    torn.audit.pop();
    for expectation in ALL.into_iter().chain(["Depth(below: 1000, at: 2.0)"]) {
        assert_eq!(failed(&without, expectation).obstacle, Some(NotMeasured::NoAudit));
        assert_eq!(failed(&torn, expectation).obstacle, Some(NotMeasured::NoAudit));
        assert!(matches!(failed(&stopped_after(19), expectation).obstacle, Some(NotMeasured::NotReached { .. })));
        met(&recording(), expectation);
    }
}
