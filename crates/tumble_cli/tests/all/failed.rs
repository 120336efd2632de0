//! Runs that fail or are interrupted, and files that cannot be written: exit 3, and what there is so far is kept.

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::{Bench, EXPLODING, FALLING, ended};

#[test]
fn a_state_that_overflows_names_body_quantity_phase_and_step() {
    let bench = Bench::new();
    bench.write("exploding.ron", EXPLODING);
    let run = bench
        .tumble(["run", "exploding.ron"])
        .code(3)
        .complains("acceleration of body \"victim\" is not finite after ComputeAccelerations in step 50")
        .complains("samples so far are in out/exploding/partial");
    assert_eq!(run.stdout, "");
    assert_eq!(bench.names("out/exploding"), ["partial"]);
    let trajectory = bench.read("out/exploding/partial/trajectory.csv");
    assert!(trajectory.lines().last().expect("a row").starts_with("49,"), "{trajectory}");
    assert!(!trajectory.contains("NaN") && !trajectory.contains("inf"));
    // Steps 0 to 49 of two bodies, and the head.
    assert_eq!(trajectory.lines().count(), 1 + 2 * 50);
}

#[test]
fn the_sample_of_a_step_that_failed_is_not_kept() {
    let bench = Bench::new();
    bench.write("exploding.ron", EXPLODING.replace("expect", "/* expect").replace("    ],\n)", "    ], */\n)"));
    bench.tumble(["run", "exploding.ron", "--every", "8"]).code(3);
    let trajectory = bench.read("out/exploding/partial/trajectory.csv");
    assert!(trajectory.lines().last().expect("a row").starts_with("48,"), "{trajectory}");
}

#[test]
fn earlier_good_files_stay_and_a_good_run_removes_partial() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.write("exploding.ron", EXPLODING);
    bench.tumble(["run", "falling.ron", "--out", "here"]).code(0);
    let good = bench.read("here/summary.json");
    bench.tumble(["run", "exploding.ron", "--out", "here"]).code(3);
    assert_eq!(bench.read("here/summary.json"), good);
    assert!(bench.path("here/partial/trajectory.csv").exists());
    bench.tumble(["run", "falling.ron", "--out", "here"]).code(0);
    assert!(!bench.path("here/partial").exists());
}

#[test]
fn an_out_folder_that_cannot_be_made_is_told_before_the_run() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    for place in ["falling.ron", "falling.ron/below", "/dev/null/x"] {
        // A run of 1e8 steps would not end within the test.
        let options = ["--out", place, "--dt", "1e-9"];
        let run = bench.tumble(["run", "falling.ron"].iter().chain(&options)).code(3);
        assert!(run.stderr.contains(&format!("cannot create folder `{place}`")), "{}", run.stderr);
    }
    assert_eq!(bench.read("falling.ron"), FALLING);
}

#[test]
fn a_file_that_cannot_be_replaced_leaves_all_others_as_they_were() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.tumble(["run", "falling.ron"]).code(0);
    let before = bench.read("out/falling/summary.json");
    fs::remove_file(bench.path("out/falling/energy.svg")).expect("a file");
    fs::create_dir(bench.path("out/falling/energy.svg")).expect("a folder in its place");
    bench
        .tumble(["run", "falling.ron", "--every", "5"])
        .code(3)
        .complains("cannot replace `out/falling/energy.svg`")
        .complains("samples so far are in out/falling/partial");
    assert_eq!(bench.read("out/falling/summary.json"), before);
    assert!(!bench.names("out/falling").iter().any(|name| name.ends_with(".tmp")));
}

#[cfg(unix)]
#[test]
fn a_link_to_nowhere_is_no_folder() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    std::os::unix::fs::symlink("/dev/full", bench.path("full")).expect("a link");
    bench.tumble(["run", "falling.ron", "--out", "full"]).code(3).complains("cannot create folder `full`");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_under_standard_output_is_told_and_keeps_the_files() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    for arguments in [vec!["scenes"], vec!["schema"], vec!["check", "head_on"], vec!["run", "falling.ron"]] {
        let output = bench.command(&arguments).stdout(full()).output().expect("the program runs");
        ended(output).code(3).complains("cannot write to standard output");
    }
    assert!(bench.path("out/falling/replay.html").exists());
    // Nobody can be told when standard error is full, too; the exit code still tells.
    let output = bench.command(["run", "missing.ron"]).stdout(full()).stderr(full()).output().expect("it runs");
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn a_reader_who_has_seen_enough_is_no_failure() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    for arguments in
        [vec!["scenes"], vec!["schema"], vec!["check", "rod_pile"], vec!["run", "falling.ron"], vec!["--help"]]
    {
        let mut child =
            bench.command(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
        drop(child.stdout.take());
        let run = ended(child.wait_with_output().expect("it ends")).code(0);
        assert_eq!(run.stderr, "", "{arguments:?}");
    }
    assert!(bench.path("out/falling/replay.html").exists());
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_samples_so_far() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    for signal in ["INT", "TERM"] {
        // Half a minute of stepping at a million steps a second: it is interrupted long before.
        let long = ["run", "falling.ron", "--out", signal, "--duration", "300000", "--every", "1000000"];
        let child = bench.command(long).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
        // The folder is made after the program has begun to listen for signals.
        let started = Instant::now();
        while !bench.path(signal).exists() {
            assert!(started.elapsed() < Duration::from_secs(60), "the program never began");
            sleep(Duration::from_millis(5));
        }
        bench.write(&format!("{signal}/trajectory.csv"), "an earlier good file");
        sleep(Duration::from_millis(500));
        let kill = format!("kill -{signal} {}", child.id());
        assert!(std::process::Command::new("sh").args(["-c", &kill]).status().expect("sh").success());
        let asked = Instant::now();
        let run = ended(child.wait_with_output().expect("it ends")).code(3).complains("interrupted at");
        run.complains(&format!("{signal}/partial"));
        assert!(asked.elapsed() < Duration::from_secs(60));
        assert_eq!(bench.read(&format!("{signal}/trajectory.csv")), "an earlier good file");
        let partial = bench.read(&format!("{signal}/partial/trajectory.csv"));
        let steps: Vec<u64> = partial.lines().skip(1).filter_map(|line| line.split(',').next()?.parse().ok()).collect();
        assert!(steps.first() == Some(&0) && steps.last().is_some_and(|&last| last > 0 && last < 30_000_000));
    }
}
