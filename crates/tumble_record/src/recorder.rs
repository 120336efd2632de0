//! Fills a [`Recording`] while a simulation runs.

use std::borrow::Cow;
use std::collections::HashMap;

use bevy_ecs::change_detection::Tick;
use bevy_ecs::message::MessageCursor;
use bevy_ecs::prelude::*;
use tumble_math::{Dim, Inertia, Linear, Pose};
use tumble_sim::contact::{Colliders, ContactManifold, ContactMemory, ContactPair};
use tumble_sim::force::{gravity_potential, spring_potential};
use tumble_sim::{
    Anchor, AngularVelocity, BodyIndex, BodyInertia, BodyTable, Clock, ContactReport, GravityScale, Ledger,
    LinearVelocity, Mass, Orientation, Position, Response, Settings, Simulation, Spring, StepError,
    Touch as TouchMessage,
};

use crate::dim::RecordDim;
use crate::joints::JointLog;
use crate::recording::{
    AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, Recording, Sample, ShapeRecord, Touch, TouchPhase,
};
use crate::sampling::Sampling;
use crate::springs::SpringLog;

/// Recording of a simulation.
pub trait Record {
    /// The plane or space.
    type Dim: RecordDim;

    /// Starts to record: a sample now, after every `every`-th step, and of the last step; audits and touches of every step.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated.
    fn record(&mut self, every: u32) -> Result<(), StepError> {
        self.record_sampled(Sampling::every(every))
    }

    /// Starts to record: a sample now, after each step that is to be sampled, and of the last step; audits and touches of every step.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated.
    fn record_sampled(&mut self, sampling: Sampling) -> Result<(), StepError>;

    /// What was recorded so far, the present included; `None` unless [`record`](Self::record) was called.
    fn recording(&mut self) -> Option<&Recording<Self::Dim>>;

    /// Takes the recording out, the present included, and ends it.
    fn take_recording(&mut self) -> Option<Recording<Self::Dim>>;
}

impl<D: RecordDim> Record for Simulation<D> {
    type Dim = D;

    fn record_sampled(&mut self, sampling: Sampling) -> Result<(), StepError> {
        if self.world().get_resource::<Ledger>().is_none() {
            self.keep_ledger();
        }
        self.prepare()?;
        let settings = self.settings();
        let recording = Recording::<D> {
            contact: settings.contact.word().to_owned(),
            dt: settings.dt,
            length_scale: settings.length_scale,
            gravity: settings.gravity,
            ..Recording::default()
        };
        let first = self.world().get_resource::<Recorder<D>>().is_none();
        let mut recorder = Recorder::new(recording, sampling, self.world_mut());
        recorder.audit(self.world());
        recorder.sample(self.world());
        self.world_mut().insert_resource(recorder);
        if first {
            self.after_step(after_step::<D>);
        }
        Ok(())
    }

    fn recording(&mut self) -> Option<&Recording<D>> {
        with_recorder::<D>(self.world_mut(), Recorder::sample_present);
        self.world().get_resource::<Recorder<D>>().map(|recorder| &recorder.recording)
    }

    fn take_recording(&mut self) -> Option<Recording<D>> {
        with_recorder::<D>(self.world_mut(), Recorder::sample_present);
        self.world_mut().get_resource_mut::<Recorder<D>>().map(|mut recorder| {
            recorder.state = State::Ended;
            std::mem::take(&mut recorder.recording)
        })
    }
}

fn after_step<D: RecordDim>(world: &mut World) {
    with_recorder::<D>(world, |recorder, world| {
        recorder.follow_structure(world);
        recorder.follow_springs_and_joints(world);
        recorder.audit(world);
        recorder.touches(world);
        recorder.drop_provisional();
        if recorder.sampling.takes(world.resource::<Clock>().step) {
            recorder.sample(world);
        }
    });
}

/// Calls a function with the recorder and the world it looks at.
fn with_recorder<D: RecordDim>(world: &mut World, function: impl FnOnce(&mut Recorder<D>, &World)) {
    // The recorder is lent out as a whole: its place in the world stays, empty.
    let Some(mut place) = world.get_resource_mut::<Recorder<D>>() else { return };
    if place.state == State::Ended {
        return;
    }
    let mut recorder = std::mem::replace(&mut *place, Recorder::lent());
    recorder.queries.update(world);
    function(&mut recorder, world);
    *world.resource_mut::<Recorder<D>>() = recorder;
}

/// Whether the recorder is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Recording,
    Ended,
}

/// Records into a [`Recording`].
#[derive(Resource)]
struct Recorder<D: RecordDim> {
    recording: Recording<D>,
    sampling: Sampling,
    state: State,
    /// Index in the recording of each body id.
    known: HashMap<u64, usize>,
    /// Index in the recording of each rank of the body table.
    of_rank: Vec<usize>,
    table_tick: Option<Tick>,
    /// Whether the last sample is only there because someone looked.
    provisional: bool,
    springs: SpringLog,
    joints: JointLog,
    cursor: MessageCursor<TouchMessage>,
    queries: Queries<D>,
}

type BodyComponents<D> = (
    &'static BodyIndex,
    &'static Position<<D as Dim>::Vector>,
    &'static Orientation<<D as Dim>::Rotation>,
    &'static LinearVelocity<<D as Dim>::Vector>,
    &'static AngularVelocity<<D as Dim>::Angular>,
    &'static Mass,
    &'static BodyInertia<<D as Dim>::Inertia>,
    Option<&'static GravityScale>,
);
type SpringComponents<D> = (Entity, &'static Spring<<D as Dim>::Vector>);
type PairComponents<D> = (&'static ContactPair, &'static ContactManifold<D>, &'static ContactMemory<D>);

/// Queries over the world, built once.
struct Queries<D: RecordDim>(Option<BuiltQueries<D>>);

struct BuiltQueries<D: RecordDim> {
    bodies: QueryState<BodyComponents<D>>,
    pairs: QueryState<PairComponents<D>>,
    springs: QueryState<SpringComponents<D>>,
}

impl<D: RecordDim> Queries<D> {
    fn update(&mut self, world: &mut World) {
        let queries = self.0.get_or_insert_with(|| BuiltQueries {
            bodies: world.query(),
            pairs: world.query(),
            springs: world.query(),
        });
        queries.bodies.update_archetypes(world);
        queries.pairs.update_archetypes(world);
        queries.springs.update_archetypes(world);
    }

    fn get(&self) -> &BuiltQueries<D> {
        self.0.as_ref().expect("queries are built before they are used")
    }
}

impl<D: RecordDim> Recorder<D> {
    fn new(recording: Recording<D>, sampling: Sampling, world: &mut World) -> Self {
        let mut recorder = Self { recording, sampling, state: State::Recording, ..Self::lent() };
        recorder.queries.update(world);
        recorder.follow_structure(world);
        recorder.follow_springs_and_joints(world);
        recorder
    }

    /// What stands in the world while the recorder is at work.
    fn lent() -> Self {
        Self {
            recording: Recording::default(),
            sampling: Sampling::every(1),
            state: State::Ended,
            known: HashMap::new(),
            of_rank: Vec::new(),
            table_tick: None,
            provisional: false,
            springs: SpringLog::default(),
            joints: JointLog::default(),
            cursor: MessageCursor::default(),
            queries: Queries(None),
        }
    }

    /// Takes up bodies that are new since the last step.
    fn follow_structure(&mut self, world: &World) {
        let Some(table) = world.get_resource_ref::<BodyTable>() else { return };
        if self.table_tick == Some(table.last_changed()) {
            return;
        }
        self.table_tick = Some(table.last_changed());
        let colliders = world.resource::<Colliders<D>>();
        self.of_rank.clear();
        for (rank, entry) in table.entries().iter().enumerate() {
            let next = self.recording.bodies.len();
            let index = *self.known.entry(entry.id.0).or_insert(next);
            self.of_rank.push(index);
            if index == next {
                let kind = match entry.kind {
                    tumble_sim::BodyKind::Dynamic => BodyKind::Dynamic,
                    tumble_sim::BodyKind::Kinematic => BodyKind::Kinematic,
                    tumble_sim::BodyKind::Static => BodyKind::Static,
                };
                let shapes = colliders.of_body(rank as u32);
                let body = Some(world.entity(entry.entity)).filter(|_| kind == BodyKind::Dynamic);
                self.recording.bodies.push(BodyRecord {
                    id: entry.id.0,
                    name: entry.name.clone(),
                    kind,
                    mass: body.map_or(f64::INFINITY, |body| body.get::<Mass>().map_or(0.0, |mass| mass.0)),
                    inertia: body.map_or(D::INFINITE_INERTIA, |body| {
                        body.get::<BodyInertia<D::Inertia>>().map_or(D::Inertia::ZERO, |inertia| inertia.0)
                    }),
                    shapes: shapes
                        .iter()
                        .map(|part| ShapeRecord {
                            geometry: D::outline(&part.shape),
                            sensor: part.response == Response::Sensor,
                        })
                        .collect(),
                });
            }
        }
    }

    /// Takes up springs and joints that are new since the last step, and lets go of those that are gone.
    fn follow_springs_and_joints(&mut self, world: &World) {
        let springs = &self.queries.get().springs;
        let body_of =
            |entity| world.get::<BodyIndex>(entity).and_then(|index| self.of_rank.get(index.0 as usize)).copied();
        let time = world.resource::<Clock>().time();
        self.springs.follow(springs.iter_manual(world), body_of, time, &mut self.recording.springs);
        self.joints.follow(world, body_of, time, &mut self.recording.joints);
    }

    fn audit(&mut self, world: &World) {
        let BuiltQueries { bodies, pairs, springs } = self.queries.get();
        let settings = world.resource::<Settings<D>>();
        let clock = world.resource::<Clock>();
        let mut row = AuditRow { step: clock.step, time: clock.time(), ..AuditRow::default() };
        // Sums go by rank, so that they do not depend on the order in which bodies were spawned.
        let mut energies = vec![BodySums::<D>::default(); self.of_rank.len()];
        for (index, x, rotation, v, w, mass, inertia, scale) in bodies.iter_manual(world) {
            let scale = scale.map_or(1.0, |scale| scale.0);
            let spin = inertia.0.in_world(&rotation.0).apply(w.0);
            energies[index.0 as usize] = BodySums {
                kinetic: 0.5 * (mass.0 * v.0.dot(v.0) + w.0.dot(spin)),
                potential: gravity_potential::<D>(settings.gravity, mass.0, scale, x.0),
                momentum: v.0 * mass.0,
                angular_momentum: D::torque(x.0, v.0) * mass.0 + spin,
            };
        }
        for sums in &energies {
            row.kinetic += sums.kinetic;
            row.potential += sums.potential;
            row.momentum += sums.momentum;
            row.angular_momentum += sums.angular_momentum;
        }
        for (_, spring) in springs.iter_manual(world) {
            if let (Some(a), Some(b)) = (anchor_point::<D>(&spring.a, world), anchor_point::<D>(&spring.b, world)) {
                row.potential += spring_potential(spring.stiffness, spring.rest_length, a, b);
            }
        }
        row.total = row.kinetic + row.potential;
        let tolerance = settings.touch_tolerance();
        for (pair, manifold, _) in pairs.iter_manual(world).filter(|(pair, ..)| pair.response == Response::Solid) {
            if pair.touching {
                let points = D::points(&manifold.0);
                row.contacts += points.iter().filter(|point| point.separation <= tolerance).count() as u64;
                row.deepest_overlap = points.iter().map(|point| -point.separation).fold(row.deepest_overlap, f64::max);
            }
        }
        if let Some(report) = world.resource::<ContactReport>().solved {
            row.iterations = Some(u64::from(report.iterations));
            row.residual = Some(report.residual);
        }
        if let Some(ledger) = world.get_resource::<Ledger>() {
            row.ledger = *ledger;
        }
        self.recording.audit.push(row);
    }

    fn touches(&mut self, world: &World) {
        let (clock, table) = (world.resource::<Clock>(), world.resource::<BodyTable>());
        let Some(messages) = world.get_resource::<Messages<TouchMessage>>() else { return };
        for message in self.cursor.read(messages) {
            let index = |id: u64| self.known.get(&id).copied();
            let (Some(a), Some(b)) = (index(message.pair.a.0), index(message.pair.b.0)) else { continue };
            self.recording.touches.push(Touch {
                step: clock.step,
                time: message.time,
                a,
                b,
                phase: match message.phase {
                    tumble_sim::TouchPhase::Began => TouchPhase::Begin,
                    tumble_sim::TouchPhase::Ended => TouchPhase::End,
                },
                sensor: message.response == Response::Sensor,
            });
        }
        debug_assert!(table.entries().len() == self.of_rank.len(), "structure is followed before touches");
    }

    fn sample(&mut self, world: &World) {
        let BuiltQueries { bodies, pairs, .. } = self.queries.get();
        let clock = world.resource::<Clock>();
        let mut states = vec![None; self.recording.bodies.len()];
        for (index, x, rotation, v, w, ..) in bodies.iter_manual(world) {
            states[self.of_rank[index.0 as usize]] = Some(BodyState {
                position: x.0,
                orientation: D::orientation(&rotation.0),
                velocity: v.0,
                angular_velocity: w.0,
            });
        }
        let tolerance = world.resource::<Settings<D>>().touch_tolerance();
        let mut touching: Vec<_> =
            pairs.iter_manual(world).filter(|(pair, ..)| pair.response == Response::Solid).collect();
        touching.sort_by_key(|(pair, ..)| pair.key);
        let mut contacts = Vec::new();
        for (pair, manifold, memory) in touching {
            let normal = D::normal(&manifold.0);
            for (point, memory) in D::points(&manifold.0).iter().zip(memory.0.as_ref()) {
                if point.separation > tolerance && memory.given == D::Vector::ZERO {
                    continue;
                }
                contacts.push(ContactRecord {
                    a: self.of_rank[pair.bodies[0] as usize],
                    b: self.of_rank[pair.bodies[1] as usize],
                    point: point.point,
                    normal,
                    separation: point.separation,
                    normal_impulse: memory.given.dot(normal),
                    tangent_impulse: D::tangent_impulse(normal, memory.given),
                    kind: Cow::Borrowed(point.kind.as_str()),
                });
            }
        }
        let mut sample = Sample { step: clock.step, time: clock.time(), states, contacts, joints: Vec::new() };
        sample.joints = self.joints.forces(world, &self.recording.joints, &sample);
        self.recording.samples.push(sample);
    }

    /// Adds the present as a sample that the next step may drop again.
    fn sample_present(&mut self, world: &World) {
        let step = world.resource::<Clock>().step;
        if self.recording.samples.last().is_none_or(|sample| sample.step != step) {
            self.sample(world);
            self.provisional = true;
        }
    }

    fn drop_provisional(&mut self) {
        if std::mem::take(&mut self.provisional) {
            self.recording.samples.pop();
        }
    }
}

/// What one body adds to the sums of an audit row.
#[derive(Clone, Copy, Default)]
struct BodySums<D: Dim> {
    kinetic: f64,
    potential: f64,
    momentum: D::Vector,
    angular_momentum: D::Angular,
}

fn anchor_point<D: RecordDim>(anchor: &Anchor<D::Vector>, world: &World) -> Option<D::Vector> {
    match *anchor {
        Anchor::World(point) => Some(point),
        Anchor::Body(entity, point) => {
            let position = world.get::<Position<D::Vector>>(entity)?.0;
            let rotation = world.get::<Orientation<D::Rotation>>(entity)?.0;
            Some(Pose::<D> { position, rotation }.transform_point(point))
        }
    }
}
