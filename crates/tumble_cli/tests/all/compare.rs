//! `tumble compare`: models and step sizes side by side.

use crate::support::{Bench, EXPLODING, FALLING};

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
    for label in ["impulse at 0.01 s", "velocity-lcp at 0.005 s", "total energy"] {
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
    bench.tumble(["compare", "silent.ron", "--out", "here"]).code(0).says("–").says("5 runs");
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
    compared.says("for being near the reference: impulse at 0.001 s and penalty at 0.001 s (");
}

#[test]
fn one_run_alone_is_not_compared() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let compared = bench.tumble(["compare", "falling.ron", "--contact", "impulse"]).code(0);
    compared.says("One run alone: there is nothing to compare.");
}

/// A ball on a floor, about which nothing is promised.
const SILENT: &str = r#"(
    format: 1, duration: 0.2,
    bodies: [
        (name: "floor", kind: Static, parts: [HalfPlane()]),
        (name: "ball", at: (0, 0.5), parts: [Disc(radius: 0.1)]),
    ],
)"#;

#[test]
fn without_expectations_the_scenes_own_model_is_the_measure() {
    let bench = Bench::new();
    bench.write("silent.ron", SILENT.replace("duration", "contact: VelocityLcp, dt: 0.01, duration"));
    let compared = bench.tumble(["compare", "silent.ron", "--contact", "impulse,penalty"]).code(0);
    compared
        .says("off velocity-lcp [m]")
        .says("nothing is expected, so errors are distances from velocity-lcp with steps of 0.000625 s")
        .says("Best for being near the reference: ");
    // Symplectic Euler falls g h t/2 too far: 9.81 · 0.2 · (0.01 − 0.000625)/2.
    let csv = bench.read("out/silent/compare/compare.csv");
    let errors: Vec<f64> = cells(&csv)[1..].iter().map(|row| row[6].parse().expect("a number")).collect();
    assert!(errors.iter().all(|error| (error - 0.009196875).abs() < 1e-12), "{errors:?}");
    // Asked for, the reference is no surprise; with expectations there is none.
    let asked = bench.tumble(["compare", "silent.ron", "--contact", "impulse,penalty", "--reference", "impulse"]);
    asked.code(0).says("\nerrors are distances from impulse with steps of 0.000625 s");
    bench.write("falling.ron", FALLING);
    let compared = bench.tumble(["compare", "falling.ron"]).code(0);
    assert!(!compared.stdout.contains("distances"), "{}", compared.stdout);
}

#[test]
fn models_that_the_scene_claims_nothing_for_are_named() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING.replace("because:", "under: [Impulse, RestingLcp], because:"));
    let compared = bench.tumble(["compare", "falling.ron"]).code(0);
    let compared = compared
        .says("left out, because the scene claims nothing for it: penalty, velocity-lcp, soft-step (see --contact)");
    assert_eq!(compared.stdout.matches("\npenalty").count(), 0, "{}", compared.stdout);
    let compared = bench.tumble(["compare", "falling.ron", "--contact", "penalty,impulse"]).code(0);
    assert!(!compared.stdout.contains("left out"), "{}", compared.stdout);
    assert_eq!(compared.stdout.matches("\npenalty").count(), 1, "{}", compared.stdout);
}

#[test]
fn a_reference_that_fails_leaves_the_rest() {
    let bench = Bench::new();
    // Any overlap of a mass of 1e-9 kg overflows; it meets the floor at 0.29 s.
    let scene = SILENT.replace("duration: 0.2", "models: (penalty: (stiffness: 1e308)), dt: 0.01, duration: 0.5");
    bench.write("stiff.ron", scene.replace("radius: 0.1", "radius: 0.1, mass: 1e-9"));
    let compared =
        bench.tumble(["compare", "stiff.ron", "--contact", "impulse,velocity-lcp", "--reference", "penalty"]);
    compared.code(0).says("the reference, penalty with steps of 0.000625 s, failed: ").says("Best for");
    let csv = bench.read("out/stiff/compare/compare.csv");
    assert!(cells(&csv)[1..].iter().all(|row| row[6].is_empty() && row[12].is_empty()), "{csv}");
}

#[test]
fn any_scene_can_be_compared() {
    let bench = Bench::new();
    let floor = r#"(name: "floor", kind: Static, parts: [HalfPlane()])"#;
    let rod = r#"(name: "rod", at: (0, 1), angle_degrees: 30, parts: [Rod(from: (0, 0), to: (1, 0), density: 1)])"#;
    let scenes = [
        ("static", format!("(format: 1, duration: 0.1, bodies: [{floor}])")),
        (
            "jointed",
            format!(
                "(format: 1, duration: 0.1, bodies: [{floor}, {rod}], joints: [(name: \"pin\", kind: Revolute, \
                 a: World(point: (0, 1)), b: Body(name: \"rod\", point: (0, 0)))])"
            ),
        ),
        (
            "lecture",
            format!(
                "(format: 1, dt: 0.001, duration: 0.6, models: (penalty: (law: Lecture)), bodies: [{floor}, {rod}])"
            ),
        ),
    ];
    for (name, scene) in scenes {
        bench.write(&format!("{name}.ron"), scene);
        let compared = bench.tumble(["compare", &format!("{name}.ron")]).code(0);
        let compared = compared.says(&format!("{name}: 5 runs of")).says("Best for ");
        assert!(!compared.stdout.contains("FAILED"), "{}", compared.stdout);
        assert_eq!(bench.names(&format!("out/{name}/compare")), ["compare.csv", "compare.svg"]);
    }
}

#[test]
fn curves_that_coincide_have_dashes_of_their_own() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.tumble(["compare", "falling.ron"]).code(0);
    let svg = bench.read("out/falling/compare/compare.svg");
    let strokes = |color: &str| svg.matches(&format!("stroke=\"{color}\"")).count();
    // Four models, one curve: a solid line with one piece in the legend, then shorter and shorter dashes.
    let counts = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"].map(strokes);
    assert_eq!(counts[0], 2, "{counts:?}");
    assert!(counts[1] > 10 && counts.is_sorted(), "{counts:?}");
}

#[test]
fn every_model_with_several_steps_is_drawn_in_its_colour_broad_to_fine() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.tumble(["compare", "falling.ron", "--dt", "0.02,0.01,0.005,0.0025"]).code(0).says("20 runs");
    let svg = bench.read("out/falling/compare/compare.svg");
    let lines: Vec<&str> = svg.lines().filter(|line| line.starts_with("<polyline")).collect();
    // Eight units to a pixel; colours of the five models.
    for color in ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"] {
        let of_model = lines.iter().filter(|line| line.contains(&format!("stroke=\"{color}\"")));
        let widths: Vec<&str> =
            of_model.filter_map(|line| line.split_once("stroke-width=\"")?.1.split('"').next()).collect();
        let first =
            |width: &str| widths.iter().position(|is| *is == width).unwrap_or_else(|| panic!("{color}: {widths:?}"));
        let order = ["112", "80", "48", "16"].map(first);
        assert!(order.is_sorted(), "{color}: broad ones are drawn before fine ones, {order:?}");
    }
    // The lowest entry of the legend is inside the picture of 540 px, beside its piece.
    let label = svg.lines().zip(svg.lines().skip(1)).find(|(_, text)| text.contains("soft-step at 0.0025 s"));
    let y = label.and_then(|(tag, _)| tag.split_once(" y=\"")?.1.split('"').next()?.parse::<f64>().ok());
    assert!(y.is_some_and(|y| y < 8.0 * 530.0), "{label:?}");
}

#[test]
fn what_cannot_be_written_leaves_nothing() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.write("taken", "a file, not a folder");
    bench.tumble(["compare", "falling.ron", "--out", "taken"]).code(3).complains("cannot create folder `taken`");
    assert_eq!(bench.read("taken"), "a file, not a folder");
    bench.write("half/compare.svg/inside", "in the way");
    let failed = bench.tumble(["compare", "falling.ron", "--out", "half"]).code(3);
    failed.complains("cannot replace `half/compare.svg`");
    assert_eq!(bench.names("half"), ["compare.svg"], "neither or both");
    assert_eq!(bench.names(""), ["falling.ron", "half", "taken"]);
}
