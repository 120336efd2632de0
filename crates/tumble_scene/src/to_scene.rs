//! From a simulation to a scene: a world that was built in code, written down.
//!
//! ```
//! use glam::dvec2;
//! use tumble_scene::ToScene;
//! use tumble_shape::Disc;
//! use tumble_sim::{Amount, Part, Position, Settings, Simulation};
//!
//! let mut simulation = Simulation::new(Settings::default());
//! let ball = simulation.spawn(Position(dvec2(0.0, 5.0)));
//! simulation.attach(ball, Part::new(Disc::try_new(dvec2(0.0, 0.0), 0.1)?, Amount::Mass(2.0)));
//! assert!(simulation.to_scene()?.to_ron().contains("Disc(radius: 0.1, mass: 2.0)"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use bevy_ecs::prelude::{Entity, EntityRef, RelationshipTarget};
use thiserror::Error;
use tumble_math::{Dim, Linear, Planar, Rotation, Vector};
use tumble_sim::{
    Anchor, AppliedForce, BodyIndex, BodyTable, BodyView, CentreOverride, GravityScale, IgnoredPairs, ImpulseSettings,
    InertiaOverride, Joint, JointTable, Keyframes, LinearDrag, Lock, LockedAxes, MassOverride, MaterialId, Materials,
    Parts, PenaltySettings, Pinned, QuadraticDrag, Response, Settings, Simulation, SleepSettings, Spring,
    SpringDamperSettings, StepError,
};
use tumble_solver::soft_step::SoftSettings;
use tumble_solver::{Surface, velocity_lcp};

use crate::check::Promises;
use crate::dim::{PartFields, SceneDim};
use crate::exact::before_shift;
use crate::format::{
    AnchorEntry, Axes, Axis, BodyEntry, BodyKind, Drag, Expectation, ForceEntry, FrictionEntry, Groups, ImpulseEntry,
    Integrator, JointEntry, Keyframe, MaterialEntry, ModelEntries, PairEntry, PenaltyEntry, PenaltyLaw, RestitutionLaw,
    Scene, SleepEntry, SoftStepEntry, SpringEntry, VelocityLcpEntry, VelocitySolver,
};
use crate::initial_overlaps;
use crate::materials::{DEFAULT_MATERIAL, MaterialLibrary};
use crate::validate::open_joints;

/// A simulation written as a scene.
pub trait ToScene<D: SceneDim = Planar> {
    /// The world as it stands now, as the start of a scene.
    ///
    /// A simulation that has not begun to run comes back from its scene bit for bit, provided that the names of its bodies sort
    /// like their ids and each angle is some number of degrees to the last bit (the nearest is taken).
    ///
    /// Bodies are written one by one, repeats unrolled; boxes become polygons. `about`, `duration` and `every` are those of the scene the
    /// simulation came from, if any; otherwise the duration is 1 s. Expectations about bodies that are gone are left out. What a file
    /// cannot hold is not written: systems of the user's, and what a run remembers (contact impulses, the time that has passed, so that
    /// forces and keyframes begin anew).
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated, or something is set that the format has no word for.
    fn to_scene(&mut self) -> Result<Scene<D>, UnwritableError>;
}

/// Why a simulation cannot be written as a scene.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum UnwritableError {
    /// A body cannot be simulated.
    #[error(transparent)]
    Step(#[from] StepError),
    /// A setting differs from its default, and scenes have no word for it.
    #[error("the setting `{0}` cannot be written in a scene")]
    Setting(&'static str),
    /// A body has something that scenes have no word for.
    #[error("body \"{body}\" has {what}, which cannot be written in a scene")]
    Body {
        /// Name of the body.
        body: String,
        /// What it has.
        what: &'static str,
    },
}

impl<D: SceneDim> ToScene<D> for Simulation<D> {
    fn to_scene(&mut self) -> Result<Scene<D>, UnwritableError> {
        (D::scene_engine().write_down)(self)
    }
}

pub(crate) fn written_down<D: SceneDim>(simulation: &mut Simulation<D>) -> Result<Scene<D>, UnwritableError> {
    simulation.prepare()?;
    // Springs and forces act in the order in which the world holds them, which is the order of the files they make.
    let world = simulation.world_mut();
    let springs: Vec<Spring<D::Vector>> = world.query::<&Spring<D::Vector>>().iter(world).copied().collect();
    let forces: Vec<AppliedForce<D>> = world.query::<&AppliedForce<D>>().iter(world).cloned().collect();
    let promises = simulation.world().get_resource::<Promises<D>>().cloned().unwrap_or_default();

    let mut scene = with_settings(simulation.settings(), promises.scene.as_ref())?;
    scene.bodies = bodies(simulation)?;
    write_materials(simulation, &mut scene);
    scene.springs = springs.iter().filter_map(|spring| spring_entry(simulation, spring)).collect();
    scene.joints = joint_entries(simulation);
    for open in open_joints(&scene) {
        scene.joints[open].allow_gap = true;
    }
    scene.forces = forces.iter().filter_map(|force| force_entry(simulation, force)).collect();
    let promised = promises.scene.into_iter().flat_map(|scene| scene.expect).chain(promises.added);
    let is_there = |name: &str| scene.bodies.iter().any(|body| body.name == name);
    let is_joint = |name: &str| scene.joints.iter().any(|joint| joint.name == name);
    let can_be_told =
        |e: &Expectation<D>| e.claim().bodies().into_iter().all(is_there) && joint_named(e).is_none_or(is_joint);
    scene.expect = promised.filter(can_be_told).collect();
    // What cannot be looked at cannot overlap either; building the scene will tell what is wrong.
    scene.allow_overlap =
        initial_overlaps(&scene, &MaterialLibrary::of_scene(&scene)).is_ok_and(|overlaps| !overlaps.is_empty());
    Ok(scene)
}

/// A scene with settings and nothing in it.
fn with_settings<D: SceneDim>(settings: &Settings<D>, origin: Option<&Scene<D>>) -> Result<Scene<D>, UnwritableError> {
    let default = ImpulseSettings::default();
    if settings.speculative_limit.is_some() {
        return Err(UnwritableError::Setting("speculative_limit"));
    }
    if settings.impulse.tolerance != default.tolerance {
        return Err(UnwritableError::Setting("impulse.tolerance"));
    }
    if settings.impulse.recovery != default.recovery {
        return Err(UnwritableError::Setting("impulse.recovery"));
    }
    let blank = Scene::empty();
    let origin = origin.unwrap_or(&blank);
    Ok(Scene {
        about: origin.about.clone(),
        duration: origin.duration,
        every: origin.every,
        dt: settings.dt,
        gravity: settings.gravity,
        length_scale: settings.length_scale,
        slop: settings.slop,
        integrator: match settings.integrator {
            tumble_sim::Integrator::SymplecticEuler => Integrator::SymplecticEuler,
            tumble_sim::Integrator::Ballistic => Integrator::Ballistic,
        },
        time_of_impact: settings.time_of_impact,
        contact: settings.contact.into(),
        models: ModelEntries {
            penalty: penalty_entry(&settings.penalty, settings.length_scale),
            impulse: ImpulseEntry {
                iterations: settings.impulse.iterations,
                colliding_tolerance: settings.impulse.colliding_above,
                max_impulses: settings.impulse.impulses_per_contact,
            },
            velocity_lcp: VelocityLcpEntry {
                solver: match settings.velocity_lcp.solver {
                    velocity_lcp::VelocitySolver::Auto => VelocitySolver::Auto,
                    velocity_lcp::VelocitySolver::Pivoting => VelocitySolver::Pivoting,
                    velocity_lcp::VelocitySolver::BlockGaussSeidel => VelocitySolver::BlockGaussSeidel,
                    velocity_lcp::VelocitySolver::Newton => VelocitySolver::Newton,
                },
                restitution: match settings.velocity_lcp.restitution {
                    velocity_lcp::Restitution::Poisson => RestitutionLaw::Poisson,
                    velocity_lcp::Restitution::Newton => RestitutionLaw::Newton,
                },
            },
            soft_step: soft_entry(settings),
        },
        ..blank
    })
}

fn soft_entry<D: Dim>(settings: &Settings<D>) -> SoftStepEntry {
    let (length_scale, sleep, settings) = (settings.length_scale, settings.sleep, &settings.soft_step);
    let (default, default_sleep) = (SoftSettings::default(), SleepSettings::default());
    SoftStepEntry {
        substeps: (settings.substeps != default.substeps).then_some(settings.substeps),
        frequency: (settings.frequency != default.frequency).then_some(settings.frequency),
        damping_ratio: (settings.damping_ratio != default.damping_ratio).then_some(settings.damping_ratio),
        push_speed: (settings.push_speed != default.push_speed * length_scale).then_some(settings.push_speed),
        sleep: sleep.map(|sleep| SleepEntry {
            speed: (sleep.speed != default_sleep.speed * length_scale).then_some(sleep.speed),
            after: (sleep.after != default_sleep.after).then_some(sleep.after),
        }),
    }
}

fn penalty_entry(settings: &PenaltySettings, length_scale: f64) -> PenaltyEntry {
    match settings.law {
        tumble_sim::PenaltyLaw::SpringDamper(SpringDamperSettings { stiffness, damping, slip_speed }) => {
            let default = SpringDamperSettings::default().slip_speed * length_scale;
            let slip_speed = Some(slip_speed).filter(|speed| *speed != default);
            PenaltyEntry { stiffness, damping, slip_speed, ..PenaltyEntry::default() }
        }
        tumble_sim::PenaltyLaw::Lecture { stiffness, viscosity } => PenaltyEntry {
            law: PenaltyLaw::Lecture,
            stiffness: Some(stiffness),
            viscosity: Some(viscosity),
            ..PenaltyEntry::default()
        },
    }
}

/// Materials that parts are made of, and those of their pairs that do not follow from the materials.
fn write_materials<D: SceneDim>(simulation: &Simulation<D>, scene: &mut Scene<D>) {
    let materials = simulation.world().resource::<Materials>();
    let parts = part_entities(simulation).filter_map(|part| simulation.world().get::<tumble_sim::Part<D>>(part));
    let mut used: Vec<MaterialId> = parts.map(|part| part.material).collect();
    used.sort_unstable_by_key(|id| materials.name(*id));
    used.dedup();
    for &id in &used {
        let own = materials.surface(id, id);
        if materials.name(id) != DEFAULT_MATERIAL || own != Surface::default() {
            let entry = MaterialEntry {
                static_friction: Some(own.static_friction.into()),
                kinetic_friction: Some(own.kinetic_friction.into()),
                restitution: Some(own.restitution),
            };
            scene.materials.insert(materials.name(id).to_owned(), entry);
        }
    }
    let library = MaterialLibrary::of_scene(scene);
    for (index, &a) in used.iter().enumerate() {
        for &b in &used[index..] {
            let (name_a, name_b, wanted) = (materials.name(a), materials.name(b), materials.surface(a, b));
            let follows = library.pair(name_a, name_b).properties;
            let follows = Surface {
                static_friction: follows.static_friction,
                kinetic_friction: follows.kinetic_friction,
                restitution: follows.restitution,
            };
            if follows != wanted {
                scene.pairs.push(PairEntry {
                    between: (name_a.to_owned(), name_b.to_owned()),
                    dry: FrictionEntry {
                        static_friction: Some(wanted.static_friction.into()),
                        kinetic_friction: Some(wanted.kinetic_friction.into()),
                        ..FrictionEntry::default()
                    },
                    restitution: Some(wanted.restitution),
                    ..PairEntry::default()
                });
            }
        }
    }
}

fn part_entities<D: SceneDim>(simulation: &Simulation<D>) -> impl Iterator<Item = Entity> {
    let world = simulation.world();
    let bodies = world.resource::<BodyTable>().entries().iter();
    bodies.filter_map(|body| world.get::<Parts>(body.entity)).flat_map(|parts| parts.iter())
}

/// Every body, in the order of ids.
fn bodies<D: SceneDim>(simulation: &Simulation<D>) -> Result<Vec<BodyEntry<D>>, UnwritableError> {
    let world = simulation.world();
    let table = world.resource::<BodyTable>();
    let every_group = part_entities(simulation)
        .filter_map(|part| world.get::<tumble_sim::Part<D>>(part))
        .all(|part| part.groups == tumble_sim::Groups::default());
    let mut bodies = Vec::with_capacity(table.entries().len());
    for entry in table.entries() {
        let Ok(view) = simulation.body(&entry.name) else { continue };
        let mut body = body(simulation, &view, &entry.name)?;
        if every_group {
            // Where nobody has a group of its own, all of them are the same as the first one.
            (body.groups, body.collides_with) = (Groups::ALL, Groups::ALL);
        }
        let ignored = world.resource::<IgnoredPairs>().iter().filter(|(one, _)| *one == entry.id);
        let others = ignored.filter_map(|(_, other)| table.entries().iter().find(|body| body.id == other));
        body.ignores = others.map(|other| other.name.clone()).collect();
        bodies.push(body);
    }
    Ok(bodies)
}

fn body<D: SceneDim>(
    simulation: &Simulation<D>,
    view: &BodyView<D>,
    name: &str,
) -> Result<BodyEntry<D>, UnwritableError> {
    let entity = simulation.world().entity(view.entity());
    let centre = -view.from_part_frame(D::Vector::ZERO);
    let shift = view.rotation().rotate(centre);
    let linear = entity.get::<LinearDrag>().copied().unwrap_or_default();
    let quadratic = entity.get::<QuadraticDrag>().copied().unwrap_or_default();
    if quadratic.rotation != 0.0 {
        return Err(UnwritableError::Body { body: name.to_owned(), what: "quadratic drag against rotation" });
    }
    let mut body = BodyEntry {
        name: name.to_owned(),
        kind: match entity.get::<tumble_sim::BodyKind>().copied().unwrap_or_default() {
            tumble_sim::BodyKind::Dynamic => BodyKind::Dynamic,
            tumble_sim::BodyKind::Kinematic => BodyKind::Kinematic,
            tumble_sim::BodyKind::Static => BodyKind::Static,
        },
        at: before_shift(view.position(), shift),
        velocity: view.velocity(),
        angular_velocity: view.angular_velocity(),
        mass: entity.get::<MassOverride>().map(|mass| mass.0),
        centre: entity.get::<CentreOverride<D::Vector>>().map(|centre| centre.0),
        inertia: entity.get::<InertiaOverride<D::Inertia>>().map(|inertia| D::inertia_entry(inertia.0)),
        gravity_scale: entity.get::<GravityScale>().map_or(1.0, |scale| scale.0),
        drag: Drag { linear: linear.translation, quadratic: quadratic.translation, turning: linear.rotation },
        pinned: entity.contains::<Pinned>(),
        locked: entity.get::<LockedAxes<D::Vector>>().map(locked_axes::<D>).unwrap_or_default(),
        ..BodyEntry::default()
    };
    D::write_rotation(&mut body, view.rotation());
    write_keyframes(&entity, &mut body);
    write_parts(simulation, view.entity(), &mut body)?;
    Ok(body)
}

/// Writes the keyframes that a body of the world has.
fn write_keyframes<D: SceneDim>(entity: &EntityRef, body: &mut BodyEntry<D>) {
    let Some(path) = entity.get::<Keyframes<D::Vector, D::Rotation>>() else { return };
    // The path gives the velocity.
    (body.velocity, body.angular_velocity) = (D::Vector::ZERO, D::Angular::ZERO);
    let centre = body.centre.unwrap_or(D::Vector::ZERO);
    let written = |frame: &tumble_sim::Keyframe<D::Vector, D::Rotation>| {
        let at = before_shift(frame.position, frame.rotation.rotate(centre));
        let mut entry = Keyframe { time: frame.time, at, ..Keyframe::default() };
        D::write_keyframe_rotation(&mut entry, frame.rotation);
        entry
    };
    body.keyframes = path.0.iter().map(written).collect();
}

fn locked_axes<D: SceneDim>(locked: &LockedAxes<D::Vector>) -> Vec<Axis> {
    let along = (0..D::Vector::AXES).filter(|&axis| locked.translation[axis] != 0.0).map(|axis| Axis::ALONG[axis]);
    along.chain((locked.rotation == Lock::Locked).then_some(Axis::Angle)).collect()
}

/// Writes the parts; what they have in common goes to the body.
fn write_parts<D: SceneDim>(
    simulation: &Simulation<D>,
    entity: Entity,
    body: &mut BodyEntry<D>,
) -> Result<(), UnwritableError> {
    let world = simulation.world();
    let parts = world.get::<Parts>(entity).into_iter().flat_map(|parts| parts.iter());
    let parts: Vec<&tumble_sim::Part<D>> = parts.filter_map(|part| world.get(part)).collect();
    let Some(first) = parts.first() else { return Ok(()) };
    let materials = world.resource::<Materials>();
    let name = |id: MaterialId| Some(materials.name(id).to_owned());
    let one_material = parts.iter().all(|part| part.material == first.material);
    let one_group = parts.iter().all(|part| part.groups == first.groups);
    body.material = name(first.material).filter(|name| one_material && name != DEFAULT_MATERIAL);
    if one_group {
        body.groups = Groups::Bits(first.groups.member_of);
        body.collides_with = Groups::Bits(first.groups.accepts);
    }
    let fields = |part: &tumble_sim::Part<D>| PartFields {
        amount: part.amount,
        material: name(part.material).filter(|_| !one_material),
        sensor: part.response == Response::Sensor,
        groups: (!one_group).then_some(Groups::Bits(part.groups.member_of)),
        collides_with: (!one_group).then_some(Groups::Bits(part.groups.accepts)),
    };
    for pieces in parts.chunk_by(|one, other| D::are_pieces(&one.shape, &other.shape) && fields(one) == fields(other)) {
        let shapes: Vec<&D::Shape> = pieces.iter().map(|part| &part.shape).collect();
        let what = "several grounds of triangles that meet at corners";
        let unwritable = || UnwritableError::Body { body: body.name.clone(), what };
        let part = D::part(&shapes, fields(pieces[0])).ok_or_else(unwritable)?;
        body.parts.push(part);
    }
    Ok(())
}

/// `None` if a body that it holds is gone, and the spring does nothing.
fn spring_entry<D: SceneDim>(simulation: &Simulation<D>, spring: &Spring<D::Vector>) -> Option<SpringEntry<D>> {
    Some(SpringEntry {
        from: anchor_entry(simulation, &spring.a)?,
        to: anchor_entry(simulation, &spring.b)?,
        stiffness: spring.stiffness,
        damping: spring.damping,
        rest_length: Some(spring.rest_length),
    })
}

/// Every joint, in the order of the table; joints cannot hold bodies that are gone.
fn joint_entries<D: SceneDim>(simulation: &Simulation<D>) -> Vec<JointEntry<D>> {
    let world = simulation.world();
    let mut entries = Vec::new();
    for entry in world.resource::<JointTable<D>>().entries() {
        let Some(joint) = world.get::<Joint<D::Vector>>(entry.entity) else { continue };
        let ends = [&joint.a, &joint.b].map(|anchor| anchor_entry(simulation, anchor));
        let [Some(a), Some(b)] = ends else { continue };
        let kind = D::joint_entry(&joint.kind);
        entries.push(JointEntry { name: entry.name.clone(), kind, a, b, allow_gap: false });
    }
    entries
}

/// Name of the joint, if the expectation is about one.
fn joint_named<D: SceneDim>(expectation: &Expectation<D>) -> Option<&str> {
    if let Expectation::JointForce(e) = expectation { Some(&e.of) } else { None }
}

/// `None` if its body is gone.
fn anchor_entry<D: SceneDim>(simulation: &Simulation<D>, anchor: &Anchor<D::Vector>) -> Option<AnchorEntry<D>> {
    match *anchor {
        Anchor::World(point) => Some(AnchorEntry::World { point }),
        Anchor::Body(entity, point) => {
            let (name, body) = body_of(simulation, entity)?;
            Some(AnchorEntry::Body { name: name.to_owned(), point: design_point(&body, point) })
        }
    }
}

/// `None` if its body is gone, and the force does nothing.
fn force_entry<D: SceneDim>(simulation: &Simulation<D>, force: &AppliedForce<D>) -> Option<ForceEntry<D>> {
    let (name, body) = body_of(simulation, force.body)?;
    Some(ForceEntry {
        on: name.to_owned(),
        point: design_point(&body, force.point),
        force: force.force,
        torque: force.torque,
        axes: match force.axes {
            tumble_sim::Axes::World => Axes::World,
            tumble_sim::Axes::Body => Axes::Body,
        },
        from: force.course.from,
        until: Some(force.course.until).filter(|until| until.is_finite()),
        factor: force.course.factor.clone(),
    })
}

fn body_of<D: SceneDim>(simulation: &Simulation<D>, entity: Entity) -> Option<(&str, BodyView<'_, D>)> {
    let index = simulation.world().get::<BodyIndex>(entity)?;
    let name = &simulation.world().resource::<BodyTable>().entry(index.0).name;
    Some((name, simulation.body(name).ok()?))
}

/// A point of the body frame in the frame of the parts [m]; `None` for the centre of mass.
fn design_point<D: SceneDim>(body: &BodyView<D>, point: D::Vector) -> Option<D::Vector> {
    (point != D::Vector::ZERO).then(|| before_shift(point, body.from_part_frame(D::Vector::ZERO)))
}
