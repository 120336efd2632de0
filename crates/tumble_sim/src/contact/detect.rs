//! Collision detection (L1): near pairs, then contact points, then what is remembered of them.

use std::collections::HashMap;

use bevy_ecs::prelude::*;
use tumble_collision::{BroadPhase, PairChanges, TurningBox};
use tumble_math::{Dim, Linear, Matrix, Pose, Rotation};
use tumble_solver::soft_step::PairColour;

use super::colliders::may_touch;
use super::{Collider, Colliders, ContactManifold, ContactMemory, ContactPair, IgnoredPairs, Materials, PairKey};
use super::{ContactReuse, SoftModel, Touch, TouchPhase};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, LinearVelocity, Orientation, Position,
};
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::notice::Notices;
use crate::part::Response;
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
    /// A ball around each part that holds all that it can reach in the next step.
    pub(super) balls: Vec<Ball<D::Vector>>,
    /// Where each part may be until the end of the next step; `None` for a part without bounds.
    pub(super) boxes: Vec<Option<D::OrientedBox>>,
    /// The same with the margins of fat volumes: two parts are a pair while both overlap.
    fat_boxes: Vec<Option<D::OrientedBox>>,
    /// All near pairs, in the order of their parts.
    pairs: Vec<NearPair>,
    ranks: Ranks,
    pub(super) touches: Vec<Touch>,
}

/// A ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball<V> {
    centre: V,
    radius: f64,
}

impl<V: Linear> Ball<V> {
    /// Whether two balls have no point in common.
    #[inline]
    pub(super) fn is_apart_from(&self, other: &Self) -> bool {
        let (between, reach) = (other.centre - self.centre, self.radius + other.radius);
        between.dot(between) > reach * reach
    }
}

/// A near pair and its entity.
#[derive(Clone, Copy, Debug)]
struct NearPair {
    /// Ranks of the two parts.
    parts: (u32, u32),
    entity: Entity,
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
            balls: Vec::new(),
            boxes: Vec::new(),
            fat_boxes: Vec::new(),
            pairs: Vec::new(),
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
        self.pairs.len()
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
    detection.changes.added.clear();
    detection.changes.removed.clear();
    if !fault.is_none() {
        return;
    }
    detection.motions.resize_with(table.entries().len(), BodyMotion::default);
    detection.balls.resize(colliders.as_slice().len(), Ball { centre: D::Vector::ZERO, radius: f64::INFINITY });
    detection.boxes.resize(colliders.as_slice().len(), None);
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
            detection.balls[part] = Ball { centre: pose.position, radius };
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
            detection.boxes[part] = bounds;
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
}

/// Whether a body is where it was, within a distance for its centre and for the points within a radius of it, which may be infinite [m].
fn is_near<D: Geometry>(now: &Pose<D>, then: &Pose<D>, radius: f64, distance: f64) -> bool {
    let moved = now.position - then.position;
    let turned = || radius * radius * now.rotation.strayed(&D::Rotation::default(), &then.rotation);
    moved.dot(moved) <= distance * distance && (now.rotation == then.rotation || turned() <= distance * distance)
}

/// Gives the entities of pairs that ended to pairs that began, in order; spawns what is missing and despawns what is left.
pub fn sync_pairs<D: Geometry>(world: &mut World) {
    let detection = world.resource_mut::<Detection<D>>().into_inner();
    let renewed = detection.ranks == Ranks::Renewed;
    if detection.changes.added.is_empty() && detection.changes.removed.is_empty() && !renewed {
        return;
    }
    let changes = std::mem::take(&mut detection.changes);
    let mut pairs = std::mem::take(&mut detection.pairs);
    let (table, colliders) = (world.resource::<BodyTable>(), world.resource::<Colliders<D>>().as_slice());
    let materials = world.resource::<Materials>();

    let mut removed = changes.removed.iter().peekable();
    let mut added = changes.added.iter().peekable();
    let mut ended = Vec::new();
    pairs.retain(|pair| {
        let ends = if renewed {
            // `added` holds all pairs there are.
            while added.next_if(|other| **other < pair.parts).is_some() {}
            added.peek() != Some(&&pair.parts)
        } else {
            while removed.next_if(|other| **other < pair.parts).is_some() {}
            removed.next_if(|other| **other == pair.parts).is_some()
        };
        if ends {
            ended.push(pair.entity);
        }
        !ends
    });
    let fresh = |parts: &&(u32, u32)| !renewed || pairs.binary_search_by_key(*parts, |pair| pair.parts).is_err();
    let began: Vec<ContactPair> = (changes.added.iter().filter(fresh))
        .map(|&(a, b)| new_pair(&colliders[a as usize], &colliders[b as usize], [a, b], table, materials))
        .collect();

    let mut touches = Vec::new();
    end_touches(world, &ended, world.resource::<Clock>().time_after_part(), &mut touches);
    let reuse = Reuse::of(world.resource::<Settings<D>>().contact);
    if reuse == Reuse::Yes {
        release_colours::<D>(world, &ended);
    }
    place_pairs::<D>(world, &ended, &began, reuse, &mut pairs);
    // Two runs in order, which a stable sort only merges.
    pairs.sort_by_key(|pair| pair.parts);
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.pairs = pairs;
    detection.touches.append(&mut touches);
    detection.changes = changes;
}

/// Makes contact entities agree with the tables after bodies or parts were added or removed: pairs of known parts get their new
/// ranks and keep their memory; pairs of parts that are gone end.
pub(crate) fn renumber_pairs<D: Geometry>(world: &mut World) {
    let pairs = std::mem::take(&mut world.resource_mut::<Detection<D>>().pairs);
    let colliders = world.resource::<Colliders<D>>();
    let (table, materials) = (world.resource::<BodyTable>(), world.resource::<Materials>());
    let ranks: HashMap<(u64, u32), u32> = colliders
        .as_slice()
        .iter()
        .enumerate()
        .map(|(rank, part)| ((table.entry(part.body).id.0, part.part), rank as u32))
        .collect();
    let mut renumbered = Vec::new();
    let mut gone = Vec::new();
    for NearPair { entity, .. } in pairs {
        let Some(key) = world.get::<ContactPair>(entity).map(|pair| pair.key) else { continue };
        match (ranks.get(&(key.a.0, key.part_a)), ranks.get(&(key.b.0, key.part_b))) {
            (Some(&a), Some(&b)) => {
                let list = colliders.as_slice();
                let pair = new_pair(&list[a as usize], &list[b as usize], [a, b], table, materials);
                renumbered.push((entity, pair));
            }
            _ => gone.push(entity),
        }
    }
    let mut pairs = Vec::new();
    for (entity, pair) in renumbered {
        if let Some(mut known) = world.get_mut::<ContactPair>(entity) {
            *known = ContactPair { touching: known.touching, points: known.points, ..pair };
        }
        // Their shapes may be others now.
        if let Some(mut reuse) = world.get_mut::<ContactReuse<D>>(entity) {
            *reuse = ContactReuse::default();
        }
        pairs.push(NearPair { parts: pair.colliders.into(), entity });
    }
    pairs.sort_unstable_by_key(|pair| pair.parts);
    let mut touches = Vec::new();
    end_touches(world, &gone, world.resource::<Clock>().time(), &mut touches);
    for entity in gone {
        world.despawn(entity);
    }
    world.resource_mut::<SoftModel<D>>().colours().forget();
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.pairs = pairs;
    detection.touches.append(&mut touches);
    detection.forget_ranks();
}

/// Tells of the pairs that touched until now.
fn end_touches(world: &World, ended: &[Entity], time: f64, touches: &mut Vec<Touch>) {
    for pair in ended.iter().filter_map(|entity| world.get::<ContactPair>(*entity)).filter(|pair| pair.touching) {
        touches.push(Touch { phase: TouchPhase::Ended, pair: pair.key, response: pair.response, time });
    }
}

/// Gives the colours of ended pairs back.
fn release_colours<D: Geometry>(world: &mut World, ended: &[Entity]) {
    let mut released = Vec::with_capacity(ended.len());
    released.extend(ended.iter().filter_map(|entity| world.get::<ContactPair>(*entity)).copied());
    let mut soft = world.resource_mut::<SoftModel<D>>();
    for pair in released {
        soft.colours().release(pair.bodies, pair.colour);
    }
}

/// Finds an entity for every pair that began: one whose pair ended, as long as there are any, and otherwise a new one.
fn place_pairs<D: Geometry>(
    world: &mut World,
    ended: &[Entity],
    began: &[ContactPair],
    reuse: Reuse,
    pairs: &mut Vec<NearPair>,
) {
    let mut began = began.iter().copied();
    let near = |pair: &ContactPair, entity| NearPair { parts: pair.colliders.into(), entity };
    for entity in ended {
        // The user may have despawned it.
        let Ok(contact) = world.get_entity_mut(*entity) else { continue };
        // What somebody has put on it must not pass to another pair.
        let plain = contact.archetype().components().len() == reuse.components();
        if plain && let Some(pair) = began.next() {
            pairs.push(near(&pair, *entity));
            renew::<D>(contact, pair);
        } else {
            contact.despawn();
        }
    }
    let fresh: Vec<ContactPair> = began.collect();
    let bundles = (fresh.iter().copied())
        .map(|pair| (pair, ContactManifold::<D>(D::Manifold::default()), ContactMemory::<D>(D::PerPoint::default())));
    let entities: Vec<Entity> = match reuse {
        Reuse::No => world.spawn_batch(bundles).collect(),
        Reuse::Yes => {
            let bundles =
                bundles.map(|(pair, manifold, memory)| (pair, manifold, memory, ContactReuse::<D>::default()));
            world.spawn_batch(bundles).collect()
        }
    };
    pairs.extend(fresh.iter().zip(entities).map(|(pair, entity)| near(pair, entity)));
}

/// Makes another pair's contact of an entity.
fn renew<D: Geometry>(mut contact: EntityWorldMut<'_>, pair: ContactPair) {
    if let Some(mut known) = contact.get_mut::<ContactPair>() {
        *known = pair;
    }
    if let Some(mut manifold) = contact.get_mut::<ContactManifold<D>>() {
        manifold.0 = D::Manifold::default();
    }
    if let Some(mut memory) = contact.get_mut::<ContactMemory<D>>() {
        memory.0 = D::PerPoint::default();
    }
    if let Some(mut reuse) = contact.get_mut::<ContactReuse<D>>() {
        *reuse = ContactReuse::default();
    }
}

/// Whether contact points are reused from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reuse {
    Yes,
    No,
}

impl Reuse {
    fn of(model: ContactModel) -> Self {
        if model == ContactModel::SoftStep { Self::Yes } else { Self::No }
    }

    /// Number of components of a contact.
    fn components(self) -> usize {
        match self {
            Self::No => 3,
            Self::Yes => 4,
        }
    }
}

fn new_pair<D: Geometry>(
    a: &Collider<D>,
    b: &Collider<D>,
    colliders: [u32; 2],
    table: &BodyTable,
    materials: &Materials,
) -> ContactPair {
    let sensor = a.response == Response::Sensor || b.response == Response::Sensor;
    ContactPair {
        key: PairKey { a: table.entry(a.body).id, b: table.entry(b.body).id, part_a: a.part, part_b: b.part },
        bodies: [a.body, b.body],
        colliders,
        surface: materials.surface(a.material, b.material),
        response: if sensor { Response::Sensor } else { Response::Solid },
        touching: false,
        points: 0,
        colour: PairColour::NONE,
    }
}
