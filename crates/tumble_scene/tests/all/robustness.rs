//! Nothing that can stand in a file makes the reader panic, hang or misread; what is written reads back equal.

use std::thread;
use std::time::Instant;

use glam::{DVec2, dvec2};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use tumble_scene::format::{
    AnchorEntry, AtRestExpectation, Axes, Axis, BodyEntry, BodyKind, BoxPart, Coefficient, ContactModel, DiscPart,
    Drag, Event, Expectation, ForceEntry, ForceExpectation, FrictionEntry, Groups, HalfPlanePart, ImpulseEntry,
    Integrator, Jitter, Keyframe, MaterialEntry, ModelEntries, OrderExpectation, PairEntry, Part, PenaltyEntry,
    PenaltyLaw, PolygonPart, Repeat, RepeatGrid, RepeatLine, RodPart, ScalarExpectation, Scene, SpringEntry, Surface,
    Take, TargetForce,
};

const FULL: &str = r##"#![enable(implicit_some)]
/* every kind of thing /* once */ */
Scene(
    format: 1, duration: 2, dt: 1e-2, gravity: (0, -9.81), about: r#"a "raw" text"#, seed: 0xff, every: 1_0,
    contact: Penalty, models: (penalty: (law: Lecture, stiffness: Some(3.0)), impulse: (iterations: None)),
    materials: {"box": (static_friction: (0.4, 0.5), kinetic_friction: 0.3)}, take: High, surface: Lubricated,
    pairs: [(between: ("box", "steel"), dry: (static_friction: 0.61))],
    part_lists: {"hammer": [Rod(from: (0, 0), to: (1, 0), density: 2.0), Disc(radius: 0.25, at: (1, 0))]},
    bodies: [
        (name: "floor", kind: Static, material: "steel", parts: [HalfPlane()], groups: ["walls"]), // the floor
        (name: "böx", at: (0, 1), material: "box", parts: [Box(size: (1, 1), mass: 2), List("hammer")], centre: (0, 0.1),
         locked: [X, Angle], repeat: Grid(count: (2, 3), spacing: (2, 2), jitter: (at: (0.1, 0)))),
    ],
    springs: [(from: World(point: (0, 1)), to: Body(name: "böx-0-0"), stiffness: 3)],
    forces: [(on: "böx-1-2", force: (1, 0), factor: [(0, 0), (1, 1)])],
    expect: [
        Speed(of: "böx-0-0", at: 2.0, is: 6.94, within: 0.02, because: "g\tt", under: [Impulse]),
        ContactForceSum(on: "böx-0-0", at: 1, is: Vector(0, 1), within: 0.1),
        Order(events: [Touch("floor", "böx-0-0"), Part("floor", "böx-0-0")]),
    ],
)
"##;

fn quick(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(11), failure_persistence: None, ..ProptestConfig::default() }
}

#[test]
fn a_scene_with_everything_is_read_and_written_back() {
    let loaded = Scene::parse(FULL, "full.ron").unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!((loaded.scene.seed, loaded.scene.every), (255, 10));
    assert_eq!(loaded.scene.expand().len(), 7);
    let text = loaded.scene.to_ron();
    let again = Scene::parse(&text, "again.ron").unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    assert_eq!(again.scene, loaded.scene);
}

#[test]
fn a_byte_order_mark_is_no_mistake() {
    assert!(Scene::parse(&format!("\u{FEFF}{FULL}"), "full.ron").is_ok());
}

#[test]
fn every_beginning_of_a_scene_is_refused_with_a_place() {
    let end = FULL.trim_end().len();
    for length in (0..end).filter(|&length| FULL.is_char_boundary(length)) {
        let mistakes = Scene::parse(&FULL[..length], "cut.ron").expect_err("the scene is cut");
        let first = mistakes.iter().next().expect("there is a mistake");
        assert!(mistakes.position(first).is_some(), "{mistakes}");
    }
}

#[test]
fn deep_nesting_is_refused_without_overflowing_the_stack() {
    for bracket in ["(", "[", "{\"a\":", "a(", "(a:", "Some("] {
        let mistakes = Scene::parse(&bracket.repeat(1_000_000), "deep.ron").expect_err("far too deep").to_string();
        assert!(mistakes.contains("brackets stand more than 64 levels deep"), "{mistakes}");
    }
    let comment = Scene::parse(&"/*".repeat(1_000_000), "deep.ron").expect_err("never ends").to_string();
    assert!(comment.contains("this comment never ends"), "{comment}");
}

#[test]
fn megabytes_of_mistakes_are_refused_within_seconds() {
    let start = Instant::now();
    let body = "(name: \"b\", parts: [Disc(radius: 1, densty: 2)]),\n";
    let many = format!("(format: 1, duration: 1, bodies: [\n{}])", body.repeat(2_000_000 / body.len()));
    let message = Scene::parse(&many, "many.ron").expect_err("a field is unknown").to_string();
    assert!(message.contains("more in many.ron"), "{}", message.len());
    assert!(message.len() < 50_000);
    let line = format!("(format: 1, duration: 1, about: \"{}\", x: 1)", "y".repeat(2_000_000));
    let message = Scene::parse(&line, "line.ron").expect_err("a field is unknown").to_string();
    assert!(message.contains("line.ron:1:2000037"), "{message}");
    assert!(message.len() < 2000);
    // Measured 5 s for both without optimisation on a busy core; a quadratic reader would take an hour.
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}

#[test]
fn a_missing_file_a_folder_and_bytes_that_are_no_text_are_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let message = |path: &std::path::Path| Scene::load(path).expect_err("no scene there").to_string();
    let missing = message(&folder.path().join("none.ron"));
    assert!(missing.contains("none.ron\" cannot be read") && missing.contains("os error 2"), "{missing}");
    assert!(message(folder.path()).contains("is a folder, not a file"));
    let binary = folder.path().join("binary.ron");
    std::fs::write(&binary, [b'(', b'\n', 0xff, 0xfe]).expect("the folder is writable");
    assert!(message(&binary).contains("is not a text in UTF-8: see line 2"));
}

#[test]
fn a_scene_built_in_code_is_checked_without_a_text() {
    let body = BodyEntry { name: "b".into(), mass: Some(f64::NAN), parts: vec![disc()], ..BodyEntry::default() };
    let scene = Scene { bodies: vec![body], ..Scene::default() };
    let library = tumble_scene::materials::MaterialLibrary::of_scene(&scene);
    let skyward = Scene { gravity: dvec2(0.0, f64::INFINITY), ..Scene::default() };
    let message = skyward.check(&library).expect_err("gravity is infinite").to_string();
    assert!(message.contains("gravity[1] must be finite") && message.contains("the scene: gravity[1]"), "{message}");
    let message = scene.check(&library).expect_err("the mass is NaN").to_string();
    assert!(message.contains("bodies[0].mass must be finite"), "{message}");
}

fn disc() -> Part {
    Part::Disc(DiscPart { radius: 1.0, ..DiscPart::default() })
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -10.0..10.0,
        Just(0.0),
        Just(1.0),
        Just(-9.81),
        Just(0.1 + 0.2),
        Just(1e-300),
        Just(6.02e23),
        Just(5e-324)
    ]
}

fn vector() -> impl Strategy<Value = DVec2> {
    (number(), number()).prop_map(|(x, y)| dvec2(x, y))
}

fn text() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,8}", any::<String>(), Just("\"quoted\" \\ \u{1b} \n".to_owned())]
}

fn groups() -> impl Strategy<Value = Groups> {
    prop_oneof![any::<u32>().prop_map(Groups::Bits), proptest::collection::vec(text(), 0..3).prop_map(Groups::Names)]
}

fn coefficient() -> impl Strategy<Value = Coefficient> {
    (number(), number()).prop_map(|(low, high)| Coefficient { low, high })
}

fn part() -> impl Strategy<Value = Part> {
    let maybe = proptest::option::of(number());
    prop_oneof![
        (vector(), vector(), number(), maybe, proptest::option::of(groups())).prop_map(
            |(from, to, radius, density, groups)| {
                Part::Rod(RodPart { from, to, radius, density, groups, ..RodPart::default() })
            }
        ),
        (number(), vector(), proptest::option::of(text()), any::<bool>()).prop_map(|(radius, at, material, sensor)| {
            Part::Disc(DiscPart { radius, at, material, sensor, ..DiscPart::default() })
        }),
        proptest::collection::vec(vector(), 0..5)
            .prop_map(|points| Part::Polygon(PolygonPart { points, ..PolygonPart::default() })),
        (vector(), number()).prop_map(|(size, angle_degrees)| Part::Box(BoxPart {
            size,
            angle_degrees,
            ..BoxPart::default()
        })),
        (vector(), number()).prop_map(|(normal, offset)| Part::HalfPlane(HalfPlanePart {
            normal,
            offset,
            ..HalfPlanePart::default()
        })),
        text().prop_map(Part::List),
    ]
}

fn body() -> impl Strategy<Value = BodyEntry> {
    let place = (text(), vector(), number(), vector(), proptest::option::of(vector()));
    let things = (proptest::collection::vec(part(), 0..4), groups(), proptest::option::of(number()), any::<bool>());
    let repeat = prop_oneof![
        Just(None),
        (any::<(u32, u32)>(), vector()).prop_map(|(count, spacing)| {
            Some(Repeat::Grid(RepeatGrid { count, spacing, jitter: Jitter { at: DVec2::ONE, angle_degrees: 2.0 } }))
        }),
        (any::<u32>(), vector()).prop_map(|(count, spacing)| Some(Repeat::Line(RepeatLine {
            count,
            spacing,
            jitter: Jitter::default()
        }))),
    ];
    (place, things, repeat).prop_map(
        |((name, at, angle_degrees, velocity, centre), (parts, groups, mass, flag), repeat)| BodyEntry {
            name,
            kind: if flag { BodyKind::Kinematic } else { BodyKind::Dynamic },
            at,
            angle_degrees,
            velocity,
            centre,
            parts,
            groups,
            mass,
            pinned: flag,
            locked: if flag { vec![Axis::Angle, Axis::Y] } else { Vec::new() },
            drag: Drag { linear: angle_degrees, quadratic: 0.0, turning: 0.0 },
            keyframes: if flag {
                vec![Keyframe { time: 1.0, at, angle_degrees, ..Keyframe::default() }]
            } else {
                Vec::new()
            },
            repeat,
            ..BodyEntry::default()
        },
    )
}

fn scene() -> impl Strategy<Value = Scene> {
    let settings = (text(), number(), number(), vector(), proptest::option::of(number()), any::<u64>(), any::<bool>());
    let materials = proptest::collection::btree_map(text(), (coefficient(), proptest::option::of(number())), 0..3);
    let lists = proptest::collection::btree_map(text(), proptest::collection::vec(part(), 0..3), 0..2);
    let bodies = proptest::collection::vec(body(), 0..4);
    let names = (text(), text());
    (settings, materials, lists, bodies, names, vector(), number()).prop_map(
        |((about, dt, duration, gravity, slop, seed, flag), materials, part_lists, bodies, (a, b), point, amount)| {
            Scene {
                about,
                dt,
                duration,
                gravity,
                slop,
                seed,
                allow_overlap: flag,
                integrator: if flag { Integrator::Ballistic } else { Integrator::SymplecticEuler },
                contact: if flag { ContactModel::Penalty } else { ContactModel::Impulse },
                models: ModelEntries {
                    penalty: PenaltyEntry { law: PenaltyLaw::Lecture, stiffness: slop, ..PenaltyEntry::default() },
                    impulse: ImpulseEntry { iterations: Some(7), ..ImpulseEntry::default() },
                    ..ModelEntries::default()
                },
                surface: if flag { Surface::Lubricated } else { Surface::Dry },
                take: if flag { Take::High } else { Take::Low },
                pairs: vec![PairEntry {
                    between: (a.clone(), b.clone()),
                    dry: FrictionEntry {
                        static_friction: Some(amount.into()),
                        note: a.clone(),
                        ..FrictionEntry::default()
                    },
                    ..PairEntry::default()
                }],
                materials: materials
                    .into_iter()
                    .map(|(name, (friction, restitution))| {
                        (
                            name,
                            MaterialEntry { static_friction: Some(friction), restitution, ..MaterialEntry::default() },
                        )
                    })
                    .collect(),
                part_lists,
                bodies,
                springs: vec![SpringEntry {
                    from: AnchorEntry::World { point },
                    to: AnchorEntry::Body { name: a.clone(), point: flag.then_some(point) },
                    stiffness: amount,
                    damping: 0.0,
                    rest_length: slop,
                }],
                forces: vec![ForceEntry {
                    on: b.clone(),
                    force: point,
                    axes: Axes::Body,
                    factor: vec![(0.0, amount), (1.0, 2.0)],
                    ..ForceEntry::default()
                }],
                expect: vec![
                    Expectation::Speed(ScalarExpectation {
                        of: a.clone(),
                        at: Some(amount),
                        below: slop,
                        ..ScalarExpectation::default()
                    }),
                    Expectation::AtRest(AtRestExpectation {
                        of: flag.then(|| a.clone()),
                        from: amount,
                        speed_below: 1e-3,
                        turn_below: amount,
                        drift_below: None,
                        because: b.clone(),
                        under: vec![ContactModel::Impulse],
                    }),
                    Expectation::ContactForceSum(ForceExpectation {
                        on: a.clone(),
                        by: None,
                        at: None,
                        from: None,
                        until: None,
                        is: if flag { TargetForce::Vector(dvec2(amount, 2.0)) } else { TargetForce::Newtons(amount) },
                        within: 0.5,
                        because: String::new(),
                        under: Vec::new(),
                    }),
                    Expectation::Order(OrderExpectation {
                        events: vec![Event::Touch(a.clone(), b.clone()), Event::Part(a, b)],
                        ..OrderExpectation::default()
                    }),
                ],
                ..Scene::default()
            }
        },
    )
}

/// Whatever a scene holds, sound or not, its text has no mistake of syntax or structure and reads back equal.
#[test]
fn what_is_written_reads_back_equal() {
    // The generator of random scenes keeps whole scenes on the stack, many times over where nothing is optimised.
    let test = || {
        let run = TestRunner::new(quick(150)).run(&scene(), |scene| {
            let text = scene.to_ron();
            let options = ron::Options::default().with_default_extension(
                ron::extensions::Extensions::IMPLICIT_SOME
                    | ron::extensions::Extensions::UNWRAP_NEWTYPES
                    | ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES,
            );
            let read: Scene =
                options.from_str(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
            prop_assert_eq!(&read, &scene, "{}", text);
            // The values are arbitrary, so the scene may be refused, but never for how it is written.
            if let Err(mistakes) = Scene::parse(&text, "scene.ron") {
                let placed = mistakes.iter().all(|mistake| !mistake.path.to_string().is_empty());
                prop_assert!(placed, "{}\n{}", mistakes, text);
            }
            Ok(())
        });
        run.map_err(|failure| failure.to_string())
    };
    let thread = thread::Builder::new().stack_size(64 << 20).spawn(test).expect("a thread can be started");
    thread.join().expect("nothing panics").expect("every scene comes back");
}

proptest! {
    #![proptest_config(quick(400))]

    #[test]
    fn no_text_makes_the_reader_panic(text in any::<String>()) {
        prop_assert!(Scene::parse(&text, "scene.ron").is_err());
    }

    #[test]
    fn no_heap_of_scene_words_makes_the_reader_panic(
        words in proptest::collection::vec(prop_oneof![
            Just("("), Just(")"), Just("["), Just("]"), Just("{"), Just("}"), Just(","), Just(":"), Just("="), Just("bodies"), Just("name"),
            Just("Rod"), Just("1"), Just("-1e3"), Just("\"a\""), Just("r#"), Just("\""), Just("/*"), Just("//"), Just("\n"), Just("None"),
            Just("Some("), Just("é"), Just("'"), Just("b\""), Just("\\"), Just("#![")
        ], 0..40),
    ) {
        if let Err(mistakes) = Scene::parse(&words.concat(), "scene.ron") {
            prop_assert!(!mistakes.to_string().is_empty());
        }
    }

    /// A scene with a few bytes cut out, doubled or replaced is read or refused; refused only with places that exist.
    #[test]
    fn no_damaged_scene_makes_the_reader_panic(
        damage in proptest::collection::vec((0.0..1.0, 0_usize..12, prop_oneof![Just(""), Just("("), Just("\""), Just("nan"), Just("]"), Just("9")]), 1..4),
    ) {
        let mut text = FULL.to_owned();
        for (place, length, with) in damage {
            let floor = |mut index: usize, text: &str| { while !text.is_char_boundary(index) { index -= 1; } index };
            let start = floor((place * text.len() as f64) as usize, &text);
            let end = floor((start + length).min(text.len()), &text).max(start);
            text.replace_range(start..end, with);
        }
        if let Err(mistakes) = Scene::parse(&text, "scene.ron") {
            prop_assert!(!mistakes.to_string().is_empty());
            prop_assert!(mistakes.iter().all(|mistake| mistake.span.as_ref().is_some_and(|span| span.end <= text.len())));
        }
    }
}
