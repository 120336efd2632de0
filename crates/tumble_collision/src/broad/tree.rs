//! A tree of boxes with eight children to a node: sorted now and then, and mended in between.
//!
//! ```text
//!            ┌─────────────────┐        each node knows the boxes of its eight children, so that a query
//!            │ ┌──┐┌──┐   ┌──┐ │        compares all of them at once and goes on where they overlap
//!            │ └──┘└──┘ … └──┘ │
//!            └─────────────────┘
//! ```
//!
//! A leaf whose box changes stays where it is, and the boxes above it follow. After as many changes as there are leaves all are sorted
//! anew: halved along the longest side of what their centres span, again and again. Boxes are rounded outwards to single precision:
//! a query finds every leaf that overlaps, and perhaps one that nearly does.

use std::ops::Range;

use tumble_math::{Bounds, Vector};

/// Children of a node.
const WIDTH: usize = 8;
/// Stands for no place.
const NONE: u32 = u32::MAX;
/// Marks a child that is a leaf: the rest of the number is its proxy.
const LEAF: u32 = 1 << 31;

/// A box in single precision around one in double precision. In the plane the third axis is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SmallBox {
    low: [f32; 3],
    high: [f32; 3],
}

impl SmallBox {
    fn around<V: Vector>(bounds: &Bounds<V>) -> Self {
        let mut small = Self { low: [0.0; 3], high: [0.0; 3] };
        for axis in 0..V::AXES {
            let (low, high) = (bounds.min[axis] as f32, bounds.max[axis] as f32);
            small.low[axis] = if f64::from(low) > bounds.min[axis] { low.next_down() } else { low };
            small.high[axis] = if f64::from(high) < bounds.max[axis] { high.next_up() } else { high };
        }
        small
    }
}

/// The boxes of eight children, axis by axis; those of empty places are NaN, which overlaps nothing.
#[derive(Clone, Debug)]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    children: [u32; WIDTH],
    /// Place in the node above; [`NONE`] at the root.
    parent: u32,
}

impl Node {
    fn empty(parent: u32) -> Self {
        Self { low: [[f32::NAN; WIDTH]; 3], high: [[f32::NAN; WIDTH]; 3], children: [NONE; WIDTH], parent }
    }

    fn bounds_of(&self, slot: usize) -> SmallBox {
        SmallBox { low: self.low.map(|low| low[slot]), high: self.high.map(|high| high[slot]) }
    }

    fn set_bounds(&mut self, slot: usize, bounds: &SmallBox) {
        for axis in 0..3 {
            self.low[axis][slot] = bounds.low[axis];
            self.high[axis][slot] = bounds.high[axis];
        }
    }

    /// The box around all children.
    fn bounds(&self) -> SmallBox {
        SmallBox {
            low: self.low.map(|low| low.into_iter().fold(f32::INFINITY, f32::min)),
            high: self.high.map(|high| high.into_iter().fold(f32::NEG_INFINITY, f32::max)),
        }
    }

    /// Which children overlap a box, one bit each.
    #[inline]
    fn overlapping(&self, bounds: &SmallBox, axes: usize) -> u32 {
        let mut hits = [u32::MAX; WIDTH];
        for axis in 0..axes {
            let (low, high) = (bounds.low[axis], bounds.high[axis]);
            for ((hit, child_low), child_high) in hits.iter_mut().zip(&self.low[axis]).zip(&self.high[axis]) {
                *hit &= 0_u32.wrapping_sub(u32::from((*child_low <= high) & (*child_high >= low)));
            }
        }
        (0..WIDTH as u32).zip(hits).map(|(slot, hit)| hit & 1 << slot).sum()
    }
}

/// What is sorted: a leaf by its centre.
#[derive(Clone, Copy, Debug)]
struct Item {
    centre: [f32; 3],
    proxy: u32,
}

/// A tree of boxes; its leaves are proxies with dense ids.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    /// The first is the root.
    nodes: Vec<Node>,
    /// Box of each proxy that is in the tree.
    leaves: Vec<Option<SmallBox>>,
    /// Place of each proxy, node and child in one number; [`NONE`] until it is sorted in.
    places: Vec<u32>,
    /// Number of leaves, and of changes since they were sorted.
    count: usize,
    changes: usize,
    /// Whether a leaf waits to be sorted in.
    waits: bool,
    /// Scratch space.
    items: Vec<Item>,
}

impl Tree {
    /// Adds a proxy.
    pub(super) fn insert<V: Vector>(&mut self, proxy: u32, bounds: &Bounds<V>) {
        let index = proxy as usize;
        if self.leaves.len() <= index {
            self.leaves.resize(index + 1, None);
            self.places.resize(index + 1, NONE);
        }
        self.leaves[index] = Some(SmallBox::around(bounds));
        self.places[index] = NONE;
        self.count += 1;
        self.waits = true;
    }

    /// Takes a proxy out.
    pub(super) fn remove(&mut self, proxy: u32) {
        let index = proxy as usize;
        if self.leaves[index].take().is_none() {
            return;
        }
        self.count -= 1;
        let place = std::mem::replace(&mut self.places[index], NONE);
        if place != NONE {
            self.nodes[place as usize / WIDTH].children[place as usize % WIDTH] = NONE;
            self.change(place, &Node::empty(NONE).bounds_of(0));
        }
    }

    /// Gives a proxy a new box.
    pub(super) fn replace<V: Vector>(&mut self, proxy: u32, bounds: &Bounds<V>) {
        let bounds = SmallBox::around(bounds);
        self.leaves[proxy as usize] = Some(bounds);
        let place = self.places[proxy as usize];
        if place != NONE {
            self.change(place, &bounds);
        }
    }

    /// Sorts the leaves, if some wait for it or many have changed: to be called before queries.
    pub(super) fn sort<V: Vector>(&mut self) {
        if !self.waits && self.changes <= self.count {
            return;
        }
        (self.waits, self.changes) = (false, 0);
        self.nodes.clear();
        let mut items = std::mem::take(&mut self.items);
        items.clear();
        let leaves = (0..).zip(&self.leaves).filter_map(|(proxy, bounds)| Some((proxy, bounds.as_ref()?)));
        items.extend(leaves.map(|(proxy, SmallBox { low, high })| Item {
            centre: [0, 1, 2].map(|axis| 0.5 * low[axis] + 0.5 * high[axis]),
            proxy,
        }));
        if !items.is_empty() {
            self.build::<V>(&mut items, NONE);
        }
        self.items = items;
    }

    /// Calls `visit` with every proxy whose box overlaps; `stack` is scratch space.
    pub(super) fn query<V: Vector>(&self, bounds: &Bounds<V>, stack: &mut Vec<u32>, mut visit: impl FnMut(u32)) {
        let bounds = SmallBox::around(bounds);
        stack.clear();
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            let mut hits = node.overlapping(&bounds, V::AXES);
            while hits != 0 {
                let child = node.children[hits.trailing_zeros() as usize];
                hits &= hits - 1;
                if child & LEAF != 0 {
                    visit(child & !LEAF);
                } else {
                    stack.push(child);
                }
            }
        }
    }

    /// Makes a node of some leaves, and of what is below it; returns its index.
    fn build<V: Vector>(&mut self, items: &mut [Item], parent: u32) -> u32 {
        let index = self.nodes.len();
        self.nodes.push(Node::empty(parent));
        let place = |slot: usize| (index * WIDTH + slot) as u32;
        if items.len() <= WIDTH {
            for (slot, item) in items.iter().enumerate() {
                self.nodes[index].children[slot] = LEAF | item.proxy;
                self.places[item.proxy as usize] = place(slot);
                if let Some(bounds) = &self.leaves[item.proxy as usize] {
                    self.nodes[index].set_bounds(slot, bounds);
                }
            }
            return index as u32;
        }
        // Full nodes below, and as few of them as can be.
        let mut below = WIDTH;
        while below * WIDTH < items.len() {
            below *= WIDTH;
        }
        let mut groups = [const { 0..0 }; WIDTH];
        let count = items.len().div_ceil(below);
        divide::<V>(items, 0, &mut groups[..count]);
        for (slot, group) in groups[..count].iter().enumerate() {
            let child = self.build::<V>(&mut items[group.clone()], place(slot));
            let bounds = self.nodes[child as usize].bounds();
            self.nodes[index].children[slot] = child;
            self.nodes[index].set_bounds(slot, &bounds);
        }
        index as u32
    }

    /// Gives the child at a place a new box, and those above it theirs.
    fn change(&mut self, mut place: u32, bounds: &SmallBox) {
        self.changes += 1;
        let mut bounds = *bounds;
        while place != NONE {
            let (node, slot) = (&mut self.nodes[place as usize / WIDTH], place as usize % WIDTH);
            // What does not change here changes nothing above.
            if node.bounds_of(slot) == bounds {
                return;
            }
            node.set_bounds(slot, &bounds);
            (place, bounds) = (node.parent, node.bounds());
        }
    }
}

/// Divides items into groups of nearly the same size that lie together; `first` is the index of the first item.
fn divide<V: Vector>(items: &mut [Item], first: usize, groups: &mut [Range<usize>]) {
    if let [group] = groups {
        *group = first..first + items.len();
        return;
    }
    let half = groups.len() / 2;
    let middle = items.len() * half / groups.len();
    let span = |axis: usize| {
        let coordinates = items.iter().map(|item| item.centre[axis]);
        let (low, high) = coordinates.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    let axis = (0..V::AXES).max_by(|one, other| span(*one).total_cmp(&span(*other))).unwrap_or(0);
    items.select_nth_unstable_by(middle, |one, other| {
        one.centre[axis].total_cmp(&other.centre[axis]).then(one.proxy.cmp(&other.proxy))
    });
    let (low, high) = items.split_at_mut(middle);
    let (low_groups, high_groups) = groups.split_at_mut(half);
    divide::<V>(low, first, low_groups);
    divide::<V>(high, first + middle, high_groups);
}
