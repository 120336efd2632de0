//! Where parts may be until the end of the next step: the first part of collision detection (L1).
//!
//! Each part has a ball and a box that turns with it, as tight as its motion allows: two parts whose balls or boxes are apart do not meet.
//! Around these lie the fat bounds of the broad phase, which last for some steps.

use tumble_collision::{BroadPhase, TurningBox, Volume};
use tumble_math::{Linear, Pose, Rotation};
use tumble_team::Team;

use super::Colliders;
use super::detect::{BodyMotion, Seen};
use super::near::PartRanks;
use crate::geometry::Geometry;
use crate::notice::Notices;
use crate::{Clock, ContactModel, Settings};

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
/// Bodies that a thread looks after at a time.
const BODIES_OF_A_TASK: usize = 256;

/// Bounds of all parts.
#[derive(Debug)]
pub(super) struct PartBounds<D: Geometry> {
    tight: Vec<Tight<D>>,
    /// Turning boxes with the margins of fat volumes: two parts are a near pair while both these and the volumes overlap.
    fat: Vec<Option<D::OrientedBox>>,
    tasks: Vec<Found<D>>,
}

/// Where a part may be until the end of the next step.
#[derive(Clone, Debug)]
struct Tight<D: Geometry> {
    centre: D::Vector,
    radius: f64,
    /// `None` for a part without bounds.
    turning: Option<D::OrientedBox>,
}

/// What a thread found.
#[derive(Debug, Default)]
struct Found<D: Geometry> {
    /// Parts whose pairs must be looked for again, and the fat volumes of those that left theirs.
    left: Vec<(u32, Option<Volume<D::Vector>>)>,
    /// Bodies that may travel farther in a step than contacts reach, and how far [m].
    too_far: Vec<(u32, f64)>,
}

impl<D: Geometry> Default for PartBounds<D> {
    fn default() -> Self {
        Self { tight: Vec::new(), fat: Vec::new(), tasks: Vec::new() }
    }
}

impl<D: Geometry> PartBounds<D> {
    /// Whether two parts are too far from each other to come near: fat bounds overlap long before.
    #[inline]
    pub(super) fn are_apart(&self, (a, b): PartRanks) -> bool {
        let (a, b) = (&self.tight[a as usize], &self.tight[b as usize]);
        let (between, reach) = (b.centre - a.centre, a.radius + b.radius);
        between.dot(between) > reach * reach || matches!((&a.turning, &b.turning), (Some(a), Some(b)) if !a.overlaps(b))
    }

    /// Whether two parts are no near pair, although their fat volumes overlap: long thin parts that lie askew are far apart in them.
    #[inline]
    pub(super) fn lie_askew(&self, a: u32, b: u32) -> bool {
        matches!((&self.fat[a as usize], &self.fat[b as usize]), (Some(a), Some(b)) if !a.overlaps(b))
    }

    /// Brings the bounds of all bodies that were seen, and the broad phase, to where they are now.
    pub(super) fn follow(
        &mut self,
        team: &Team,
        colliders: &Colliders<D>,
        motions: &mut [BodyMotion<D>],
        broad: &mut BroadPhase<D::Vector>,
        rules: &Rules,
        notices: &mut Notices,
    ) {
        let parts = colliders.as_slice().len();
        let nowhere = || Tight { centre: D::Vector::ZERO, radius: f64::INFINITY, turning: None };
        self.tight.resize_with(parts, nowhere);
        self.fat.resize(parts, None);
        let tasks = motions.len().div_ceil(BODIES_OF_A_TASK);
        self.tasks.resize_with(tasks.max(self.tasks.len()), Found::default);
        let (mut tight, mut fat) = (&mut self.tight[..], &mut self.fat[..]);
        let known = &*broad;
        let chunks =
            motions.chunks_mut(BODIES_OF_A_TASK).zip(&mut self.tasks).enumerate().map(|(k, (motions, found))| {
                let first = (k * BODIES_OF_A_TASK) as u32;
                let parts = colliders.range(first).start..colliders.range(first + motions.len() as u32 - 1).end;
                let these = tight.split_off_mut(..parts.len()).unwrap_or_default();
                let fat_ones = fat.split_off_mut(..parts.len()).unwrap_or_default();
                Chunk { first, motions, first_part: parts.start, tight: these, fat: fat_ones, found }
            });
        team.share(chunks, |chunk| chunk.follow(colliders, known, rules));
        for found in &mut self.tasks[..tasks] {
            for (part, volume) in found.left.drain(..) {
                match volume {
                    Some(volume) => broad.refit(part, volume),
                    None => broad.touch(part),
                }
            }
            for (body, travel) in found.too_far.drain(..) {
                notices.moved_too_far(body, travel, rules.step);
            }
        }
    }
}

/// How bounds are made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    step: u64,
    dt: f64,
    /// Unit of the tolerances [m].
    length_scale: f64,
    /// Farthest that contacts look ahead [m].
    limit: f64,
    /// Whether bounds reach along the motion only.
    slim: bool,
    /// Whether the bounds there are belong to these bodies.
    known: bool,
}

impl Rules {
    pub(super) fn new<D: Geometry>(clock: &Clock, settings: &Settings<D>, known: bool) -> Self {
        Self {
            step: clock.step,
            dt: clock.dt,
            length_scale: settings.length_scale,
            limit: settings.speculative_limit(),
            slim: settings.contact == ContactModel::SoftStep,
            known,
        }
    }
}

/// Some bodies and their parts.
struct Chunk<'a, D: Geometry> {
    /// Rank of the first body.
    first: u32,
    motions: &'a mut [BodyMotion<D>],
    /// Rank of the first part.
    first_part: usize,
    tight: &'a mut [Tight<D>],
    fat: &'a mut [Option<D::OrientedBox>],
    found: &'a mut Found<D>,
}

impl<D: Geometry> Chunk<'_, D> {
    fn follow(self, colliders: &Colliders<D>, broad: &BroadPhase<D::Vector>, rules: &Rules) {
        let Rules { dt, length_scale, limit, slim, known, .. } = *rules;
        let fat_margin = FAT_MARGIN * length_scale;
        for (index, motion) in (self.first..).zip(self.motions) {
            let seen = std::mem::replace(&mut motion.seen, Seen::No);
            if seen == Seen::No {
                continue;
            }
            let pose = motion.pose;
            let turning = motion.angular_velocity.length() * colliders.extent_of_body(index);
            let speed = motion.velocity.length() + turning;
            let bending = motion.acceleration.length() * dt;
            let travel = (speed + bending) * dt;
            if travel > limit {
                self.found.too_far.push((index, travel));
            }
            let reach = travel.min(limit) + 0.5 * REST_MARGIN * length_scale;
            let (boxed, boxed_reach) = motion.boxed;
            let near = known
                && reach <= boxed_reach
                && is_near(&pose, &boxed, colliders.radius_of_body(index), SLACK * length_scale);
            if !(known && seen == Seen::Unmoved && reach <= motion.reach) {
                motion.reach = reach;
            }
            motion.axes = D::matrix(&pose.rotation);
            let parts = colliders.range(index);
            for part in parts.clone() {
                let tight = &mut self.tight[part - self.first_part];
                (tight.centre, tight.radius) =
                    (pose.position, colliders.as_slice()[part].bounding_radius + motion.reach);
            }
            if near {
                continue;
            }
            motion.boxed = (pose, reach);
            // Fat bounds reach ahead rather than all round: bodies that fall side by side are no pairs.
            let steps = if slim { STEPS_AHEAD_ALONG } else { STEPS_AHEAD };
            let along = |steps: f64| motion.velocity * (steps * dt).min(steps * limit / speed);
            let (ahead, step) = (along(steps), if slim { along(1.0) } else { D::Vector::ZERO });
            // Bounds reach as far as a point can travel in the step: all round, as an impact may turn it anywhere, or along the motion and as far
            // as turning and forces bend it. Centre and turn may each use up the slack besides.
            let reach = 2.0 * SLACK * length_scale
                + if slim { ((turning + bending) * dt).min(limit) + 0.5 * REST_MARGIN * length_scale } else { reach };
            let margin = fat_margin + (turning * dt).min(limit);
            for part in parts {
                let (shape, place) = (&colliders.as_slice()[part].shape, part - self.first_part);
                let bounds = D::oriented_box(shape, &pose, reach).map(|bounds| bounds.swept(step));
                self.tight[place].turning = bounds;
                let volume = D::volume(shape, &pose).swept(step).grown(reach);
                let left = !broad.holds(part as u32, &volume, ahead, margin);
                let fat = &mut self.fat[place];
                let strayed = || matches!((&fat, &bounds), (Some(fat), Some(bounds)) if !fat.contains(bounds));
                if left || strayed() {
                    *fat = bounds.map(|bounds| bounds.swept(ahead).grown(margin));
                    self.found.left.push((part as u32, left.then(|| volume.swept(ahead).grown(margin))));
                }
            }
        }
    }
}

/// Whether a body is where it was, within a distance for its centre and for the points within a radius of it, which may be infinite [m].
fn is_near<D: Geometry>(now: &Pose<D>, then: &Pose<D>, radius: f64, distance: f64) -> bool {
    let moved = now.position - then.position;
    let turned = || radius * radius * now.rotation.strayed(&D::Rotation::default(), &then.rotation);
    moved.dot(moved) <= distance * distance && (now.rotation == then.rotation || turned() <= distance * distance)
}
