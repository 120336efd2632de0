//! Separation in space: of points, lines and polyhedra that are rounded by a radius.
//!
//! Polyhedra that share a point are least deep in each other along the normal of a face or across an edge of each (S. Gottschalk, 1996).
//! Polyhedra apart are at least as far from each other as on the best of these axes. Lines and points have exact distances.

use glam::{DVec3, dvec3};
use tumble_math::Bounds;

use super::gap;

/// A convex core.
#[derive(Clone, Debug)]
pub struct Core {
    corners: Vec<DVec3>,
    /// Corners of each face, in the order in which they go round it; none for points and lines.
    faces: Vec<Vec<usize>>,
    edges: Vec<[usize; 2]>,
    /// Directions of edges and normals of faces, each once.
    directions: Vec<DVec3>,
    normals: Vec<DVec3>,
    radius: f64,
}

/// Sines below this count as parallel: the axis across two such edges would be noise [1].
const PARALLEL: f64 = 1e-6;

impl Core {
    /// A line, or a point where both ends are the same.
    pub fn round(from: DVec3, to: DVec3, radius: f64) -> Self {
        Self::new(vec![from, to], Vec::new(), vec![[0, 1]], radius)
    }

    /// A box around the origin, put in its place.
    pub fn block(half_extents: DVec3, place: impl Fn(DVec3) -> DVec3) -> Self {
        // Bit k of a corner's number says on which side of axis k it lies.
        let side = |corner: usize, axis: usize| if corner & (1 << axis) == 0 { -1.0 } else { 1.0 };
        let corner = |i| dvec3(side(i, 0), side(i, 1), side(i, 2)) * half_extents;
        let corners = (0..8).map(|i| place(corner(i))).collect();
        let mut faces = Vec::with_capacity(6);
        let mut edges = Vec::with_capacity(12);
        for axis in 0..3 {
            let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            for start in [0, 1 << axis] {
                faces.push(vec![start, start | u, start | u | v, start | v]);
            }
            edges.extend([0, u, v, u | v].map(|start| [start, start | 1 << axis]));
        }
        Self::new(corners, faces, edges, 0.0)
    }

    /// A regular icosahedron around the origin, put in its place.
    pub fn icosahedron(radius: f64, place: impl Fn(DVec3) -> DVec3) -> Self {
        let corners = crate::plan::icosahedron(radius);
        let edge = corners[1..].iter().map(|corner| corner.distance(corners[0])).fold(f64::INFINITY, f64::min);
        let joined = |i: usize, k: usize| corners[i].distance(corners[k]) < 1.01 * edge;
        let (mut faces, mut edges) = (Vec::with_capacity(20), Vec::with_capacity(30));
        for i in 0..12 {
            for j in (0..i).filter(|j| joined(i, *j)) {
                edges.push([i, j]);
                faces.extend((0..j).filter(|k| joined(i, *k) && joined(j, *k)).map(|k| vec![i, j, k]));
            }
        }
        Self::new(corners.map(place).into(), faces, edges, 0.0)
    }

    fn new(corners: Vec<DVec3>, faces: Vec<Vec<usize>>, edges: Vec<[usize; 2]>, radius: f64) -> Self {
        let directions = each_once(edges.iter().map(|[from, to]| corners[*to] - corners[*from]));
        let normals = each_once(faces.iter().map(|face| {
            let [a, b, c] = [corners[face[0]], corners[face[1]], corners[face[2]]];
            (b - a).cross(c - a)
        }));
        Self { corners, faces, edges, directions, normals, radius }
    }

    /// The box around it [m].
    pub fn bounds(&self) -> Bounds<DVec3> {
        Bounds::around(self.corners.iter().copied()).grown(self.radius)
    }

    fn is_line(&self) -> bool {
        self.faces.is_empty()
    }

    fn line(&self, edge: [usize; 2]) -> [DVec3; 2] {
        edge.map(|corner| self.corners[corner])
    }
}

/// Unit vectors along these; of parallel ones the first.
fn each_once(vectors: impl Iterator<Item = DVec3>) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::new();
    for unit in vectors.filter_map(DVec3::try_normalize) {
        if kept.iter().all(|known| known.cross(unit).length() > PARALLEL) {
            kept.push(unit);
        }
    }
    kept
}

/// How far apart two cores are, negative when they overlap [m].
pub fn separation(a: &Core, b: &Core) -> f64 {
    let apart = match (a.is_line(), b.is_line()) {
        (true, true) => line_distance(a.line(a.edges[0]), b.line(b.edges[0])),
        (false, false) => widest_gap(a, b),
        (true, false) => line_from_polyhedron(a, b),
        (false, true) => line_from_polyhedron(b, a),
    };
    apart - a.radius - b.radius
}

fn widest_gap(a: &Core, b: &Core) -> f64 {
    let across = a.directions.iter().flat_map(|one| b.directions.iter().map(move |other| one.cross(*other)));
    let across = across.filter(|axis| axis.length() > PARALLEL).map(DVec3::normalize);
    let axes = a.normals.iter().chain(&b.normals).copied().chain(across);
    axes.map(|axis| gap(&a.corners, &b.corners, axis)).fold(f64::NEG_INFINITY, f64::max)
}

fn line_from_polyhedron(line: &Core, polyhedron: &Core) -> f64 {
    let widest = widest_gap(line, polyhedron);
    if widest <= 0.0 {
        return widest;
    }
    // Nearest are two lines, or an end of the line and a face above which it is.
    let ends = line.line(line.edges[0]);
    let lines = polyhedron.edges.iter().map(|edge| line_distance(ends, polyhedron.line(*edge)));
    let heights = polyhedron.faces.iter().flat_map(|face| ends.map(|end| height_above(polyhedron, face, end)));
    lines.chain(heights.flatten()).fold(f64::INFINITY, f64::min)
}

/// Distance of a point from the plane of a face, where it is above the face [m].
fn height_above(polyhedron: &Core, face: &[usize], point: DVec3) -> Option<f64> {
    let corner = |i: usize| polyhedron.corners[face[i % face.len()]];
    let normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalize();
    let mut inward = (0..face.len()).map(|i| (corner(i + 1) - corner(i)).cross(point - corner(i)).dot(normal));
    inward.all(|side| side >= 0.0).then(|| (point - corner(0)).dot(normal).abs())
}

/// Distance of two lines between points (C. Ericson, "Real-Time Collision Detection", 2004, 5.1.9) [m].
fn line_distance([a, a_end]: [DVec3; 2], [b, b_end]: [DVec3; 2]) -> f64 {
    let (along_a, along_b, between) = (a_end - a, b_end - b, b - a);
    let (aa, bb, ab) = (along_a.length_squared(), along_b.length_squared(), along_a.dot(along_b));
    let part = |along: f64, squared: f64| if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
    // Where the endless line of a is nearest to that of b; anywhere for parallel ones.
    let cross = aa * bb - ab * ab;
    let on_a = if cross > PARALLEL * PARALLEL * aa * bb {
        ((between.dot(along_a) * bb - between.dot(along_b) * ab) / cross).clamp(0.0, 1.0)
    } else {
        0.0
    };
    // The point of b nearest to it, and the point of a nearest to that.
    let on_b = part((a + along_a * on_a - b).dot(along_b), bb);
    let on_a = part((b + along_b * on_b - a).dot(along_a), aa);
    (a + along_a * on_a).distance(b + along_b * on_b)
}
