//! `tumble compare`: models and step sizes side by side.

mod support;

use support::{Bench, EXPLODING, FALLING};

/// The rows of `compare.csv` as lists of cells, the head first.
fn cells(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn every_model_runs_with_every_step() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let compared = bench.tumble(["compare", "falling.ron", "--contact", "impulse,velocity-lcp", "--dt", "0.01,0.005"]);
    let compared = compared.code(0).says("falling: 4 runs of 0.1 s").says("files in out/falling/compare: compare.csv");
    assert_eq!(bench.names("out/falling/compare"), ["compare.csv", "compare.svg"]);
    let csv = bench.read("out/falling/compare/compare.csv");
    let rows = cells(&csv);
    let head = "contact,dt,steps,expectations_met,expectations_claimed,worst_ratio,reference_error,energy_drift,\
                deepest_overlap,residual,creep,microseconds_per_step,failure";
    assert_eq!(rows[0], head.split(',').collect::<Vec<_>>());
    let keys: Vec<_> = rows[1..].iter().map(|row| row[..5].to_vec()).collect();
    let expected = [
        ["impulse", "0.01", "10", "1", "1"],
        ["impulse", "0.005", "20", "1", "1"],
        ["velocity-lcp", "0.01", "10", "1", "1"],
        ["velocity-lcp", "0.005", "20", "1", "1"],
    ];
    assert_eq!(keys, expected);
    let svg = bench.read("out/falling/compare/compare.svg");
    for label in ["impulse, 0.01 s", "velocity-lcp, 0.005 s", "total energy"] {
        assert!(svg.contains(label), "{label} is not in the picture");
    }
    assert_eq!(compared.stdout.lines().filter(|line| line.contains("1 of 1")).count(), 4 + 1, "{}", compared.stdout);
}

#[test]
fn models_are_those_for_which_something_is_claimed() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING.replace("because:", "under: [Impulse, RestingLcp], because:"));
    bench.tumble(["compare", "falling.ron", "--out", "here"]).code(0);
    let csv = bench.read("here/compare.csv");
    let models: Vec<&str> = cells(&csv)[1..].iter().map(|row| row[0]).collect();
    assert_eq!(models, ["impulse", "resting-lcp"]);
    bench.write("silent.ron", "(format: 1, duration: 0.1, bodies: [(name: \"ball\", parts: [Disc(radius: 1)])])");
    bench.tumble(["compare", "silent.ron", "--out", "here"]).code(0).says("–").says("4 runs");
}

#[test]
fn the_reference_has_a_sixteenth_of_the_smallest_step() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let arguments = ["compare", "falling.ron", "--contact", "impulse", "--dt", "0.01,0.02", "--reference", "impulse"];
    bench.tumble(arguments).code(0).says("off impulse [m]");
    let csv = bench.read("out/falling/compare/compare.csv");
    let errors: Vec<f64> = cells(&csv)[1..].iter().map(|row| row[6].parse().expect("a number")).collect();
    // Symplectic Euler falls g h t/2 too far: 10 · 0.1 · (h − 0.01/16)/2.
    for (error, step) in errors.into_iter().zip([0.01, 0.02]) {
        assert!((error - 0.5 * (step - 0.01 / 16.0)).abs() < 1e-12, "{error}");
    }
}

#[test]
fn creep_is_the_drift_of_what_should_rest() {
    let bench = Bench::new();
    let scene = r#"(
        format: 1, duration: 10, gravity: (0, 0),
        bodies: [
            (name: "slow", velocity: (0.001, 0), parts: [Disc(radius: 0.1)]),
            (name: "quick", at: (0, 5), velocity: (1, 0), parts: [Disc(radius: 0.1)]),
        ],
        expect: [AtRest(of: "slow", from: 5, speed_below: 0.01, because: "nearly")],
    )"#;
    bench.write("slow.ron", scene);
    // 1 mm/s are 0.06 m/min; a tenth of the tolerance of the speed.
    let compared = bench.tumble(["compare", "slow.ron", "--contact", "impulse"]).code(0);
    let row = compared.stdout.lines().find(|line| line.starts_with("impulse")).expect("a row").to_owned();
    assert!(row.contains(" 0.06 ") && row.contains(" 0.1 "), "{row}");
}

#[test]
fn a_model_that_fails_is_a_row_that_says_so() {
    let bench = Bench::new();
    let scene = r#"(
        format: 1, duration: 1, models: (penalty: (stiffness: 1e308)),
        bodies: [
            (name: "floor", kind: Static, parts: [HalfPlane()]),
            (name: "ball", at: (0, 0.5), parts: [Disc(radius: 0.1, mass: 1e-3)]),
        ],
    )"#;
    bench.write("stiff.ron", scene);
    let compared = bench.tumble(["compare", "stiff.ron", "--contact", "penalty,impulse"]).code(0);
    let compared = compared.says("FAILED").says("penalty: the run failed:").says("not finite");
    compared.says("Only impulse came to its end");
    assert_eq!(bench.names("out/stiff/compare"), ["compare.csv", "compare.svg"]);
    bench.write("exploding.ron", EXPLODING);
    bench.tumble(["compare", "exploding.ron"]).code(3).says("No run came to its end.");
}

#[test]
fn the_sentence_names_the_best_of_the_table() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING.replace("(0, -10)", "(0, -10), integrator: SymplecticEuler"));
    let arguments = ["compare", "falling.ron", "--contact", "impulse,penalty", "--dt", "0.01,0.001"];
    let compared = bench.tumble(arguments.iter().chain(&["--reference", "impulse"])).code(0);
    let compared = compared.says("Best for the expectations: all alike (1 of 1");
    compared.says("for being near the reference: impulse, 0.001 s and penalty, 0.001 s (");
}
