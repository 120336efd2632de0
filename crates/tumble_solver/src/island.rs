//! Islands: sets of links (contacts, joints) that share bodies which can move, and so have to be solved together.

use tumble_math::{Dim, Linear};

use crate::SolverBody;

/// Links sorted into islands, in the order of each island's first link; within an island in their own order.
#[derive(Clone, Debug, Default)]
pub struct Islands {
    /// Where each island begins in `links`; one more at the end.
    starts: Vec<u32>,
    links: Vec<u32>,
    idle: Vec<u32>,
    parents: Vec<u32>,
    /// Number of the island of each root body.
    numbers: Vec<u32>,
}

impl Islands {
    /// Finds the islands of links between these bodies.
    pub fn find<D: Dim>(&mut self, bodies: &[SolverBody<D>], links: impl Iterator<Item = [u32; 2]> + Clone) {
        self.parents.clear();
        self.parents.extend(0..bodies.len() as u32);
        let moves = |body: u32| can_move(&bodies[body as usize]);
        for [a, b] in links.clone() {
            if moves(a) && moves(b) {
                let (a, b) = (self.root(a), self.root(b));
                // The smaller index leads, so that the outcome does not depend on the order of links.
                self.parents[a.max(b) as usize] = a.min(b);
            }
        }

        // Count, then place.
        self.numbers.clear();
        self.numbers.resize(bodies.len(), u32::MAX);
        self.idle.clear();
        self.starts.clear();
        self.starts.push(0);
        for (i, [a, b]) in links.clone().enumerate() {
            let Some(body) = [a, b].into_iter().find(|body| moves(*body)) else {
                self.idle.push(i as u32);
                continue;
            };
            let root = self.root(body) as usize;
            if self.numbers[root] == u32::MAX {
                self.numbers[root] = self.starts.len() as u32 - 1;
                self.starts.push(0);
            }
            self.starts[self.numbers[root] as usize + 1] += 1;
        }
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        let mut next = self.starts.clone();
        self.links.clear();
        self.links.resize(self.starts.last().map_or(0, |end| *end as usize), 0);
        for (i, [a, b]) in links.enumerate() {
            if let Some(body) = [a, b].into_iter().find(|body| moves(*body)) {
                let root = self.root(body) as usize;
                let number = self.numbers[root] as usize;
                self.links[next[number] as usize] = i as u32;
                next[number] += 1;
            }
        }
    }

    /// Number of islands.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The links of one island, in rising order.
    pub fn links(&self, island: usize) -> &[u32] {
        &self.links[self.starts[island] as usize..self.starts[island + 1] as usize]
    }

    /// Links between bodies neither of which can move; they are in no island.
    pub fn idle(&self) -> &[u32] {
        &self.idle
    }

    /// The island that a body belongs to, if it can move and has a link.
    pub fn of_body(&self, body: u32) -> Option<usize> {
        let mut root = *self.parents.get(body as usize)?;
        while self.parents[root as usize] != root {
            root = self.parents[root as usize];
        }
        let number = self.numbers[root as usize];
        (number != u32::MAX).then_some(number as usize)
    }

    /// The body that stands for all that are connected to this one.
    fn root(&mut self, mut body: u32) -> u32 {
        while self.parents[body as usize] != body {
            let grandparent = self.parents[self.parents[body as usize] as usize];
            self.parents[body as usize] = grandparent;
            body = grandparent;
        }
        body
    }
}

/// Whether impulses change anything about a body.
pub(crate) fn can_move<D: Dim>(body: &SolverBody<D>) -> bool {
    body.inverse_mass != D::Vector::ZERO || body.inverse_inertia != D::Inertia::default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use tumble_math::Planar;

    fn free() -> SolverBody<Planar> {
        SolverBody { inverse_mass: DVec2::ONE, inverse_inertia: 1.0, ..SolverBody::default() }
    }

    #[test]
    fn bodies_on_one_floor_are_islands_apart() {
        let floor = SolverBody::default();
        let bodies = [floor, free(), free(), free(), free()];
        let links = [[0, 3], [1, 2], [0, 1], [0, 2], [3, 4], [0, 0]];
        let mut islands = Islands::default();
        islands.find(&bodies, links.into_iter());
        assert_eq!(islands.len(), 2);
        assert_eq!(islands.links(0), [0, 4]);
        assert_eq!(islands.links(1), [1, 2, 3]);
        assert_eq!(islands.idle(), [5]);
        assert_eq!((islands.of_body(0), islands.of_body(4), islands.of_body(2)), (None, Some(0), Some(1)));
    }

    #[test]
    fn a_second_search_forgets_the_first() {
        let bodies = [free(), free(), free()];
        let mut islands = Islands::default();
        islands.find(&bodies, [[0, 1], [1, 2]].into_iter());
        islands.find(&bodies, [[0, 2]].into_iter());
        assert_eq!(islands.len(), 1);
        assert_eq!(islands.links(0), [0]);
        assert_eq!(islands.of_body(1), None);
    }
}
