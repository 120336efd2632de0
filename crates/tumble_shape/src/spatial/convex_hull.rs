//! Convex hull: a filled polyhedron without inward corners.

use glam::DVec3;
use tumble_math::{Pose, Rotation, Spatial};

use super::{SpatialShapeError, hull, polyhedron_mass};
use crate::MassProperties;

/// Largest number of corners, so that corners and edges can be told apart by the 15 bits of a contact's feature id.
const CORNER_LIMIT: usize = 10_000;

/// Distance from a plane that still counts as in it, relative to the longest side of the cloud's box [1].
const FLAT: f64 = 1e-9;

/// A filled polyhedron without inward corners.
///
/// ```text
///          vertex            loop of a face: counter-clockwise seen from outside
///            / \
///   edge →  /   \  face      edge.faces = [left, right] seen from outside along
///          /_____\           edge.vertices = [from, to]
/// ```
///
/// Faces are polygons: triangles in one plane have been joined. Every vertex has three faces or more around it, every edge two.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexHull {
    vertices: Box<[DVec3]>,
    faces: Box<[Face]>,
    sides: Box<[Side]>,
    edges: Box<[Edge]>,
    centre: DVec3,
    inner_radius: f64,
    outer_radius: f64,
    /// Distance from a plane that counted as in it, relative to the longest side of the cloud's box [1].
    relative_tolerance: f64,
}

/// A face of a polyhedron: its plane, and where its sides are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Outward unit normal.
    pub normal: DVec3,
    /// Largest normal · p over the polyhedron, so that no vertex is outside the plane [m].
    pub offset: f64,
    /// Its first side.
    first: u32,
    /// Number of its sides.
    count: u32,
}

/// A side of a face: where it begins, which edge it is, and the plane through it that is square to the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Unit vector in the plane of the face, out of it.
    pub outward: DVec3,
    /// outward · p of the points of the side [m].
    pub offset: f64,
    /// Vertex where the side begins; the next side of the face begins where it ends.
    pub vertex: u32,
    /// The edge.
    pub edge: u32,
}

/// An edge, with the two faces that meet there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Both ends.
    pub vertices: [u32; 2],
    /// The face on the left seen from outside, then the one on the right.
    pub faces: [u32; 2],
    /// Cosine of the angle between their normals [1].
    pub cosine: f64,
}

impl ConvexHull {
    /// The hull of points [m]; points inside it are dropped, and so are points within 1e-9 of the cloud's size of a face.
    pub fn try_new(points: &[DVec3]) -> Result<Self, SpatialShapeError> {
        Self::try_with_tolerance(points, FLAT)
    }

    /// The hull of points [m], with faces flat to a tolerance, relative to the longest side of the cloud's box [1].
    ///
    /// 1e-9 by [`try_new`](Self::try_new). Points rounded to single precision want 1e-6, or a square of theirs stays two triangles.
    /// More makes fewer and larger faces; the hull's surface moves by about the tolerance.
    pub fn try_with_tolerance(points: &[DVec3], relative_tolerance: f64) -> Result<Self, SpatialShapeError> {
        let polygons = hull::polygons(points, relative_tolerance)?;
        let mut number = vec![u32::MAX; points.len()];
        polygons.iter().flatten().for_each(|&corner| number[corner] = 0);
        let corners: Vec<usize> = (0..points.len()).filter(|&i| number[i] == 0).collect();
        if corners.len() > CORNER_LIMIT {
            return Err(SpatialShapeError::TooManyCorners { count: corners.len(), limit: CORNER_LIMIT });
        }
        for (new, &old) in corners.iter().enumerate() {
            number[old] = new as u32;
        }
        let loops: Vec<Vec<u32>> =
            polygons.into_iter().map(|polygon| polygon.into_iter().map(|i| number[i]).collect()).collect();
        let hull = Self::from_loops(corners.into_iter().map(|i| points[i]).collect(), &loops);
        Ok(Self { relative_tolerance, ..hull })
    }

    /// A polyhedron from its vertices [m] and the loops of its faces, which must be closed, convex and counter-clockwise.
    pub(super) fn from_loops(vertices: Box<[DVec3]>, loops: &[Vec<u32>]) -> Self {
        let mut sides: Vec<Side> = Vec::new();
        let mut faces: Vec<Face> = Vec::with_capacity(loops.len());
        let mut ends: Vec<([u32; 2], u32, usize)> = Vec::new();
        for polygon in loops {
            let normal = newell(&vertices, polygon);
            let offset = vertices.iter().map(|&vertex| normal.dot(vertex)).fold(f64::NEG_INFINITY, f64::max);
            let first = sides.len();
            for (i, &from) in polygon.iter().enumerate() {
                let to = polygon[(i + 1) % polygon.len()];
                let (p, q) = (vertices[from as usize], vertices[to as usize]);
                let outward = unit_or_zero((q - p).cross(normal));
                ends.push(([from.min(to), from.max(to)], faces.len() as u32, sides.len()));
                sides.push(Side { outward, offset: outward.dot((p + q) * 0.5), vertex: from, edge: 0 });
            }
            faces.push(Face { normal, offset, first: first as u32, count: polygon.len() as u32 });
        }
        // The two sides of an edge stand next to each other; the one that runs from the smaller vertex to the larger is its left.
        ends.sort_unstable();
        let mut edges = Vec::with_capacity(ends.len() / 2);
        for pair in ends.chunks_exact(2) {
            let ([low, high], face, side) = pair[0];
            let (_, other_face, other_side) = pair[1];
            let forward = sides[side].vertex == low;
            for side in [side, other_side] {
                sides[side].edge = edges.len() as u32;
            }
            let pair = if forward { [face, other_face] } else { [other_face, face] };
            let [left, right] = pair.map(|face| faces[face as usize].normal);
            edges.push(Edge { vertices: [low, high], faces: pair, cosine: left.dot(right) });
        }

        let mut hull = Self {
            vertices,
            faces: faces.into(),
            sides: sides.into(),
            edges: edges.into(),
            centre: DVec3::ZERO,
            inner_radius: 0.0,
            outer_radius: 0.0,
            relative_tolerance: FLAT,
        };
        hull.centre_on(hull.mass_properties(1.0).centre);
        hull
    }

    /// Measures the radii from a centre that is known better than by summing [m].
    pub(super) fn centre_on(&mut self, centre: DVec3) {
        self.centre = centre;
        let depth = |face: &Face| face.offset - face.normal.dot(self.centre);
        self.inner_radius = self.faces.iter().map(depth).fold(f64::INFINITY, f64::min);
        let reach = |vertex: &DVec3| vertex.distance_squared(self.centre);
        self.outer_radius = self.vertices.iter().map(reach).fold(0.0, f64::max).sqrt();
    }

    /// Corners, in the order of the points given [m].
    #[inline]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Faces.
    #[inline]
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The sides of a face, counter-clockwise.
    #[inline]
    pub fn sides(&self, face: &Face) -> &[Side] {
        &self.sides[face.first as usize..(face.first + face.count) as usize]
    }

    /// Edges.
    #[inline]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Centre of its volume, always inside [m].
    #[inline]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Distance of the nearest face from the centre [m].
    #[inline]
    pub fn inner_radius(&self) -> f64 {
        self.inner_radius
    }

    /// Distance of the farthest vertex from the centre [m].
    #[inline]
    pub fn outer_radius(&self) -> f64 {
        self.outer_radius
    }

    /// How flat its faces are, relative to the longest side of the cloud's box: the tolerance it was made with [1].
    #[inline]
    pub fn relative_tolerance(&self) -> f64 {
        self.relative_tolerance
    }

    /// Volume inside [m³].
    pub fn volume(&self) -> f64 {
        self.mass_properties(1.0).mass
    }

    /// The polyhedron turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        let turned = |unit: DVec3| super::turned_unit(&pose.rotation, unit);
        let mut posed = self.clone();
        for vertex in &mut posed.vertices {
            *vertex = pose.transform_point(*vertex);
        }
        for face in &mut posed.faces {
            face.normal = turned(face.normal);
            face.offset = posed.vertices.iter().map(|&p| face.normal.dot(p)).fold(f64::NEG_INFINITY, f64::max);
        }
        for side in &mut posed.sides {
            side.offset += pose.rotation.rotate(side.outward).dot(pose.position);
            side.outward = turned(side.outward);
        }
        posed.centre = pose.transform_point(self.centre);
        posed
    }

    /// Mass properties at a density [kg/m³].
    pub fn mass_properties(&self, density: f64) -> MassProperties<Spatial> {
        polyhedron_mass::of(self, density)
    }
}

/// Unit normal of a polygon that need not be quite flat: the direction of its area vector Σ pᵢ × pᵢ₊₁ / 2 (Newell).
fn newell(vertices: &[DVec3], polygon: &[u32]) -> DVec3 {
    let place = |i: usize| vertices[polygon[i % polygon.len()] as usize];
    let origin = place(0);
    let twice_area =
        (1..polygon.len()).fold(DVec3::ZERO, |sum, i| sum + (place(i) - origin).cross(place(i + 1) - origin));
    unit_or_zero(twice_area)
}

/// The unit vector, exact along a coordinate axis.
fn unit_or_zero(vector: DVec3) -> DVec3 {
    let length = vector.length();
    if length > 0.0 { vector / length } else { DVec3::ZERO }
}
