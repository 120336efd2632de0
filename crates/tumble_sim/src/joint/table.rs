//! The table of joints, in an order that depends on the bodies and not on when a joint was spawned.

use std::collections::HashSet;

use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;

use tumble_math::Rotation;

use super::{Joint, JointMotion};
use crate::body::{BodyTable, InDim, Orientation};
use crate::error::BodyError;
use crate::force::Anchor;
use crate::geometry::Geometry;

/// One joint of the table.
#[derive(Clone, Debug)]
pub struct JointEntry<D: Geometry> {
    /// Its entity.
    pub entity: Entity,
    /// Its name; `joint-<number>` where none was given.
    pub name: String,
    /// What it lets the bodies do.
    pub kind: <D::Vector as InDim>::JointKind,
    /// Ranks of the two bodies; the number of bodies stands for the world.
    pub bodies: [u32; 2],
    /// The anchors: in body frames, or in world axes [m].
    pub anchors: [D::Vector; 2],
    /// Orientation of b in the frame of a when the joint was made.
    pub(crate) held: D::Rotation,
}

/// All joints: in the order of their bodies, then of their names.
#[derive(Resource, Clone, Debug)]
pub struct JointTable<D: Geometry> {
    entries: Vec<JointEntry<D>>,
    /// Pairs of bodies with a joint between them, the smaller rank first.
    pairs: HashSet<[u32; 2]>,
}

impl<D: Geometry> Default for JointTable<D> {
    fn default() -> Self {
        Self { entries: Vec::new(), pairs: HashSet::new() }
    }
}

impl<D: Geometry> JointTable<D> {
    /// All joints, in order.
    pub fn entries(&self) -> &[JointEntry<D>] {
        &self.entries
    }

    /// Whether a joint holds two bodies together, which then do not collide.
    pub fn hold_together(&self, one: u32, other: u32) -> bool {
        !self.pairs.is_empty() && self.pairs.contains(&[one.min(other), one.max(other)])
    }
}

/// Rebuilds the table; joints that were in it keep the orientation that they hold.
pub(crate) fn prepare_joints<D: Geometry>(world: &mut World) -> Result<(), BodyError> {
    let mut joints = world.query::<(Entity, &Joint<D::Vector>, Option<&Name>)>();
    let found: Vec<(Entity, Joint<D::Vector>, Option<String>)> = joints
        .iter(world)
        .map(|(entity, joint, name)| (entity, *joint, name.map(|name| name.as_str().to_owned())))
        .collect();
    let known = std::mem::take(&mut world.resource_mut::<JointTable<D>>().entries);
    let mut entries = Vec::with_capacity(found.len());
    for (number, (entity, joint, name)) in found.into_iter().enumerate() {
        let name = name.unwrap_or_else(|| format!("joint-{number}"));
        let mut bodies = [0; 2];
        let mut anchors = [joint.a, joint.b].map(|anchor| match anchor {
            Anchor::World(point) | Anchor::Body(_, point) => point,
        });
        for (rank, anchor) in bodies.iter_mut().zip([joint.a, joint.b]) {
            let gone = || BodyError::JointWithoutBody { joint: name.clone() };
            *rank = rank_of::<D>(world, anchor).ok_or_else(gone)?;
        }
        if bodies[0] == bodies[1] {
            return Err(BodyError::JointToItself { joint: name });
        }
        if let Some((quantity, value)) = joint.kind.bad_quantity() {
            return Err(BodyError::BadJoint { joint: name, quantity, value });
        }
        let before = known.iter().find(|entry| entry.entity == entity).map(|entry| entry.held);
        let held = before.unwrap_or_else(|| {
            let [a, b] = [joint.a, joint.b].map(|anchor| rotation_of::<D>(world, anchor));
            b.seen_from(&a)
        });
        // The first of the two is the one with the smaller rank where that changes nothing, so that writing them the other way round changes no bit.
        if bodies[0] > bodies[1] && !joint.kind.holds_directions() {
            bodies.reverse();
            anchors.reverse();
        }
        entries.push(JointEntry { entity, name, kind: joint.kind, bodies, anchors, held });
    }
    entries.sort_by(|one, other| (one.bodies, &one.name).cmp(&(other.bodies, &other.name)));
    let pairs =
        entries.iter().map(|entry| [entry.bodies[0].min(entry.bodies[1]), entry.bodies[0].max(entry.bodies[1])]);
    let pairs = pairs.collect();
    world.insert_resource(JointTable::<D> { entries, pairs });
    Ok(())
}

fn rank_of<D: Geometry>(world: &World, anchor: Anchor<D::Vector>) -> Option<u32> {
    let table = world.resource::<BodyTable>();
    match anchor {
        Anchor::World(_) => Some(table.entries().len() as u32),
        Anchor::Body(entity, _) => world.get::<crate::body::BodyIndex>(entity).map(|index| index.0),
    }
}

fn rotation_of<D: Geometry>(world: &World, anchor: Anchor<D::Vector>) -> D::Rotation {
    match anchor {
        Anchor::World(_) => D::Rotation::default(),
        Anchor::Body(entity, _) => {
            world.get::<Orientation<D::Rotation>>(entity).map_or(D::Rotation::default(), |orientation| orientation.0)
        }
    }
}
