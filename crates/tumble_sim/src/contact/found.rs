//! Contact points in the order in which they are solved.
//!
//! Pairs lie in memory in the order of their birth, while anything computed from them goes by the order of their parts. So their points
//! are read as they lie, sorted, and poured out in order: much quicker than reaching for the pairs in order, each a few cache misses away.

use tumble_solver::ContactRow;

use super::Detection;
use super::problem::{PairQuery, RowSource};
use crate::geometry::Geometry;
use crate::part::Response;

/// Up to this many pairs are solved in the order of their parts.
const PAIRS_IN_ORDER: usize = 400;
/// Beyond, neighbours in the order of solving are this many pairs apart, so that they rarely share a body: the processor works at
/// several at once instead of waiting for each, and a sweep spreads its changes over the whole pile.
const STRIDE: usize = 16;

/// Which points are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Points {
    /// Those that touch.
    Touching,
    /// Those with a gap: when finding points, besides those that touch.
    Near,
}

/// The points of solid pairs, and what sorts them.
#[derive(Debug)]
pub(super) struct FoundPoints<D: Geometry> {
    /// As they lie in memory.
    rows: Vec<ContactRow<D>>,
    sources: Vec<RowSource>,
    pairs: Vec<FoundPair>,
    /// Scratch space of the sorting.
    unsorted: Vec<FoundPair>,
    places: Vec<u32>,
}

/// A pair and its points.
#[derive(Clone, Copy, Debug)]
struct FoundPair {
    /// Ranks of the two parts.
    parts: [u32; 2],
    /// Its first point.
    first: u32,
    /// Number of its points.
    count: u8,
    /// Bit k is set where point k touches.
    touching: u8,
}

impl<D: Geometry> Default for FoundPoints<D> {
    fn default() -> Self {
        Self { rows: Vec::new(), sources: Vec::new(), pairs: Vec::new(), unsorted: Vec::new(), places: Vec::new() }
    }
}

impl<D: Geometry> FoundPoints<D> {
    /// Finds the points of all solid pairs, or of those that touch.
    pub(super) fn find(&mut self, detection: &Detection<D>, pairs: &PairQuery<D>, wanted: Points) {
        self.rows.clear();
        self.sources.clear();
        self.pairs.clear();
        for (entity, pair, manifold, memory) in pairs {
            let points = D::points(&manifold.0);
            if points.is_empty() || pair.response == Response::Sensor || (wanted == Points::Touching && !pair.touching)
            {
                continue;
            }
            let mut found = FoundPair {
                parts: pair.colliders,
                first: self.rows.len() as u32,
                count: points.len() as u8,
                touching: 0,
            };
            let frame = D::contact_frame(D::normal(&manifold.0));
            let [a, b] = pair.bodies;
            let [at_a, at_b] = pair.bodies.map(|body| detection.motions()[body as usize].pose.position);
            for (number, (point, memory)) in points.iter().zip(memory.0.as_ref()).enumerate() {
                found.touching |= u8::from(memory.touches) << number;
                self.rows.push(ContactRow {
                    a,
                    b,
                    frame,
                    arm_a: point.point - at_a,
                    arm_b: point.point - at_b,
                    separation: point.separation,
                    allowance: 0.0,
                    surface: pair.surface,
                    impulse: memory.impulse,
                    slip: memory.slip,
                });
                self.sources.push(RowSource {
                    entity,
                    point: number as u8,
                    held: memory.held,
                    separation_before: memory.separation_before,
                    held_back: memory.held_back,
                });
            }
            self.pairs.push(found);
        }
    }

    /// Sorts the pairs by their parts: by counting for the first, which is much quicker than comparing, then each few by the second.
    pub(super) fn sort(&mut self) {
        let Self { pairs, unsorted, places, .. } = self;
        let Some(last) = pairs.iter().map(|pair| pair.parts[0]).max() else { return };
        std::mem::swap(pairs, unsorted);
        places.clear();
        places.resize(last as usize + 2, 0);
        for pair in &*unsorted {
            places[pair.parts[0] as usize + 1] += 1;
        }
        for part in 0..=last as usize {
            places[part + 1] += places[part];
        }
        pairs.clear();
        pairs.extend_from_slice(unsorted);
        for pair in &*unsorted {
            let place = &mut places[pair.parts[0] as usize];
            pairs[*place as usize] = *pair;
            *place += 1;
        }
        for few in pairs.chunk_by_mut(|one, other| one.parts[0] == other.parts[0]) {
            few.sort_unstable_by_key(|pair| pair.parts[1]);
        }
    }

    /// Appends the points that touch, or those with a gap: in the order of their pairs, or every [`STRIDE`]th of it in turn where there
    /// are many.
    pub(super) fn pour(&self, wanted: Points, rows: &mut Vec<ContactRow<D>>, sources: &mut Vec<RowSource>) {
        let stride = if self.pairs.len() > PAIRS_IN_ORDER { STRIDE } else { 1 };
        for turn in 0..stride.min(self.pairs.len()) {
            for pair in self.pairs[turn..].iter().step_by(stride) {
                for number in 0..pair.count {
                    let touches = pair.touching >> number & 1 == 1;
                    if touches == (wanted == Points::Touching) {
                        let place = pair.first as usize + usize::from(number);
                        rows.push(self.rows[place]);
                        sources.push(self.sources[place]);
                    }
                }
            }
        }
    }
}
