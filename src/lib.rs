//! Rigid bodies in contact, simulated without a window: exact, exchangeable contact models, reproducible to the bit.
//!
//! A scene is a RON file or a few lines of Rust; what comes out is numbers, pictures and a verdict on what the scene promised. This page is a
//! tour of nine stops, each with a snippet that compiles and a link to where the code lives. The numbered course in `examples/` goes
//! on from here.
//!
//! # 1. A world in ten lines
//!
//! A [`Simulation`](sim::Simulation) is a `bevy_ecs` world and the schedule of a step. Bodies are entities with a [`Position`](sim::Position); shapes
//! are attached to them as [`Part`](sim::Part)s, which give them mass. SI units, radians, y upwards by default.
//!
//! ```
//! use tumble::prelude::*;
//!
//! let mut simulation = Simulation::new(Settings::default());
//! let floor = simulation.spawn((Name::new("floor"), BodyKind::Static, Position(dvec2(0.0, 0.0))));
//! simulation.attach(floor, Part::new(HalfPlane::try_new(dvec2(0.0, 1.0), 0.0)?, Amount::Density(0.0)));
//! let ball = simulation.spawn((Name::new("ball"), Position(dvec2(0.0, 2.0)), AngularVelocity(0.5)));
//! simulation.attach(ball, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.25)?, Amount::Mass(1.0)));
//!
//! simulation.run_for(3.0)?;
//! assert!((simulation.body("ball")?.position().y - 0.25).abs() < 1e-6); // it lies on the floor
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 2. The step
//!
//! Six phases, always in this order, each a [system set](sim::StepSystems) to hook systems of one's own into:
//!
//! ```text
//! 1 AccumulateForces     gravity, drag, springs, your forces, penalty contacts
//! 2 ComputeAccelerations a = M⁻¹ f
//! 3 FilterVelocities     v += a Δt; contacts take out what they forbid
//! 4 UpdatePositions      x += v Δt
//! 5 DetectCollisions     near pairs, then contact points
//! 6 ResolveImpulses      bounce where bodies still approach
//! ```
//!
//! A force of one's own is a system that adds to [`Force`](sim::Force); forces last one step and run in the order in which they are added.
//! The page to read is [`sim::schedule`].
//!
//! ```
//! use tumble::prelude::*;
//!
//! fn wind(mut bodies: Query<&mut Force<DVec2>>) {
//!     for mut force in &mut bodies {
//!         force.0.x += 2.0;
//!     }
//! }
//!
//! let mut simulation = Simulation::new(Settings::weightless());
//! simulation.spawn((Name::new("leaf"), Position(dvec2(0.0, 0.0)), MassOverride(0.5), InertiaOverride(1.0)));
//! simulation.add_force(wind);
//! simulation.run_for(1.0)?;
//! assert!((simulation.body("leaf")?.velocity().x - 4.0).abs() < 1e-12); // 2 N / 0.5 kg · 1 s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 3. Choosing a contact model
//!
//! One scene runs under every model, chosen by one word. [`Impulse`](sim::ContactModel::Impulse), the default, answers collisions one by one, worst
//! first, and holds what rests: exact restitution and friction, still stacks. [`Penalty`](sim::ContactModel::Penalty) pushes overlapping points
//! apart with springs and dampers: smooth forces, simultaneous contacts, at the price of sinking and creeping.
//! [`VelocityLcp`](sim::ContactModel::VelocityLcp) solves all contacts that hang together at once, with exact friction: the answer for coupled impacts, and rest without
//! creep. [`RestingLcp`](sim::ContactModel::RestingLcp) finds contact *forces* from conditions on accelerations, for few contacts. [`SoftStep`](sim::ContactModel::SoftStep)
//! takes substeps with soft contacts: for thousands of bodies, fast rather than exact. Ideas and equations stand in [`solver`], measured limits in `docs/models/`.
//!
//! ```
//! use tumble::prelude::*;
//!
//! for contact in ContactModel::ALL {
//!     let mut simulation = Simulation::new(Settings { contact, dt: 0.001, ..Settings::weightless() });
//!     let rubber = simulation.materials_mut().set("rubber", Surface { restitution: 0.5, ..Surface::default() });
//!     for (name, x, speed) in [("left", -1.0, 2.0), ("right", 1.0, -2.0)] {
//!         let ball = simulation.spawn((Name::new(name), Position(dvec2(x, 0.0)), LinearVelocity(dvec2(speed, 0.0))));
//!         simulation.attach(ball, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.5)?, Amount::Mass(1.0)).material(rubber));
//!     }
//!     simulation.run_for(1.0)?;
//!     assert!((simulation.body("right")?.velocity().x - 1.0).abs() < 0.05); // ε · 2 m/s; exact under impulses
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 4. Joints
//!
//! A [`Joint`](sim::Joint) is an entity that holds two bodies, or a body and the world, together: revolute, distance, fixed, prismatic; in
//! space a [`SpatialJointKind`](sim::SpatialJointKind), spherical besides. It holds to
//! round-off under every model but the penalty model, where it is a spring. Example 12 builds a mechanism of four.
//!
//! ```
//! use tumble::prelude::*;
//!
//! let mut simulation = Simulation::new(Settings { dt: 0.002, ..Settings::default() });
//! let rod = simulation.spawn((Name::new("rod"), Position(dvec2(0.5, 0.0))));
//! simulation.attach(rod, Part::new(Rod::try_new(dvec2(-0.5, 0.0), dvec2(0.5, 0.0), 0.0)?, Amount::Mass(1.0)));
//! let (a, b) = (Anchor::World(dvec2(0.0, 0.0)), Anchor::Body(rod, dvec2(-0.5, 0.0)));
//! simulation.spawn(Joint { a, b, kind: JointKind::Revolute });
//! simulation.run_for(10.0)?;
//! // The centre stays half a metre from the pin.
//! assert!((simulation.body("rod")?.position().length() - 0.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 5. Shapes
//!
//! [`Rod`](shape::Rod), [`Disc`](shape::Disc), [`ConvexPolygon`](shape::ConvexPolygon) and, for floors and walls, [`HalfPlane`](shape::HalfPlane).
//! Mass, centre and inertia of a body add up from its parts by the parallel-axis theorem; degenerate shapes are refused with the reason.
//! See [`shape`].
//!
//! ```
//! use tumble::prelude::*;
//! use tumble::shape::MassProperties;
//!
//! // An L of two rods of 1 kg/m.
//! let lying = Rod::try_new(dvec2(0.0, 0.0), dvec2(2.0, 0.0), 0.0)?.mass_properties(1.0);
//! let standing = Rod::try_new(dvec2(0.0, 0.0), dvec2(0.0, 1.0), 0.0)?.mass_properties(1.0);
//! let both = MassProperties::combine([lying, standing]).ok_or("no mass")?;
//! assert_eq!(both.mass, 3.0);
//! assert!((both.centre - dvec2(2.0 / 3.0, 1.0 / 6.0)).length() < 1e-15);
//! assert!(Rod::try_new(dvec2(1.0, 1.0), dvec2(1.0, 1.0), 0.0).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 6. Scenes and their promises
//!
//! A [`Scene`](scene::format::Scene) is plain data, read from RON with all mistakes of a file reported at once. It carries expectations, each with a tolerance
//! and a reason, so that a scene is its own test: [run it](scene::Check::run_scene) and [check it](scene::Check::check). A world built in code can be
//! [written as a scene](scene::ToScene). The format is [`scene::format`]. A file with `dimension: Spatial` is a scene of space:
//! [`AnyLoaded`](scene::AnyLoaded) reads scenes of either dimension, [`Loaded::<Spatial>`](scene::Loaded) those of space.
//!
//! ```
//! use tumble::prelude::*;
//!
//! let text = r#"(
//!     format: 1, duration: 1,
//!     materials: { "wood": (static_friction: 0.5, kinetic_friction: 0.4) },
//!     bodies: [
//!         (name: "floor", kind: Static, material: "wood", parts: [HalfPlane()]),
//!         (name: "box", at: (0, 0.5), velocity: (3, 0), material: "wood", parts: [Box(size: (1, 1))]),
//!     ],
//!     expect: [
//!         X(of: "box", at: 1, is: 1.147, within: 0.02, because: "it stops after v²/(2 μ_k g); first order: v Δt/2"),
//!         AtRest(of: "box", from: 0.9, because: "μ_k g t = v at 0.76 s"),
//!     ],
//! )"#;
//! let mut simulation = Simulation::from_loaded(&Scene::parse(text, "slide.ron")?)?;
//! simulation.run_scene()?;
//! let verdict = simulation.check();
//! assert!(verdict.passed(), "{verdict}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 7. Recording
//!
//! [`record`](record::Record::record) samples states and contacts while a simulation runs, and audits energy, momentum and overlap every step. From a
//! recording come CSV tables, plots, a replay that opens in a browser, glTF and PNG frames, and a fingerprint of every bit of the state, in the plane and in space. See [`record`].
//!
//! ```
//! use tumble::prelude::*;
//!
//! let mut simulation = Simulation::new(Settings::default());
//! simulation.spawn((Name::new("stone"), Position(dvec2(0.0, 10.0)), MassOverride(1.0), InertiaOverride(1.0)));
//! simulation.record(1)?;
//! simulation.run_for(1.0)?;
//! let recording = simulation.take_recording().ok_or("nothing was recorded")?;
//! let height = &"y:stone".parse::<Channel>()?.series(&recording)?[0];
//! assert_eq!((height.values.len(), height.values[0]), (101, 10.0));
//! assert!(Plot::energy(&recording).to_svg().starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 8. How accurate it is
//!
//! State is 64-bit, and the same scene gives the same bits in every run, in debug and release, whatever the order in which bodies were spawned.
//! `docs/validation.md` lists the cases that are tested, each with its tolerance and why. The [integrators](sim::Integrator) are first and second order;
//! example 06 measures it. With [`time_of_impact`](sim::Settings::time_of_impact) steps are cut where gaps close: bounces then come at their times, to 1e-9 s.
//!
//! ```
//! use tumble::prelude::*;
//!
//! fn fall(integrator: Integrator) -> Result<f64, Box<dyn std::error::Error>> {
//!     let mut simulation = Simulation::new(Settings { integrator, ..Settings::default() });
//!     simulation.spawn((Name::new("stone"), Position(dvec2(0.0, 0.0)), MassOverride(1.0), InertiaOverride(1.0)));
//!     simulation.run_for(1.0)?;
//!     Ok(simulation.body("stone")?.position().y)
//! }
//! assert!((fall(Integrator::Ballistic)? + 4.905).abs() < 1e-12); // −½ g t², exact
//! assert!((fall(Integrator::SymplecticEuler)? + 4.905 + 0.04905).abs() < 1e-12); // ½ g t Δt lower
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 9. Where it is wrong
//!
//! One-by-one impulses answer the simultaneous impacts of one body in an order, and the order shows: a rod that lands flat on both ends with
//! ε < 1 leaves with a little spin (example 08). Penalty contact sinks and creeps. A body that moves further in one step than
//! [contacts are made beforehand](sim::Settings::speculative_limit) may pass through thin things, and is [reported](sim::Notices). Newton's restitution with
//! friction can create energy in rare configurations.
//!
//! ```
//! use tumble::prelude::*;
//!
//! let mut simulation = Simulation::new(Settings::weightless());
//! for (name, at, velocity) in [("wall", 5.0, 0.0), ("bullet", 0.0, 900.0)] {
//!     let body = simulation.spawn((Name::new(name), Position(dvec2(at, 0.0)), LinearVelocity(dvec2(velocity, 0.0))));
//!     simulation.attach(body, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.1)?, Amount::Mass(1.0)));
//! }
//! simulation.run_for(0.1)?;
//! assert!(simulation.notices().fast_bodies().is_some()); // 9 m in one step of 10 ms
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 10. Where the code lives
//!
//! One module for each layer, lowest first; each uses only what is above it in this list. `ARCHITECTURE.md` has a screen for each.
//!
//! | Module | What it knows |
//! |---|---|
//! | [`math`] | vectors, rotations, trigonometry with the same bits everywhere |
//! | [`lcp`] | linear complementarity problems and their solvers |
//! | [`shape`] | geometry and mass properties |
//! | [`collision`] | near pairs and contact points |
//! | [`solver`] | contact models on plain slices |
//! | [`sim`] | bodies as components, the step, forces |
//! | [`record`] | what happened: tables, plots, replay, glTF, frames, fingerprints |
//! | [`scene`] | files ↔ worlds, and what a scene promises |
//!
//! Systems and components come from [`bevy_ecs`], vectors from [`glam`]; both are re-exported here in the versions that fit. To derive `Component` or
//! `Resource` for types of one's own, add `bevy_ecs` to the dependencies, because its macros look for it there.

pub use bevy_ecs;
pub use glam;
pub use tumble_collision as collision;
pub use tumble_lcp as lcp;
pub use tumble_math as math;
pub use tumble_record as record;
pub use tumble_scene as scene;
pub use tumble_shape as shape;
pub use tumble_sim as sim;
pub use tumble_solver as solver;

pub mod prelude;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
