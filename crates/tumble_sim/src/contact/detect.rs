//! Collision detection (L1): near pairs, then contact points, then what is remembered of them.

use bevy_ecs::prelude::*;
use tumble_collision::{BroadPhase, PairChanges};
use tumble_math::{Dim, Linear, Matrix, Pose};

use super::bounds::{PartBounds, Rules};
use super::colliders::may_touch;
use super::near::NearPairs;
use super::{Colliders, IgnoredPairs, Touch};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, LinearVelocity, Orientation, Position,
};
use crate::fault::{Cause, Fault, FaultAt};
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::notice::Notices;
use crate::rest::Awake;
use crate::schedule::StepSystems;
use crate::threads::Threads;
use crate::{Clock, Settings};

/// Most pairs that may begin to be near in a step: about a gigabyte.
const MOST_NEAR_PAIRS: usize = 1 << 24;
/// Most pairs that may have contacts: about ten gigabytes. A million bodies in a heap have some four million.
pub const MOST_CONTACTS: usize = 1 << 23;

/// Pose and motion of a body as of the last detection.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion<D: Geometry> {
    /// Where it is.
    pub pose: Pose<D>,
    /// Its axes, as the columns of a matrix.
    pub axes: D::Matrix,
    /// Velocity of the centre of mass [m/s].
    pub velocity: D::Vector,
    /// Rate of turn [rad/s].
    pub angular_velocity: D::Angular,
    /// Acceleration by forces in the step that led here [m/s²].
    pub acceleration: D::Vector,
    /// Angular acceleration by torques in the step that led here [rad/s²].
    pub angular_acceleration: D::Angular,
    /// Farthest that a point of the body can travel in a step, within the speculative limit [m].
    pub reach: f64,
    /// Pose for which its boxes were made, and the reach that they have: they hold while the body stays near it [m].
    pub(super) boxed: (Pose<D>, f64),
    /// Whether this detection has looked at it.
    pub(super) seen: Seen,
}

/// What a detection has seen of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// It sleeps, or its bounds are up to date.
    No,
    /// It is elsewhere than in the detection before.
    Moved,
    /// It is not.
    Unmoved,
}

impl<D: Geometry> Default for BodyMotion<D> {
    fn default() -> Self {
        Self {
            pose: Pose::default(),
            axes: D::matrix(&D::Rotation::default()),
            velocity: D::Vector::ZERO,
            angular_velocity: D::Angular::ZERO,
            acceleration: D::Vector::ZERO,
            angular_acceleration: D::Angular::ZERO,
            reach: 0.0,
            boxed: (Pose::default(), f64::NEG_INFINITY),
            seen: Seen::No,
        }
    }
}

impl<D: Geometry> BodyMotion<D> {
    /// A body at rest in a pose.
    pub fn at_rest(pose: Pose<D>) -> Self {
        Self { pose, axes: D::matrix(&pose.rotation), ..Self::default() }
    }

    /// A point of the world in the body's frame [m].
    #[inline]
    pub(super) fn in_body(&self, point: D::Vector) -> D::Vector {
        self.axes.apply_transposed(point - self.pose.position)
    }

    /// A point of the body in the world's frame [m].
    #[inline]
    pub(super) fn in_world(&self, point: D::Vector) -> D::Vector {
        self.pose.position + self.axes.apply(point)
    }
}

/// Broad phase and poses of the last detection.
#[derive(Resource, Debug)]
pub struct Detection<D: Geometry> {
    broad: BroadPhase<D::Vector>,
    changes: PairChanges,
    pub(super) motions: Vec<BodyMotion<D>>,
    pub(super) bounds: PartBounds<D>,
    pub(super) near: NearPairs,
    ranks: Ranks,
    pub(super) touches: Vec<Touch>,
}

/// Whether the ranks of parts in the broad phase are those of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ranks {
    /// The tables were rebuilt since: every part must be inserted again.
    Forgotten,
    /// Every part was inserted again in this detection: `added` holds all pairs there are.
    Renewed,
    /// They are.
    Known,
}

impl<D: Geometry> Default for Detection<D> {
    fn default() -> Self {
        Self {
            broad: BroadPhase::new(),
            changes: PairChanges::default(),
            motions: Vec::new(),
            bounds: PartBounds::default(),
            near: NearPairs::default(),
            ranks: Ranks::Forgotten,
            touches: Vec::new(),
        }
    }
}

impl<D: Geometry> Detection<D> {
    /// Pose and motion of every body, by rank.
    pub fn motions(&self) -> &[BodyMotion<D>] {
        &self.motions
    }

    /// Number of pairs whose grown bounds overlap.
    pub fn pair_count(&self) -> usize {
        self.near.len()
    }

    /// Forgets all ranks: bodies or parts were added or removed.
    pub(crate) fn forget_ranks(&mut self) {
        self.broad = BroadPhase::new();
        self.ranks = Ranks::Forgotten;
    }
}

type MotionQuery<'w, 's, D> = Query<
    'w,
    's,
    (
        &'static BodyIndex,
        &'static Position<<D as Dim>::Vector>,
        &'static Orientation<<D as Dim>::Rotation>,
        &'static LinearVelocity<<D as Dim>::Vector>,
        &'static AngularVelocity<<D as Dim>::Angular>,
        &'static Acceleration<<D as Dim>::Vector>,
        &'static AngularAcceleration<<D as Dim>::Angular>,
    ),
    Awake,
>;

/// Bounds of all parts, and the pairs whose bounds overlap.
pub fn find_pairs<D: Geometry>(
    (clock, settings, threads): (Res<Clock>, Res<Settings<D>>, Res<Threads>),
    table: Res<BodyTable>,
    colliders: Res<Colliders<D>>,
    ignored: Res<IgnoredPairs>,
    joints: Res<JointTable<D>>,
    mut fault: ResMut<Fault>,
    mut notices: ResMut<Notices>,
    bodies: MotionQuery<D>,
    mut detection: ResMut<Detection<D>>,
) {
    let detection = &mut *detection;
    if !fault.is_none() {
        return;
    }
    let known = detection.ranks == Ranks::Known;
    detection.motions.resize_with(table.entries().len(), BodyMotion::default);
    for (index, position, orientation, velocity, spin, acceleration, angular_acceleration) in &bodies {
        let motion = &mut detection.motions[index.0 as usize];
        let pose = Pose { position: position.0, rotation: orientation.0 };
        motion.seen = if motion.pose == pose { Seen::Unmoved } else { Seen::Moved };
        motion.pose = pose;
        motion.velocity = velocity.0;
        motion.angular_velocity = spin.0;
        motion.acceleration = acceleration.0;
        motion.angular_acceleration = angular_acceleration.0;
    }
    let Detection { broad, changes, motions, bounds, near, ranks, .. } = detection;
    let rules = Rules::new(&clock, &settings, known);
    bounds.follow(threads.team(), &colliders, motions, broad, &rules, &mut notices);
    *ranks = if *ranks == Ranks::Forgotten { Ranks::Renewed } else { Ranks::Known };
    let list = colliders.as_slice();
    let filter = |a: u32, b: u32| {
        !bounds.lie_askew(a, b) && may_touch(&list[a as usize], &list[b as usize], &table, &ignored, &joints)
    };
    let crowded = |part: u32| FaultAt {
        body: list[part as usize].body,
        cause: Cause::Crowded,
        phase: StepSystems::DetectCollisions,
    };
    if let Err(crowd) = broad.share_pairs(threads.team(), filter, MOST_NEAR_PAIRS, changes) {
        fault.note(crowded(crowd.proxy));
        return;
    }
    near.follow(changes, *ranks == Ranks::Renewed);
    near.meet(threads.team(), |parts| bounds.are_apart(parts));
    if let Some(part) = near.crowd(MOST_CONTACTS) {
        fault.note(crowded(part));
    }
}
