//! A tree of boxes that is changed leaf by leaf.
//!
//! ```text
//!            ┌───────────────┐          every node's box holds those of its two children;
//!            │ ┌─────┐ ┌───┐ │          a query walks down only where boxes overlap
//!            │ │ a b │ │ c │ │
//!            │ └─────┘ └───┘ │
//!            └───────────────┘
//! ```
//!
//! A new leaf goes where it makes the sum of all node sizes grow least (surface-area heuristic, found by greedy descent), and on the
//! way back up each node may swap a child with a grandchild when that shrinks a box (tree rotations). After Catto, *Dynamic
//! Bounding Volume Hierarchies* (GDC 2019).

use tumble_math::{Bounds, Vector};

/// Stands for no node and no proxy.
const NONE: u32 = u32::MAX;

#[derive(Clone, Debug)]
struct Node<V> {
    bounds: Bounds<V>,
    parent: u32,
    /// Both [`NONE`] in a leaf.
    children: [u32; 2],
    /// The proxy of a leaf; [`NONE`] in other nodes.
    proxy: u32,
}

impl<V> Node<V> {
    fn is_leaf(&self) -> bool {
        self.children[0] == NONE
    }
}

/// A dynamic tree of boxes; leaves carry the ids of proxies.
#[derive(Clone, Debug)]
pub(super) struct Tree<V> {
    nodes: Vec<Node<V>>,
    free: Vec<u32>,
    root: u32,
}

impl<V> Default for Tree<V> {
    fn default() -> Self {
        Self { nodes: Vec::new(), free: Vec::new(), root: NONE }
    }
}

impl<V: Vector> Tree<V> {
    /// Adds a leaf and returns its handle.
    pub(super) fn insert(&mut self, proxy: u32, bounds: Bounds<V>) -> u32 {
        let leaf = self.allocate(Node { bounds, parent: NONE, children: [NONE; 2], proxy });
        self.attach(leaf);
        leaf
    }

    /// Takes a leaf out.
    pub(super) fn remove(&mut self, leaf: u32) {
        self.detach(leaf);
        self.free.push(leaf);
    }

    /// Gives a leaf a new box; its handle stays.
    pub(super) fn replace(&mut self, leaf: u32, bounds: Bounds<V>) {
        self.detach(leaf);
        self.node_mut(leaf).bounds = bounds;
        self.attach(leaf);
    }

    /// Calls `visit` with the proxy of every leaf whose box overlaps; `stack` is scratch space.
    pub(super) fn query(&self, bounds: &Bounds<V>, stack: &mut Vec<u32>, mut visit: impl FnMut(u32)) {
        stack.clear();
        if self.root != NONE {
            stack.push(self.root);
        }
        while let Some(index) = stack.pop() {
            let node = self.node(index);
            if !node.bounds.overlaps(bounds) {
                continue;
            }
            if node.is_leaf() {
                visit(node.proxy);
            } else {
                stack.extend(node.children);
            }
        }
    }

    fn attach(&mut self, leaf: u32) {
        if self.root == NONE {
            self.root = leaf;
            self.node_mut(leaf).parent = NONE;
            return;
        }
        let sibling = self.best_sibling(self.node(leaf).bounds);
        let grandparent = self.node(sibling).parent;
        let bounds = self.node(leaf).bounds.join(self.node(sibling).bounds);
        let parent = self.allocate(Node { bounds, parent: grandparent, children: [sibling, leaf], proxy: NONE });
        self.node_mut(leaf).parent = parent;
        self.node_mut(sibling).parent = parent;
        self.replace_child(grandparent, sibling, parent);
        self.refit_upwards(grandparent);
    }

    fn detach(&mut self, leaf: u32) {
        let parent = self.node(leaf).parent;
        if parent == NONE {
            self.root = NONE;
            return;
        }
        let sibling = self.other_child(parent, leaf);
        let grandparent = self.node(parent).parent;
        self.node_mut(sibling).parent = grandparent;
        self.replace_child(grandparent, parent, sibling);
        self.free.push(parent);
        self.refit_upwards(grandparent);
    }

    /// The node beside which a new leaf costs least, by greedy descent from the root.
    fn best_sibling(&self, leaf: Bounds<V>) -> u32 {
        let mut index = self.root;
        loop {
            let node = self.node(index);
            if node.is_leaf() {
                return index;
            }
            // A new parent here has the joined size, and deeper choices all make this node grow to it.
            let joined = node.bounds.join(leaf).half_perimeter();
            let growth_here = joined - node.bounds.half_perimeter();
            let descent_cost = |child: u32| {
                let child = self.node(child);
                let joined = child.bounds.join(leaf).half_perimeter();
                growth_here + if child.is_leaf() { joined } else { joined - child.bounds.half_perimeter() }
            };
            let costs = node.children.map(descent_cost);
            if joined < costs[0] && joined < costs[1] {
                return index;
            }
            index = node.children[usize::from(costs[1] < costs[0])];
        }
    }

    fn refit_upwards(&mut self, mut index: u32) {
        while index != NONE {
            self.rotate(index);
            let [left, right] = self.node(index).children;
            let bounds = self.node(left).bounds.join(self.node(right).bounds);
            let node = self.node_mut(index);
            // What does not change here changes nothing above.
            if node.bounds == bounds {
                return;
            }
            node.bounds = bounds;
            index = node.parent;
        }
    }

    /// Swaps a child with a grandchild under the other child, if that shrinks the other child's box.
    fn rotate(&mut self, index: u32) {
        let children = self.node(index).children;
        let mut best: Option<(f64, [u32; 4])> = None;
        for (child, parent) in [(children[0], children[1]), (children[1], children[0])] {
            let node = self.node(parent);
            if node.is_leaf() {
                continue;
            }
            let size = node.bounds.half_perimeter();
            for (grandchild, stays) in [(node.children[0], node.children[1]), (node.children[1], node.children[0])] {
                let shrinks = size - self.node(child).bounds.join(self.node(stays).bounds).half_perimeter();
                if shrinks > best.map_or(0.0, |(most, _)| most) {
                    best = Some((shrinks, [child, parent, grandchild, stays]));
                }
            }
        }
        let Some((_, [child, parent, grandchild, stays])) = best else { return };
        self.replace_child(index, child, grandchild);
        self.replace_child(parent, grandchild, child);
        self.node_mut(grandchild).parent = index;
        self.node_mut(child).parent = parent;
        self.node_mut(parent).bounds = self.node(child).bounds.join(self.node(stays).bounds);
    }

    fn replace_child(&mut self, parent: u32, old: u32, new: u32) {
        if parent == NONE {
            self.root = new;
            return;
        }
        let children = &mut self.node_mut(parent).children;
        children[usize::from(children[1] == old)] = new;
    }

    fn other_child(&self, parent: u32, child: u32) -> u32 {
        let children = self.node(parent).children;
        children[usize::from(children[0] == child)]
    }

    fn allocate(&mut self, node: Node<V>) -> u32 {
        if let Some(index) = self.free.pop() {
            *self.node_mut(index) = node;
            return index;
        }
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    fn node(&self, index: u32) -> &Node<V> {
        &self.nodes[index as usize]
    }

    fn node_mut(&mut self, index: u32) -> &mut Node<V> {
        &mut self.nodes[index as usize]
    }
}
