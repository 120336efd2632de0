//! What the scenes hold, and that bodies are apart before they begin.

use tumble_bench::judge::judge;
use tumble_bench::scenes::{AnyPlan, SCENES, find};
use tumble_bench::{Kind, Plan, PlanDim};
use tumble_math::{Linear, Pose};

/// What a plan has, whatever its dimension.
#[derive(Debug, PartialEq)]
struct Census {
    fixed: usize,
    kinematic: usize,
    dynamic: usize,
    parts: usize,
}

fn census_of<D: PlanDim>(plan: &Plan<D>) -> Census {
    let count = |kind| plan.bodies.iter().filter(|body| body.kind == kind).count();
    let parts = plan.bodies.iter().map(|body| body.parts.len()).sum();
    Census { fixed: count(Kind::Static), kinematic: count(Kind::Kinematic), dynamic: count(Kind::Dynamic), parts }
}

fn census(name: &str) -> Census {
    match find(name).expect("the scene is in the list")[0].plan() {
        AnyPlan::Planar(plan) => census_of(&plan),
        AnyPlan::Spatial(plan) => census_of(&plan),
    }
}

#[test]
fn scenes_have_their_bodies() {
    let expected = [
        ("pyramid2d", 1, 0, 5050, 5051),
        ("many_pyramids2d", 20, 0, 22_000, 22_020),
        ("tumbler2d", 0, 1, 2025, 2029),
        ("rods2d", 3, 0, 2000, 6003),
        ("rain2d", 123, 0, 1500, 4123),
        ("junkyard2d", 3, 3, 1500, 3759),
        ("rod_one2d", 1, 0, 1, 2),
        ("pyramid3d", 1, 0, 2870, 2871),
        ("wall3d", 1, 0, 1000, 1001),
        ("balls3d", 5, 0, 4096, 4101),
        ("drop3d", 5, 0, 1000, 1005),
        ("tumbler3d", 0, 1, 1728, 1734),
        ("rod_one3d", 1, 0, 1, 2),
    ];
    for (name, fixed, kinematic, dynamic, parts) in expected {
        assert_eq!(census(name), Census { fixed, kinematic, dynamic, parts }, "{name}");
    }
}

/// Overlap of a plan as it begins, and the largest distance of a dynamic body's centre of mass from its origin [m].
fn beginning<D: PlanDim>(plan: &Plan<D>) -> (usize, f64, f64) {
    let poses: Vec<Pose<D>> = plan.bodies.iter().map(|body| body.pose).collect();
    let verdict = judge(plan, &poses);
    (verdict.touching, verdict.max_overlap, plan.bodies.iter().map(|body| body.centre().length()).fold(0.0, f64::max))
}

#[test]
fn little_overlaps_at_the_beginning_and_origins_are_centres_of_mass() {
    for scene in SCENES {
        let (_, overlap, off_centre) = match scene.plan() {
            AnyPlan::Planar(plan) => beginning(&plan),
            AnyPlan::Spatial(plan) => beginning(&plan),
        };
        // Boxes side by side at 100 m: a few roundings of 1e-14. Only in `drop3d` corners of turned boxes reach into their neighbours.
        let allowed = if scene.name == "drop3d" { 0.05 } else { 1e-12 };
        assert!(overlap < allowed, "{}: {overlap}", scene.name);
        // Sums over a few parts of size 1.
        assert!(off_centre < 1e-15, "{}: {off_centre}", scene.name);
    }
}

#[test]
fn piles_begin_with_the_contacts_that_they_promise() {
    let promised = [
        ("pyramid2d", 14_950),
        ("many_pyramids2d", 58_000),
        ("pyramid3d", 10_280),
        ("growth2d-1000", 1015),
        ("growth2d-100000", 100_050),
        ("growth3d-1000", 1024),
        ("growth3d-100000", 100_096),
    ];
    for (name, contacts) in promised {
        let touching = match find(name).expect("the scene is in the list")[0].plan() {
            AnyPlan::Planar(plan) => beginning(&plan).0,
            AnyPlan::Spatial(plan) => beginning(&plan).0,
        };
        assert_eq!(touching, contacts, "{name}");
    }
}

#[test]
fn a_series_is_all_of_its_sizes_and_nothing_else() {
    let names = |word| find(word).map(|scenes| scenes.iter().map(|scene| scene.name).collect::<Vec<_>>());
    assert_eq!(names("growth3d").map(|sizes| sizes.len()), Ok(5));
    assert_eq!(names("growth3d-3000"), Ok(vec!["growth3d-3000"]));
    let unknown = names("pyramid").expect_err("there is pyramid2d, but no pyramid").to_string();
    assert!(unknown.starts_with("no scene `pyramid`; there are: pyramid2d, many_pyramids2d"), "{unknown}");
}
