//! Contact points of near pairs, and what is remembered of them: the last part of collision detection (L1).

use std::iter::repeat_with;
use std::sync::{Mutex, PoisonError};

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::prelude::*;
use tumble_math::Linear;

use super::CarriedParts;
use super::bounds::PartBounds;
use super::detect::BodyMotion;
use super::{Collider, Colliders, ContactManifold, ContactMemory, ContactPair, Detection, IN_TABLES};
use super::{ContactReuse, PointMemory, Touch, TouchPhase};
use crate::fault::Fault;
use crate::geometry::{ContactQuery, Geometry, Posed};
use crate::rest::Awake;
use crate::simulation::Beginning;
use crate::threads::{PAIRS_OF_A_TASK, Threads};
use crate::{Clock, Settings};

/// Gap up to which a touching point goes on touching, in slops: a body that turns about its contact point lifts it by
/// ½ r (ω Δt)² in each step, since steps run along tangents.
const KEEP_TOLERANCE: f64 = 0.01;

/// Contact points of every pair, matched by feature to those of the step before.
pub fn find_contacts<D: Geometry>(
    settings: Res<Settings<D>>,
    colliders: Res<Colliders<D>>,
    threads: Res<Threads>,
    mut detection: ResMut<Detection<D>>,
    mut pairs: Query<
        (&mut ContactPair, &mut ContactManifold<D>, &mut ContactMemory<D>, Option<&mut ContactReuse<D>>),
        Awake,
    >,
    mut messages: ResMut<Messages<Touch>>,
    clock: Res<Clock>,
    beginning: Res<Beginning>,
    fault: Res<Fault>,
) {
    if !fault.is_none() {
        return;
    }
    let detection = &mut *detection;
    let touches = Mutex::new(&mut detection.touches);
    let touch_tolerance = settings.touch_tolerance();
    let look = Look {
        settings: &settings,
        colliders: colliders.as_slice(),
        motions: &detection.motions,
        bounds: &detection.bounds,
        touch_tolerance,
        keep_tolerance: touch_tolerance.max(KEEP_TOLERANCE * settings.slop()),
        begins: clock.time(),
        time: if *beginning == Beginning::Yes { clock.time() } else { clock.time_after_part() },
        touches,
    };
    for (pairs, manifolds, memories, reuses) in pairs.contiguous_iter_mut().expect(IN_TABLES) {
        let (pairs, _) = ContiguousMut::split(pairs);
        let (manifolds, _) = ContiguousMut::split(manifolds);
        let (memories, _) = ContiguousMut::split(memories);
        let reuses = reuses.map_or(&mut [][..], |reuses| ContiguousMut::split(reuses).0);
        let chunks = pairs.chunks_mut(PAIRS_OF_A_TASK).zip(manifolds.chunks_mut(PAIRS_OF_A_TASK));
        let chunks = chunks.zip(memories.chunks_mut(PAIRS_OF_A_TASK));
        let chunks = chunks.zip(reuses.chunks_mut(PAIRS_OF_A_TASK).chain(repeat_with(|| &mut [][..])));
        threads.team().share(chunks, |(((pairs, manifolds), memories), reuses)| {
            let reuses = reuses.iter_mut().map(Some).chain(repeat_with(|| None));
            for (((pair, manifold), memory), reuse) in pairs.iter_mut().zip(manifolds).zip(memories).zip(reuses) {
                look.at(pair, &mut manifold.0, &mut memory.0, reuse);
            }
        });
    }
    if !detection.touches.is_empty() {
        // By whichever thread and in whatever order they were found.
        detection.touches.sort_by(|one, other| {
            one.time.total_cmp(&other.time).then((one.pair, one.phase).cmp(&(other.pair, other.phase)))
        });
        messages.write_batch(detection.touches.drain(..));
    }
}

/// What is needed to look at a pair.
struct Look<'a, D: Geometry> {
    settings: &'a Settings<D>,
    colliders: &'a [Collider<D>],
    motions: &'a [BodyMotion<D>],
    bounds: &'a PartBounds<D>,
    touch_tolerance: f64,
    keep_tolerance: f64,
    /// The step's start, and the time to which the contacts belong [s].
    begins: f64,
    time: f64,
    touches: Mutex<&'a mut Vec<Touch>>,
}

impl<D: Geometry> Look<'_, D> {
    /// Brings a pair up to date.
    fn at(
        &self,
        pair: &mut ContactPair,
        manifold: &mut D::Manifold,
        memory: &mut D::PerPoint<PointMemory<D::Vector>>,
        reuse: Option<&mut ContactReuse<D>>,
    ) {
        if !pair.touching && self.bounds.are_apart(pair.colliders.into()) {
            pair.acts = false;
            if std::mem::take(&mut pair.points) > 0 {
                *manifold = D::Manifold::default();
                pair.twist = 0.0;
                if let Some(reuse) = reuse {
                    *reuse = ContactReuse::default();
                }
            }
            return;
        }
        let bodies = pair.bodies.map(|body| &self.motions[body as usize]);
        let margin = bodies[0].reach + bodies[1].reach;
        match reuse {
            Some(reuse) if reuse.holds(bodies, margin) => reuse.carry(manifold, bodies),
            Some(reuse) => {
                let parts = self.parts(pair);
                let tolerance = parts.tolerance();
                // Farther, by what a step may reach farther and by what bodies may come nearer unnoticed.
                let looked = margin + tolerance;
                let found = self.find(pair, manifold, looked + 2.0 * tolerance);
                reuse.remember(&found, bodies, &parts, looked);
                if D::points(&found).is_empty() {
                    pair.twist = 0.0;
                }
                remember::<D>(manifold, &found, memory);
                *manifold = found;
            }
            None => {
                let found = self.find(pair, manifold, margin);
                remember::<D>(manifold, &found, memory);
                *manifold = found;
            }
        }
        pair.points = D::points(manifold).len() as u8;
        let (mut touching, mut hopped, mut near) = (false, true, false);
        for (point, memory) in D::points(manifold).iter().zip(memory.as_mut()) {
            let reach = if memory.touches { self.keep_tolerance } else { self.touch_tolerance };
            let flies = memory.flies && point.separation > -self.touch_tolerance;
            memory.touches = memory.held || point.separation <= reach && !flies;
            memory.flies &= !memory.touches;
            touching |= memory.touches;
            near |= point.separation <= margin;
            hopped &= std::mem::take(&mut memory.hopped) || !memory.touches;
        }
        pair.acts = touching || near;
        if touching != pair.touching {
            self.tell(pair, if touching { TouchPhase::Began } else { TouchPhase::Ended }, self.time);
            pair.touching = touching;
        } else if touching && hopped {
            self.tell(pair, TouchPhase::Ended, self.begins);
            self.tell(pair, TouchPhase::Began, self.time);
        }
    }

    /// What carrying its points depends on.
    fn parts(&self, pair: &ContactPair) -> CarriedParts {
        let colliders = pair.colliders.map(|collider| &self.colliders[collider as usize]);
        CarriedParts {
            reaches: colliders.map(|collider| collider.bounding_radius),
            radii: colliders.map(|collider| D::rounding(&collider.shape)),
            roll: colliders.iter().any(|part| D::round_axis(&part.shape).is_some()),
            length_scale: self.settings.length_scale,
        }
    }

    /// The points of a pair, found anew.
    fn find(&self, pair: &ContactPair, previous: &D::Manifold, margin: f64) -> D::Manifold {
        let [a, b] = [0, 1].map(|k| Posed {
            shape: &self.colliders[pair.colliders[k] as usize].shape,
            pose: &self.motions[pair.bodies[k] as usize].pose,
        });
        let flush_tolerance = 2.0 * self.settings.slop() + self.touch_tolerance;
        D::collide(a, b, &ContactQuery { margin, flush_tolerance, previous })
    }

    fn tell(&self, pair: &ContactPair, phase: TouchPhase, time: f64) {
        let touch = Touch { phase, pair: pair.key, response: pair.response, time };
        self.touches.lock().unwrap_or_else(PoisonError::into_inner).push(touch);
    }
}

/// Carries over what is remembered of the points that are found again.
fn remember<D: Geometry>(before: &D::Manifold, found: &D::Manifold, memory: &mut D::PerPoint<PointMemory<D::Vector>>) {
    let known = D::points(before);
    let same = known.iter().map(|point| point.feature).eq(D::points(found).iter().map(|point| point.feature));
    if same {
        for (memory, point) in memory.as_mut().iter_mut().zip(known) {
            memory.separation_before = Some(point.separation);
            memory.settle(D::normal(found));
        }
        return;
    }
    let old = *memory;
    for (new, point) in memory.as_mut().iter_mut().zip(D::points(found)) {
        let place = known.iter().position(|candidate| candidate.feature == point.feature);
        *new = match place {
            Some(place) => PointMemory { separation_before: Some(known[place].separation), ..old.as_ref()[place] },
            None => PointMemory { feature: point.feature, ..PointMemory::default() },
        };
        new.feature = point.feature;
        new.settle(D::normal(found));
    }
}

impl<V: Linear> PointMemory<V> {
    /// What was pending has been given.
    fn settle(&mut self, normal: V) {
        self.held_back = self.pending.dot(normal) > 0.0;
        self.given += std::mem::replace(&mut self.pending, V::ZERO);
    }
}
