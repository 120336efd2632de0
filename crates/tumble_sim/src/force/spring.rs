//! Springs with dampers between points of bodies or the world.
//!
//! ```text
//! d = p_b − p_a,  n = d/|d|,  ℓ = |d|
//! f = (k (ℓ − L) + c ℓ̇) n   on a at p_a, −f on b at p_b
//! ```

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Rotation};

use crate::body::{AngularVelocity, BodyIndex, Force, InDim, LinearVelocity, Orientation, Position, Torque};
use crate::geometry::Geometry;
use crate::ledger::{Books, ForceLine};

/// An end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor<V> {
    /// A point that does not move, in world axes [m].
    World(V),
    /// A point of a body, in its body frame [m].
    Body(Entity, V),
}

/// A spring with a damper, an entity of its own.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Spring<V: Send + Sync + 'static> {
    /// One end.
    pub a: Anchor<V>,
    /// The other end.
    pub b: Anchor<V>,
    /// k [N/m].
    pub stiffness: f64,
    /// c [N·s/m].
    pub damping: f64,
    /// L: length without force [m].
    pub rest_length: f64,
}

type BodyQuery<'w, 's, D> = Query<
    'w,
    's,
    (
        &'static BodyIndex,
        &'static Position<<D as Dim>::Vector>,
        &'static Orientation<<D as Dim>::Rotation>,
        &'static LinearVelocity<<D as Dim>::Vector>,
        &'static AngularVelocity<<D as Dim>::Angular>,
        &'static mut Force<<D as Dim>::Vector>,
        &'static mut Torque<<D as Dim>::Angular>,
    ),
>;

/// Where an anchor is, how fast it moves, and its arm from the centre of mass.
struct End<D: Dim> {
    /// Rank of the body; `None` for the world.
    body: Option<u32>,
    point: D::Vector,
    velocity: D::Vector,
    arm: D::Vector,
}

/// Adds the forces of all springs.
pub fn apply_springs<D: Geometry>(
    springs: Query<&Spring<D::Vector>>,
    mut books: Option<ResMut<Books<D>>>,
    mut bodies: BodyQuery<D>,
) {
    for spring in &springs {
        let (Some(a), Some(b)) = (end::<D>(&spring.a, &bodies), end::<D>(&spring.b, &bodies)) else { continue };
        let offset = b.point - a.point;
        let length = offset.length();
        if length == 0.0 {
            continue;
        }
        let direction = offset * (1.0 / length);
        let rate = direction.dot(b.velocity - a.velocity);
        let tension = spring.stiffness * (length - spring.rest_length) + spring.damping * rate;
        let force = direction * tension;
        pull::<D>(&spring.a, &a, force, &mut bodies);
        pull::<D>(&spring.b, &b, -force, &mut bodies);
        if let Some(books) = &mut books {
            let damper = direction * (spring.damping * rate);
            for (end, force) in [(&a, damper), (&b, -damper)] {
                if let Some(body) = end.body {
                    books.move_to(ForceLine::User, ForceLine::Springs, body as usize, force, D::torque(end.arm, force));
                }
            }
        }
    }
}

/// ½ k (ℓ − L)² of a spring whose ends are at these points [J].
pub fn spring_potential<V: Linear>(stiffness: f64, rest_length: f64, a: V, b: V) -> f64 {
    let stretch = (b - a).length() - rest_length;
    0.5 * stiffness * stretch * stretch
}

fn end<D: Dim<Vector: InDim>>(anchor: &Anchor<D::Vector>, bodies: &BodyQuery<D>) -> Option<End<D>> {
    match *anchor {
        Anchor::World(point) => Some(End { body: None, point, velocity: D::Vector::ZERO, arm: D::Vector::ZERO }),
        Anchor::Body(entity, point_body) => {
            let (index, position, orientation, velocity, spin, ..) = bodies.get(entity).ok()?;
            let arm = orientation.0.rotate(point_body);
            let velocity = velocity.0 + D::spin(spin.0, arm);
            Some(End { body: Some(index.0), point: position.0 + arm, velocity, arm })
        }
    }
}

fn pull<D: Dim<Vector: InDim>>(anchor: &Anchor<D::Vector>, end: &End<D>, force: D::Vector, bodies: &mut BodyQuery<D>) {
    if let Anchor::Body(entity, _) = *anchor
        && let Ok((.., mut sum, mut torque)) = bodies.get_mut(entity)
    {
        sum.bypass_change_detection().0 += force;
        torque.bypass_change_detection().0 += D::torque(end.arm, force);
    }
}
