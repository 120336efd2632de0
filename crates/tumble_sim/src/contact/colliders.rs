//! The table of parts: every part in the order of its body's id, then of its place on the body.

use std::collections::BTreeSet;

use bevy_ecs::prelude::*;
use tumble_math::Linear;

use crate::body::{BodyId, BodyKind, BodyTable, PartFrame};
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::part::{Groups, MaterialId, Part, Parts, Response};

/// One part as collision detection sees it.
#[derive(Clone, Debug)]
pub struct Collider<D: Geometry> {
    /// The part's entity.
    pub entity: Entity,
    /// Rank of the body.
    pub body: u32,
    /// Number of the part on its body.
    pub part: u32,
    /// The shape in the body frame.
    pub shape: D::Shape,
    /// Largest distance of the shape from the centre of mass; infinite for a shape without bounds [m].
    pub bounding_radius: f64,
    /// Its surface.
    pub material: MaterialId,
    /// Whether it pushes back.
    pub response: Response,
    /// What it can touch.
    pub groups: Groups,
}

impl<D: Geometry> Collider<D> {
    /// Largest distance of the shape from the centre of mass; 0 for a shape without bounds [m].
    pub fn extent(&self) -> f64 {
        if self.bounding_radius.is_finite() { self.bounding_radius } else { 0.0 }
    }
}

/// All parts of all bodies.
#[derive(Resource, Clone, Debug)]
pub struct Colliders<D: Geometry> {
    list: Vec<Collider<D>>,
    /// Rank of the first part of each body, and one past the end.
    starts: Vec<u32>,
    /// Largest extent of the parts of each body [m].
    extents: Vec<f64>,
    /// Largest bounding radius of the parts of each body [m].
    radii: Vec<f64>,
}

impl<D: Geometry> Default for Colliders<D> {
    fn default() -> Self {
        Self { list: Vec::new(), starts: vec![0], extents: Vec::new(), radii: Vec::new() }
    }
}

impl<D: Geometry> Colliders<D> {
    /// All parts, in order.
    pub fn as_slice(&self) -> &[Collider<D>] {
        &self.list
    }

    /// The parts of a body.
    pub fn of_body(&self, index: u32) -> &[Collider<D>] {
        &self.list[self.range(index)]
    }

    /// Largest distance of a part of the body from its centre of mass; parts without bounds count as points [m].
    pub fn extent_of_body(&self, index: u32) -> f64 {
        self.extents[index as usize]
    }

    /// The same, infinite for a body with a part without bounds [m].
    pub(super) fn radius_of_body(&self, index: u32) -> f64 {
        self.radii[index as usize]
    }

    /// Ranks of the parts of a body.
    pub fn range(&self, body: u32) -> std::ops::Range<usize> {
        self.starts[body as usize] as usize..self.starts[body as usize + 1] as usize
    }
}

/// Pairs of bodies that pass through each other.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct IgnoredPairs(BTreeSet<(BodyId, BodyId)>);

impl IgnoredPairs {
    /// Lets two bodies pass through each other.
    pub fn insert(&mut self, one: BodyId, other: BodyId) {
        self.0.insert((one.min(other), one.max(other)));
    }

    /// Whether two bodies pass through each other.
    pub fn contains(&self, one: BodyId, other: BodyId) -> bool {
        self.0.contains(&(one.min(other), one.max(other)))
    }

    /// All pairs, smaller id first.
    pub fn iter(&self) -> impl Iterator<Item = (BodyId, BodyId)> {
        self.0.iter().copied()
    }
}

/// Whether two parts may touch at all.
pub(super) fn may_touch<D: Geometry>(
    a: &Collider<D>,
    b: &Collider<D>,
    table: &BodyTable,
    ignored: &IgnoredPairs,
    joints: &JointTable<D>,
) -> bool {
    let (body_a, body_b) = (table.entry(a.body), table.entry(b.body));
    let one_moves = body_a.kind == BodyKind::Dynamic || body_b.kind == BodyKind::Dynamic;
    let apart = || !ignored.contains(body_a.id, body_b.id) && !joints.hold_together(a.body, b.body);
    a.body != b.body && one_moves && a.groups.admit(b.groups) && apart()
}

/// Rebuilds the table from the bodies and their parts.
pub(crate) fn prepare_colliders<D: Geometry>(world: &mut World) {
    let mut colliders = Colliders::<D> { list: Vec::new(), starts: Vec::new(), extents: Vec::new(), radii: Vec::new() };
    for (body, entry) in world.resource::<BodyTable>().entries().iter().enumerate() {
        colliders.starts.push(colliders.list.len() as u32);
        let origin = world.get::<PartFrame<D::Vector>>(entry.entity).map_or(D::Vector::ZERO, |frame| frame.0);
        let parts = world.get::<Parts>(entry.entity).into_iter().flat_map(|parts| parts.iter());
        for (number, (entity, part)) in parts.filter_map(|e| Some((e, world.get::<Part<D>>(e)?))).enumerate() {
            let shape = D::translated(&part.shape, origin);
            colliders.list.push(Collider {
                entity,
                body: body as u32,
                part: number as u32,
                bounding_radius: D::extent(&shape).unwrap_or(f64::INFINITY),
                shape,
                material: part.material,
                response: part.response,
                groups: part.groups,
            });
        }
        let parts = &colliders.list[colliders.starts[body] as usize..];
        colliders.extents.push(parts.iter().map(Collider::extent).fold(0.0, f64::max));
        colliders.radii.push(parts.iter().map(|part| part.bounding_radius).fold(0.0, f64::max));
    }
    colliders.starts.push(colliders.list.len() as u32);
    world.insert_resource(colliders);
}
