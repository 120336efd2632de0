//! What a manifold of two polyhedra remembers: which axis decided, and for how long it can be trusted.
//!
//! Let s be the largest separation over all directions. When b moves against a so that no point of it moves by more than δ, every
//! separation changes by at most δ, and s by at most δ. So an axis with
//!
//! ```text
//! separation now ≥ s then + δ − preference
//! ```
//!
//! is still as good as the best, to the preference by which another one would have to be better: no search is needed. δ is measured
//! from the pose of the last search, so that nothing adds up. With a flush tolerance of zero there is no preference, and no memory.
//!
//! The points of a cut face are found again one by one, and only cut anew when one of them has stopped to be a corner of the cut. Of a
//! cut with more than four corners the four that were chosen stay chosen in the meantime.

use glam::DVec3;
use tumble_shape::ConvexHull;

use super::Pair;
use super::axis::{Axis, AxisOf, Found, Limits};
use super::cut::{Cut, Source};
use super::place::Place;
use super::search::{self, EdgeInA};
use crate::manifold::Memory;

/// Which axis decided when the pair was last searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisMemory {
    known: Option<Known>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Known {
    of: AxisOf,
    /// Largest separation over all directions [m].
    best: f64,
    /// How far the faces were from lying flush [m].
    clear: f64,
    /// Where b was.
    b_in_a: Place,
    /// Of a face axis: the face of the other hull that was cut, and what made the points; no points if not all are known.
    facing: usize,
    sources: [Source; 4],
    points: usize,
}

impl Memory for AxisMemory {
    const NONE: Self = Self { known: None };
}

impl AxisMemory {
    /// What a search found, and which of it was chosen.
    pub(super) fn new(pair: &Pair, found: &Found, choice: &Axis) -> Self {
        if pair.query.flush_tolerance == 0.0 {
            return Self::NONE;
        }
        let known = Known {
            of: choice.of,
            best: found.best(),
            clear: found.flush.clear,
            b_in_a: pair.b_in_a,
            facing: 0,
            sources: [Source::Incident(0); 4],
            points: 0,
        };
        Self { known: Some(known) }
    }

    /// The same with the points of a cut to remember.
    pub(super) fn with_cut(&self, facing: usize, cut: &Cut) -> Self {
        let mut memory = *self;
        if let Some(known) = &mut memory.known {
            known.facing = facing;
            known.points = cut.len();
            for (source, point) in known.sources.iter_mut().zip(cut) {
                *source = point.source;
            }
        }
        memory
    }

    /// The same with no points to remember.
    pub(super) fn without_cut(&self) -> Self {
        let mut memory = *self;
        if let Some(known) = &mut memory.known {
            known.points = 0;
        }
        memory
    }

    /// The face that was cut, and what made the points, if they are known.
    pub(super) fn cut(&self) -> Option<(usize, &[Source])> {
        let known = self.known.as_ref().filter(|known| known.points > 0)?;
        Some((known.facing, &known.sources[..known.points]))
    }

    /// The remembered axis as it is now, if it is still as good as the best.
    pub(super) fn still_best(&self, pair: &Pair, a: &ConvexHull, b: &ConvexHull, limits: &Limits) -> Option<Axis> {
        let known = self.known.as_ref()?;
        let moved = displacement(&known.b_in_a, &pair.b_in_a, b);
        let least = known.best + moved - limits.preference;
        // No axis has become better than the best one was by more than that.
        if moved >= known.clear || moved > limits.preference {
            return None;
        }
        let axis = now(known.of, pair, a, b)?;
        (axis.separation >= least).then_some(axis)
    }
}

/// An axis of two hulls in their present poses; `None` if the features are not there or make none.
fn now(of: AxisOf, pair: &Pair, a: &ConvexHull, b: &ConvexHull) -> Option<Axis> {
    let (normal, separation) = match of {
        AxisOf::FaceA(face) => {
            let normal = a.faces().get(face)?.normal;
            (normal, search::face_separation(a, face, b, &pair.b_in_a))
        }
        AxisOf::FaceB(face) => {
            let normal = b.faces().get(face)?.normal;
            (-pair.b_in_a.vector(normal), search::face_separation(b, face, a, &pair.b_in_a.inverse()))
        }
        AxisOf::Edges(i, j) => {
            if i >= a.edges().len() || j >= b.edges().len() {
                return None;
            }
            let (one, other) = (EdgeInA::new(a, i, None), EdgeInA::new(b, j, Some(&pair.b_in_a)));
            search::separation_of_edges([a, b], &pair.b_in_a, &one, &other)?
        }
    };
    Some(Axis { of, normal, separation })
}

/// A distance that no point of a hull has moved by more than, between two places of its frame [m].
///
/// A point is the centre and an arm of at most the outer radius, which the change of rotation stretches by at most its Frobenius norm
/// over √2: the norm of R − 1 for a turn by θ is 2 √2 sin(θ/2), and it moves an arm by 2 sin(θ/2) of its length.
fn displacement(before: &Place, now: &Place, hull: &ConvexHull) -> f64 {
    let centre = now.point(hull.centre()) - before.point(hull.centre());
    let change = now.axes - before.axes;
    let columns = [change.x_axis, change.y_axis, change.z_axis].map(DVec3::length_squared);
    let turn = (0.5 * (columns[0] + columns[1] + columns[2])).sqrt();
    centre.length() + turn * hull.outer_radius()
}
