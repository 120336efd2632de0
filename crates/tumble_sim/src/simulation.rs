//! A simulation: a world, the schedule of a step, and how to run it.

use std::collections::BTreeSet;

use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{IntoScheduleConfigs, ScheduleConfigs};
use bevy_ecs::system::ScheduleSystem;
use tumble_math::{Dim, Linear, Planar};
use tumble_solver::Ending;
use tumble_team::TeamError;

use crate::Clock;
use crate::body::{
    AngularVelocity, BodyId, BodyTable, BodyView, LinearVelocity, Orientation, Position, PreviousVelocity,
    prepare_bodies,
};
use crate::contact::{
    Colliders, ContactManifold, ContactMemory, ContactPair, ContactProblem, ContactReport, Detection, IgnoredPairs,
    ImpactTimes, MOST_CONTACTS, Materials, PairKey, Pass, PointMemory, PositionCorrections, PreviousEnds, RestingModel,
    SoftModel, Touch, VelocityModel, prepare_colliders, renumber_pairs,
};
use crate::error::{StepError, UnknownBody};
use crate::fault::{Cause, Fault};
use crate::geometry::Geometry;
use crate::joint::{JointProblem, JointTable, prepare_joints};
use crate::ledger::{Books, Ledger};
use crate::needs::Need;
use crate::notice::Notices;
use crate::part::{Part, PartOf, Response};
use crate::rest::{Rest, wake_all};
use crate::schedule::{ForceSystems, UserForce, begin_schedule};
use crate::settings::{ContactModel, Integrator, Settings};
use crate::structure::Structure;
use crate::threads::Threads;

/// Whether contacts are being detected before a step rather than within it.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beginning {
    /// Before: velocities are as the user gave them.
    Yes,
    /// Within: velocities contain the accelerations of the step.
    #[default]
    No,
}

/// A world of bodies and the schedule that moves it.
pub struct Simulation<D: Geometry = Planar> {
    world: World,
    step: Schedule,
    begin: Schedule,
    look: Schedule,
    after_step: Vec<Box<dyn FnMut(&mut World) + Send + Sync>>,
    known: BTreeSet<Need>,
    memories: QueryState<&'static mut ContactMemory<D>>,
    edited: QueryState<(), Edited<D>>,
    user_forces: usize,
    /// The next body's id, as long as nobody else has had the world in hand.
    numbered: Option<u64>,
    dim: std::marker::PhantomData<D>,
}

impl<D: Geometry> std::fmt::Debug for Simulation<D> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Simulation").field("clock", self.clock()).finish_non_exhaustive()
    }
}

impl Simulation<Planar> {
    /// An empty simulation in the plane.
    pub fn new(settings: Settings) -> Self {
        Self::with_settings(settings)
    }
}

impl<D: Geometry> Simulation<D> {
    /// An empty simulation.
    pub fn with_settings(settings: Settings<D>) -> Self {
        let engine = D::engine();
        let mut world = (engine.world)(settings);
        let (memories, edited) = (world.query(), world.query_filtered());
        Self {
            world,
            memories,
            edited,
            step: (engine.step_schedule)(),
            begin: begin_schedule(),
            look: (engine.look_schedule)(),
            after_step: Vec::new(),
            known: BTreeSet::new(),
            user_forces: 0,
            numbered: None,
            dim: std::marker::PhantomData,
        }
    }

    /// Adds an entity: a body (anything with a [`Position`]), a spring, an applied force, or something of the user's.
    pub fn spawn(&mut self, bundle: impl Bundle) -> Entity {
        let entity = self.world.spawn(bundle).id();
        let body = self.world.entity(entity);
        if body.contains::<Position<D::Vector>>() {
            let nameless = !body.contains::<BodyId>();
            if nameless {
                let id = self.next_body_id();
                self.world.entity_mut(entity).insert(id);
            } else {
                self.numbered = None;
            }
            if self.settings().moves_by() == Integrator::Ballistic {
                self.world.entity_mut(entity).insert(PreviousVelocity::<D::Vector, D::Angular>::default());
            }
        }
        *self.world.resource_mut::<Structure>() = Structure::Changed;
        entity
    }

    /// Attaches a part to a body.
    pub fn attach(&mut self, body: Entity, part: Part<D>) -> Entity {
        self.world.spawn((part, PartOf(body))).id()
    }

    /// Adds a system that adds to [`Force`](crate::Force) or [`Torque`](crate::Torque). Forces run in the order in which they are added.
    pub fn add_force<M>(&mut self, system: impl IntoScheduleConfigs<ScheduleSystem, M>) {
        let place = UserForce(self.user_forces);
        if self.user_forces > 0 {
            self.step.configure_sets(place.after(UserForce(self.user_forces - 1)));
        }
        self.step.configure_sets(place.in_set(ForceSystems::User));
        let configs: ScheduleConfigs<ScheduleSystem> = system.in_set(place);
        self.step.add_systems(configs);
        self.user_forces += 1;
    }

    /// Adds systems of one's own to the step, ordered against [`StepSystems`](crate::StepSystems).
    pub fn add_systems<M>(&mut self, systems: impl IntoScheduleConfigs<ScheduleSystem, M>) {
        self.step.add_systems(systems);
    }

    /// Keeps the [`Ledger`] of every step from now on.
    pub fn keep_ledger(&mut self) {
        self.world.insert_resource(Ledger::default());
        self.world.insert_resource(Books::<D>::default());
        *self.world.resource_mut::<Structure>() = Structure::Changed;
    }

    /// Calls a function after every step.
    pub fn after_step(&mut self, function: impl FnMut(&mut World) + Send + Sync + 'static) {
        self.after_step.push(Box::new(function));
    }

    /// Lets so many threads share the work of a step; 0 counts as 1, which is the default. The bits are the same whatever their number.
    ///
    /// Detection and the soft-step model share their work, in steps that are large enough to gain from it; other models use one thread.
    ///
    /// # Errors
    ///
    /// When the system refuses a thread.
    pub fn set_threads(&mut self, threads: usize) -> Result<(), TeamError> {
        self.world.insert_resource(Threads::new(threads)?);
        Ok(())
    }

    /// Takes one step.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated, or the state of one is not finite any more; the step is then not counted.
    pub fn step(&mut self) -> Result<(), StepError> {
        let pairs = self.world.resource::<Detection<D>>().pair_count();
        if self.world.resource::<Threads>().count() == 1 {
            return self.step_here();
        }
        let team = self.world.resource_mut::<Threads>().choose(pairs).clone();
        team.enter(|| self.step_here())
    }

    fn step_here(&mut self) -> Result<(), StepError> {
        self.numbered = None;
        let rebuilt = *self.world.resource::<Structure>() == Structure::Changed;
        self.prepare()?;
        self.forget_last_step();
        if rebuilt || self.was_edited() {
            wake_all(&mut self.world);
            self.world.insert_resource(Beginning::Yes);
            self.begin.run(&mut self.world);
            self.world.insert_resource(Beginning::No);
            self.check_fault()?;
        }
        loop {
            self.step.run(&mut self.world);
            self.world.clear_trackers();
            self.check_fault()?;
            if self.world.resource::<ImpactTimes<D>>().pass == Pass::TakenBack {
                continue;
            }
            let ends = self.world.resource_mut::<Clock>().end_part();
            if self.world.resource::<ImpactTimes<D>>().arrives {
                // Impacts have changed how far bodies reach.
                self.detect()?;
            }
            if ends {
                break;
            }
            self.world.resource_mut::<ImpactTimes<D>>().begin_part();
            self.world.resource_mut::<JointProblem<D>>().begin_part();
        }
        let step = self.clock().step;
        if let Some(report) = self.world.resource::<ContactReport>().solved.filter(|r| r.ending == Ending::NotConverged)
        {
            self.world.resource_mut::<Notices>().not_converged(report.residual, step);
        }
        for function in &mut self.after_step {
            function(&mut self.world);
        }
        Ok(())
    }

    /// Takes the steps of a duration, rounded to whole steps [s].
    ///
    /// # Errors
    ///
    /// See [`step`](Self::step).
    pub fn run_for(&mut self, seconds: f64) -> Result<(), StepError> {
        let steps = (seconds / self.clock().dt).round();
        for _ in 0..steps as u64 {
            self.step()?;
        }
        Ok(())
    }

    /// Rebuilds the tables of bodies and parts if something was added, removed or changed; [`step`](Self::step) does it by itself.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated.
    pub fn prepare(&mut self) -> Result<(), StepError> {
        if *self.world.resource::<Structure>() == Structure::Known {
            return Ok(());
        }
        let dt = self.clock().dt;
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::TimeStep(dt));
        }
        let engine = D::engine();
        (engine.rebuild)(&mut self.world)?;
        let mut needs = (engine.needs)(&mut self.world);
        for need in needs.difference(&self.known) {
            (engine.add_systems)(*need, &mut self.step, &mut self.begin);
        }
        self.known.append(&mut needs);
        self.world.insert_resource(Structure::Known);
        Ok(())
    }

    /// Finds contacts as they are now, without answering them.
    ///
    /// # Errors
    ///
    /// When a body cannot be simulated.
    pub fn detect(&mut self) -> Result<(), StepError> {
        self.prepare()?;
        if self.known.contains(&Need::Detection) {
            self.world.insert_resource(Beginning::Yes);
            self.look.run(&mut self.world);
            self.world.insert_resource(Beginning::No);
        }
        Ok(())
    }

    /// Pairs of bodies that overlap by more than `depth` as of the last detection, each with its overlap [m].
    pub fn overlaps_deeper_than(&mut self, depth: f64) -> Vec<(PairKey, f64)> {
        let mut pairs = self.world.query::<(&ContactPair, &ContactManifold<D>)>();
        let mut overlaps: Vec<(PairKey, f64)> = pairs
            .iter(&self.world)
            .filter(|(pair, _)| pair.response == Response::Solid)
            .map(|(pair, manifold)| {
                let points = D::points(&manifold.0).iter();
                (pair.key, points.map(|point| -point.separation).fold(0.0, f64::max))
            })
            .filter(|(_, overlap)| *overlap > depth)
            .collect();
        overlaps.sort_by_key(|(key, _)| *key);
        overlaps
    }

    /// The body of a name.
    ///
    /// # Errors
    ///
    /// When no body has it.
    pub fn body(&self, name: &str) -> Result<BodyView<'_, D>, UnknownBody> {
        let entity = self.entity(name)?;
        Ok(BodyView::new(self.world.entity(entity)))
    }

    /// The entity of the body of a name.
    ///
    /// # Errors
    ///
    /// When no body has it.
    pub fn entity(&self, name: &str) -> Result<Entity, UnknownBody> {
        let unknown = || UnknownBody(name.to_owned());
        if *self.world.resource::<Structure>() == Structure::Known {
            let table = self.world.resource::<BodyTable>();
            return table.index_of(name).map(|index| table.entry(index).entity).ok_or_else(unknown);
        }
        let mut names = self.world.try_query::<(Entity, &Name)>().ok_or_else(unknown)?;
        names.iter(&self.world).find(|(_, known)| known.as_str() == name).map(|(entity, _)| entity).ok_or_else(unknown)
    }

    /// The simulated time [s].
    pub fn time(&self) -> f64 {
        self.clock().time()
    }

    /// Step count and Δt.
    pub fn clock(&self) -> &Clock {
        self.world.resource::<Clock>()
    }

    /// The settings.
    pub fn settings(&self) -> &Settings<D> {
        self.world.resource::<Settings<D>>()
    }

    /// Surfaces by pair of materials, to be set before the first step.
    pub fn materials_mut(&mut self) -> Mut<'_, Materials> {
        self.world.resource_mut::<Materials>()
    }

    /// What a user should know about the run so far.
    pub fn notices(&self) -> &Notices {
        self.world.resource::<Notices>()
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world, to be edited between steps.
    pub fn world_mut(&mut self) -> &mut World {
        self.numbered = None;
        &mut self.world
    }

    /// One more than the largest id there is.
    fn next_body_id(&mut self) -> BodyId {
        let next = self.numbered.unwrap_or_else(|| {
            let mut taken = self.world.query::<&BodyId>();
            taken.iter(&self.world).map(|id| id.0 + 1).max().unwrap_or(0)
        });
        self.numbered = Some(next + 1);
        BodyId(next)
    }

    fn forget_last_step(&mut self) {
        *self.world.resource_mut::<ContactReport>() = ContactReport::default();
        *self.world.resource_mut::<Fault>() = Fault::default();
        self.world.resource_mut::<ImpactTimes<D>>().begin_step();
        if self.known.contains(&Need::Joints) {
            let joints = self.world.resource::<JointTable<D>>().entries().len();
            self.world.resource_mut::<JointProblem<D>>().begin_step(joints);
        }
        if self.known.contains(&Need::Detection) {
            self.world.resource_mut::<Messages<Touch>>().update();
            // Soft steps write what they give, rather than add it.
            if self.settings().contact != ContactModel::SoftStep {
                for mut memory in self.memories.iter_mut(&mut self.world) {
                    for point in memory.bypass_change_detection().0.as_mut() {
                        let point: &mut PointMemory<D::Vector> = point;
                        point.given = D::Vector::ZERO;
                    }
                }
            }
        }
    }

    /// Whether the state of a body was changed from outside since the last step.
    fn was_edited(&mut self) -> bool {
        (self.known.contains(&Need::Detection) || self.known.contains(&Need::Joints))
            && self.edited.iter(&self.world).next().is_some()
    }

    fn check_fault(&self) -> Result<(), StepError> {
        let Some(fault) = self.world.resource::<Fault>().get() else { return Ok(()) };
        let body = self.world.resource::<BodyTable>().entry(fault.body).name.clone();
        let step = self.clock().step + 1;
        Err(match fault.cause {
            Cause::NotFinite(quantity) => {
                StepError::NotFinite { body, quantity: quantity.as_str(), phase: fault.phase, step }
            }
            Cause::Crowded => StepError::Crowded { body, most: MOST_CONTACTS, step },
        })
    }
}

/// A world with the resources of a simulation.
pub(crate) fn new_world<D: Geometry>(settings: Settings<D>) -> World {
    let mut world = World::new();
    world.insert_resource(Clock::new(settings.dt));
    world.insert_resource(settings);
    world.init_resource::<Structure>();
    world.init_resource::<Threads>();
    world.init_resource::<Rest>();
    world.init_resource::<Beginning>();
    world.init_resource::<BodyTable>();
    world.init_resource::<Colliders<D>>();
    world.init_resource::<Detection<D>>();
    world.init_resource::<ContactProblem<D>>();
    world.init_resource::<PositionCorrections<D>>();
    world.init_resource::<PreviousEnds<D>>();
    world.init_resource::<VelocityModel<D>>();
    world.init_resource::<RestingModel<D>>();
    world.init_resource::<SoftModel<D>>();
    world.init_resource::<ImpactTimes<D>>();
    world.init_resource::<JointTable<D>>();
    world.init_resource::<JointProblem<D>>();
    world.init_resource::<ContactReport>();
    world.init_resource::<IgnoredPairs>();
    world.init_resource::<Materials>();
    world.init_resource::<Messages<Touch>>();
    world.init_resource::<Notices>();
    world.init_resource::<Fault>();
    world
}

/// Rebuilds the tables of bodies and parts.
pub(crate) fn rebuild<D: Geometry>(world: &mut World) -> Result<(), StepError> {
    wake_all(world);
    prepare_bodies::<D>(world)?;
    prepare_joints::<D>(world)?;
    prepare_colliders::<D>(world);
    renumber_pairs::<D>(world);
    world.resource_mut::<PreviousEnds<D>>().forget();
    Ok(())
}

type Edited<D> = Or<(
    Changed<Position<<D as Dim>::Vector>>,
    Changed<Orientation<<D as Dim>::Rotation>>,
    Changed<LinearVelocity<<D as Dim>::Vector>>,
    Changed<AngularVelocity<<D as Dim>::Angular>>,
)>;
