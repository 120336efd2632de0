//! `tumble scenes`, `check`, `test`, `schema` and the help.

use crate::support::{BROKEN_PROMISE, Bench, EXPLODING, FALLING};

#[test]
fn scenes_lists_every_shipped_scene_with_what_it_shows() {
    let scenes = Bench::new().tumble(["scenes"]).code(0);
    let mut names: Vec<String> = Vec::new();
    for folder in ["planar", "spatial"] {
        let folder = format!("{}/../../assets/scenes/{folder}", env!("CARGO_MANIFEST_DIR"));
        let files = std::fs::read_dir(folder).expect("the folder of shipped scenes");
        let stem = |path: &std::path::Path| path.file_stem().expect("a stem").to_string_lossy().into_owned();
        let mut of_folder: Vec<String> = files.map(|file| stem(&file.expect("a file").path())).collect();
        of_folder.sort();
        names.append(&mut of_folder);
    }
    let listed: Vec<&str> = scenes.stdout.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(listed, names);
    assert!(scenes.stdout.lines().all(|line| line.split_whitespace().count() > 3), "{}", scenes.stdout);
}

#[test]
fn check_prints_masses_and_surfaces_with_units_and_runs_nothing() {
    let bench = Bench::new();
    let scene = r#"(
        format: 1, duration: 1e300, dt: 1e-300,
        bodies: [
            (name: "floor", kind: Static, at: (0, -5), parts: [HalfPlane()]),
            (name: "rod", at: (1, 2), parts: [Rod(from: (0, 0), to: (4, 0), density: 0.5)]),
        ],
        springs: [(from: Body(name: "rod"), to: World(point: (0, 9)), stiffness: 10)],
    )"#;
    bench.write("rod.ron", scene);
    let check = bench.tumble(["check", "rod.ron"]).code(0);
    // m = 0.5·4, I = m l²/12; the centre is half the rod away from where it begins.
    let expected = "\
rod.ron: 2 bodies, 1 spring

body   kind     mass [kg]  centre x [m]  y [m]  inertia [kg·m²]
floor  static           -             0     -5                -
rod    dynamic          2             3      2          2.66667

material  on       μ_s [1]  from     μ_k [1]  from     ε [1]  from
default   default        0  not set        0  not set      0  not set
";
    assert_eq!(check.stdout, expected);
    assert_eq!(bench.names("."), ["rod.ron"]);
}

#[test]
fn check_goes_on_after_a_scene_with_mistakes() {
    let bench = Bench::new();
    bench.write("falling.ron", FALLING);
    bench.write("wrong.ron", "(format: 2, duration: 1)");
    bench
        .tumble(["check", "wrong.ron", "falling.ron", "head_on"])
        .code(2)
        .complains("format 2 is not known")
        .says("wrong.ron: FAILED")
        .says("falling.ron: 1 body, 1 expectation")
        .says("head_on: ");
}

#[test]
fn check_warns_of_what_a_material_does_not_tell() {
    let bench = Bench::new();
    let scene = r#"(
        format: 1, duration: 1,
        pairs: [(between: ("wood", "ice"), dry: (static_friction: 0.1, kinetic_friction: 0.2))],
        bodies: [
            (name: "lake", kind: Static, material: "ice", parts: [HalfPlane()]),
            (name: "sledge", at: (0, 1), material: "wood", parts: [Box(size: (1, 1))]),
        ],
    )"#;
    bench.write("lake.ron", scene);
    bench
        .tumble(["check", "lake.ron"])
        .code(0)
        .complains("kinetic friction 0.2 is above static friction 0.1")
        .says("2 bodies, 1 warning")
        .says("ice       wood      0.1  pair      0.2  pair      0  not set");
}

#[test]
fn test_prints_a_line_per_expectation_and_counts() {
    let bench = Bench::new();
    bench.write("scenes/b/falling.ron", FALLING);
    bench.write("scenes/a/promise.ron", BROKEN_PROMISE);
    bench.write("scenes/c.ron", "(format: 1, duration: 0.1, bodies: [(name: \"d\", parts: [Disc(radius: 1)])])");
    bench.write("scenes/notes.txt", "no scene");
    let test = bench.tumble(["test", "scenes"]).code(1);
    let expected = "\
scenes/a/promise.ron
FAILED  VelocityY of \"ball\" at 0.1 s: -1 m/s, expected 1 ± 0.5 (balls fall up)

scenes/b/falling.ron
ok      VelocityY of \"ball\" at 0.1 s: -1 m/s, expected -1 ± 1e-9 (v = g t)

scenes/c.ron
nothing is expected

2 expectations: 1 ok, 1 FAILED in 3 scenes
";
    assert_eq!(test.stdout, expected);
    assert_eq!(bench.names("."), ["scenes"], "tests write no files");
    bench.tumble(["test", "scenes/b", "scenes/c.ron", "head_on"]).code(0).says(" in 3 scenes");
}

#[test]
fn test_counts_scenes_that_cannot_be_read_and_runs_the_others() {
    let bench = Bench::new();
    bench.write("a.ron", "(format: 1");
    bench.write("b.ron", FALLING);
    bench.write("c.ron", EXPLODING);
    bench
        .tumble(["test", "a.ron", "b.ron", "c.ron"])
        .code(2)
        .complains("a.ron:1")
        .says("a.ron\nFAILED  the scene cannot be run\n")
        .says("ok      VelocityY")
        .says("3 expectations: 2 ok, 1 FAILED in 3 scenes; scenes that cannot be run: 1; runs that failed: 1");
}

#[test]
fn an_expectation_that_a_failed_run_never_reached_has_failed() {
    let bench = Bench::new();
    bench.write("exploding.ron", EXPLODING);
    bench
        .tumble(["test", "exploding.ron"])
        .code(3)
        .says("FAILED  the run: acceleration of body \"victim\" is not finite after ComputeAccelerations in step 50")
        .says("ok      Y of \"witness\" at 0.1 s")
        .says("FAILED  Y of \"witness\" at 0.9 s");
}

#[test]
fn test_under_another_model_asks_only_what_is_claimed_for_it() {
    let bench = Bench::new();
    bench.write("promise.ron", BROKEN_PROMISE.replace("because", "under: [Penalty], because"));
    bench.tumble(["test", "promise.ron"]).code(0).says("skipped VelocityY").says("1 expectation: 1 skipped in 1 scene");
    bench.tumble(["test", "promise.ron", "--contact", "penalty"]).code(1).says("FAILED  VelocityY");
}

#[test]
fn a_folder_without_scenes_is_told() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("nothing")).expect("a folder");
    bench.tumble(["test", "nothing"]).code(2).complains("there is no scene (*.ron) in the folder \"nothing\"");
}

#[test]
fn schema_is_json_with_units() {
    let schema = Bench::new().tumble(["schema"]).code(0);
    let schema: serde_json::Value = serde_json::from_str(&schema.stdout).expect("JSON");
    for dimension in ["PlanarScene", "SpatialScene"] {
        let dt = &schema["$defs"][dimension]["properties"]["dt"];
        assert!(dt["description"].as_str().expect("a description").contains("[s]"));
        assert_eq!(dt["default"], 0.01);
    }
    assert_eq!(schema["then"]["$ref"], "#/$defs/SpatialScene");
    assert_eq!(
        schema["$defs"]["PlanarScene"]["properties"]["gravity"]["prefixItems"].as_array().map(Vec::len),
        Some(2)
    );
    assert_eq!(
        schema["$defs"]["SpatialScene"]["properties"]["gravity"]["prefixItems"].as_array().map(Vec::len),
        Some(3)
    );
}

#[test]
fn help_and_version_are_there() {
    let bench = Bench::new();
    let help = bench.tumble(["--help"]).code(0).says("Exit codes:").says("interrupted");
    for command in ["run", "scenes", "check", "test", "compare", "schema"] {
        assert!(help.stdout.contains(&format!("\n  {command} ")), "{}", help.stdout);
        bench.tumble([command, "--help"]).code(0).says("Usage: tumble");
    }
    bench
        .tumble(["run", "--help"])
        .code(0)
        .says("friction_force")
        .says("[possible values: penalty, impulse, resting-lcp, velocity-lcp, soft-step]");
    bench.tumble(["--version"]).code(0).says("tumble 0.1.0");
}
