//! Sleep: islands of bodies that have come to rest cost nothing until something touches them.
//!
//! An island is what hangs together by contacts between bodies that move; what cannot move does not join islands, it carries them.
//!
//! ```text
//!   ┌─┐           all of an island slow for long enough ─▶ Asleep: no forces, no steps, no detection
//!   ├─┤┌─┐        a contact point with a body that is awake, or with a carrier that moves ─▶ awake, before it is solved
//! ══╧═╧╧═╧══      a body added, removed or edited ─▶ all awake
//! ```
//!
//! Sleeping bodies lie in tables of their own, which the systems of a step do not visit. Soft steps solve the pairs that are left in the same
//! order, so what is awake moves by the same bits as if nothing slept.
//!
//! Bodies of joints, springs and applied forces never sleep, nor do those that they lie against. Forces of the user wake nobody.

use std::collections::BTreeSet;

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear};

use crate::body::{AngularVelocity, BodyIndex, BodyKind, BodyTable, LinearVelocity};
use crate::contact::{Colliders, ContactPair};
use crate::force::{Anchor, AppliedForce, Spring};
use crate::geometry::Geometry;
use crate::joint::JointTable;
use crate::part::Response;
use crate::{Clock, Settings};

/// A body of an island that sleeps, or a contact of such a body.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asleep;

/// What the systems of a step visit.
pub type Awake = Without<Asleep>;

/// When bodies fall asleep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SleepSettings {
    /// No point of a body is faster than this [m/s]. Default 0.05.
    pub speed: f64,
    /// For so long [s]. Default 0.5.
    pub after: f64,
}

impl Default for SleepSettings {
    fn default() -> Self {
        Self { speed: 0.05, after: 0.5 }
    }
}

/// Who has been slow for how long, and who sleeps with whom.
#[derive(Resource, Clone, Debug, Default)]
pub struct Rest {
    /// Time for which each body has been slow, by rank [s].
    slow_for: Vec<f64>,
    /// The island of each sleeping body, by rank: the least rank in it.
    island: Vec<Option<u32>>,
    /// Union-find: a body of the same island with a rank no larger.
    leaders: Vec<u32>,
    /// Bodies whose island must stay awake, by rank.
    restless: Vec<bool>,
}

impl Rest {
    /// Number of sleeping bodies.
    pub fn sleeping(&self) -> usize {
        self.island.iter().flatten().count()
    }

    fn leader(&mut self, mut body: u32) -> u32 {
        while self.leaders[body as usize] != body {
            let next = self.leaders[body as usize];
            self.leaders[body as usize] = self.leaders[next as usize];
            body = next;
        }
        body
    }

    fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.leader(one), self.leader(other));
        self.leaders[one.max(other) as usize] = one.min(other);
    }
}

type BodyMotions<'w, 's, D> = Query<
    'w,
    's,
    (
        Entity,
        &'static BodyIndex,
        &'static BodyKind,
        &'static mut LinearVelocity<<D as Dim>::Vector>,
        &'static mut AngularVelocity<<D as Dim>::Angular>,
    ),
    Awake,
>;

/// Wakes islands that are touched, then lets islands sleep that have been slow for long enough.
pub fn settle<D: Geometry>(
    (clock, settings): (Res<Clock>, Res<Settings<D>>),
    table: Res<BodyTable>,
    colliders: Res<Colliders<D>>,
    joints: Res<JointTable<D>>,
    mut rest: ResMut<Rest>,
    mut bodies: BodyMotions<D>,
    pairs: Query<(Entity, &ContactPair), Awake>,
    sleeping_pairs: Query<(Entity, &ContactPair), With<Asleep>>,
    springs: Query<&Spring<D::Vector>>,
    applied: Query<&AppliedForce<D>>,
    mut commands: Commands,
) {
    let Some(sleep) = settings.sleep else { return };
    let count = table.entries().len();
    let rest = &mut *rest;
    rest.slow_for.resize(count, 0.0);
    rest.island.resize(count, None);
    rest.restless.clear();
    rest.restless.resize(count, false);
    rest.leaders.clear();
    rest.leaders.extend(0..count as u32);

    for (_, index, kind, velocity, spin) in &bodies {
        let speed = velocity.0.length() + spin.0.length() * colliders.extent_of_body(index.0);
        let slow = speed <= sleep.speed;
        let time = &mut rest.slow_for[index.0 as usize];
        *time = if slow { *time + clock.dt } else { 0.0 };
        // What carries does not sleep, but whom it carries may, as long as it stands.
        let moves = velocity.0 != D::Vector::ZERO || spin.0 != D::Angular::ZERO;
        rest.restless[index.0 as usize] = *kind != BodyKind::Dynamic && moves;
    }
    let tied = joints.entries().iter().flat_map(|joint| joint.bodies);
    for body in tied.filter(|body| (*body as usize) < count) {
        rest.restless[body as usize] = true;
    }
    let held = springs.iter().flat_map(|spring| [spring.a, spring.b]).filter_map(|end| match end {
        Anchor::Body(body, _) => Some(body),
        Anchor::World(_) => None,
    });
    for body in held.chain(applied.iter().map(|force| force.body)) {
        if let Ok((_, index, ..)) = bodies.get(body) {
            rest.restless[index.0 as usize] = true;
        }
    }

    let moves = |body: u32| table.entry(body).kind == BodyKind::Dynamic;
    let mut woken = BTreeSet::new();
    for (_, pair) in &pairs {
        if pair.response == Response::Sensor || !pair.acts {
            continue;
        }
        let [a, b] = pair.bodies;
        for (one, other) in [(a, b), (b, a)] {
            // A body that is awake lies against it, or what carries it has begun to move.
            if let Some(island) = rest.island[one as usize]
                && rest.island[other as usize].is_none()
                && (moves(other) || rest.restless[other as usize])
            {
                woken.insert(island);
            }
        }
        match [moves(a), moves(b)] {
            [true, true] => rest.join(a, b),
            [true, false] => rest.restless[a as usize] |= rest.restless[b as usize],
            [false, true] => rest.restless[b as usize] |= rest.restless[a as usize],
            [false, false] => {}
        }
    }
    wake(rest, &woken, &table, &sleeping_pairs, &mut commands);

    // An island stays awake for the sake of any of its bodies.
    for body in 0..count as u32 {
        let waits = rest.slow_for[body as usize] < sleep.after;
        if moves(body) && (rest.restless[body as usize] || waits) && rest.island[body as usize].is_none() {
            let leader = rest.leader(body);
            rest.restless[leader as usize] = true;
        }
    }
    let mut slept = false;
    for body in 0..count as u32 {
        let leader = rest.leader(body);
        if moves(body) && rest.island[body as usize].is_none() && !rest.restless[leader as usize] {
            rest.island[body as usize] = Some(leader);
            slept = true;
        }
    }
    if !slept {
        return;
    }
    for (entity, index, _, mut velocity, mut spin) in &mut bodies {
        if rest.island[index.0 as usize].is_some() {
            velocity.bypass_change_detection().0 = D::Vector::ZERO;
            spin.bypass_change_detection().0 = D::Angular::ZERO;
            commands.entity(entity).insert(Asleep);
        }
    }
    for (entity, pair) in &pairs {
        let sleeps = |body: u32| rest.island[body as usize].is_some();
        // What is kinematic may begin to move.
        let stands = |body: u32| sleeps(body) || table.entry(body).kind == BodyKind::Static;
        if pair.bodies.into_iter().any(sleeps) && pair.bodies.into_iter().all(stands) {
            commands.entity(entity).insert(Asleep);
        }
    }
}

/// Wakes islands, and the contacts of their bodies.
fn wake(
    rest: &mut Rest,
    woken: &BTreeSet<u32>,
    table: &BodyTable,
    sleeping_pairs: &Query<(Entity, &ContactPair), With<Asleep>>,
    commands: &mut Commands,
) {
    if woken.is_empty() {
        return;
    }
    for (body, island) in rest.island.iter_mut().enumerate() {
        if island.is_some_and(|island| woken.contains(&island)) {
            *island = None;
            rest.slow_for[body] = 0.0;
            commands.entity(table.entry(body as u32).entity).remove::<Asleep>();
        }
    }
    for (entity, pair) in sleeping_pairs {
        let kind = |body: u32| table.entry(body).kind;
        if pair.bodies.iter().any(|body| kind(*body) == BodyKind::Dynamic && rest.island[*body as usize].is_none()) {
            commands.entity(entity).remove::<Asleep>();
        }
    }
}

/// Wakes everything: bodies were added, removed or edited.
pub(crate) fn wake_all(world: &mut World) {
    if world.resource::<Rest>().island.is_empty() {
        return;
    }
    *world.resource_mut::<Rest>() = Rest::default();
    let mut sleeping = world.query_filtered::<Entity, With<Asleep>>();
    let sleeping: Vec<Entity> = sleeping.iter(world).collect();
    for entity in sleeping {
        world.entity_mut(entity).remove::<Asleep>();
    }
}
