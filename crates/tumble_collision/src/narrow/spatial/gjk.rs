//! Distance of two convex cores: Gilbert, Johnson and Keerthi (1988).
//!
//! The distance of two convex bodies is that of their Minkowski difference from the origin. A simplex of up to four of its points
//! walks towards the origin; in each round the point of the difference farthest in that direction is added. It stops when
//! no point is farther by more than rounding, or when the simplex does not come closer.

use glam::DVec3;

use super::core::Core;
use super::simplex::{Simplex, Support};

/// Share of the squared distance that the next support point must gain, or the search ends [1].
const GAIN: f64 = 1e-15;

/// Rounds after which the search ends; polyhedra need about ten.
const ROUNDS: u32 = 64;

/// The closest points of two cores that are apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closest {
    /// Closest point of core a, in the frame of a [m].
    pub(super) on_a: DVec3,
    /// Closest point of core b, in the frame of a [m].
    pub(super) on_b: DVec3,
    /// The points whose weighted mean they are.
    pub(super) simplex: Simplex,
}

/// Closest points of two cores, both in the frame of a; `None` if they overlap or touch.
///
/// `direction` is a first guess of the direction from a to b; any will do.
pub(super) fn closest(a: &Core, b: &Core, direction: DVec3) -> Option<Closest> {
    let support = |direction: DVec3| {
        let (on_a, id_a) = a.farthest(direction);
        let (on_b, id_b) = b.farthest(-direction);
        Support { w: on_a - on_b, on_a, on_b, ids: [id_a, id_b] }
    };
    let mut simplex = Simplex::new(support(direction));
    let mut to_origin = -simplex.points()[0].w;
    let mut squared = to_origin.length_squared();
    // Size of the bodies, for what rounding may leave of a distance.
    let size = simplex.points()[0].on_a.length() + simplex.points()[0].on_b.length();
    for _ in 0..ROUNDS {
        if squared <= (f64::EPSILON * size) * (f64::EPSILON * size) {
            return None;
        }
        let next = support(to_origin);
        let known = simplex.points().iter().any(|point| point.ids == next.ids && point.w == next.w);
        // w · v is the largest over the difference: no point of it is closer than that along v.
        if known || squared + next.w.dot(to_origin) <= GAIN * squared {
            break;
        }
        let before = simplex;
        let found = -simplex.add(next)?;
        if found.length_squared() >= squared {
            simplex = before;
            break;
        }
        to_origin = found;
        squared = found.length_squared();
    }
    Some(Closest { on_a: simplex.mean(|point| point.on_a), on_b: simplex.mean(|point| point.on_b), simplex })
}
