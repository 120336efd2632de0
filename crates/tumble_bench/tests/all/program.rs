//! The program from outside.

use assert_cmd::Command;
use tumble_bench::Line;
use tumble_bench::scenes::SCENES;

fn bench(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("tumble_bench").expect("the program is built with its tests");
    command.args(arguments);
    command
}

fn lines(arguments: &[&str]) -> Vec<String> {
    let output = bench(arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).expect("CSV is text").lines().map(str::to_owned).collect()
}

#[test]
fn a_scene_is_a_header_and_a_line() {
    let lines = lines(&["wall3d", "--steps", "2", "--threads", "2", "--header"]);
    assert_eq!(lines[0], Line::HEADER);
    let line: Line = lines[1].parse().expect("the program writes what the library reads");
    assert_eq!((line.engine.as_str(), line.scene.as_str(), line.steps, line.threads), ("tumble", "wall3d", 2, 2));
    assert_eq!(line.bodies, 1001);
    // Each brick lies on two others or on the floor.
    assert!(line.contacts >= 1900, "{}", line.contacts);
    assert!(line.bytes_per_body > 100.0, "a body is more than its pose and velocity");
}

#[test]
fn a_scene_gives_the_same_fingerprint_each_time() {
    let fingerprint = |line: &str| line.parse::<Line>().map(|line| line.fingerprint);
    let run = || lines(&["rain2d", "--steps", "5"]);
    assert_eq!(fingerprint(&run()[0]), fingerprint(&run()[0]));
}

#[test]
fn every_scene_takes_a_step() {
    // The largest sizes of the series differ from the smaller ones in nothing but size.
    for scene in SCENES.iter().filter(|scene| !scene.name.ends_with("0000")) {
        let line: Line = lines(&[scene.name, "--steps", "1"])[0].parse().expect("a line");
        assert!(line.max_overlap < 0.05, "{}: {}", scene.name, line.max_overlap);
    }
}

#[test]
fn a_profile_goes_to_standard_error_and_names_the_phases() {
    let output = bench(&["rod_one2d", "--steps", "100", "--profile"]).assert().success().get_output().clone();
    let profile = String::from_utf8(output.stderr).expect("a profile is text");
    assert!(profile.contains("FilterVelocities") && profile.contains("DetectCollisions"), "{profile}");
    assert_eq!(String::from_utf8_lossy(&output.stdout).lines().count(), 1);
}

#[test]
fn wrong_words_and_numbers_end_with_code_2() {
    for (arguments, culprit) in [
        (&["pyramid"][..], "no scene `pyramid`"),
        (&["pyramid2d", "--threads", "0"], "--threads"),
        (&["pyramid2d", "--steps", "0"], "--steps"),
        (&["pyramid2d", "--steps", "many"], "--steps"),
        (&["pyramid2d", "--contact", "magic"], "expected one of: penalty"),
    ] {
        let output = bench(arguments).assert().code(2).get_output().stderr.clone();
        let message = String::from_utf8_lossy(&output);
        assert!(message.contains(culprit), "{message}");
    }
}
