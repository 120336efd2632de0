//! The point of a simplex that is closest to the origin.

use glam::DVec3;

/// A point of the Minkowski difference b − a, with the two points it comes from.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Support {
    /// Point of a minus point of b [m].
    pub(super) w: DVec3,
    /// Point of a [m].
    pub(super) on_a: DVec3,
    /// Point of b [m].
    pub(super) on_b: DVec3,
    /// Numbers of the vertices of a and b.
    pub(super) ids: [u32; 2],
}

/// One to four points, with the weights that make the closest point of their hull to the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Simplex {
    points: [Support; 4],
    weights: [f64; 4],
    count: usize,
}

impl Simplex {
    pub(super) fn new(first: Support) -> Self {
        Self { points: [first; 4], weights: [1.0, 0.0, 0.0, 0.0], count: 1 }
    }

    pub(super) fn points(&self) -> &[Support] {
        &self.points[..self.count]
    }

    /// Weighted mean of what a function tells of each point.
    pub(super) fn mean(&self, of: impl Fn(&Support) -> DVec3) -> DVec3 {
        (0..self.count).fold(DVec3::ZERO, |sum, i| sum + of(&self.points[i]) * self.weights[i])
    }

    /// Adds a point, and keeps only those that the closest point to the origin needs; that point, or `None` if the origin is inside.
    pub(super) fn add(&mut self, point: Support) -> Option<DVec3> {
        self.points[self.count] = point;
        self.count += 1;
        let p = self.points;
        match self.count {
            2 => self.keep(segment(p[0].w, p[1].w).with([0, 1, 0])),
            3 => self.keep(triangle(p[0].w, p[1].w, p[2].w).with([0, 1, 2])),
            _ => {
                let closest = tetrahedron([p[0].w, p[1].w, p[2].w, p[3].w])?;
                self.keep(closest);
            }
        }
        Some(self.mean(|point| point.w))
    }

    fn keep(&mut self, part: Part) {
        let points = self.points;
        self.count = part.count;
        for i in 0..part.count {
            self.points[i] = points[part.corners[i]];
            self.weights[i] = part.weights[i];
        }
    }
}

/// Some corners of a simplex and their weights.
#[derive(Clone, Copy)]
struct Part {
    corners: [usize; 3],
    weights: [f64; 3],
    count: usize,
}

impl Part {
    fn corner(i: usize) -> Self {
        Self { corners: [i, 0, 0], weights: [1.0, 0.0, 0.0], count: 1 }
    }

    fn edge(i: usize, j: usize, weight_of_j: f64) -> Self {
        Self { corners: [i, j, 0], weights: [1.0 - weight_of_j, weight_of_j, 0.0], count: 2 }
    }

    /// The same part, of a simplex whose corners have other numbers.
    fn with(mut self, numbers: [usize; 3]) -> Self {
        for corner in &mut self.corners[..self.count] {
            *corner = numbers[*corner];
        }
        self
    }

    fn point(&self, corners: &[DVec3]) -> DVec3 {
        (0..self.count).fold(DVec3::ZERO, |sum, i| sum + corners[self.corners[i]] * self.weights[i])
    }
}

fn segment(a: DVec3, b: DVec3) -> Part {
    let along = b - a;
    let share = -a.dot(along);
    let squared = along.length_squared();
    if share <= 0.0 || squared == 0.0 {
        Part::corner(0)
    } else if share >= squared {
        Part::corner(1)
    } else {
        Part::edge(0, 1, share / squared)
    }
}

/// Closest point of a triangle to the origin by its Voronoi regions (Ericson 2004, 5.1.5).
fn triangle(a: DVec3, b: DVec3, c: DVec3) -> Part {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(a), -ac.dot(a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return Part::corner(0);
    }
    let (d3, d4) = (-ab.dot(b), -ac.dot(b));
    if d3 >= 0.0 && d4 <= d3 {
        return Part::corner(1);
    }
    let (d5, d6) = (-ab.dot(c), -ac.dot(c));
    if d6 >= 0.0 && d5 <= d6 {
        return Part::corner(2);
    }
    // Twice the areas that the origin's foot makes with the sides, by cross products, which do not cancel near the plane.
    let n = ab.cross(ac);
    let (of_a, of_b, of_c) = (n.dot(b.cross(c)), n.dot(c.cross(a)), n.dot(a.cross(b)));
    if of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return Part::edge(0, 1, d1 / (d1 - d3));
    }
    if of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return Part::edge(0, 2, d2 / (d2 - d6));
    }
    if of_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return Part::edge(1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let total = of_a + of_b + of_c;
    if total > 0.0 {
        return Part { corners: [0, 1, 2], weights: [of_a / total, of_b / total, of_c / total], count: 3 };
    }
    // All on one line, to rounding: the best of its sides.
    let sides = [segment(a, b).with([0, 1, 0]), segment(a, c).with([0, 2, 0]), segment(b, c).with([1, 2, 0])];
    closest_of(&sides, &[a, b, c])
}

/// Closest point of a tetrahedron to the origin; `None` if the origin is inside.
fn tetrahedron(p: [DVec3; 4]) -> Option<Part> {
    let mut outside = [None; 4];
    for (i, face) in [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].into_iter().enumerate() {
        let [a, b, c] = face.map(|corner| p[corner]);
        let opposite = p[6 - face[0] - face[1] - face[2]];
        let normal = (b - a).cross(c - a);
        let (of_origin, of_opposite) = (-normal.dot(a), normal.dot(opposite - a));
        // A flat tetrahedron has no inside.
        if of_origin * of_opposite <= 0.0 {
            outside[i] = Some(triangle(a, b, c).with(face));
        }
    }
    let mut parts = outside.iter().flatten();
    let first = *parts.next()?;
    let closer = |best: Part, part: &Part| closest_of(&[best, *part], &p);
    Some(parts.fold(first, closer))
}

/// The part that comes closest to the origin; the first of equal ones.
fn closest_of(parts: &[Part], corners: &[DVec3]) -> Part {
    let mut best = (f64::INFINITY, parts[0]);
    for part in parts {
        let squared = part.point(corners).length_squared();
        if squared < best.0 {
            best = (squared, *part);
        }
    }
    best.1
}
