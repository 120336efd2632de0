//! `tumble run` when all goes well.

use crate::support::{BROKEN_PROMISE, Bench, FALLING};

const FILES: [&str; 7] =
    ["audit.csv", "contacts.csv", "energy.svg", "replay.html", "summary.json", "touches.csv", "trajectory.csv"];

#[test]
fn no_arguments_run_the_homework() {
    let bench = Bench::new();
    let run = bench.tumble([""; 0]).code(0).says("homework_rods");
    assert_eq!(bench.names("out/homework_rods"), FILES);
    assert_eq!(run.stderr, "");
    let named = bench.tumble(["run", "homework_rods"]).code(0);
    assert_eq!(named.number("fingerprint"), run.number("fingerprint"));
}

#[test]
fn the_summary_tells_what_happened() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let run = bench.tumble(["run", "falling.ron"]).code(0).says("falling: A ball falls.").says("ok      VelocityY");
    assert_eq!(run.number("bodies"), "1, 1 of which can move");
    assert_eq!(run.number("contact model"), "impulse");
    assert_eq!(run.number("contacts"), "0 at the end, 0 at the peak");
    assert_eq!(run.number("steps   "), "10 of 0.01 s");
    assert_eq!(run.number("simulated time"), "0.1 s");
    assert!(run.stdout.contains("1 expectation: 1 ok"));
    assert!(run.stdout.contains("files in out/falling: trajectory.csv"));

    let summary: serde_json::Value = serde_json::from_str(&bench.read("out/falling/summary.json")).expect("JSON");
    assert_eq!(summary["scene"], "falling");
    assert_eq!(summary["steps"], 10);
    assert_eq!(summary["fingerprint"], run.number("fingerprint"));
}

#[test]
fn pictures_in_space_are_written_when_asked_for() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let run = bench.tumble(["run", "falling.ron", "--gltf", "--frames", "3"]).code(0);
    assert!(run.stdout.contains("scene.gltf, frames, scene.gif"), "{}", run.stdout);
    assert_eq!(bench.names("out/falling/frames"), ["0000.png", "0001.png", "0002.png"]);
    assert!(bench.read("out/falling/scene.gltf").contains("\"animations\""));
    assert!(bench.path("out/falling/scene.gif").exists());
}

#[test]
fn two_processes_give_the_same_bits() {
    let bench = Bench::new();
    let runs = ["one", "two"].map(|out| {
        bench.tumble(["run", "homework_rods_impulse", "--out", out]).code(0);
        ["trajectory.csv", "contacts.csv", "audit.csv", "touches.csv"].map(|file| bench.read(&format!("{out}/{file}")))
    });
    assert!(runs[0] == runs[1]);
    assert!(runs[0][0].lines().count() > 100);
}

#[test]
fn every_thins_samples_and_nothing_else() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let all = bench.tumble(["run", "falling.ron", "--out", "all"]).code(0);
    let some = bench.tumble(["run", "falling.ron", "--out", "some", "--every", "4"]).code(0);
    assert_eq!(all.number("fingerprint"), some.number("fingerprint"));
    let steps = |csv: String| {
        csv.lines().skip(1).map(|line| line.split(',').next().expect("a cell").to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(steps(bench.read("some/trajectory.csv")), ["0", "4", "8", "10"]);
    assert_eq!(steps(bench.read("all/trajectory.csv")).len(), 11);
    assert_eq!(bench.read("some/audit.csv"), bench.read("all/audit.csv"));
}

#[test]
fn every_changes_no_verdict() {
    let bench = Bench::new();
    // The height peaks at step 5, between the samples.
    let throw = r#"(
        format: 1, duration: 0.1, gravity: (0, -10),
        bodies: [(name: "ball", velocity: (0, 0.5), parts: [Disc(radius: 0.5)])],
        expect: [Y(of: "ball", always: true, below: 0.005, because: "a bound that only step 5 breaks")],
    )"#;
    bench.write("throw.ron", throw);
    let fine = bench.tumble(["run", "throw.ron"]);
    let coarse = bench.tumble(["run", "throw.ron", "--every", "100"]);
    assert_eq!((fine.code, coarse.code), (1, 1), "{}\n{}", fine.stdout, coarse.stdout);
}

#[test]
fn a_failed_expectation_is_exit_1_and_its_files_are_there() {
    let bench = Bench::new();
    bench.write("promise.ron", BROKEN_PROMISE);
    bench.tumble(["run", "promise.ron"]).code(1).says("FAILED  VelocityY").says("balls fall up");
    assert_eq!(bench.names("out/promise"), FILES);
}

#[test]
fn an_overridden_scene_tells_its_verdict_without_failing() {
    let bench = Bench::new();
    bench.write("promise.ron", BROKEN_PROMISE);
    for (option, value) in [("--contact", "penalty"), ("--dt", "0.005"), ("--duration", "0.05")] {
        bench.tumble(["run", "promise.ron", option, value]).code(0).says("FAILED").says("(the scene was overridden)");
    }
    let run = bench.tumble(["run", "promise.ron", "--dt", "0.005", "--duration", "0.05", "--contact", "penalty"]);
    assert_eq!(run.number("steps   "), "10 of 0.005 s");
    assert_eq!(run.number("contact model"), "penalty");
}

#[test]
fn quiet_prints_failures_only() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.write("promise.ron", BROKEN_PROMISE);
    let fine = bench.tumble(["run", "falling.ron", "--quiet"]).code(0);
    assert_eq!((fine.stdout.as_str(), fine.stderr.as_str()), ("", ""));
    let failed = bench.tumble(["run", "promise.ron", "-q"]).code(1);
    assert_eq!(failed.stdout.lines().count(), 1);
    assert!(failed.stdout.starts_with("FAILED"));
}

#[test]
fn plots_are_drawn_once_each() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let plots = ["--plot", "total", "--plot", "y:ball", "--plot", "y:ball", "--plot", "speed"];
    bench.tumble(["run", "falling.ron"].iter().chain(&plots)).code(0);
    let names = bench.names("out/falling");
    let pictures: Vec<&String> = names.iter().filter(|name| name.ends_with(".svg")).collect();
    assert_eq!(pictures, ["energy.svg", "speed.svg", "total.svg", "y-ball.svg"]);
}

#[test]
fn a_file_in_this_folder_never_hides_a_shipped_scene() {
    let bench = Bench::new();
    bench.write("head_on", FALLING);
    bench.write("scenes/head_on.ron", FALLING);
    bench.tumble(["run", "head_on"]).code(0).says("left");
    bench.tumble(["run", "./head_on"]).code(0).says("A ball falls.");
    bench.tumble(["run", "scenes/head_on.ron"]).code(0).says("A ball falls.");
}

#[test]
fn warnings_go_to_standard_error() {
    let bench = Bench::new();
    bench.write("empty.ron", "(format: 1, duration: 0.1)");
    bench.tumble(["run", "empty.ron"]).code(0).complains("warning: the scene has no bodies").complains("empty.ron:1");
    assert_eq!(bench.tumble(["run", "empty.ron", "-q"]).code(0).stderr, "");
}
