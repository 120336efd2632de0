//! Collision detection (L1): near pairs, then contact points, then what is remembered of them.

use std::collections::{HashMap, HashSet};

use bevy_ecs::prelude::*;
use tumble_collision::{BroadPhase, PairChanges, TurningBox};
use tumble_math::{Dim, Linear, Matrix, Pose};

use super::colliders::may_touch;
use super::{Collider, Colliders, ContactManifold, ContactMemory, ContactPair, IgnoredPairs, Materials, PairKey};
use super::{ContactReuse, Touch, TouchPhase};
use crate::body::{
    Acceleration, AngularAcceleration, AngularVelocity, BodyIndex, BodyTable, LinearVelocity, Orientation, Position,
};
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::notice::Notices;
use crate::part::Response;
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
        }
    }
}

impl<D: Geometry> BodyMotion<D> {
    /// A point of the world in the body's frame [m].
    #[inline]
    pub(super) fn to_body(&self, point: D::Vector) -> D::Vector {
        self.axes.apply_transposed(point - self.pose.position)
    }

    /// A point of the body in the world's frame [m].
    #[inline]
    pub(super) fn to_world(&self, point: D::Vector) -> D::Vector {
        self.pose.position + self.axes.apply(point)
    }
}

/// Broad phase and poses of the last detection.
#[derive(Resource, Debug)]
pub struct Detection<D: Geometry> {
    broad: BroadPhase<D::Vector>,
    changes: PairChanges,
    pub(super) motions: Vec<BodyMotion<D>>,
    /// Where each part may be until the end of the next step; `None` for a part without bounds.
    pub(super) boxes: Vec<Option<D::OrientedBox>>,
    /// The same with the margins of fat volumes: two parts are a pair while both overlap.
    fat_boxes: Vec<Option<D::OrientedBox>>,
    pairs: HashMap<PairKey, Entity>,
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
            boxes: Vec::new(),
            fat_boxes: Vec::new(),
            pairs: HashMap::new(),
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

/// Margin of fat bounds beyond the travel that they foresee, in length scales: larger finds pairs anew less often.
const FAT_MARGIN: f64 = 0.05;
/// Steps of steady motion that fat bounds allow for: more finds pairs anew less often [1].
const STEPS_AHEAD: f64 = 2.0;
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
>;

/// Bounds of all parts, and the pairs whose bounds overlap.
pub fn find_pairs<D: Geometry>(
    clock: Res<Clock>,
    settings: Res<Settings<D>>,
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
    detection.boxes.resize(colliders.as_slice().len(), None);
    detection.fat_boxes.resize(colliders.as_slice().len(), None);
    let fat_margin = FAT_MARGIN * settings.length_scale;
    let limit = settings.speculative_limit();
    for (index, position, orientation, velocity, spin, acceleration, angular_acceleration) in &bodies {
        let motion = &mut detection.motions[index.0 as usize];
        let pose = Pose { position: position.0, rotation: orientation.0 };
        let parts = colliders.range(index.0);
        let extent = colliders.as_slice()[parts.clone()].iter().map(|part| part.extent).fold(0.0, f64::max);
        let turning = spin.0.length() * extent;
        let speed = velocity.0.length() + turning;
        let travel = (speed + acceleration.0.length() * clock.dt) * clock.dt;
        if travel > limit {
            notices.moved_too_far(index.0, travel, clock.step);
        }
        let reach = travel.min(limit) + 0.5 * REST_MARGIN * settings.length_scale;
        let unmoved = detection.ranks == Ranks::Known && motion.pose == pose && reach <= motion.reach;
        *motion = BodyMotion {
            pose,
            axes: D::matrix(&pose.rotation),
            velocity: velocity.0,
            angular_velocity: spin.0,
            acceleration: acceleration.0,
            angular_acceleration: angular_acceleration.0,
            reach: if unmoved { motion.reach } else { reach },
        };
        if unmoved {
            continue;
        }
        // Fat bounds reach ahead rather than all round: bodies that fall side by side are no pairs.
        let ahead = velocity.0 * (STEPS_AHEAD * clock.dt).min(STEPS_AHEAD * limit / speed);
        for part in parts {
            let shape = &colliders.as_slice()[part].shape;
            let bounds = D::oriented_box(shape, &pose, reach);
            detection.boxes[part] = bounds;
            let volume = D::volume(shape, &pose).grown(reach);
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
    detection.broad.update_pairs(filter, &mut detection.changes);
}

/// Despawns the entities of pairs that ended and spawns those of pairs that began, in order.
pub fn sync_pairs<D: Geometry>(world: &mut World) {
    let detection = world.resource_mut::<Detection<D>>().into_inner();
    let renewed = detection.ranks == Ranks::Renewed;
    if detection.changes.added.is_empty() && detection.changes.removed.is_empty() && !renewed {
        return;
    }
    let changes = std::mem::take(&mut detection.changes);
    let mut pairs = std::mem::take(&mut detection.pairs);
    let table = world.resource::<BodyTable>();
    let colliders = world.resource::<Colliders<D>>();
    let materials = world.resource::<Materials>();
    let pair_of = |&(a, b): &(u32, u32)| {
        new_pair(&colliders.as_slice()[a as usize], &colliders.as_slice()[b as usize], [a, b], table, materials)
    };

    let added: Vec<ContactPair> = changes.added.iter().map(pair_of).collect();
    let removed: Vec<PairKey> = if renewed {
        let near: HashSet<PairKey> = added.iter().map(|pair| pair.key).collect();
        let mut apart: Vec<PairKey> = pairs.keys().copied().filter(|key| !near.contains(key)).collect();
        apart.sort();
        apart
    } else {
        changes.removed.iter().map(|pair| pair_of(pair).key).collect()
    };
    let time = world.resource::<Clock>().time_after_part();
    let mut ended = Vec::new();
    for key in removed {
        if let Some(entity) = pairs.remove(&key) {
            end_pair(world, entity, time, &mut ended);
        }
    }
    let reuse = Reuse::of(world.resource::<Settings<D>>().contact);
    spawn_pairs::<D>(world, added, reuse, &mut pairs);
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.pairs = pairs;
    detection.touches.append(&mut ended);
    detection.changes = changes;
}

/// Makes contact entities agree with the tables after bodies or parts were added or removed: pairs of known parts get their new
/// ranks and keep their memory; pairs of parts that are gone end.
pub(crate) fn renumber_pairs<D: Geometry>(world: &mut World) {
    let mut pairs = std::mem::take(&mut world.resource_mut::<Detection<D>>().pairs);
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
    for (key, entity) in &pairs {
        match (ranks.get(&(key.a.0, key.part_a)), ranks.get(&(key.b.0, key.part_b))) {
            (Some(&a), Some(&b)) => {
                let list = colliders.as_slice();
                let pair = new_pair(&list[a as usize], &list[b as usize], [a, b], table, materials);
                renumbered.push((*entity, pair));
            }
            _ => gone.push((*key, *entity)),
        }
    }
    gone.sort();
    for (entity, pair) in renumbered {
        if let Some(mut known) = world.get_mut::<ContactPair>(entity) {
            *known = ContactPair { touching: known.touching, ..pair };
        }
        // Their shapes may be others now.
        if let Some(mut reuse) = world.get_mut::<ContactReuse<D>>(entity) {
            *reuse = ContactReuse::default();
        }
    }
    let time = world.resource::<Clock>().time();
    let mut ended = Vec::new();
    for (key, entity) in gone {
        pairs.remove(&key);
        end_pair(world, entity, time, &mut ended);
    }
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.pairs = pairs;
    detection.touches.append(&mut ended);
    detection.forget_ranks();
}

fn end_pair(world: &mut World, entity: Entity, time: f64, ended: &mut Vec<Touch>) {
    if let Some(pair) = world.get::<ContactPair>(entity)
        && pair.touching
    {
        ended.push(Touch { phase: TouchPhase::Ended, pair: pair.key, response: pair.response, time });
    }
    world.despawn(entity);
}

fn spawn_pairs<D: Geometry>(
    world: &mut World,
    added: Vec<ContactPair>,
    reuse: Reuse,
    pairs: &mut HashMap<PairKey, Entity>,
) {
    let fresh: Vec<ContactPair> = added.into_iter().filter(|pair| !pairs.contains_key(&pair.key)).collect();
    let keys: Vec<PairKey> = fresh.iter().map(|pair| pair.key).collect();
    let bundles = fresh
        .into_iter()
        .map(|pair| (pair, ContactManifold::<D>(D::Manifold::default()), ContactMemory::<D>(D::PerPoint::default())));
    let entities: Vec<Entity> = match reuse {
        Reuse::No => world.spawn_batch(bundles).collect(),
        Reuse::Yes => {
            let bundles =
                bundles.map(|(pair, manifold, memory)| (pair, manifold, memory, ContactReuse::<D>::default()));
            world.spawn_batch(bundles).collect()
        }
    };
    pairs.extend(keys.into_iter().zip(entities));
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
    }
}
