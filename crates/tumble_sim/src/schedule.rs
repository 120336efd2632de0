//! The step, on one page.
//!
//! | # | Phase | Reads | Writes |
//! |---|---|---|---|
//! | 1 | `AccumulateForces` | state, contacts¹ | `Force`, `Torque` |
//! | 2 | `ComputeAccelerations` | `Force`, `Torque`, inverse masses | `Acceleration`, `AngularAcceleration` |
//! | 3 | `FilterVelocities` | accelerations, contacts¹ | `LinearVelocity`, `AngularVelocity` |
//! | 4 | `UpdatePositions` | velocities, contacts¹ | `Position`, `Orientation` |
//! | 5 | `DetectCollisions` | state | contact entities, [`Touch`](crate::Touch) messages |
//! | 6 | `ResolveImpulses` | contacts², velocities | velocities |
//!
//! ¹ as found by phase 5 of the step before; a new or edited simulation runs phases 5 and 6 once before its step. ² as found in this step.
//!
//! | Model | phase 1 | phase 3 | phase 4 | phase 6 |
//! |---|---|---|---|---|
//! | penalty | spring and damper per point | – | – | – |
//! | impulse | – | touching contacts, accumulated impulses | no gap closes beyond touch | colliding contacts, worst first |
//! | resting LCP | forces at all resting points | what they leave of velocities | no gap closes beyond touch | colliding contacts, worst first |
//! | velocity LCP | – | touching contacts, all at once | no gap closes beyond touch | colliding contacts with those that touch, all at once |
//! | soft step | – | substeps: soft contacts, eight at a time; rebound | what they displaced | – |
//! | *joints* | penalty: spring and damper | J v = 0 with the contacts | curvature, error | J v = 0 (ballistic) |

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, SingleThreadedExecutor};

use crate::body::follow_keyframes;
use crate::contact::{
    apply_lecture_floor, apply_penalty_forces, apply_resting_forces, filter_positions, filter_velocities,
    find_contacts, find_pairs, is_taken, look_for_impacts, mend_soft_joints, resolve_impulses, sync_pairs,
    take_soft_steps,
};
use crate::force::{
    apply_forces, apply_gravity, apply_linear_drag, apply_quadratic_drag, apply_scaled_gravity, apply_springs,
};
use crate::geometry::Geometry;
use crate::integrate::{
    clear_forces, compute_accelerations, integrate_velocities, remember_velocities, update_positions,
};
use crate::joint::{apply_joint_springs, correct_curvature, stop_joints};
use crate::ledger::{self, ForceLine};
use crate::needs::Need;
use crate::rest::settle;

/// The phases of a step, in the order they run. Hook your own systems between them.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StepSystems {
    /// Sum gravity, drag, springs, the user's forces and penalty contacts.
    AccumulateForces,
    /// a = M⁻¹ f, through the inverse-mass filter.
    ComputeAccelerations,
    /// v += a Δt; then contacts take out what they forbid.
    FilterVelocities,
    /// x += v Δt; turn by ω Δt; keep gaps from closing beyond touch.
    UpdatePositions,
    /// Near pairs, then contact points, then what is remembered of them.
    DetectCollisions,
    /// Bounce where bodies still approach.
    ResolveImpulses,
}

/// The parts of [`StepSystems::AccumulateForces`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ForceSystems {
    /// Forget the forces of the last step.
    Clear,
    /// Gravity, drag, springs, applied forces.
    BuiltIn,
    /// The user's forces, in the order in which they were added.
    User,
    /// Penalty contacts.
    ContactForces,
}

/// The user's forces, one after the other.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct UserForce(pub usize);

/// Every system in its place; each is added once, when something needs it.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Place {
    Gravity,
    ScaledGravity,
    LinearDrag,
    QuadraticDrag,
    Springs,
    Applied,
    Remember,
    Keyframes,
    Integrate,
    JointSprings,
    ContactForces,
    Filter,
    ImpactTimes,
    Curvature,
    FilterPositions,
    Move,
    Impacts,
    StopJoints,
    BookGravity,
    BookDrag,
    BookSprings,
    BookUser,
    BookJoints,
    BookContacts,
    BeforeForces,
    AfterForces,
    LookAtContacts,
    BeforeCurvature,
    AfterCurvature,
    AfterMoves,
    BeforeStop,
    AfterStop,
    Close,
    Sleep,
}

/// The schedule of one step.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step;

/// Phases 5 and 6 alone, before the first step and after edits.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Begin;

/// A schedule that runs on one thread, and in which systems that race are an error.
fn sequential(label: impl ScheduleLabel) -> Schedule {
    let mut schedule = Schedule::new(label);
    schedule.set_executor(SingleThreadedExecutor::new());
    schedule.set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..Default::default() });
    schedule
}

/// The step without any force or contact model: those are added when [needed](Need).
pub(crate) fn step_schedule<D: Geometry>() -> Schedule {
    use StepSystems::{
        AccumulateForces, ComputeAccelerations, DetectCollisions, FilterVelocities, ResolveImpulses, UpdatePositions,
    };
    let mut schedule = sequential(Step);
    schedule.configure_sets(
        (AccumulateForces, ComputeAccelerations, FilterVelocities, UpdatePositions, DetectCollisions, ResolveImpulses)
            .chain(),
    );
    schedule.configure_sets(
        (ForceSystems::Clear, ForceSystems::BuiltIn, ForceSystems::User, ForceSystems::ContactForces)
            .chain()
            .in_set(AccumulateForces),
    );
    schedule.configure_sets(
        (
            (Place::Gravity, Place::ScaledGravity, Place::BookGravity).chain(),
            (Place::LinearDrag, Place::QuadraticDrag, Place::BookDrag).chain(),
            (Place::Springs, Place::BookSprings, Place::Applied).chain(),
        )
            .chain()
            .in_set(ForceSystems::BuiltIn),
    );
    schedule.configure_sets(
        (
            (Place::Remember, Place::Keyframes).chain(),
            (Place::BeforeForces, Place::Integrate, Place::AfterForces).chain(),
            (Place::Filter, Place::LookAtContacts, Place::ImpactTimes).chain(),
        )
            .chain()
            .in_set(FilterVelocities),
    );
    schedule.configure_sets(
        (
            (Place::BookUser, Place::JointSprings, Place::BookJoints).chain(),
            (Place::ContactForces, Place::BookContacts).chain(),
        )
            .chain()
            .in_set(ForceSystems::ContactForces),
    );
    schedule.configure_sets(
        (
            (Place::BeforeCurvature, Place::Curvature, Place::AfterCurvature).chain(),
            (Place::FilterPositions, Place::Move, Place::AfterMoves).chain(),
        )
            .chain()
            .in_set(UpdatePositions),
    );
    schedule.configure_sets(
        ((Place::BeforeStop, Place::StopJoints, Place::AfterStop).chain(), Place::Impacts, Place::Close, Place::Sleep)
            .chain()
            .in_set(ResolveImpulses),
    );
    schedule.add_systems((
        clear_forces::<D>.in_set(ForceSystems::Clear),
        compute_accelerations::<D>.in_set(ComputeAccelerations),
        integrate_velocities::<D>.in_set(Place::Integrate),
        update_positions::<D>.in_set(Place::Move),
    ));
    schedule
}

/// Phases 5 and 6 alone.
pub(crate) fn begin_schedule() -> Schedule {
    let mut schedule = sequential(Begin);
    schedule.configure_sets((StepSystems::DetectCollisions, StepSystems::ResolveImpulses).chain());
    schedule.configure_sets((Place::StopJoints, Place::Impacts).chain().in_set(StepSystems::ResolveImpulses));
    schedule
}

/// Phase 5 alone, to look at contacts without answering them.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Look;

/// Phase 5 alone.
pub(crate) fn look_schedule<D: Geometry>() -> Schedule {
    let mut schedule = sequential(Look);
    schedule.add_systems(detection::<D>());
    schedule
}

/// Registers the systems of a need.
pub(crate) fn add_systems<D: Geometry>(need: Need, step: &mut Schedule, begin: &mut Schedule) {
    match need {
        Need::Gravity => step.add_systems(apply_gravity::<D>.in_set(Place::Gravity)),
        Need::ScaledGravity => step.add_systems(apply_scaled_gravity::<D>.in_set(Place::ScaledGravity)),
        Need::LinearDrag => step.add_systems(apply_linear_drag::<D>.in_set(Place::LinearDrag)),
        Need::QuadraticDrag => step.add_systems(apply_quadratic_drag::<D>.in_set(Place::QuadraticDrag)),
        Need::Springs => step.add_systems(apply_springs::<D>.in_set(Place::Springs)),
        Need::AppliedForces => step.add_systems(apply_forces::<D>.in_set(Place::Applied)),
        Need::Keyframes => step.add_systems(follow_keyframes::<D>.in_set(Place::Keyframes)),
        Need::Ballistic => step.add_systems(remember_velocities::<D>.in_set(Place::Remember)),
        Need::Detection => {
            begin.add_systems(detection::<D>());
            step.add_systems(detection::<D>())
        }
        Need::Penalty => step.add_systems(apply_penalty_forces::<D>.in_set(Place::ContactForces)),
        Need::LectureFloor => step.add_systems(apply_lecture_floor::<D>.in_set(Place::ContactForces)),
        Need::Velocity => {
            begin.add_systems(resolve_impulses::<D>.in_set(Place::Impacts));
            step.add_systems((
                filter_velocities::<D>.in_set(Place::Filter),
                filter_positions::<D>.in_set(Place::FilterPositions),
                resolve_impulses::<D>.in_set(Place::Impacts),
            ))
        }
        Need::ImpactTimes => {
            use StepSystems::{DetectCollisions, ResolveImpulses, UpdatePositions};
            step.configure_sets(
                (UpdatePositions, DetectCollisions, ResolveImpulses).distributive_run_if(is_taken::<D>),
            );
            step.add_systems(look_for_impacts::<D>.in_set(Place::ImpactTimes))
        }
        Need::Resting => step.add_systems(apply_resting_forces::<D>.in_set(Place::ContactForces)),
        Need::SoftStep => step.add_systems((
            take_soft_steps::<D>.in_set(Place::Filter),
            mend_soft_joints::<D>.in_set(Place::FilterPositions),
        )),
        Need::Sleep => step.add_systems(settle::<D>.in_set(Place::Sleep)),
        Need::Joints => {
            begin.add_systems(stop_joints::<D>.in_set(Place::StopJoints));
            step.add_systems((
                correct_curvature::<D>.in_set(Place::Curvature),
                stop_joints::<D>.in_set(Place::StopJoints),
            ))
        }
        Need::Ledger => step.add_systems((
            ledger::open::<D>.in_set(ForceSystems::Clear),
            ledger::book_forces::<D, { ForceLine::Gravity as usize }>.in_set(Place::BookGravity),
            ledger::book_forces::<D, { ForceLine::User as usize }>.in_set(Place::BookDrag),
            ledger::book_forces::<D, { ForceLine::Springs as usize }>.in_set(Place::BookSprings),
            ledger::book_forces::<D, { ForceLine::User as usize }>.in_set(Place::BookUser),
            ledger::book_forces::<D, { ForceLine::Joints as usize }>.in_set(Place::BookJoints),
            ledger::book_forces::<D, { ForceLine::Contacts as usize }>.in_set(Place::BookContacts),
            ledger::before_forces::<D>.in_set(Place::BeforeForces),
            ledger::after_forces::<D>.in_set(Place::AfterForces),
            ledger::look_at_contacts::<D>.in_set(Place::LookAtContacts),
            ledger::before_joints::<D>.in_set(Place::BeforeCurvature),
            ledger::after_joints::<D>.in_set(Place::AfterCurvature),
            ledger::after_moves::<D>.in_set(Place::AfterMoves),
            ledger::before_joints::<D>.in_set(Place::BeforeStop),
            ledger::after_joints::<D>.in_set(Place::AfterStop),
            ledger::close::<D>.in_set(Place::Close),
        )),
        Need::JointSprings => step.add_systems(apply_joint_springs::<D>.in_set(Place::JointSprings)),
    };
}

fn detection<D: Geometry>() -> bevy_ecs::schedule::ScheduleConfigs<bevy_ecs::system::ScheduleSystem> {
    (find_pairs::<D>, sync_pairs::<D>, find_contacts::<D>).chain().in_set(StepSystems::DetectCollisions)
}
