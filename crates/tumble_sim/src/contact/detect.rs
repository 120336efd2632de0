//! Collision detection (L1): near pairs, then contact points, then what is remembered of them.

use bevy_ecs::prelude::*;
use tumble_collision::{BroadPhase, PairChanges, TurningBox};
use tumble_math::{Dim, Linear, Matrix, Pose, Rotation};

use super::colliders::may_touch;
use super::near::NearPairs;
use super::{Colliders, IgnoredPairs, Touch};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, LinearVelocity, Orientation, Position,
};
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::notice::Notices;
use crate::rest::Awake;
use crate::threads::Threads;
use crate::{Clock, ContactModel, Settings};

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
    /// Pose for which its boxes were made, and the reach that they have: they hold while the body stays within [`SLACK`] of it [m].
    boxed: (Pose<D>, f64),
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
        }
    }
}

impl<D: Geometry> BodyMotion<D> {
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
    /// The same with the margins of fat volumes: two parts are a pair while both overlap.
    fat_boxes: Vec<Option<D::OrientedBox>>,
    pub(super) near: NearPairs,
    ranks: Ranks,
    pub(super) touches: Vec<Touch>,
}

/// Where each part may be until the end of the next step.
#[derive(Debug)]
pub(super) struct PartBounds<D: Geometry> {
    /// A ball around each part.
    balls: Vec<Ball<D::Vector>>,
    /// A box around it that turns with it; `None` for a part without bounds.
    boxes: Vec<Option<D::OrientedBox>>,
}

impl<D: Geometry> PartBounds<D> {
    fn resize(&mut self, parts: usize) {
        self.balls.resize(parts, Ball { centre: D::Vector::ZERO, radius: f64::INFINITY });
        self.boxes.resize(parts, None);
    }

    /// Whether two parts are too far from each other to come near: fat bounds overlap long before.
    #[inline]
    pub(super) fn are_apart(&self, (a, b): (u32, u32)) -> bool {
        let (a, b) = (a as usize, b as usize);
        self.balls[a].is_apart_from(&self.balls[b])
            || matches!((&self.boxes[a], &self.boxes[b]), (Some(a), Some(b)) if !a.overlaps(b))
    }
}

/// A ball.
#[derive(Clone, Copy, Debug)]
struct Ball<V> {
    centre: V,
    radius: f64,
}

impl<V: Linear> Ball<V> {
    /// Whether two balls have no point in common.
    #[inline]
    fn is_apart_from(&self, other: &Self) -> bool {
        let (between, reach) = (other.centre - self.centre, self.radius + other.radius);
        between.dot(between) > reach * reach
    }
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
            bounds: PartBounds { balls: Vec::new(), boxes: Vec::new() },
            fat_boxes: Vec::new(),
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

/// How far a body may move, and a point of it by turning, before its boxes are made anew, in length scales.
const SLACK: f64 = 0.005;
/// Margin of fat bounds beyond the travel that they foresee, in length scales: larger finds pairs anew less often.
const FAT_MARGIN: f64 = 0.05;
/// Steps of steady motion that fat bounds allow for: more finds pairs anew less often [1].
const STEPS_AHEAD: f64 = 2.0;
/// The same where bounds reach along the motion only, and stay slim [1].
const STEPS_AHEAD_ALONG: f64 = 4.0;
/// Gap within which contact points are made even for bodies at rest, in length scales.
const REST_MARGIN: f64 = 0.01;

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
    fault: Res<Fault>,
    mut notices: ResMut<Notices>,
    bodies: MotionQuery<D>,
    mut detection: ResMut<Detection<D>>,
) {
    let detection = &mut *detection;
    if !fault.is_none() {
        return;
    }
    detection.motions.resize_with(table.entries().len(), BodyMotion::default);
    detection.bounds.resize(colliders.as_slice().len());
    detection.fat_boxes.resize(colliders.as_slice().len(), None);
    let fat_margin = FAT_MARGIN * settings.length_scale;
    let limit = settings.speculative_limit();
    let slim = settings.contact == ContactModel::SoftStep;
    for (index, position, orientation, velocity, spin, acceleration, angular_acceleration) in &bodies {
        let motion = &mut detection.motions[index.0 as usize];
        let pose = Pose { position: position.0, rotation: orientation.0 };
        let parts = colliders.range(index.0);
        let extent = colliders.extent_of_body(index.0);
        let turning = spin.0.length() * extent;
        let speed = velocity.0.length() + turning;
        let travel = (speed + acceleration.0.length() * clock.dt) * clock.dt;
        if travel > limit {
            notices.moved_too_far(index.0, travel, clock.step);
        }
        let reach = travel.min(limit) + 0.5 * REST_MARGIN * settings.length_scale;
        let known = detection.ranks == Ranks::Known;
        let unmoved = known && motion.pose == pose && reach <= motion.reach;
        let (boxed, boxed_reach) = motion.boxed;
        let near = known
            && reach <= boxed_reach
            && is_near(&pose, &boxed, colliders.radius_of_body(index.0), SLACK * settings.length_scale);
        *motion = BodyMotion {
            pose,
            axes: D::matrix(&pose.rotation),
            velocity: velocity.0,
            angular_velocity: spin.0,
            acceleration: acceleration.0,
            angular_acceleration: angular_acceleration.0,
            reach: if unmoved { motion.reach } else { reach },
            boxed: if near { motion.boxed } else { (pose, reach) },
        };
        let reach_now = motion.reach;
        for part in parts.clone() {
            let radius = colliders.as_slice()[part].bounding_radius + reach_now;
            detection.bounds.balls[part] = Ball { centre: pose.position, radius };
        }
        if near {
            continue;
        }
        // Fat bounds reach ahead rather than all round: bodies that fall side by side are no pairs.
        let steps = if slim { STEPS_AHEAD_ALONG } else { STEPS_AHEAD };
        let along = |steps: f64| velocity.0 * (steps * clock.dt).min(steps * limit / speed);
        let (ahead, step) = (along(steps), if slim { along(1.0) } else { D::Vector::ZERO });
        // Bounds reach as far as a point can travel in the step: all round, as an impact may turn it anywhere, or along the motion and as far
        // as turning and forces bend it. Centre and turn may each use up the slack besides.
        let reach = 2.0 * SLACK * settings.length_scale
            + if slim {
                let bent = (turning + acceleration.0.length() * clock.dt) * clock.dt;
                bent.min(limit) + 0.5 * REST_MARGIN * settings.length_scale
            } else {
                reach
            };
        for part in parts {
            let shape = &colliders.as_slice()[part].shape;
            let bounds = D::oriented_box(shape, &pose, reach).map(|bounds| bounds.swept(step));
            detection.bounds.boxes[part] = bounds;
            let volume = D::volume(shape, &pose).swept(step).grown(reach);
            let margin = fat_margin + (turning * clock.dt).min(limit);
            let renewed = detection.broad.update_moving(part as u32, volume, ahead, margin);
            let fat = &mut detection.fat_boxes[part];
            let strayed = matches!((&fat, &bounds), (Some(fat), Some(bounds)) if !fat.contains(bounds));
            if renewed || strayed {
                *fat = bounds.map(|bounds| bounds.swept(ahead).grown(margin));
                detection.broad.touch(part as u32);
            }
        }
    }
    detection.ranks = if detection.ranks == Ranks::Forgotten { Ranks::Renewed } else { Ranks::Known };
    let list = colliders.as_slice();
    let filter = |a: u32, b: u32| {
        // Long thin parts that lie askew are far apart in overlapping bounds.
        !matches!([a, b].map(|part| &detection.fat_boxes[part as usize]), [Some(a), Some(b)] if !a.overlaps(b))
            && may_touch(&list[a as usize], &list[b as usize], &table, &ignored, &joints)
    };
    detection.broad.share_pairs(threads.team(), filter, &mut detection.changes);
    detection.near.follow(&detection.changes, detection.ranks == Ranks::Renewed);
    let bounds = &detection.bounds;
    detection.near.meet(|parts| bounds.are_apart(parts));
}

/// Whether a body is where it was, within a distance for its centre and for the points within a radius of it, which may be infinite [m].
fn is_near<D: Geometry>(now: &Pose<D>, then: &Pose<D>, radius: f64, distance: f64) -> bool {
    let moved = now.position - then.position;
    let turned = || radius * radius * now.rotation.strayed(&D::Rotation::default(), &then.rotation);
    moved.dot(moved) <= distance * distance && (now.rotation == then.rotation || turned() <= distance * distance)
}
