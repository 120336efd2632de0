//! Which materials can meet in a scene.
//!
//! Two parts can meet if a dynamic body is involved, neither is a sensor, each accepts a group of the other, and their bodies do not
//! ignore each other. Where bodies are and how they move is not asked.

use std::collections::{BTreeMap, BTreeSet};

use crate::dim::SceneDim;
use crate::expand::{copies, count};
use crate::format::{BodyEntry, BodyKind, Groups, PartEntry, Scene};
use crate::materials::DEFAULT_MATERIAL;
use crate::path::ScenePath;

/// Two materials that can meet, and where the scene says so first.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// The materials, in alphabetical order.
    pub materials: [String; 2],
    /// Where a body is given the one and the other; the same place for two copies of a body.
    pub places: [ScenePath; 2],
}

/// Every pair of materials that can meet, in alphabetical order.
pub fn meetings<D: SceneDim>(scene: &Scene<D>) -> Vec<Meeting> {
    let surfaces = surfaces(scene);
    let mut found: BTreeMap<[&str; 2], [usize; 2]> = BTreeMap::new();
    for (index, one) in surfaces.iter().enumerate() {
        for other in &surfaces[index..] {
            let (first, second) = if one.material <= other.material { (one, other) } else { (other, one) };
            let pair = [first.material, second.material];
            if !found.contains_key(&pair)
                && one.can_touch(other)
                && let Some(bodies) = bodies_that_meet(scene, first, second)
            {
                found.insert(pair, bodies);
            }
        }
    }
    let meeting = |(materials, bodies): ([&str; 2], [usize; 2])| Meeting {
        materials: materials.map(str::to_owned),
        places: [0, 1].map(|side| place(scene, bodies[side], materials[side])),
    };
    found.into_iter().map(meeting).collect()
}

/// What decides whether a part can meet another, and the bodies that have such parts.
struct SurfaceKind<'s> {
    material: &'s str,
    is_dynamic: bool,
    member_of: &'s Groups,
    accepts: &'s Groups,
    /// Indices in the scene's list of bodies, ascending.
    bodies: Vec<usize>,
}

impl SurfaceKind<'_> {
    fn can_touch(&self, other: &Self) -> bool {
        (self.is_dynamic || other.is_dynamic)
            && self.accepts.overlaps(other.member_of)
            && other.accepts.overlaps(self.member_of)
    }
}

/// All different kinds of surfaces; few, however many bodies there are.
fn surfaces<D: SceneDim>(scene: &Scene<D>) -> Vec<SurfaceKind<'_>> {
    let mut kinds: Vec<SurfaceKind> = Vec::new();
    for (index, body) in scene.bodies.iter().enumerate() {
        for part in scene.parts_of(body).filter(|part| !part.shared().sensor) {
            let material = part.shared().material.or(body.material.as_deref()).unwrap_or(DEFAULT_MATERIAL);
            let is_dynamic = body.kind == BodyKind::Dynamic;
            let (member_of, accepts) = part.shared().groups;
            let member_of = member_of.unwrap_or(&body.groups);
            let accepts = accepts.unwrap_or(&body.collides_with);
            let is_same = |kind: &&mut SurfaceKind| {
                (kind.material, kind.is_dynamic) == (material, is_dynamic)
                    && (kind.member_of, kind.accepts) == (member_of, accepts)
            };
            match kinds.iter_mut().find(is_same) {
                Some(kind) if kind.bodies.last() == Some(&index) => {}
                Some(kind) => kind.bodies.push(index),
                None => kinds.push(SurfaceKind { material, is_dynamic, member_of, accepts, bodies: vec![index] }),
            }
        }
    }
    kinds
}

/// The first two bodies with these surfaces that do not ignore each other.
fn bodies_that_meet<D: SceneDim>(scene: &Scene<D>, one: &SurfaceKind, other: &SurfaceKind) -> Option<[usize; 2]> {
    let pairs = one.bodies.iter().flat_map(|&a| other.bodies.iter().map(move |&b| [a, b]));
    pairs.into_iter().find(|&[a, b]| {
        let (body_a, body_b) = (&scene.bodies[a], &scene.bodies[b]);
        (a != b || count(body_a) > 1) && !ignores(scene, body_a, body_b) && !ignores(scene, body_b, body_a)
    })
}

/// Whether a body ignores another with all its copies.
fn ignores<D: SceneDim>(scene: &Scene<D>, body: &BodyEntry<D>, other: &BodyEntry<D>) -> bool {
    if body.ignores.is_empty() {
        return false;
    }
    let ignored: BTreeSet<String> = body.ignores.iter().flat_map(|name| scene.names_meant_by(name)).collect();
    copies(other).all(|copy| ignored.contains(&copy.name))
}

/// Where a body is given a material: in its own field, or wherever its parts stand.
fn place<D: SceneDim>(scene: &Scene<D>, index: usize, material: &str) -> ScenePath {
    let body = &scene.bodies[index];
    let field = if body.material.as_deref() == Some(material) { "material" } else { "name" };
    ScenePath::root().field("bodies").index(index).field(field)
}
