//! `tumble batch`: many runs in one table.

use crate::support::{Bench, EXPLODING, FALLING};

const VARIED: [&str; 4] = ["--vary", "bodies.ball.velocity.x=-1..1", "--show", "x:ball"];

#[test]
fn a_batch_is_a_table_of_runs_and_its_parts_make_the_whole() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let batch = |more: &[&str]| {
        let command = ["batch", "falling.ron", "--runs", "10", "--seed", "4"];
        bench.tumble(command.iter().chain(&VARIED).chain(more)).code(0)
    };
    batch(&[]).says("10 runs of falling: 100 steps in").says("table: out/falling/batch.csv");
    let whole = bench.read("out/falling/batch.csv");
    let mut lines = whole.lines();
    assert_eq!(lines.next(), Some("run,bodies.ball.velocity.x,steps,time,fingerprint,x:ball,error"));
    for (number, line) in lines.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!((cells[0], cells[2], cells[4].len(), cells[6]), (&*number.to_string(), "10", 32, ""), "{line}");
        // Constant speed for a tenth of a second: x = v t to the round-off of ten sums.
        let [speed, x]: [f64; 2] = [cells[1], cells[5]].map(|cell| cell.parse().expect("a number"));
        assert!((x - 0.1 * speed).abs() < 1e-15, "{line}");
    }
    let parts = ["1/3", "2/3", "3/3"].map(|part| {
        batch(&["--shard", part, "--out", "part.csv", "--threads", "1"]);
        bench.read("part.csv")
    });
    let rows: Vec<&str> = parts.iter().flat_map(|part| part.lines().skip(1)).collect();
    assert_eq!(rows, whole.lines().skip(1).collect::<Vec<_>>());
}

#[test]
fn a_run_has_the_fingerprint_of_its_scene_run_by_itself() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let single = bench.tumble(["run", "falling.ron"]).code(0).number("fingerprint");
    bench.tumble(["batch", "falling.ron", "--runs", "1"]).code(0);
    let table = bench.read("out/falling/batch.csv");
    let fingerprint = table.lines().nth(1).and_then(|row| row.split(',').nth(3));
    assert_eq!(fingerprint, Some(&*single));
}

#[test]
fn runs_that_fail_are_told_in_the_table_and_by_the_exit_code() {
    let bench = Bench::new();
    bench.write("exploding.ron", EXPLODING);
    bench
        .tumble(["batch", "exploding.ron", "--runs", "2"])
        .code(3)
        .complains("2 runs failed; the first is run 0: ")
        .complains("body \"victim\" is not finite after ComputeAccelerations in step 50");
    assert!(
        bench.read("out/exploding/batch.csv").lines().all(|row| row.starts_with("run,") || row.contains("step 50"))
    );
}

#[test]
fn what_a_batch_cannot_do_is_refused_before_the_first_run() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    for (arguments, words) in [
        (&["--vary", "bodies.bal.velocity.x=0..1"][..], "there is no \"bal\" in bodies"),
        (&["--vary", "bodies.ball"], "a variation is written PATH=LOW..HIGH"),
        (&["--show", "y:bal"], "there is no body `bal` (did you mean `ball`?)"),
        (&["--shard", "3/2"], "I/K with I from 1 to K"),
    ] {
        bench.tumble(["batch", "falling.ron", "--runs", "3"].iter().chain(arguments)).code(2).complains(words);
    }
    assert!(!bench.path("out").exists());
}
