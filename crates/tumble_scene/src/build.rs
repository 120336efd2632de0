//! From a scene to a simulation.

use std::collections::BTreeMap;

use bevy_ecs::name::Name;
use bevy_ecs::prelude::Entity;
use thiserror::Error;
use tumble_math::{Linear, Planar, Rotation, Vector};
use tumble_sim::{
    Anchor, AppliedForce, BodyId, CentreOverride, Course, GravityScale, IgnoredPairs, ImpulseSettings, InertiaOverride,
    Joint, Keyframes, LinearDrag, LinearVelocity, Lock, LockedAxes, MassOverride, MaterialId, Orientation, Part,
    PenaltySettings, Pinned, Position, QuadraticDrag, Response, Settings, Simulation, SleepSettings, Spring,
    SpringDamperSettings, StepError, VelocityLcpSettings,
};
use tumble_solver::soft_step::SoftSettings;
use tumble_solver::{Surface, velocity_lcp};

use crate::check::remember;
use crate::diagnostics::Diagnostics;
use crate::dim::{PartError, SceneDim};
use crate::expand::ExpandedBody;
use crate::format::{
    AnchorEntry, Axes, Axis, BodyEntry, BodyKind, ForceEntry, Groups, ImpulseEntry, Integrator, JointEntry, Keyframe,
    PartEntry, PenaltyEntry, PenaltyLaw, RestitutionLaw, Scene, SoftStepEntry, SpringEntry, VelocityLcpEntry,
    VelocitySolver,
};
use crate::load::Loaded;
use crate::materials::{DEFAULT_MATERIAL, MaterialLibrary};
use crate::overlap::initial_overlaps;
use crate::shapes::amount;

/// Why a scene cannot become a simulation.
#[derive(Debug, Error)]
pub enum BuildError {
    /// The scene has mistakes.
    #[error("{0}")]
    Scene(Diagnostics),
    /// A part has no proper shape.
    #[error("a part of body \"{body}\": {source}")]
    Shape {
        /// The body.
        body: String,
        /// What is wrong.
        source: PartError,
    },
    /// A spring, a joint or a force is about a body that is not there.
    #[error("no body is named \"{0}\"")]
    UnknownBody(String),
    /// A body cannot be simulated.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// A simulation out of a scene.
pub trait FromScene<D: SceneDim = Planar>: Sized {
    /// Builds a scene that was loaded, with its material tables.
    ///
    /// # Errors
    ///
    /// When bodies [overlap](initial_overlaps) at the start, or one cannot be simulated; loading has found everything else before.
    fn from_loaded(loaded: &Loaded<D>) -> Result<Self, BuildError> {
        let overlaps = initial_overlaps(&loaded.scene, &loaded.materials)?;
        if !overlaps.is_empty() {
            return Err(BuildError::Scene(loaded.diagnose(overlaps)));
        }
        Self::with_materials(&loaded.scene, &loaded.materials)
    }

    /// Builds a scene made in code, after checking it.
    ///
    /// # Errors
    ///
    /// When the scene has mistakes.
    fn from_scene(scene: &Scene<D>) -> Result<Self, BuildError> {
        let materials = MaterialLibrary::of_scene(scene);
        scene.check(&materials).map_err(BuildError::Scene)?;
        let overlaps = initial_overlaps(scene, &materials)?;
        if !overlaps.is_empty() {
            let mut mistakes = Diagnostics::new("the scene", "");
            mistakes.extend(overlaps);
            return Err(BuildError::Scene(mistakes));
        }
        Self::with_materials(scene, &materials)
    }

    /// Builds a scene whose materials are looked up in a library, without looking for mistakes.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated.
    fn with_materials(scene: &Scene<D>, materials: &MaterialLibrary) -> Result<Self, BuildError>;
}

impl<D: SceneDim> FromScene<D> for Simulation<D> {
    fn with_materials(scene: &Scene<D>, materials: &MaterialLibrary) -> Result<Self, BuildError> {
        (D::scene_engine().build)(scene, materials)
    }
}

pub(crate) fn simulation<D: SceneDim>(
    scene: &Scene<D>,
    materials: &MaterialLibrary,
) -> Result<Simulation<D>, BuildError> {
    let bodies = scene.expand();
    let mut simulation = Simulation::with_settings(settings(scene));
    let ids = add_materials(&mut simulation, &bodies, materials);
    let groups = GroupBits::of(&bodies);
    for (id, body) in bodies.iter().enumerate() {
        add_body(&mut simulation, BodyId(id as u64), &body.body, &ids, &groups)?;
    }
    ignore_pairs(&mut simulation, &bodies);
    // Springs, joints and forces hold on to centres of mass, which exist once the bodies are prepared.
    simulation.prepare()?;
    for spring in &scene.springs {
        add_spring(&mut simulation, spring)?;
    }
    for force in &scene.forces {
        add_force(&mut simulation, force)?;
    }
    add_joints(&mut simulation, &scene.joints)?;
    simulation.prepare()?;
    remember(&mut simulation, scene);
    Ok(simulation)
}

fn settings<D: SceneDim>(scene: &Scene<D>) -> Settings<D> {
    Settings {
        dt: scene.dt,
        gravity: scene.gravity,
        length_scale: scene.length_scale,
        slop: scene.slop,
        integrator: match scene.integrator {
            Integrator::SymplecticEuler => tumble_sim::Integrator::SymplecticEuler,
            Integrator::Ballistic => tumble_sim::Integrator::Ballistic,
        },
        time_of_impact: scene.time_of_impact,
        contact: scene.contact.into(),
        penalty: penalty_settings(&scene.models.penalty, scene.length_scale),
        impulse: impulse_settings(&scene.models.impulse),
        velocity_lcp: velocity_settings(&scene.models.velocity_lcp),
        soft_step: soft_settings(&scene.models.soft_step, scene.length_scale),
        sleep: scene.models.soft_step.sleep.as_ref().map(|entry| {
            let default = SleepSettings::default();
            SleepSettings {
                speed: entry.speed.unwrap_or(default.speed * scene.length_scale),
                after: entry.after.unwrap_or(default.after),
            }
        }),
        ..Settings::weightless()
    }
}

fn soft_settings(entry: &SoftStepEntry, length_scale: f64) -> SoftSettings {
    let default = SoftSettings::default();
    SoftSettings {
        substeps: entry.substeps.unwrap_or(default.substeps),
        frequency: entry.frequency.unwrap_or(default.frequency),
        damping_ratio: entry.damping_ratio.unwrap_or(default.damping_ratio),
        push_speed: entry.push_speed.unwrap_or(default.push_speed * length_scale),
    }
}

fn penalty_settings(entry: &PenaltyEntry, length_scale: f64) -> PenaltySettings {
    let law = match entry.law {
        PenaltyLaw::SpringDamper => tumble_sim::PenaltyLaw::SpringDamper(SpringDamperSettings {
            stiffness: entry.stiffness,
            damping: entry.damping,
            slip_speed: entry.slip_speed.unwrap_or(SpringDamperSettings::default().slip_speed * length_scale),
        }),
        PenaltyLaw::Lecture => tumble_sim::PenaltyLaw::Lecture {
            stiffness: entry.stiffness.unwrap_or(PenaltyEntry::LECTURE_STIFFNESS),
            viscosity: entry.viscosity.unwrap_or(PenaltyEntry::LECTURE_VISCOSITY),
        },
    };
    PenaltySettings { law }
}

fn velocity_settings(entry: &VelocityLcpEntry) -> VelocityLcpSettings {
    VelocityLcpSettings {
        solver: match entry.solver {
            VelocitySolver::Auto => velocity_lcp::VelocitySolver::Auto,
            VelocitySolver::Pivoting => velocity_lcp::VelocitySolver::Pivoting,
            VelocitySolver::BlockGaussSeidel => velocity_lcp::VelocitySolver::BlockGaussSeidel,
            VelocitySolver::Newton => velocity_lcp::VelocitySolver::Newton,
        },
        restitution: match entry.restitution {
            RestitutionLaw::Poisson => velocity_lcp::Restitution::Poisson,
            RestitutionLaw::Newton => velocity_lcp::Restitution::Newton,
        },
    }
}

fn impulse_settings(entry: &ImpulseEntry) -> ImpulseSettings {
    let default = ImpulseSettings::default();
    ImpulseSettings {
        iterations: entry.iterations,
        colliding_above: entry.colliding_tolerance,
        impulses_per_contact: entry.max_impulses,
        ..default
    }
}

/// Enters the surfaces of all pairs of materials that occur; returns the id of each name.
fn add_materials<D: SceneDim>(
    simulation: &mut Simulation<D>,
    bodies: &[ExpandedBody<D>],
    library: &MaterialLibrary,
) -> BTreeMap<String, MaterialId> {
    let mut used = BTreeMap::from([(DEFAULT_MATERIAL.to_owned(), MaterialId::default())]);
    for part in bodies.iter().flat_map(|body| body.body.parts.iter().map(move |part| (part, &body.body))) {
        used.entry(material_of::<D>(part.0, part.1).to_owned()).or_default();
    }
    let surface = |a: &str, b: &str| {
        let properties = library.pair(a, b).properties;
        Surface {
            static_friction: properties.static_friction,
            kinetic_friction: properties.kinetic_friction,
            restitution: properties.restitution,
        }
    };
    let mut materials = simulation.materials_mut();
    for (name, id) in &mut used {
        *id = materials.set(name, surface(name, name));
    }
    for (a, id_a) in &used {
        for (b, id_b) in used.range::<String, _>((std::ops::Bound::Excluded(a), std::ops::Bound::Unbounded)) {
            materials.set_pair(*id_a, *id_b, surface(a, b));
        }
    }
    used
}

fn material_of<'a, D: SceneDim>(part: &'a D::Part, body: &'a BodyEntry<D>) -> &'a str {
    part.shared().material.or(body.material.as_deref()).unwrap_or(DEFAULT_MATERIAL)
}

/// Bits of the groups that a scene names, in alphabetical order.
struct GroupBits<'a>(Vec<&'a str>);

impl<'a> GroupBits<'a> {
    fn of<D: SceneDim>(bodies: &'a [ExpandedBody<D>]) -> Self {
        let mut names = Vec::new();
        let mut add = |groups: Option<&'a Groups>| {
            if let Some(Groups::Names(list)) = groups {
                names.extend(list.iter().map(String::as_str));
            }
        };
        for body in bodies {
            add(Some(&body.body.groups));
            add(Some(&body.body.collides_with));
            for part in &body.body.parts {
                let (groups, collides_with) = part.shared().groups;
                add(groups);
                add(collides_with);
            }
        }
        names.sort_unstable();
        names.dedup();
        Self(names)
    }

    fn bits(&self, groups: &Groups) -> u32 {
        match groups {
            Groups::Bits(bits) => *bits,
            Groups::Names(list) => {
                let bit = |name: &String| self.0.iter().position(|known| known == name).map_or(0, |place| 1 << place);
                list.iter().map(bit).fold(0, std::ops::BitOr::bitor)
            }
        }
    }
}

fn add_body<D: SceneDim>(
    simulation: &mut Simulation<D>,
    id: BodyId,
    body: &BodyEntry<D>,
    materials: &BTreeMap<String, MaterialId>,
    groups: &GroupBits,
) -> Result<(), BuildError> {
    let entity = simulation.spawn((
        Name::new(body.name.clone()),
        id,
        match body.kind {
            BodyKind::Dynamic => tumble_sim::BodyKind::Dynamic,
            BodyKind::Kinematic => tumble_sim::BodyKind::Kinematic,
            BodyKind::Static => tumble_sim::BodyKind::Static,
        },
        Position(body.at),
        Orientation(D::design_rotation(body)),
        LinearVelocity(body.velocity),
        tumble_sim::AngularVelocity(body.angular_velocity),
    ));
    add_options(simulation, entity, body);
    for part in &body.parts {
        let shapes = D::shapes(part).map_err(|source| BuildError::Shape { body: body.name.clone(), source })?;
        let amount = amount(part);
        let (member_of, accepts) = part.shared().groups;
        let groups = tumble_sim::Groups {
            member_of: groups.bits(member_of.unwrap_or(&body.groups)),
            accepts: groups.bits(accepts.unwrap_or(&body.collides_with)),
        };
        let response = if part.shared().sensor { Response::Sensor } else { Response::Solid };
        let material = materials.get(material_of::<D>(part, body)).copied().unwrap_or_default();
        for shape in shapes {
            simulation.attach(entity, Part::new(shape, amount).material(material).groups(groups).response(response));
        }
    }
    Ok(())
}

/// Adds the components that only some bodies have.
fn add_options<D: SceneDim>(simulation: &mut Simulation<D>, entity: Entity, body: &BodyEntry<D>) {
    let mut entity = simulation.world_mut().entity_mut(entity);
    if let Some(mass) = body.mass {
        entity.insert(MassOverride(mass));
    }
    if let Some(centre) = body.centre {
        entity.insert(CentreOverride(centre));
    }
    if let Some(inertia) = &body.inertia {
        entity.insert(InertiaOverride(D::inertia(inertia)));
    }
    if body.gravity_scale != 1.0 {
        entity.insert(GravityScale(body.gravity_scale));
    }
    if body.drag.linear != 0.0 || body.drag.turning != 0.0 {
        entity.insert(LinearDrag { translation: body.drag.linear, rotation: body.drag.turning });
    }
    if body.drag.quadratic != 0.0 {
        entity.insert(QuadraticDrag { translation: body.drag.quadratic, rotation: 0.0 });
    }
    if body.pinned {
        entity.insert(Pinned);
    }
    if !body.locked.is_empty() {
        let locked = |axis: Axis| body.locked.contains(&axis);
        let mut translation = D::Vector::ZERO;
        for (number, axis) in Axis::ALONG.into_iter().enumerate().take(D::Vector::AXES) {
            translation[number] = if locked(axis) { 1.0 } else { 0.0 };
        }
        let rotation = if locked(Axis::Angle) { Lock::Locked } else { Lock::Free };
        entity.insert(LockedAxes { translation, rotation });
    }
    if !body.keyframes.is_empty() {
        entity.insert(keyframes(body));
    }
}

/// The path of the centre of mass that keyframes of the design frame mean.
fn keyframes<D: SceneDim>(body: &BodyEntry<D>) -> Keyframes<D::Vector, D::Rotation> {
    let centre = body.centre.unwrap_or(D::Vector::ZERO);
    let frame = |frame: &Keyframe<D>| {
        let rotation = D::keyframe_rotation(frame).unwrap_or_default();
        tumble_sim::Keyframe { time: frame.time, position: frame.at + rotation.rotate(centre), rotation }
    };
    Keyframes(body.keyframes.iter().map(frame).collect())
}

fn ignore_pairs<D: SceneDim>(simulation: &mut Simulation<D>, bodies: &[ExpandedBody<D>]) {
    let id = |name: &str| bodies.binary_search_by(|body| body.body.name.as_str().cmp(name)).ok();
    let pairs = bodies.iter().enumerate().flat_map(|(one, body)| {
        body.body.ignores.iter().filter_map(move |name| Some((BodyId(one as u64), BodyId(id(name)? as u64))))
    });
    let pairs: Vec<_> = pairs.collect();
    let mut ignored = simulation.world_mut().resource_mut::<IgnoredPairs>();
    for (one, other) in pairs {
        ignored.insert(one, other);
    }
}

fn add_spring<D: SceneDim>(simulation: &mut Simulation<D>, entry: &SpringEntry<D>) -> Result<(), BuildError> {
    let (a, from) = anchor(simulation, &entry.from)?;
    let (b, to) = anchor(simulation, &entry.to)?;
    simulation.spawn(Spring {
        a,
        b,
        stiffness: entry.stiffness,
        damping: entry.damping,
        rest_length: entry.rest_length.unwrap_or_else(|| (from - to).length()),
    });
    Ok(())
}

fn add_joints<D: SceneDim>(simulation: &mut Simulation<D>, entries: &[JointEntry<D>]) -> Result<(), BuildError> {
    // All anchors before the first joint: a joint may have the name of a body.
    let joints: Result<Vec<_>, BuildError> = entries.iter().map(|entry| joint(simulation, entry)).collect();
    for (joint, entry) in joints?.into_iter().zip(entries) {
        simulation.spawn((Name::new(entry.name.clone()), joint));
    }
    Ok(())
}

fn joint<D: SceneDim>(simulation: &Simulation<D>, entry: &JointEntry<D>) -> Result<Joint<D::Vector>, BuildError> {
    let (a, at_a) = anchor(simulation, &entry.a)?;
    let (b, at_b) = anchor(simulation, &entry.b)?;
    Ok(Joint { a, b, kind: D::joint(&entry.kind, [at_a, at_b]) })
}

/// The anchor, and where it is at the start in world axes [m].
fn anchor<D: SceneDim>(
    simulation: &Simulation<D>,
    entry: &AnchorEntry<D>,
) -> Result<(Anchor<D::Vector>, D::Vector), BuildError> {
    match entry {
        AnchorEntry::World { point } => Ok((Anchor::World(*point), *point)),
        AnchorEntry::Body { name, point } => {
            let body = simulation.body(name).map_err(|unknown| BuildError::UnknownBody(unknown.0))?;
            let point = point.map_or(D::Vector::ZERO, |point| body.from_part_frame(point));
            Ok((Anchor::Body(body.entity(), point), body.position() + body.rotation().rotate(point)))
        }
    }
}

fn add_force<D: SceneDim>(simulation: &mut Simulation<D>, entry: &ForceEntry<D>) -> Result<(), BuildError> {
    let body = simulation.body(&entry.on).map_err(|unknown| BuildError::UnknownBody(unknown.0))?;
    let force = AppliedForce::<D> {
        body: body.entity(),
        point: entry.point.map_or(D::Vector::ZERO, |point| body.from_part_frame(point)),
        force: entry.force,
        torque: entry.torque,
        axes: match entry.axes {
            Axes::World => tumble_sim::Axes::World,
            Axes::Body => tumble_sim::Axes::Body,
        },
        course: Course { from: entry.from, until: entry.until.unwrap_or(f64::INFINITY), factor: entry.factor.clone() },
    };
    simulation.spawn(force);
    Ok(())
}
