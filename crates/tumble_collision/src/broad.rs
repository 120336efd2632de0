//! Broad phase: the set of pairs whose grown volumes overlap.
//!
//! Each proxy has a *fat* volume: its true one grown by a margin. As long as the true volume stays inside, nothing is done; when it
//! leaves, the fat one is built anew and its pairs are found again, by a tree of boxes. So the cost of a step follows the
//! number of proxies that left, plus one pass over the list of pairs.
//!
//! ```text
//!   ┌─ fat ──────────┐
//!   │    ┌ true ┐    │      a pair lives while two fat volumes overlap
//!   │    │   ●──┼──▶ │
//!   │    └──────┘    │
//!   └────────────────┘
//! ```
//!
//! Half-spaces reach everywhere and would spoil the tree: each moved box is tested against each of them directly.
//!
//! The set of pairs depends on the fat volumes alone, never on the order of insertion or the form of the tree.

mod oriented;
mod oriented_spatial;
mod tree;
mod volume;

use std::sync::atomic::{AtomicUsize, Ordering};

use tumble_math::Vector;
use tumble_team::Team;

pub use oriented::{OrientedBox, TurningBox};
pub use oriented_spatial::SpatialOrientedBox;
pub use volume::Volume;

use tree::Tree;

/// How the set of pairs changed: (smaller id, larger id), both lists sorted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PairChanges {
    /// Pairs that began.
    pub added: Vec<(u32, u32)>,
    /// Pairs that ended; to be handled before `added`, because a pair whose proxy was replaced stands in both.
    pub removed: Vec<(u32, u32)>,
}

/// Keeps the set of near pairs of proxies with dense ids.
#[derive(Clone, Debug)]
pub struct BroadPhase<V> {
    proxies: Vec<Option<Proxy<V>>>,
    tree: Tree,
    /// Ids of the half-spaces.
    half_spaces: Vec<u32>,
    /// What happened to each id since the last update of pairs.
    marks: Vec<Mark>,
    /// Ids whose mark is not `Clean`.
    marked: Vec<u32>,
    pairs: Vec<(u32, u32)>,
    /// Scratch space, kept so that a steady step allocates nothing.
    pairs_before: Vec<(u32, u32)>,
    /// Pairs as one number each, the smaller id in its upper half.
    candidates: Vec<u64>,
    searches: Vec<Search>,
}

/// What a thread finds.
#[derive(Clone, Debug, Default)]
struct Search {
    candidates: Vec<u64>,
    stack: Vec<u32>,
}

/// More pairs begin at once than could be kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("more than {most} pairs begin at once, {of_proxy} of them with proxy {proxy}")]
pub struct Crowded {
    /// One of the proxies with the most pairs.
    pub proxy: u32,
    /// How many it has.
    pub of_proxy: usize,
    /// The limit.
    pub most: usize,
}

/// Proxies that are looked at to find one in the thick of a crowd.
const WITNESSES: usize = 64;

/// Changed proxies that a thread looks after at a time.
const PROXIES_OF_A_TASK: usize = 128;

#[derive(Clone, Copy, Debug)]
struct Proxy<V> {
    fat: Volume<V>,
    /// Whether it is in the tree: a box that is not empty.
    in_tree: bool,
}

/// What happened to a proxy since the last update of pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Clean,
    /// Its fat volume or its filter changed: pairs may begin and end.
    Changed,
    /// It was removed, and perhaps inserted again: all its former pairs end.
    Replaced,
}

impl<V> Default for BroadPhase<V> {
    fn default() -> Self {
        Self {
            proxies: Vec::new(),
            tree: Tree::default(),
            half_spaces: Vec::new(),
            marks: Vec::new(),
            marked: Vec::new(),
            pairs: Vec::new(),
            pairs_before: Vec::new(),
            candidates: Vec::new(),
            searches: Vec::new(),
        }
    }
}

impl<V: Vector> BroadPhase<V> {
    /// A broad phase without proxies.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a proxy under a dense id of the caller's choice, its volume grown by `fat_margin` [m]; replaces one that is there.
    pub fn insert(&mut self, id: u32, volume: Volume<V>, fat_margin: f64) {
        self.remove(id);
        self.place(id, volume.grown(fat_margin));
    }

    /// Takes a proxy out; its pairs end at the next [`update_pairs`](Self::update_pairs).
    pub fn remove(&mut self, id: u32) {
        if self.proxy(id).is_some() {
            self.displace(id);
            self.mark(id, Mark::Replaced);
        }
    }

    /// Tells where a proxy is now; when it left its fat volume, that is built anew with `fat_margin` around it [m].
    ///
    /// A fat volume that became needlessly wide (more than four margins, after a fast body slowed down) is built anew as well.
    pub fn update(&mut self, id: u32, volume: Volume<V>, fat_margin: f64) {
        self.update_moving(id, volume, V::ZERO, fat_margin);
    }

    /// The same for a proxy that is on its way: the fat volume reaches as far ahead as it is expected to `travel` [m].
    ///
    /// Returns whether the fat volume is a new one.
    pub fn update_moving(&mut self, id: u32, volume: Volume<V>, travel: V, fat_margin: f64) -> bool {
        let holds = self.holds(id, &volume, travel, fat_margin);
        if !holds {
            self.refit(id, volume.swept(travel).grown(fat_margin));
        }
        !holds
    }

    /// Whether a proxy is still inside its fat volume, and that is not needlessly wide.
    pub fn holds(&self, id: u32, volume: &Volume<V>, travel: V, fat_margin: f64) -> bool {
        let wide = 4.0 * (fat_margin + travel.length());
        self.proxy(id).is_some_and(|proxy| proxy.fat.contains(volume) && volume.grown(wide).contains(&proxy.fat))
    }

    /// Gives a proxy another fat volume, or places a new one.
    pub fn refit(&mut self, id: u32, fat: Volume<V>) {
        match (self.proxy(id), fat) {
            (None, _) => self.place(id, fat),
            (Some(Proxy { in_tree: true, .. }), Volume::Box(bounds)) if bounds.overlaps(&bounds) => {
                self.tree.replace(id, &bounds);
                self.proxies[id as usize] = Some(Proxy { fat, in_tree: true });
                self.mark(id, Mark::Changed);
            }
            (Some(_), _) => {
                self.displace(id);
                self.place(id, fat);
            }
        }
    }

    /// Asks the filter again about all pairs of a proxy at the next [`update_pairs`](Self::update_pairs).
    pub fn touch(&mut self, id: u32) {
        if self.proxy(id).is_some() {
            self.mark(id, Mark::Changed);
        }
    }

    /// Brings the set of pairs up to date and tells what changed since the last time.
    ///
    /// `filter(smaller id, larger id)` says whether a pair is wanted; it is asked when the pair may begin, and again only when one
    /// of the two moved out of its fat volume, was replaced, or was [touched](Self::touch).
    pub fn update_pairs(&mut self, filter: impl Fn(u32, u32) -> bool + Sync, changes: &mut PairChanges) {
        self.share_pairs(&Team::alone(), filter, usize::MAX, changes).expect("there is no limit");
    }

    /// The same, with the search shared by a team.
    ///
    /// # Errors
    ///
    /// When more than `most` pairs begin or are looked at again; then the set of pairs stays as it was.
    pub fn share_pairs(
        &mut self,
        team: &Team,
        filter: impl Fn(u32, u32) -> bool + Sync,
        most: usize,
        changes: &mut PairChanges,
    ) -> Result<(), Crowded> {
        changes.added.clear();
        changes.removed.clear();
        if self.marked.is_empty() {
            return Ok(());
        }
        self.tree.sort::<V>();
        if !self.find_candidates(team, &filter, most) {
            return Err(self.find_crowd(&filter, most));
        }
        self.merge_candidates(changes);
        for id in self.marked.drain(..) {
            self.marks[id as usize] = Mark::Clean;
        }
        Ok(())
    }

    /// All pairs, sorted: (smaller id, larger id).
    pub fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// The fat volume of a proxy.
    pub fn fat_volume(&self, id: u32) -> Option<Volume<V>> {
        self.proxy(id).map(|proxy| proxy.fat)
    }

    /// Oracle: the pairs whose fat volumes overlap and that the filter wants, found by looking at every pair.
    pub fn all_pairs(&self, filter: impl Fn(u32, u32) -> bool) -> Vec<(u32, u32)> {
        let count = self.proxies.len() as u32;
        let every = (0..count).flat_map(|low| (low + 1..count).map(move |high| (low, high)));
        every.filter(|&(low, high)| self.fat_volumes_overlap(low, high) && filter(low, high)).collect()
    }

    /// Collects every wanted pair of which at least one is marked, each once and in order. Returns whether there are no more than `most`.
    fn find_candidates(&mut self, team: &Team, filter: &(impl Fn(u32, u32) -> bool + Sync), most: usize) -> bool {
        let tasks = self.marked.len().div_ceil(PROXIES_OF_A_TASK);
        let mut searches = std::mem::take(&mut self.searches);
        searches.resize_with(tasks.max(searches.len()), Search::default);
        let (known, found) = (&*self, AtomicUsize::new(0));
        team.share(known.marked.chunks(PROXIES_OF_A_TASK).zip(&mut searches), |(marked, search)| {
            for id in marked {
                let before = search.candidates.len();
                known.search(*id, filter, search);
                let new = search.candidates.len() - before;
                if found.fetch_add(new, Ordering::Relaxed).saturating_add(new) > most {
                    break;
                }
            }
            search.candidates.sort_unstable();
        });
        self.candidates.clear();
        if found.into_inner() > most {
            // What they hold is given back.
            return false;
        }
        for search in &mut searches[..tasks] {
            self.candidates.append(&mut search.candidates);
        }
        // Runs in order, which a stable sort only merges.
        self.candidates.sort();
        self.searches = searches;
        true
    }

    /// Of some marked proxies, the one that begins the most pairs.
    fn find_crowd(&self, filter: &impl Fn(u32, u32) -> bool, most: usize) -> Crowded {
        let mut search = Search::default();
        let mut crowd = Crowded { proxy: self.marked[0], of_proxy: 0, most };
        for &proxy in self.marked.iter().step_by(self.marked.len().div_ceil(WITNESSES)) {
            search.candidates.clear();
            self.search(proxy, filter, &mut search);
            if search.candidates.len() > crowd.of_proxy {
                (crowd.proxy, crowd.of_proxy) = (proxy, search.candidates.len());
            }
        }
        crowd
    }

    /// Collects the wanted pairs of a marked proxy.
    fn search(&self, id: u32, filter: &impl Fn(u32, u32) -> bool, search: &mut Search) {
        let Some(proxy) = &self.proxies[id as usize] else { return };
        let Search { candidates, stack } = search;
        let mut look = |other: u32| {
            let (low, high) = (id.min(other), id.max(other));
            if self.proxy(other).is_some_and(|other| other.fat.overlaps(&proxy.fat)) && filter(low, high) {
                candidates.push(u64::from(low) << 32 | u64::from(high));
            }
        };
        match &proxy.fat {
            Volume::Box(bounds) => {
                // Of two marked boxes, the one with the smaller id reports the pair.
                self.tree.query(bounds, stack, |other| {
                    if other > id || (other < id && self.marks[other as usize] == Mark::Clean) {
                        look(other);
                    }
                });
                self.half_spaces.iter().for_each(|other| look(*other));
            }
            Volume::HalfSpace { .. } => {
                (0..self.proxies.len())
                    .filter(|other| self.marks[*other] == Mark::Clean)
                    .for_each(|other| look(other as u32));
            }
        }
    }

    /// Makes the pairs those of before with no proxy marked, and the candidates.
    fn merge_candidates(&mut self, changes: &mut PairChanges) {
        let Self { pairs, pairs_before, candidates, marks, .. } = self;
        std::mem::swap(pairs, pairs_before);
        pairs.clear();
        let mut candidates = candidates.iter().map(|pair| ((pair >> 32) as u32, *pair as u32)).peekable();
        for &pair in &*pairs_before {
            while let Some(new) = candidates.next_if(|candidate| *candidate < pair) {
                changes.added.push(new);
                pairs.push(new);
            }
            let found = candidates.next_if(|candidate| *candidate == pair).is_some();
            match (marks[pair.0 as usize], marks[pair.1 as usize]) {
                (Mark::Clean, Mark::Clean) => pairs.push(pair),
                (Mark::Replaced, _) | (_, Mark::Replaced) => {
                    changes.removed.push(pair);
                    if found {
                        changes.added.push(pair);
                        pairs.push(pair);
                    }
                }
                _ if found => pairs.push(pair),
                _ => changes.removed.push(pair),
            }
        }
        changes.added.extend(candidates.clone());
        pairs.extend(candidates);
    }

    fn proxy(&self, id: u32) -> Option<&Proxy<V>> {
        self.proxies.get(id as usize)?.as_ref()
    }

    fn fat_volumes_overlap(&self, one: u32, other: u32) -> bool {
        matches!((self.proxy(one), self.proxy(other)), (Some(one), Some(other)) if one.fat.overlaps(&other.fat))
    }

    fn place(&mut self, id: u32, fat: Volume<V>) {
        if self.proxies.len() <= id as usize {
            self.proxies.resize(id as usize + 1, None);
            self.marks.resize(id as usize + 1, Mark::Clean);
        }
        // An empty or NaN box does not even overlap itself; it meets nothing, and must not spoil the boxes above it.
        let in_tree = matches!(&fat, Volume::Box(bounds) if bounds.overlaps(bounds));
        match &fat {
            Volume::Box(bounds) if in_tree => self.tree.insert(id, bounds),
            Volume::Box(_) => {}
            Volume::HalfSpace { .. } => self.half_spaces.push(id),
        }
        self.proxies[id as usize] = Some(Proxy { fat, in_tree });
        self.mark(id, Mark::Changed);
    }

    fn displace(&mut self, id: u32) {
        match self.proxies[id as usize].take() {
            Some(Proxy { in_tree: true, .. }) => self.tree.remove(id),
            _ => self.half_spaces.retain(|&other| other != id),
        }
    }

    fn mark(&mut self, id: u32, mark: Mark) {
        let present = &mut self.marks[id as usize];
        match *present {
            Mark::Clean => {
                *present = mark;
                self.marked.push(id);
            }
            Mark::Changed => *present = mark,
            Mark::Replaced => {}
        }
    }
}
