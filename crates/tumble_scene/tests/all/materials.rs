//! The lecture's table, the look-up of pairs, where figures come from, and which materials can meet.

use tumble_scene::format::{Scene, Surface, Take};
use tumble_scene::materials::{MaterialLibrary, MaterialNotice, PairProperties, lecture_table};
use tumble_scene::{Loaded, meetings};

/// Lowest and highest figure; `None` where the table has none.
type Range = Option<(f64, f64)>;

const fn one(value: f64) -> Range {
    Some((value, value))
}

const fn range(low: f64, high: f64) -> Range {
    Some((low, high))
}

/// The table as the lecture prints it: pair, then μ_s dry, μ_s lubricated, μ_k dry, μ_k lubricated.
const ROWS: [(&str, &str, [Range; 4]); 24] = [
    ("aluminium", "steel", [one(0.61), None, one(0.47), None]),
    ("aluminium", "aluminium", [range(1.05, 1.35), one(0.3), range(1.4, 1.5), None]),
    ("gold", "gold", [None, None, one(2.5), None]),
    ("platinum", "platinum", [one(1.2), one(0.25), one(3.0), None]),
    ("silver", "silver", [one(1.4), one(0.55), one(1.5), None]),
    ("alumina", "silicon nitride", [None, None, None, one(0.004)]),
    ("BAM", "titanium boride", [range(0.04, 0.05), one(0.02), None, None]),
    ("brass", "steel", [range(0.35, 0.51), one(0.19), one(0.44), None]),
    ("cast iron", "copper", [one(1.05), None, one(0.29), None]),
    ("cast iron", "zinc", [one(0.85), None, one(0.21), None]),
    ("concrete", "rubber", [one(1.0), one(0.30), range(0.6, 0.85), range(0.45, 0.75)]),
    ("concrete", "wood", [one(0.62), None, None, None]),
    ("copper", "glass", [one(0.68), None, one(0.53), None]),
    ("copper", "steel", [one(0.53), None, one(0.36), one(0.18)]),
    ("glass", "glass", [range(0.9, 1.0), range(0.005, 0.01), one(0.4), range(0.09, 0.116)]),
    ("human synovial fluid", "cartilage", [None, one(0.01), None, one(0.003)]),
    ("ice", "ice", [range(0.02, 0.09), None, None, None]),
    ("polyethene", "steel", [one(0.2), one(0.2), None, None]),
    ("PTFE", "PTFE", [one(0.04), one(0.04), None, one(0.04)]),
    ("steel", "ice", [one(0.03), None, None, None]),
    ("steel", "PTFE", [range(0.04, 0.2), one(0.04), None, one(0.04)]),
    ("steel", "steel", [range(0.74, 0.80), range(0.005, 0.23), range(0.42, 0.62), range(0.029, 0.19)]),
    ("wood", "metal", [range(0.2, 0.6), one(0.2), one(0.49), one(0.075)]),
    ("wood", "wood", [range(0.25, 0.62), one(0.2), range(0.32, 0.48), range(0.067, 0.167)]),
];

fn library(surface: Surface, take: Take) -> MaterialLibrary {
    MaterialLibrary::of_scene(&Scene { surface, take, ..Scene::default() })
}

/// A scene with these bodies and tables.
fn lay_out(text: &str) -> Loaded {
    let text = format!("(format: 1, duration: 1.0, allow_overlap: true, {text})");
    Scene::parse(&text, "test.ron").unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn library_of(text: &str) -> MaterialLibrary {
    lay_out(&format!("bodies: [], {text}")).materials
}

#[test]
fn every_row_of_the_lecture_stands_in_the_table_with_its_ranges() {
    let table = lecture_table();
    assert_eq!(table.pairs.len(), ROWS.len());
    for (pair, (a, b, figures)) in table.pairs.iter().zip(ROWS) {
        assert_eq!(pair.between, (a.to_owned(), b.to_owned()));
        let written = [
            pair.dry.static_friction,
            pair.lubricated.static_friction,
            pair.dry.kinetic_friction,
            pair.lubricated.kinetic_friction,
        ];
        assert_eq!(written.map(|figure| figure.map(|range| (range.low, range.high))), figures, "{a} / {b}");
        assert_eq!(pair.restitution, None);
    }
}

#[test]
fn wet_figures_are_noted() {
    let noted: Vec<(String, String)> = lecture_table()
        .pairs
        .iter()
        .filter(|pair| pair.lubricated.note.contains("wet"))
        .map(|pair| pair.between.clone())
        .collect();
    let expected = [("alumina", "silicon nitride"), ("concrete", "rubber"), ("wood", "metal"), ("wood", "wood")];
    assert_eq!(noted, expected.map(|(a, b)| (a.to_owned(), b.to_owned())));
}

#[test]
fn every_row_is_looked_up_in_either_order_with_absent_figures_filled_in() {
    for take in [Take::Low, Take::Midpoint, Take::High] {
        let pick = |figure: Range| {
            figure.map(|(low, high)| match take {
                Take::Low => low,
                Take::High => high,
                Take::Midpoint => 0.5 * (low + high),
            })
        };
        for (surface, first) in [(Surface::Dry, 0), (Surface::Lubricated, 1)] {
            let library = library(surface, take);
            for (a, b, figures) in ROWS {
                let in_state = |first: usize| (pick(figures[first]), pick(figures[first + 2]));
                // The other surface state stands in where this one has nothing; then one coefficient for the other.
                let (of_rest, of_motion) = match in_state(first) {
                    (None, None) => in_state(1 - first),
                    given => given,
                };
                let static_friction = of_rest.or(of_motion).expect("each row has a figure");
                let kinetic_friction = of_motion.or(of_rest).expect("each row has a figure");
                let expected = PairProperties { static_friction, kinetic_friction, restitution: 0.0 };
                let found = library.pair(a, b);
                assert_eq!(found.properties, expected, "{a} / {b} {surface:?}");
                assert_eq!(found, library.pair(b, a));
                let has = |wanted: fn(&MaterialNotice) -> bool| found.notices.iter().any(wanted);
                let one_for_both = of_rest.is_none() || of_motion.is_none();
                assert_eq!(
                    has(|notice| matches!(notice, MaterialNotice::OneForBoth { .. })),
                    one_for_both,
                    "{a} / {b}"
                );
                let above = kinetic_friction > static_friction;
                assert_eq!(
                    has(|notice| matches!(notice, MaterialNotice::KineticAboveStatic { .. })),
                    above,
                    "{a} / {b}"
                );
                let other_state = in_state(first) == (None, None);
                assert_eq!(
                    has(|notice| matches!(notice, MaterialNotice::OtherSurface { .. })),
                    other_state,
                    "{a} / {b}"
                );
            }
        }
    }
}

#[test]
fn an_unlisted_pair_combines_its_materials() {
    let library = library_of(
        r#"materials: {
            "ball": (static_friction: 0.4, restitution: 0.9),
            "floor": (static_friction: 0.9, kinetic_friction: 0.4, restitution: 0.2),
        }"#,
    );
    let pair = library.pair("floor", "ball").properties;
    // √(0.4 · 0.9) = 0.6 and √(0.4 · 0.4) = 0.4; the square root is exact to half an ulp of the product's rounding.
    assert!((pair.static_friction - 0.6).abs() < 1e-15, "{pair:?}");
    assert_eq!(pair.kinetic_friction, 0.4);
    assert_eq!(pair.restitution, 0.9);
    assert_eq!(library.pair("ball", "ball").properties.static_friction, 0.4);
}

#[test]
fn an_unlisted_pair_of_the_table_uses_each_material_against_itself() {
    let library = library(Surface::Dry, Take::Midpoint);
    let steel = library.pair("steel", "steel").properties;
    let glass = library.pair("glass", "glass").properties;
    let both = library.pair("steel", "glass").properties;
    assert_eq!(both.static_friction, (steel.static_friction * glass.static_friction).sqrt());
    assert_eq!(both.kinetic_friction, (steel.kinetic_friction * glass.kinetic_friction).sqrt());
}

#[test]
fn a_pair_of_which_nothing_is_known_has_no_friction_and_a_notice() {
    let found = library(Surface::Dry, Take::Midpoint).pair("zinc", "gold");
    assert_eq!(found.properties.static_friction, 0.0);
    assert!(found.notices.contains(&MaterialNotice::NoFriction { material: "zinc".into() }), "{found:?}");
}

#[test]
fn what_the_scene_says_is_stronger_than_the_table() {
    let by_material = library_of(r#"materials: {"steel": (static_friction: 0.3)}"#);
    assert_eq!(by_material.pair("steel", "steel").properties.static_friction, 0.3);
    let by_pair = library_of(
        r#"pairs: [(between: ("ice", "steel"), dry: (static_friction: 0.5, kinetic_friction: 0.4), restitution: 0.1)]"#,
    );
    let expected = PairProperties { static_friction: 0.5, kinetic_friction: 0.4, restitution: 0.1 };
    assert_eq!(by_pair.pair("steel", "ice").properties, expected);
    let bounce_only = library_of(r#"pairs: [(between: ("ice", "steel"), restitution: 0.6)]"#);
    let expected = PairProperties { static_friction: 0.03, kinetic_friction: 0.03, restitution: 0.6 };
    assert_eq!(bounce_only.pair("steel", "ice").properties, expected);
}

#[test]
fn a_pair_is_stronger_than_materials_of_the_same_table() {
    let library = library_of(
        r#"materials: {"a": (static_friction: 1, restitution: 1), "b": (static_friction: 1)},
           pairs: [(between: ("b", "a"), dry: (static_friction: 0.2, kinetic_friction: 0.1), restitution: 0.5)]"#,
    );
    let expected = PairProperties { static_friction: 0.2, kinetic_friction: 0.1, restitution: 0.5 };
    assert_eq!(library.pair("a", "b").properties, expected);
}

#[test]
fn the_material_of_bodies_that_name_none_is_frictionless_unless_defined() {
    let plain = library(Surface::Dry, Take::Midpoint).pair("default", "default");
    assert_eq!((plain.properties, plain.notices.len()), (PairProperties::default(), 0));
    let defined = library_of(r#"materials: {"default": (static_friction: 0.5)}"#).pair("default", "default");
    assert_eq!(defined.properties.kinetic_friction, 0.5);
}

#[test]
fn tables_of_files_lie_between_the_lecture_and_the_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("the folder is writable");
    write(
        "a.ron",
        r#"(format: 1, pairs: [(between: ("ice", "ice"), dry: (static_friction: 0.7)), (between: ("x", "y"), dry: (static_friction: 0.1))])"#,
    );
    write("b.ron", r#"(format: 1, materials: {"x": (static_friction: 0.8), "y": (static_friction: 0.8)})"#);
    write(
        "scene.ron",
        r#"(format: 1, duration: 1.0, bodies: [], materials_from: ["a.ron", "b.ron"], materials: {"y": (restitution: 0.5)})"#,
    );
    let loaded = Scene::load(folder.path().join("scene.ron")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(loaded.materials.pair("ice", "ice").properties.static_friction, 0.7);
    // The second file speaks of both materials and lies above the pair of the first.
    assert_eq!(loaded.materials.pair("x", "y").properties.static_friction, 0.8);
    assert_eq!(loaded.materials.pair("x", "y").properties.restitution, 0.5);
}

#[test]
fn mistakes_of_a_table_are_told_with_its_own_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("the folder is writable");
    write("bad.ron", "(\n  format: 1,\n  pairs: [(between: (\"ice\", \"ice\"), dry: (static_friction: -0.7))],\n)");
    write("scene.ron", "(format: 1, duration: 1.0, bodies: [], materials_from: [\"bad.ron\", \"none.ron\"])");
    let message = Scene::load(folder.path().join("scene.ron")).expect_err("the table is wrong").to_string();
    assert!(message.contains("bad.ron:3:60"), "{message}");
    assert!(message.contains("a friction coefficient must not be negative"), "{message}");
    assert!(message.contains("none.ron\" cannot be read"), "{message}");
}

/// The pairs that can meet, as `a+b`.
fn pairs(text: &str) -> Vec<String> {
    meetings(&lay_out(text).scene).into_iter().map(|meeting| meeting.materials.join("+")).collect()
}

#[test]
fn materials_meet_where_a_body_moves_and_two_bodies_are_there() {
    let floor_and_ball = r#"bodies: [
        (name: "floor", kind: Static, material: "ice", parts: [HalfPlane()]),
        (name: "lift", kind: Kinematic, material: "glass", parts: [Disc(radius: 1)]),
        (name: "ball", material: "wood", parts: [Disc(radius: 1)]),
    ]"#;
    assert_eq!(
        pairs(floor_and_ball),
        ["glass+wood", "ice+wood"],
        "one ball meets no other, and what is driven meets no floor"
    );
    let two_balls = r#"bodies: [(name: "ball", material: "wood", parts: [Disc(radius: 1)], repeat: Line(count: 2, spacing: (3, 0)))]"#;
    assert_eq!(pairs(two_balls), ["wood+wood"]);
    let plain =
        r#"bodies: [(name: "a", parts: [Disc(radius: 1)]), (name: "b", parts: [Disc(radius: 1, material: "ice")])]"#;
    assert_eq!(pairs(plain), ["default+ice"]);
}

#[test]
fn sensors_groups_and_ignored_bodies_keep_materials_apart() {
    let sensor = r#"bodies: [
        (name: "gate", kind: Static, material: "ice", parts: [Box(size: (1, 1), sensor: true)]),
        (name: "ball", material: "wood", parts: [Disc(radius: 1)]),
    ]"#;
    assert!(pairs(sensor).is_empty());
    let grouped = |groups: &str| {
        pairs(&format!(
            r#"bodies: [
                (name: "wall", kind: Static, material: "ice", groups: ["walls"], parts: [Box(size: (1, 1))]),
                (name: "ball", material: "wood", groups: ["balls"], collides_with: [{groups}], parts: [Disc(radius: 1)]),
            ]"#
        ))
    };
    assert_eq!(grouped(r#""walls", "balls""#), ["ice+wood"]);
    assert!(grouped(r#""balls""#).is_empty());
    let ignored = |ignores: &str| {
        pairs(&format!(
            r#"bodies: [
                (name: "ball", material: "wood", parts: [Disc(radius: 1)], repeat: Line(count: 2, spacing: (3, 0))),
                (name: "box", material: "ice", ignores: [{ignores}], parts: [Box(size: (1, 1))]),
            ]"#
        ))
    };
    assert_eq!(ignored(r#""ball-0""#), ["ice+wood", "wood+wood"], "the other ball still meets the box");
    assert_eq!(ignored(r#""ball""#), ["wood+wood"]);
}

#[test]
fn notices_are_about_materials_that_can_meet() {
    // Steel against itself has a kinetic coefficient only in the scene's own table, which two steel bodies would need.
    let scene = |ignores: &str| {
        lay_out(&format!(
            r#"pairs: [(between: ("tin", "tin"), dry: (kinetic_friction: 0.4))], bodies: [
                (name: "a", material: "tin", parts: [Disc(radius: 1)]),
                (name: "b", material: "tin", ignores: [{ignores}], parts: [Disc(radius: 1)]),
            ]"#
        ))
    };
    assert!(scene("").warnings.to_string().contains("\"tin\" on \"tin\": no static friction is known"));
    assert_eq!(scene(r#""a""#).warnings.len(), 0);
}

#[test]
fn each_figure_says_where_it_came_from() {
    let library = library_of(
        r#"surface: Dry,
        materials: {
            "ball": (static_friction: 0.4, restitution: 0.9),
            "floor": (static_friction: (0.2, 0.6), kinetic_friction: 0.1, restitution: 0.2),
            "felt": (),
        },
        pairs: [
            (between: ("cup", "table"), dry: (static_friction: (0.2, 0.6)), restitution: 0.5),
            (between: ("cup", "tray"), lubricated: (static_friction: 0.1, kinetic_friction: 0.1)),
        ]"#,
    );
    let origins = |a: &str, b: &str| {
        let origins = library.pair(a, b).origins;
        assert_eq!(origins, library.pair(b, a).origins, "in either order");
        [origins.static_friction, origins.kinetic_friction, origins.restitution].map(|origin| origin.to_string())
    };
    assert_eq!(origins("cup", "table"), ["pair, middle of 0.2 to 0.6", "pair, middle of 0.2 to 0.6, like μ_s", "pair"]);
    assert_eq!(origins("cup", "tray"), ["pair, of lubricated surfaces", "pair, of lubricated surfaces", "not set"]);
    assert_eq!(origins("ball", "ball"), ["\"ball\"", "\"ball\", like μ_s", "\"ball\""]);
    assert_eq!(
        origins("floor", "ball"),
        ["√(0.4 · 0.4), middle of 0.2 to 0.6", "√(0.4 · 0.1), like μ_s", "\"ball\""],
        "the materials combine, and the one that bounces more decides"
    );
    assert_eq!(origins("felt", "floor"), ["not set", "not set", "\"floor\""]);
    assert_eq!(origins("cup", "cup"), ["not set"; 3]);
}
