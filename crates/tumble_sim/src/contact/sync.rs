//! The contacts of near pairs: entities that begin, end, and are used again.

use std::collections::HashMap;

use bevy_ecs::prelude::*;
use tumble_solver::soft_step::PairColour;

use super::near::{NearPair, NearPairs};
use super::{Collider, Colliders, ContactManifold, ContactMemory, ContactPair, Detection, Materials, PairKey};
use super::{ContactReuse, SoftModel, Touch, TouchPhase};
use crate::body::BodyTable;
use crate::geometry::Geometry;
use crate::part::Response;
use crate::{Clock, ContactModel, Settings};

/// Gives the contacts of pairs that ended to pairs that began, in order; spawns what is missing and despawns what is left.
pub fn sync_pairs<D: Geometry>(world: &mut World) {
    let near = &mut world.resource_mut::<Detection<D>>().into_inner().near;
    if near.ended.is_empty() && near.began.is_empty() {
        return;
    }
    let mut near = std::mem::take(near);
    let NearPairs { pairs, ended, began, .. } = &mut near;
    let (table, colliders) = (world.resource::<BodyTable>(), world.resource::<Colliders<D>>().as_slice());
    let materials = world.resource::<Materials>();
    let fresh: Vec<ContactPair> = (began.iter().map(|place| pairs[*place as usize].parts))
        .map(|(a, b)| new_pair(&colliders[a as usize], &colliders[b as usize], [a, b], table, materials))
        .collect();
    let mut touches = Vec::new();
    end_touches(world, ended, world.resource::<Clock>().time_after_part(), &mut touches);
    let reuse = Reuse::of(world.resource::<Settings<D>>().contact);
    if reuse == Reuse::Yes {
        release_colours::<D>(world, ended);
    }
    let mut places = began.drain(..);
    place_pairs::<D>(world, ended, &fresh, reuse, |entity| {
        if let Some(place) = places.next() {
            pairs[place as usize].contact = Some(entity);
        }
    });
    drop(places);
    ended.clear();
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.near = near;
    detection.touches.append(&mut touches);
}

/// Makes contact entities agree with the tables after bodies or parts were added or removed: pairs of known parts get their new
/// ranks and keep their memory; pairs of parts that are gone end.
pub(crate) fn renumber_pairs<D: Geometry>(world: &mut World) {
    let near = std::mem::take(&mut world.resource_mut::<Detection<D>>().near);
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
    for entity in near.pairs.iter().filter_map(|pair| pair.contact) {
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
            *known = ContactPair { touching: known.touching, points: known.points, acts: known.acts, ..pair };
        }
        // Their shapes may be others now.
        if let Some(mut reuse) = world.get_mut::<ContactReuse<D>>(entity) {
            *reuse = ContactReuse::default();
        }
        pairs.push(NearPair { parts: pair.colliders.into(), contact: Some(entity) });
    }
    pairs.sort_unstable_by_key(|pair| pair.parts);
    let mut touches = Vec::new();
    end_touches(world, &gone, world.resource::<Clock>().time(), &mut touches);
    for entity in gone {
        world.despawn(entity);
    }
    world.resource_mut::<SoftModel<D>>().colours().forget();
    let mut detection = world.resource_mut::<Detection<D>>();
    detection.near.pairs = pairs;
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

/// Finds an entity for every pair that began, in order: one whose pair ended, as long as there are any, and otherwise a new one.
fn place_pairs<D: Geometry>(
    world: &mut World,
    ended: &[Entity],
    began: &[ContactPair],
    reuse: Reuse,
    mut placed: impl FnMut(Entity),
) {
    let mut began = began.iter().copied();
    for entity in ended {
        // The user may have despawned it.
        let Ok(contact) = world.get_entity_mut(*entity) else { continue };
        // What somebody has put on it must not pass to another pair.
        let plain = contact.archetype().components().len() == reuse.components();
        if plain && let Some(pair) = began.next() {
            renew::<D>(contact, pair);
            placed(*entity);
        } else {
            contact.despawn();
        }
    }
    let fresh: Vec<ContactPair> = began.collect();
    let bundles = (fresh.iter().copied())
        .map(|pair| (pair, ContactManifold::<D>(D::Manifold::default()), ContactMemory::<D>(D::PerPoint::default())));
    match reuse {
        Reuse::No => world.spawn_batch(bundles).for_each(placed),
        Reuse::Yes => {
            let bundles =
                bundles.map(|(pair, manifold, memory)| (pair, manifold, memory, ContactReuse::<D>::default()));
            world.spawn_batch(bundles).for_each(placed);
        }
    }
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
        acts: false,
        colour: PairColour::NONE,
        twist: 0.0,
    }
}
