//! Broad phase: the set of pairs whose grown bounds overlap.

use tumble_math::{Bounds, Planar, Pose, Vector};
use tumble_shape::PlanarShape;

/// Where a shape may be, coarsely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Volume<V> {
    /// Inside a box.
    Box(Bounds<V>),
    /// Where normal · p ≤ offset.
    HalfSpace {
        /// Unit vector out of the solid.
        normal: V,
        /// Signed distance of the surface from the origin along the normal [m].
        offset: f64,
    },
}

impl<V: Vector> Volume<V> {
    /// The volume grown by a margin on every side [m].
    pub fn grown(self, margin: f64) -> Self {
        match self {
            Self::Box(bounds) => Self::Box(bounds.grown(margin)),
            Self::HalfSpace { normal, offset } => Self::HalfSpace { normal, offset: offset + margin },
        }
    }
}

impl Volume<glam::DVec2> {
    /// The volume of a shape in a pose.
    pub fn of_planar(shape: &PlanarShape, pose: &Pose<Planar>) -> Self {
        match shape {
            PlanarShape::HalfPlane(half_plane) => {
                let posed = half_plane.posed(pose);
                Self::HalfSpace { normal: posed.normal(), offset: posed.offset() }
            }
            _ => Self::Box(shape.bounds(pose).unwrap_or(Bounds::empty())),
        }
    }
}

/// How the set of pairs changed: (smaller id, larger id), both lists sorted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PairChanges {
    /// Pairs that began.
    pub added: Vec<(u32, u32)>,
    /// Pairs that ended; to be handled before `added`, because a pair whose proxy was replaced stands in both.
    pub removed: Vec<(u32, u32)>,
}

/// Keeps the set of near pairs of proxies with dense ids.
#[derive(Clone, Debug, Default)]
pub struct BroadPhase<V> {
    fat: Vec<Option<Volume<V>>>,
}

impl<V: Vector> BroadPhase<V> {
    /// A broad phase without proxies.
    pub fn new() -> Self {
        Self { fat: Vec::new() }
    }

    /// Adds a proxy under a dense id of the caller's choice, its volume grown by `fat_margin` [m]; replaces one that is there.
    pub fn insert(&mut self, _id: u32, _volume: Volume<V>, _fat_margin: f64) {}

    /// Takes a proxy out; its pairs end at the next [`update_pairs`](Self::update_pairs).
    pub fn remove(&mut self, _id: u32) {}

    /// Tells where a proxy is now; only when it left its grown volume is that rebuilt, with `fat_margin` around it [m].
    pub fn update(&mut self, _id: u32, _volume: Volume<V>, _fat_margin: f64) {}

    /// Asks the filter again about all pairs of a proxy at the next [`update_pairs`](Self::update_pairs).
    pub fn touch(&mut self, _id: u32) {}

    /// Brings the set of pairs up to date and tells what changed.
    pub fn update_pairs(&mut self, _filter: impl Fn(u32, u32) -> bool, _changes: &mut PairChanges) {}

    /// All pairs, sorted.
    pub fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        std::iter::empty()
    }

    /// The grown volume of a proxy.
    pub fn fat_volume(&self, id: u32) -> Option<Volume<V>> {
        self.fat.get(id as usize).copied().flatten()
    }
}
