//! Wrong arguments and wrong scenes: exit 2, words that lead on, and no files.

use std::ffi::OsString;

use crate::support::{Bench, FALLING};

#[test]
fn wrong_arguments_are_refused_by_name() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    let cases: &[(&[&str], &str)] = &[
        (&["walk"], "unrecognized subcommand 'walk'"),
        (&["run", "falling.ron", "--fast"], "unexpected argument '--fast'"),
        (&["run", "falling.ron", "other.ron"], "unexpected argument 'other.ron'"),
        (&["run", "falling.ron", "--contact", "impluse"], "a similar value exists: 'impulse'"),
        (&["run", "falling.ron", "--contact"], "a value is required"),
        (&["run", "falling.ron", "--dt", "0"], "must be positive"),
        (&["run", "falling.ron", "--dt", "NaN"], "must be positive and finite"),
        (&["run", "falling.ron", "--dt", "-0.01"], "must be positive"),
        (&["run", "falling.ron", "--dt", "inf"], "must be positive and finite"),
        (&["run", "falling.ron", "--dt", "1e400"], "must be positive and finite"),
        (&["run", "falling.ron", "--dt", "fast"], "must be a number of seconds"),
        (&["run", "falling.ron", "--dt", "1"], "the duration 0.1 s is shorter than one step of 1 s"),
        (&["run", "falling.ron", "--dt", "1e-300"], "1e8 are run"),
        (&["run", "falling.ron", "--duration", "0"], "must be positive"),
        (&["run", "falling.ron", "--duration", "-inf"], "must be positive"),
        (&["run", "falling.ron", "--duration", "1e300"], "1e8 are run"),
        (&["run", "falling.ron", "--every", "0"], "0 is not in 1.."),
        (&["run", "falling.ron", "--every", "-3"], "-3 is not in 1.."),
        (&["run", "falling.ron", "--every", "1.5"], "invalid value '1.5'"),
        (&["run", "falling.ron", "--every", "4294967296"], "4294967296 is not in 1.."),
        (&["run", "falling.ron", "--threads", "0"], "must be a number from 1 to 256"),
        (&["run", "falling.ron", "--threads", "-2"], "must be a number from 1 to 256"),
        (&["run", "falling.ron", "--threads", "100000"], "must be a number from 1 to 256"),
        (
            &["batch", "falling.ron", "--runs", "2", "--out", "b.csv", "--threads", "many"],
            "must be a number from 1 to 256",
        ),
        (&["run", "falling.ron", "--plot", "hight"], "unknown channel `hight`"),
        (&["run", "falling.ron", "--plot", "omeg:ball"], "did you mean `omega`"),
        (&["run", "falling.ron", "--plot", ""], "unknown channel"),
        (&["run", "falling.ron", "--plot", "y:bal"], "there is no body `bal` (did you mean `ball`?)"),
        (&["run", "falling.ron", "--plot", "total:ball"], "is of the whole world"),
        (&["run", "falling.ron", "--out", ""], "a value is required"),
        (&["run", "falling"], "no scene that comes with the program is called \"falling\""),
        (&["run", "head_one"], "did you mean head_on?"),
        (&["run", "homework"], "did you mean homework_rods or homework_rods_impulse?"),
        (&["run", ""], "a value is required"),
        (&["run", "missing.ron"], "\"missing.ron\" cannot be read"),
        (&["run", "./missing"], "\"./missing\" cannot be read"),
        (&["run", "falling.ron/inside.ron"], "cannot be read"),
        (&["check"], "required arguments"),
        (&["check", "missing.ron"], "cannot be read"),
        (&["test"], "required arguments"),
        (&["test", "missing.ron"], "cannot be read"),
        (&["test", "falling.ron", "--contact", "soft"], "possible values: penalty, impulse"),
        (&["compare"], "required arguments"),
        (&["compare", "missing.ron"], "cannot be read"),
        (
            &["compare", "falling.ron", "--contact", "impulse,soft"],
            "penalty, impulse, resting-lcp, velocity-lcp, soft-step",
        ),
        (&["compare", "falling.ron", "--reference", "best"], "penalty, impulse, resting-lcp, velocity-lcp, soft-step"),
        (&["compare", "falling.ron", "--dt", "0.01,0"], "must be positive"),
        (&["compare", "falling.ron", "--dt", "NaN"], "must be positive and finite"),
        (&["compare", "falling.ron", "--dt", "0.01,"], "must be a number of seconds"),
        (&["compare", "falling.ron", "--dt", "0.01,0.02,0.010"], "--dt: 0.01 is given twice"),
        (&["compare", "falling.ron", "--contact", "impulse,impulse"], "--contact: impulse is given twice"),
        (
            &["compare", "falling.ron", "--dt", "0.01,0.02,0.03,0.04,0.05"],
            "25 runs cannot be told apart in one plot: at most 4 time steps of several models, or 12 runs in all",
        ),
        (&["compare", "falling.ron", "--out", ""], "a value is required"),
        (&["compare", "falling.ron", "--dt", "0.01,1"], "is shorter than one step of 1 s"),
        (&["compare", "falling.ron", "--dt", "1e-7", "--reference", "impulse", "--contact", "x"], "possible values"),
        (&["compare", "falling.ron", "--plot", "hight"], "unknown channel `hight`"),
        (&["compare", "falling.ron", "--plot", "y:bal"], "there is no body `bal` (did you mean `ball`?)"),
        (&["compare", "falling.ron", "--plot", "joint_force:pin"], "there is no joint `pin`; joints: none"),
        (
            &["compare", "falling.ron", "--contact", "impulse,penalty", "--dt", "1e-3,2e-3,3e-3,4e-3,5e-3,6e-3,7e-3"],
            "14 runs cannot be told apart in one plot",
        ),
        (&["schema", "1"], "unexpected argument"),
    ];
    for (arguments, words) in cases {
        let ended = bench.tumble(*arguments);
        assert!(ended.code == 2 && ended.stderr.contains(words), "{arguments:?}: no `{words}` in {ended:?}");
    }
    assert_eq!(bench.names("."), ["falling.ron"], "what is refused leaves no files");
}

#[test]
fn a_folder_is_no_scene() {
    let bench = Bench::new();
    bench.write("scenes/falling.ron", FALLING);
    bench.tumble(["run", "scenes"]).code(2).complains("write ./scenes");
    bench.tumble(["run", "./scenes"]).code(2).complains("\"./scenes\" is a folder, not a file");
    bench.tumble(["run", "scenes/"]).code(2).complains("is a folder, not a file");
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_line() {
    let bench = Bench::new();
    bench.write("latin1.ron", b"(\n  format: 1,\n  about: \"na\xefve\",\n)");
    bench.tumble(["run", "latin1.ron"]).code(2).complains("is not a text in UTF-8: see line 3");
    bench.write("empty.ron", "");
    bench.tumble(["run", "empty.ron"]).code(2).complains("empty.ron");
    bench.write("nulls.ron", [0; 100]);
    bench.tumble(["run", "nulls.ron"]).code(2).complains("nulls.ron");
}

#[cfg(unix)]
#[test]
fn names_that_are_no_text_are_names_all_the_same() {
    use std::os::unix::ffi::OsStringExt;
    let bench = Bench::new();
    let name = OsString::from_vec(b"na\xefve.ron".to_vec());
    let bad = OsString::from_vec(b"na\xefve".to_vec());
    bench.tumble([OsString::from("run"), bad.clone()]).code(2);
    bench.tumble([OsString::from("run"), OsString::from("homework_rods"), OsString::from("--plot"), bad]).code(2);
    if std::fs::write(bench.path(&name), FALLING).is_ok() {
        bench.tumble([OsString::from("run"), name]).code(0).says("A ball falls.");
    }
}

#[test]
fn all_mistakes_of_a_scene_are_told_at_once() {
    let bench = Bench::new();
    let scene = r#"(
    format: 1, duration: 1, dt: -0.1,
    bodies: [
        (name: "ball", material: "rubbber", parts: [Disc(radius: 1)]),
        (name: "ball", parts: [Rod(from: (0, 0), to: (0, 0))]),
    ],
    expect: [Speed(of: "bal", at: 9, is: 1, within: 0.1)],
)"#;
    bench.write("wrong.ron", scene);
    for command in ["run", "check", "test"] {
        let ended = bench.tumble([command, "wrong.ron"]).code(2);
        for words in ["dt must be positive", "rubbber", "wrong.ron:4:", "wrong.ron:5:", "did you mean \"ball\"?"] {
            assert!(ended.stderr.contains(words), "{command}: no `{words}` in:\n{}", ended.stderr);
        }
        assert!(!ended.stderr.contains('\u{1b}'), "no colours into a pipe");
    }
    assert_eq!(bench.names("."), ["wrong.ron"]);
}

#[test]
fn bodies_that_overlap_at_the_start_are_a_mistake_unless_allowed() {
    let bench = Bench::new();
    let scene = r#"(
    format: 1, duration: 0.1,
    bodies: [
        (name: "left", parts: [Disc(radius: 1)]),
        (name: "right", at: (1.75, 0), parts: [Disc(radius: 1)]),
        (name: "apart", at: (9, 0), parts: [Disc(radius: 1)]),
    ],
)"#;
    bench.write("overlap.ron", scene);
    for command in ["run", "check", "test"] {
        bench
            .tumble([command, "overlap.ron"])
            .code(2)
            .complains("bodies \"left\" and \"right\" overlap by 2.500e-1 m")
            .complains("overlap.ron:4:")
            .complains("allow_overlap: true");
    }
    bench.write("allowed.ron", scene.replace("duration", "allow_overlap: true, duration"));
    bench.tumble(["run", "allowed.ron"]).code(0);
}
