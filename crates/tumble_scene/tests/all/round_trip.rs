//! Scene → simulation → scene → simulation: the same bits.

use glam::{DVec2, dvec2, dvec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tumble_math::{Planar, Rotation, Spatial};
use tumble_record::{Fingerprint, Record};
use tumble_scene::format::{
    AnchorEntry, Axes, Axis, BodyEntry, BodyKind, BoxPart, ContactModel, DiscPart, Drag, Expectation, ForceEntry,
    FrictionEntry, Groups, HalfPlanePart, ImpulseEntry, Integrator, KeptExpectation, Keyframe, MaterialEntry,
    ModelEntries, PairEntry, Part, PenaltyEntry, PenaltyLaw, PolygonPart, RodPart, Scene, SpringEntry,
};
use tumble_scene::shipped::SHIPPED;
use tumble_scene::{AnyLoaded, Check, FromScene, Loaded, SceneDim, ToScene, UnwritableError};
use tumble_sim::{Orientation, Position, QuadraticDrag, Settings, Simulation, SleepSettings};

/// The state after some steps, or where and why the run failed.
fn state_after<D: SceneDim>(steps: u32, simulation: &mut Simulation<D>) -> Result<Fingerprint, String> {
    simulation.record(u32::MAX).map_err(|error| error.to_string())?;
    for _ in 0..steps {
        simulation.step().map_err(|error| error.to_string())?;
    }
    let recording = simulation.recording().ok_or("nothing was recorded")?;
    recording.samples.last().map(|last| recording.fingerprint(last)).ok_or_else(|| "no sample".into())
}

/// Builds a scene, writes it, reads and builds what was written, and compares both after 100 steps.
fn same_bits_after_a_round_trip<D: SceneDim>(mut first: Simulation<D>) -> Result<(), String> {
    let written = first.to_scene().map_err(|error| error.to_string())?;
    let text = written.to_ron();
    let read = Loaded::<D>::parse(&text, "written.ron").map_err(|mistakes| format!("{mistakes}\n{text}"))?;
    if read.scene != written {
        return Err(format!("reading gives another scene\n{text}"));
    }
    let mut second = Simulation::from_loaded(&read).map_err(|error| format!("{error}\n{text}"))?;
    let again = second.to_scene().map_err(|error| error.to_string())?;
    if again != written {
        return Err(format!("writing again gives another scene\n{text}\n{}", again.to_ron()));
    }
    let (one, two) = (state_after(100, &mut first), state_after(100, &mut second));
    if one == two { Ok(()) } else { Err(format!("{one:?} became {two:?}\n{text}")) }
}

#[test]
fn shipped_scenes_come_back_bit_for_bit() {
    for shipped in SHIPPED {
        let loaded = shipped.load_any().unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let compared = match loaded {
            AnyLoaded::Planar(loaded) => Simulation::from_loaded(&loaded).map(same_bits_after_a_round_trip),
            AnyLoaded::Spatial(loaded) => Simulation::from_loaded(&loaded).map(same_bits_after_a_round_trip),
        };
        let compared = compared.unwrap_or_else(|error| panic!("{}: {error}", shipped.name));
        compared.unwrap_or_else(|reason| panic!("{}: {reason}", shipped.name));
    }
}

#[test]
fn soft_steps_that_sleep_come_back_bit_for_bit() -> Result<(), Box<dyn std::error::Error>> {
    for (sleep, expected) in [
        ("sleep: ()", Some(SleepSettings { speed: 0.05 * 0.5, after: 0.5 })),
        ("sleep: (speed: 0.2, after: 0.1)", Some(SleepSettings { speed: 0.2, after: 0.1 })),
        ("substeps: 3", None),
    ] {
        let text = format!(
            r#"(
            format: 1, duration: 1, contact: SoftStep, length_scale: 0.5, models: (soft_step: ({sleep})),
            bodies: [
                (name: "floor", kind: Static, parts: [HalfPlane()]),
                (name: "box", at: (0, 0.6), parts: [Box(size: (1, 1))]),
            ],
        )"#
        );
        let simulation = Simulation::<Planar>::from_loaded(&Loaded::parse(&text, "sleep.ron")?)?;
        assert_eq!(simulation.settings().sleep, expected);
        same_bits_after_a_round_trip(simulation)?;
    }
    Ok(())
}

#[test]
fn everything_that_space_has_comes_back_bit_for_bit() -> Result<(), Box<dyn std::error::Error>> {
    let text = r#"(
        format: 1, dimension: Spatial, duration: 1, gravity: (0, -9.81, 0.1), contact: VelocityLcp,
        materials: { "rubber": (static_friction: 0.8, kinetic_friction: 0.7, restitution: 0.3) },
        part_lists: { "hammer": [
            Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0.1, density: 3),
            Box(size: (0.4, 0.2, 0.2), at: (0, 1, 0), orientation: Turn(axis: (0, 1, 0), angle_degrees: 30)),
        ] },
        bodies: [
            (name: "floor", kind: Static, at: (0, -5, 0), material: "rubber", parts: [HalfSpace(normal: (0.1, 1, 0.2))]),
            (name: "hammer", at: (3, 0, 0), angular_velocity: (1, 2, 3), parts: [List("hammer")], ignores: ["stone"],
                orientation: Turns([(axis: (1, 0, 0), angle_degrees: 20), (axis: (0, 1, 1), angle_degrees: -70)])),
            (name: "stone", velocity: (0, 0, 1), material: "rubber", orientation: Quaternion(1, 2, 3, 4), parts: [
                Hull(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], mass: 2),
            ]),
            (name: "pill", at: (-3, 0, 0), centre: (0.1, 0, 0), inertia: Tensor(xx: 1, yy: 2, zz: 2.5, xy: 0.1), parts: [
                Capsule(from: (0, 0, 0), to: (0, 0, 1), radius: 0.2), Sphere(radius: 0.3, groups: 2, collides_with: 1),
            ]),
            (name: "crate", at: (0, 4, 0), parts: [Box(size: (0.5, 0.5, 0.5))], locked: [Z],
                repeat: Grid(count: (2, 2, 2), spacing: (1, 1, 1), jitter: (at: (0.1, 0.1, 0.1), angle_degrees: 20))),
            (name: "top", at: (9, 0, 0), parts: [Cone(base: (0, 1, 0), tip: (0, 0, 0), radius: 0.5)], pinned: true),
            (name: "stick", at: (9, 0, 9), inertia: Diagonal(0.1, 0.1, 0.1), parts: [Rod(from: (0, 0, 0), to: (1, 0, 0))]),
        ],
        springs: [(from: World(point: (3, 5, 0)), to: Body(name: "hammer", point: (0, 1, 0)), stiffness: 3)],
        joints: [
            (name: "ball", kind: Spherical, a: World(point: (9, 0, 9)), b: Body(name: "stick", point: (0, 0, 0))),
            (name: "hinge", kind: Revolute(axis: (0, 1, 0)), a: World(point: (-3, 0, 0)), b: Body(name: "pill", point: (0, 0, 0))),
            (name: "weld", kind: Fixed, a: Body(name: "crate-0-0-0"), b: Body(name: "crate-1-1-1"), allow_gap: true),
            (name: "slide", kind: Prismatic(axis: (0, 0, 2)), a: World(point: (0, 0, 0)), b: Body(name: "stone", point: (0, 0, 0))),
            (name: "rope", kind: Distance(length: 3.4), a: Body(name: "stone"), b: Body(name: "pill"), allow_gap: true),
        ],
        forces: [(on: "hammer", force: (1, 0, 0), torque: (0, 0.1, 0), axes: Body, until: 0.5)],
        expect: [TurnRate(of: "hammer", always: true, below: 100), AngularVelocityZ(of: "hammer", at: 0, is: 3, within: 1e-9), Orientation(of: "top", always: true, within_degrees: 1)],
    )"#;
    let loaded = Loaded::<Spatial>::parse(text, "all.ron")?;
    Ok(same_bits_after_a_round_trip(Simulation::from_loaded(&loaded)?)?)
}

#[test]
fn keyframes_of_space_come_back_bit_for_bit() -> Result<(), Box<dyn std::error::Error>> {
    // The centre of mass is beside the origin of the design frame, so a path of the one is not that of the other.
    let text = r#"(
        format: 1, dimension: Spatial, dt: 0.01, duration: 1, gravity: (0, 0, -9.81),
        bodies: [
            (name: "table", kind: Kinematic, at: (0.1, -0.1, 0), centre: (0.3, 0, 0.2),
                parts: [Box(size: (2, 2, 0.2))],
                keyframes: [
                    (time: 0.1, at: (0.1, -0.1, 0)),
                    (time: 0.3, at: (0.2, 0, 0.3), orientation: Turn(axis: (0, 0, 1), angle_degrees: 40)),
                    (time: 0.6, at: (0.2, 0.1, 0.3),
                        orientation: Turns([(axis: (1, 0, 0), angle_degrees: 20), (axis: (0, 1, 1), angle_degrees: -70)])),
                    (time: 0.9, at: (-0.2, 0.1, 0), orientation: Quaternion(1, 2, 3, 4)),
                ]),
            (name: "crate", at: (0.3, 0.2, 0.35), parts: [Box(size: (0.5, 0.5, 0.5), density: 2)]),
        ],
    )"#;
    let loaded = Loaded::<Spatial>::parse(text, "table.ron")?;
    let mut simulation = Simulation::from_loaded(&loaded)?;
    let path = |scene: &Scene<Spatial>| {
        let table = scene.bodies.iter().find(|body| body.name == "table").expect("the table");
        table.keyframes.clone()
    };
    let (given, written) = (path(&loaded.scene), path(&simulation.to_scene()?));
    assert_eq!(written.len(), given.len());
    for (given, written) in given.iter().zip(&written) {
        assert_eq!(written.time, given.time);
        // Through the centre of mass and back: round-off of coordinates below 1.
        assert!((written.at - given.at).length() < 1e-15, "{} became {}", given.at, written.at);
        let [from, to] = [given, written].map(|frame| Spatial::keyframe_rotation(frame).expect("a rotation"));
        assert!(from.angle_to(&to).length() < 1e-14, "at {} s", given.time);
    }
    let mut moved = Simulation::from_loaded(&loaded)?;
    moved.run_for(1.0)?;
    assert!(
        (moved.body("crate")?.position() - dvec3(0.3, 0.2, 0.35)).length() > 0.1,
        "the table takes the crate along"
    );
    Ok(same_bits_after_a_round_trip(simulation)?)
}

#[test]
fn expectations_about_bodies_that_are_there_are_kept() -> Result<(), Box<dyn std::error::Error>> {
    let text = r#"(
        format: 1, duration: 1,
        bodies: [
            (name: "stays", parts: [Disc(radius: 1)]),
            (name: "goes", at: (3, 0), parts: [Disc(radius: 1)], repeat: Line(count: 2, spacing: (3, 0))),
        ],
        expect: [
            Speed(of: "stays", at: 1, below: 10, because: "g t"),
            Speed(of: "goes-1", at: 1, below: 10, because: "g t"),
            Never(event: Touch("stays", "goes-1"), because: "they fall side by side"),
        ],
    )"#;
    let mut simulation = Simulation::from_loaded(&Scene::parse(text, "row.ron")?)?;
    simulation.expect(Expectation::MomentumKept(KeptExpectation { within: 1.0, ..KeptExpectation::default() }));
    let names = |scene: &Scene| scene.expect.iter().map(Expectation::name).collect::<Vec<_>>();
    assert_eq!(names(&simulation.to_scene()?), ["Speed", "Speed", "Never", "MomentumKept"]);
    let gone = simulation.entity("goes-1")?;
    simulation.world_mut().despawn(gone);
    assert_eq!(names(&simulation.to_scene()?), ["Speed", "MomentumKept"]);
    Ok(())
}

#[test]
fn bodies_that_overlap_at_the_start_may_do_so_in_the_scene() -> Result<(), Box<dyn std::error::Error>> {
    let mut simulation = Simulation::new(Settings::default());
    for x in [0.0, 0.5] {
        let body = simulation.spawn(Position(dvec2(x, 0.0)));
        let disc = tumble_shape::Disc::try_new(DVec2::ZERO, 0.5)?;
        simulation.attach(body, tumble_sim::Part::new(disc, tumble_sim::Amount::Density(1.0)));
    }
    let scene = simulation.to_scene()?;
    assert!(scene.allow_overlap);
    assert_eq!(scene.bodies[0].groups, Groups::ALL, "groups that nobody uses are left out");
    same_bits_after_a_round_trip(simulation)?;
    Ok(())
}

#[test]
fn joints_come_back_bit_for_bit() -> Result<(), Box<dyn std::error::Error>> {
    // The names of joints sort against their order, one is that of a body, and one is open.
    let text = r#"(
        format: 1, duration: 1,
        bodies: [
            (name: "arm", at: (0.1, 0.3), angle_degrees: 17, parts: [Rod(from: (0, 0), to: (1, 0))]),
            (name: "bob", at: (2.3, 0.7), angular_velocity: 2, parts: [Disc(at: (0.1, 0.2), radius: 0.3)]),
            (name: "cart", at: (5, 1), velocity: (1, 0), parts: [Box(size: (1, 0.5))]),
            (name: "deck", at: (5, 1.25), parts: [Box(size: (0.4, 0.5))]),
        ],
        joints: [
            (name: "z", kind: Revolute, a: World(point: (0.1, 0.3)), b: Body(name: "arm", point: (0, 0))),
            (name: "bob", kind: Distance(), a: Body(name: "bob", point: (0, 0.1)), b: Body(name: "arm", point: (1, 0))),
            (name: "y", kind: Prismatic(axis: (3, 0)), a: World(point: (0, 1.1)), b: Body(name: "cart"), allow_gap: true),
            (name: "x", kind: Fixed, a: Body(name: "cart", point: (0, 0.25)), b: Body(name: "deck", point: (0, 0))),
        ],
    )"#;
    let mut simulation = Simulation::from_loaded(&Scene::parse(text, "joints.ron")?)?;
    let written = simulation.to_scene()?;
    let open: Vec<&str> = written.joints.iter().filter(|joint| joint.allow_gap).map(|joint| &*joint.name).collect();
    assert_eq!((written.joints.len(), open), (4, vec!["y"]));
    Ok(same_bits_after_a_round_trip(simulation)?)
}

#[test]
fn what_scenes_have_no_word_for_is_refused() {
    let mut simulation = Simulation::new(Settings { speculative_limit: Some(3.0), ..Settings::default() });
    assert_eq!(simulation.to_scene(), Err(UnwritableError::Setting("speculative_limit")));
    let mut simulation = Simulation::new(Settings::default());
    let drag = QuadraticDrag { translation: 0.0, rotation: 1.0 };
    let body = simulation.spawn((Position(DVec2::ZERO), Orientation::<tumble_math::PlanarRotation>::default(), drag));
    let disc = tumble_shape::Disc::try_new(DVec2::ZERO, 0.5).expect("a disc");
    simulation.attach(body, tumble_sim::Part::new(disc, tumble_sim::Amount::Density(1.0)));
    let refusal = simulation.to_scene().expect_err("there is no word for it");
    assert_eq!(
        refusal.to_string(),
        "body \"body-0\" has quadratic drag against rotation, which cannot be written in a scene"
    );
}

fn vector(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(DVec2::from)
}

fn maybe<S: Strategy>(strategy: S) -> impl Strategy<Value = Option<S::Value>> {
    proptest::option::of(strategy)
}

fn material() -> impl Strategy<Value = Option<String>> {
    maybe(prop_oneof![Just("steel".to_owned()), Just("mine".to_owned()), Just("rubber".to_owned())])
}

fn part() -> impl Strategy<Value = Part> {
    let common = (maybe(0.5..2.0), material(), proptest::bool::weighted(0.1), maybe((1..4_u32).prop_map(Groups::Bits)));
    let shape = (0..4_u8, vector(1.0), vector(1.0), 0.05..0.5, -180.0..180.0);
    (shape, common).prop_map(|((kind, a, b, radius, angle_degrees), (density, material, sensor, groups))| match kind {
        0 => {
            let (from, to) = (a, b + dvec2(2.0, 0.0));
            Part::Rod(RodPart {
                from,
                to,
                radius: 0.1 * radius,
                density,
                material,
                sensor,
                groups,
                ..RodPart::default()
            })
        }
        1 => Part::Disc(DiscPart { radius, at: a, mass: density, material, sensor, groups, ..DiscPart::default() }),
        2 => {
            let points = vec![a, a + dvec2(radius, 0.1), a + dvec2(0.0, 1.0), a - dvec2(radius, 0.0)];
            Part::Polygon(PolygonPart { points, density, material, sensor, groups, ..PolygonPart::default() })
        }
        _ => {
            let size = dvec2(radius, 0.7);
            Part::Box(BoxPart { size, at: a, angle_degrees, density, material, sensor, groups, ..BoxPart::default() })
        }
    })
}

fn body(index: usize) -> impl Strategy<Value = BodyEntry> {
    let state = (vector(4.0), -400.0..400.0, vector(2.0), -3.0..3.0);
    let mass = (maybe(0.5..3.0), maybe(vector(0.3)), maybe(0.5..2.0), 0..3_u8);
    let motion = (maybe(0.0..1.5), maybe(0.0..1.0), maybe(0.0..1.0), proptest::bool::weighted(0.1));
    let parts = proptest::collection::vec(part(), 1..4);
    let locked = proptest::sample::subsequence(vec![Axis::X, Axis::Y, Axis::Angle], 0..2);
    (state, mass, motion, parts, material(), locked, 0..6_u8).prop_map(
        move |(
            (at, angle_degrees, velocity, spin),
            (mass, centre, inertia, _),
            motion,
            parts,
            material,
            locked,
            kind,
        )| {
            let (scale, linear, quadratic, pinned) = motion;
            let mut body = BodyEntry {
                name: format!("body-{index}"),
                at: at + dvec2(3.0 * index as f64, 4.0),
                angle_degrees,
                velocity,
                angular_velocity: spin,
                parts,
                material,
                mass,
                centre,
                inertia,
                gravity_scale: scale.unwrap_or(1.0),
                drag: Drag {
                    linear: linear.unwrap_or(0.0),
                    quadratic: quadratic.unwrap_or(0.0),
                    turning: 0.1 * linear.unwrap_or(0.0),
                },
                pinned,
                locked,
                ..BodyEntry::default()
            };
            if kind == 0 {
                body.kind = BodyKind::Kinematic;
                (body.velocity, body.angular_velocity) = (DVec2::ZERO, 0.0);
                body.keyframes = vec![
                    Keyframe { time: 0.1, at: body.at, angle_degrees, ..Keyframe::default() },
                    Keyframe {
                        time: 0.7,
                        at: body.at + velocity,
                        angle_degrees: angle_degrees + 50.0,
                        ..Keyframe::default()
                    },
                ];
            }
            body
        },
    )
}

fn floor() -> impl Strategy<Value = BodyEntry> {
    let plane = (-0.5..0.5, 0.5..2.0_f64, -1.0..1.0).prop_map(|(x, y, offset)| HalfPlanePart {
        normal: dvec2(x, y),
        offset,
        material: Some("steel".into()),
        ..HalfPlanePart::default()
    });
    (plane, vector(1.0), -20.0..20.0, maybe(vector(1.0))).prop_map(|(plane, at, angle_degrees, centre)| BodyEntry {
        name: "floor".into(),
        kind: BodyKind::Static,
        at,
        angle_degrees,
        centre,
        parts: vec![Part::HalfPlane(plane)],
        ignores: vec!["body-0".into()],
        ..BodyEntry::default()
    })
}

fn scene() -> impl Strategy<Value = Scene> {
    let bodies = (floor(), body(0), body(1), body(2), body(3)).prop_map(|(a, b, c, d, e)| vec![a, b, c, d, e]);
    let models = (any::<bool>(), any::<bool>(), maybe(100.0..1e4), maybe(1..50_u32), any::<bool>());
    let points = (vector(1.0), maybe(vector(1.0)), vector(3.0), maybe(0.5..2.0), any::<bool>());
    let figures = (0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64);
    (bodies, models, points, figures, 0.001..0.02, vector(10.0)).prop_map(
        |(
            bodies,
            (penalty, lecture, stiffness, iterations, ballistic),
            (a, b, force, rest_length, turning),
            figures,
            dt,
            gravity,
        )| {
            let (low, high, restitution, pair) = figures;
            let mine = MaterialEntry {
                static_friction: Some((low + high).into()),
                kinetic_friction: Some(low.into()),
                restitution: Some(restitution),
            };
            let bouncy = MaterialEntry { restitution: Some(high), ..MaterialEntry::default() };
            let dry = FrictionEntry { static_friction: Some(pair.into()), ..FrictionEntry::default() };
            Scene {
                dt,
                gravity,
                integrator: if ballistic { Integrator::Ballistic } else { Integrator::SymplecticEuler },
                contact: if penalty { ContactModel::Penalty } else { ContactModel::Impulse },
                models: ModelEntries {
                    penalty: PenaltyEntry {
                        law: if lecture { PenaltyLaw::Lecture } else { PenaltyLaw::SpringDamper },
                        stiffness,
                        ..PenaltyEntry::default()
                    },
                    impulse: ImpulseEntry { iterations, ..ImpulseEntry::default() },
                    ..ModelEntries::default()
                },
                allow_overlap: true,
                materials: [("mine".to_owned(), mine), ("rubber".to_owned(), bouncy)].into(),
                pairs: vec![PairEntry { between: ("mine".into(), "steel".into()), dry, ..PairEntry::default() }],
                bodies,
                springs: vec![
                    SpringEntry {
                        from: AnchorEntry::World { point: a },
                        to: AnchorEntry::Body { name: "body-1".into(), point: b },
                        stiffness: 10.0,
                        damping: 0.1,
                        rest_length,
                    },
                    SpringEntry {
                        from: AnchorEntry::Body { name: "body-2".into(), point: Some(a) },
                        to: AnchorEntry::Body { name: "body-3".into(), point: None },
                        stiffness: 20.0,
                        damping: 0.0,
                        rest_length: None,
                    },
                ],
                forces: vec![ForceEntry {
                    on: "body-0".into(),
                    point: b,
                    force,
                    torque: 0.1,
                    axes: if turning { Axes::Body } else { Axes::World },
                    from: 0.1,
                    until: rest_length,
                    factor: vec![(0.0, 1.0), (0.5, 2.0)],
                }],
                ..Scene::default()
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, rng_seed: RngSeed::Fixed(17), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_scene_comes_back_bit_for_bit(scene in scene()) {
        let simulation = Simulation::from_scene(&scene).unwrap_or_else(|error| panic!("{error}\n{}", scene.to_ron()));
        if let Err(reason) = same_bits_after_a_round_trip(simulation) {
            prop_assert!(false, "{}", reason);
        }
    }
}
