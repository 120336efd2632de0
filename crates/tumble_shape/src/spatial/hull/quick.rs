//! Quickhull: the triangles around a cloud of points.
//!
//! Barber, Dobkin and Huhdanpaa (1996). Begin with a tetrahedron; every triangle keeps the points above it. As long as a triangle
//! has some, take its highest one, remove all triangles that this point sees, and join the point to the horizon around the hole.
//!
//! ```text
//!            p                 seen: points strictly above the triangle, decided on integers,
//!          . : .               so that the horizon is always one closed loop and nothing
//!      ___/__:__\___           depends on rounding. Coplanar triangles stay apart here;
//!     /   hole   \  \          `merge` joins them to polygons.
//! ```

use super::lattice::{LatticeNormal, LatticePoint, height, normal};

/// A triangle of the hull; corners counter-clockwise seen from outside.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// Numbers of the points.
    pub(super) corners: [usize; 3],
    /// Triangle across the side from corner i to the next.
    pub(super) neighbours: [usize; 3],
}

struct Face {
    triangle: Triangle,
    normal: LatticeNormal,
    /// Points above it that no other triangle keeps.
    outside: Vec<usize>,
    alive: bool,
}

/// The triangles of the hull of points, given four of them that span a volume.
pub(super) fn triangulate(points: &[LatticePoint], first: [usize; 4]) -> Vec<Triangle> {
    let mut build = Build::new(points, first);
    while let Some(face) = build.pending.pop() {
        if let Some(apex) = build.highest_above(face) {
            build.add(apex, face);
        }
    }
    build.finish()
}

struct Build<'a> {
    points: &'a [LatticePoint],
    faces: Vec<Face>,
    /// Triangles that may have points above them.
    pending: Vec<usize>,
    /// For a corner of the horizon, the new triangle whose side starts there.
    starting_at: Vec<usize>,
}

impl<'a> Build<'a> {
    fn new(points: &'a [LatticePoint], first: [usize; 4]) -> Self {
        let mut build = Self { points, faces: Vec::new(), pending: Vec::new(), starting_at: vec![0; points.len()] };
        let [a, mut b, mut c, d] = first;
        if height(normal(points[a], points[b], points[c]), points[a], points[d]) > 0 {
            std::mem::swap(&mut b, &mut c);
        }
        // d is below a b c; each other triangle has one corner on the far side of it.
        let around = [([a, b, c], [3, 1, 2]), ([b, d, c], [3, 2, 0]), ([c, d, a], [1, 3, 0]), ([a, d, b], [2, 1, 0])];
        for (corners, neighbours) in around {
            build.push(Triangle { corners, neighbours });
        }
        let rest = (0..points.len()).filter(|i| !first.contains(i)).collect();
        build.hand_out(rest, 0);
        build
    }

    fn push(&mut self, triangle: Triangle) {
        let [a, b, c] = triangle.corners.map(|corner| self.points[corner]);
        self.faces.push(Face { triangle, normal: normal(a, b, c), outside: Vec::new(), alive: true });
    }

    fn height(&self, face: usize, point: usize) -> i128 {
        let face = &self.faces[face];
        height(face.normal, self.points[face.triangle.corners[0]], self.points[point])
    }

    /// Gives each point to the first of the triangles from `since` on that it is above; points above none are inside.
    fn hand_out(&mut self, points: Vec<usize>, since: usize) {
        for point in points {
            if let Some(face) = (since..self.faces.len()).find(|&face| self.height(face, point) > 0) {
                self.faces[face].outside.push(point);
            }
        }
        self.pending.extend((since..self.faces.len()).filter(|&face| !self.faces[face].outside.is_empty()));
    }

    fn highest_above(&self, face: usize) -> Option<usize> {
        if !self.faces[face].alive {
            return None;
        }
        self.faces[face]
            .outside
            .iter()
            .copied()
            .max_by_key(|&point| (self.height(face, point), std::cmp::Reverse(point)))
    }

    /// Makes a point that is above a triangle a corner of the hull.
    fn add(&mut self, apex: usize, face: usize) {
        // Everything the apex sees is connected.
        let mut seen = vec![face];
        self.faces[face].alive = false;
        let mut horizon = Vec::new();
        let mut orphans = Vec::new();
        let mut next = 0;
        while next < seen.len() {
            let Triangle { corners, neighbours } = self.faces[seen[next]].triangle.clone();
            orphans.append(&mut self.faces[seen[next]].outside);
            next += 1;
            for side in 0..3 {
                let across = neighbours[side];
                if !self.faces[across].alive {
                    continue;
                }
                if self.height(across, apex) > 0 {
                    self.faces[across].alive = false;
                    seen.push(across);
                } else {
                    horizon.push((corners[side], corners[(side + 1) % 3], across));
                }
            }
        }
        let since = self.faces.len();
        for (i, &(from, to, across)) in horizon.iter().enumerate() {
            self.starting_at[from] = since + i;
            let outer = &mut self.faces[across].triangle;
            let side = (0..3).find(|&side| outer.corners[side] == to && outer.corners[(side + 1) % 3] == from);
            outer.neighbours[side.expect("neighbours share a side")] = since + i;
            self.push(Triangle { corners: [from, to, apex], neighbours: [across, usize::MAX, usize::MAX] });
        }
        for i in since..self.faces.len() {
            let after = self.starting_at[self.faces[i].triangle.corners[1]];
            self.faces[i].triangle.neighbours[1] = after;
            self.faces[after].triangle.neighbours[2] = i;
        }
        orphans.retain(|&point| point != apex);
        self.hand_out(orphans, since);
    }

    /// The triangles that are left, numbered anew.
    fn finish(self) -> Vec<Triangle> {
        let mut number = vec![usize::MAX; self.faces.len()];
        let mut count = 0;
        for (old, face) in self.faces.iter().enumerate() {
            if face.alive {
                number[old] = count;
                count += 1;
            }
        }
        let alive = self.faces.into_iter().filter(|face| face.alive);
        alive
            .map(|Face { triangle: Triangle { corners, neighbours }, .. }| Triangle {
                corners,
                neighbours: neighbours.map(|old| number[old]),
            })
            .collect()
    }
}
