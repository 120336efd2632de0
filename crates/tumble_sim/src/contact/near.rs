//! Near pairs: those whose fat bounds overlap.
//!
//! Most of them never touch. A near pair gets a contact, an entity, in the first step in which its parts might touch, and keeps it until the
//! fat bounds part: what comes and goes with every small motion is a line in a list.

use bevy_ecs::prelude::*;
use tumble_collision::PairChanges;
use tumble_team::Team;

/// Near pairs that a thread takes at a time.
const PAIRS_OF_A_TASK: usize = 2048;

/// Ranks of two parts, the smaller one first.
pub(super) type PartRanks = (u32, u32);

/// A near pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearPair {
    pub(super) parts: PartRanks,
    /// Its contact, if it has one yet.
    pub(super) contact: Option<Entity>,
}

/// All near pairs.
#[derive(Debug, Default)]
pub(super) struct NearPairs {
    /// In the order of their parts.
    pub(super) pairs: Vec<NearPair>,
    /// Contacts of pairs that ended.
    pub(super) ended: Vec<Entity>,
    /// Places of pairs that need a contact.
    pub(super) began: Vec<u32>,
    /// Those that each thread found.
    found: Vec<Vec<u32>>,
    /// Scratch space: pairs that are new.
    fresh: Vec<PartRanks>,
}

impl NearPairs {
    /// Number of near pairs.
    pub(super) fn len(&self) -> usize {
        self.pairs.len()
    }

    /// A part in the thick of it, where more than `most` pairs would have contacts; then none begins.
    pub(super) fn crowd(&mut self, most: usize) -> Option<u32> {
        if self.pairs.len() <= most
            || self.began.len() + self.pairs.iter().filter(|pair| pair.contact.is_some()).count() <= most
        {
            return None;
        }
        // Pairs lie in the order of their first parts: the longest run is the one with the most partners.
        let first_part = |place: &u32| self.pairs[*place as usize].parts.0;
        let runs = self.began.chunk_by(|one, other| first_part(one) == first_part(other));
        let crowd = runs.max_by_key(|run| run.len()).and_then(|run| run.first()).map(first_part);
        self.began.clear();
        crowd
    }

    /// Follows the broad phase: changes of the pairs, or, `renewed`, all pairs there are.
    pub(super) fn follow(&mut self, changes: &PairChanges, renewed: bool) {
        if !renewed && changes.added.is_empty() && changes.removed.is_empty() {
            return;
        }
        let mut removed = changes.removed.iter().peekable();
        let mut added = changes.added.iter().peekable();
        let ended = &mut self.ended;
        self.pairs.retain(|pair| {
            let ends = if renewed {
                while added.next_if(|other| **other < pair.parts).is_some() {}
                added.peek() != Some(&&pair.parts)
            } else {
                while removed.next_if(|other| **other < pair.parts).is_some() {}
                removed.next_if(|other| **other == pair.parts).is_some()
            };
            if ends {
                ended.extend(pair.contact);
            }
            !ends
        });
        self.merge(&changes.added);
    }

    /// Adds those of some pairs, in order, that are not there yet.
    fn merge(&mut self, added: &[PartRanks]) {
        let mut known = self.pairs.iter().peekable();
        self.fresh.clear();
        self.fresh.extend(added.iter().filter(|parts| {
            while known.next_if(|pair| pair.parts < **parts).is_some() {}
            known.peek().is_none_or(|pair| pair.parts != **parts)
        }));
        // From the back, so that nothing is overwritten before it is moved.
        let mut old = self.pairs.len();
        let mut place = old + self.fresh.len();
        self.pairs.resize(place, NearPair { parts: (0, 0), contact: None });
        for &parts in self.fresh.iter().rev() {
            while old > 0 && self.pairs[old - 1].parts > parts {
                old -= 1;
                place -= 1;
                self.pairs[place] = self.pairs[old];
            }
            place -= 1;
            self.pairs[place] = NearPair { parts, contact: None };
        }
    }

    /// Notes which pairs need a contact: those that have none and are not apart any more.
    pub(super) fn meet(&mut self, team: &Team, are_apart: impl Fn(PartRanks) -> bool + Sync) {
        let tasks = self.pairs.len().div_ceil(PAIRS_OF_A_TASK);
        self.found.resize_with(tasks.max(self.found.len()), Vec::new);
        let chunks = self.pairs.chunks(PAIRS_OF_A_TASK).zip(&mut self.found).enumerate();
        team.share(chunks, |(k, (pairs, found))| {
            let needs = |pair: &NearPair| pair.contact.is_none() && !are_apart(pair.parts);
            let places = (k * PAIRS_OF_A_TASK) as u32..;
            found.extend(places.zip(pairs).filter(|(_, pair)| needs(pair)).map(|(place, _)| place));
        });
        self.began.clear();
        self.found[..tasks].iter_mut().for_each(|found| self.began.append(found));
    }
}
