//! Triangle mesh and height field: ground that does not move, made of facets.
//!
//! ```text
//!        ridge          A facet touches only along normals that lean no further over a side than the
//!         /\            neighbour's normal does: over a ridge up to the normal of the far side, over a
//!    ____/  \__         flat or hollow side not at all. So nothing catches on the inner edges of a mesh.
//!   level    \hollow
//! ```
//!
//! Every facet is a collider of its own, with its own bounds and its own contact points; a mesh is the list of them.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use thiserror::Error;
use tumble_math::{Pose, Spatial};

use super::ConvexHull;

/// Sine of a lean that still counts as none [1].
const UPRIGHT: f64 = 1e-9;

/// Why triangles do not make a mesh. Triangles and vertices are counted from 0, in the order given.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum MeshError {
    /// A coordinate or length is infinite or NaN.
    #[error("a coordinate or length is infinite or not a number")]
    NotFinite,
    /// There is no triangle.
    #[error("the mesh has no triangle")]
    Empty,
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {count}")]
    MissingVertex {
        /// The triangle.
        triangle: usize,
        /// The vertex it names.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// The corners of a triangle lie on one line.
    #[error("the corners of triangle {triangle} lie on one line, so it has no area")]
    NoArea {
        /// The triangle.
        triangle: usize,
    },
    /// Two triangles have the same side in the same direction.
    #[error(
        "triangles {first} and {second} both run from vertex {from} to vertex {to}: one is turned over, or more than two \
         share the side"
    )]
    SharedSide {
        /// The one triangle.
        first: usize,
        /// The other triangle.
        second: usize,
        /// Where the side begins.
        from: u32,
        /// Where it ends.
        to: u32,
    },
    /// The ground has no thickness.
    #[error("the thickness of the ground is {thickness} m, but must be positive")]
    ThicknessNotPositive {
        /// The thickness given [m].
        thickness: f64,
    },
    /// The numbers of a height field do not fill its rows.
    #[error("{count} heights do not fill rows of {columns}; there must be at least two rows of at least two")]
    Rows {
        /// Number of heights.
        count: usize,
        /// Heights in a row.
        columns: usize,
    },
}

/// What lies beyond a side of a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Beyond {
    /// Nothing: the mesh ends there.
    Border,
    /// A facet in the same plane, or one that rises.
    Level,
    /// A facet that falls: components of its normal across the side and up.
    Ridge { across: f64, up: f64 },
}

/// A triangle of the ground, solid below to the mesh's thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// The prism below the triangle; face 0 is the triangle, faces 2 to 4 are below its sides.
    prism: ConvexHull,
    beyond: [Beyond; 3],
    thickness: f64,
}

impl Facet {
    /// The prism below the triangle; its face 0 is the triangle, which is all that can be seen of it.
    #[inline]
    pub fn prism(&self) -> &ConvexHull {
        &self.prism
    }

    /// Corners of the triangle, counter-clockwise seen from above the ground [m].
    pub fn corners(&self) -> [DVec3; 3] {
        std::array::from_fn(|corner| self.prism.vertices()[corner])
    }

    /// Depth of solid ground below the triangle [m].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Unit normal of the triangle, out of the ground.
    #[inline]
    pub fn normal(&self) -> DVec3 {
        self.prism.faces()[0].normal
    }

    /// Whether something may touch it along a direction out of the ground: see the top of the module.
    pub fn allows(&self, direction: DVec3) -> bool {
        let top = &self.prism.faces()[0];
        let up = top.normal.dot(direction);
        let fits = |(outward, beyond): (DVec3, &Beyond)| {
            let lean = outward.dot(direction);
            lean <= UPRIGHT
                || match beyond {
                    Beyond::Border => true,
                    Beyond::Level => false,
                    Beyond::Ridge { across, up: rise } => lean * rise <= up * across + UPRIGHT,
                }
        };
        up > 0.0 && self.prism.sides(top).iter().map(|side| side.outward).zip(&self.beyond).all(fits)
    }

    /// The facet turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Spatial>) -> Self {
        Self { prism: self.prism.posed(pose), beyond: self.beyond, thickness: self.thickness }
    }
}

/// Triangles that share sides, counter-clockwise seen from above the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    vertices: Box<[DVec3]>,
    triangles: Box<[[u32; 3]]>,
    neighbours: Box<[[Option<u32>; 3]]>,
    thickness: f64,
}

impl TriangleMesh {
    /// A mesh of triangles over vertices [m], solid below each triangle to a thickness [m].
    ///
    /// The thickness is what a body may sink in before it is through: more than it travels in a step, less than the ground is thick.
    pub fn try_new(
        vertices: impl Into<Box<[DVec3]>>,
        triangles: impl Into<Box<[[u32; 3]]>>,
        thickness: f64,
    ) -> Result<Self, MeshError> {
        let (vertices, triangles) = (vertices.into(), triangles.into());
        if !(thickness.is_finite() && vertices.iter().all(|vertex| vertex.is_finite())) {
            return Err(MeshError::NotFinite);
        }
        if thickness <= 0.0 {
            return Err(MeshError::ThicknessNotPositive { thickness });
        }
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        for (i, triangle) in triangles.iter().enumerate() {
            if let Some(&vertex) = triangle.iter().find(|&&vertex| vertex as usize >= vertices.len()) {
                return Err(MeshError::MissingVertex { triangle: i, vertex, count: vertices.len() });
            }
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
            if (b - a).cross(c - a).length() <= UPRIGHT * longest {
                return Err(MeshError::NoArea { triangle: i });
            }
        }
        let neighbours = neighbours(&triangles)?;
        Ok(Self { vertices, triangles, neighbours, thickness })
    }

    /// A height field: the height z [m] of each point of a grid with the spacing [m] along x and y, row by row along x, the first one
    /// at the origin; every cell is two triangles.
    pub fn from_heights(spacing: DVec2, columns: usize, heights: &[f64], thickness: f64) -> Result<Self, MeshError> {
        if columns < 2 || heights.len() < 2 * columns || !heights.len().is_multiple_of(columns) {
            return Err(MeshError::Rows { count: heights.len(), columns });
        }
        let place = |(i, &height): (usize, &f64)| {
            DVec3::new((i % columns) as f64 * spacing.x, (i / columns) as f64 * spacing.y, height)
        };
        let vertices: Vec<DVec3> = heights.iter().enumerate().map(place).collect();
        let mut triangles = Vec::new();
        for row in 1..heights.len() / columns {
            for column in 1..columns {
                let corner = |r: usize, c: usize| (r * columns + c) as u32;
                let (near, far) = (corner(row - 1, column - 1), corner(row, column));
                triangles.push([near, corner(row - 1, column), far]);
                triangles.push([near, far, corner(row, column - 1)]);
            }
        }
        Self::try_new(vertices, triangles, thickness)
    }

    /// The mesh that has these facets, in this order; nothing if no mesh has just these.
    ///
    /// Corners at the same place are one vertex, so the facets of a mesh whose vertices are all at places of their own come back to it.
    pub fn from_facets(facets: &[&Facet]) -> Option<Self> {
        let (vertices, triangles) = join_corners(facets.iter().map(|facet| facet.corners()));
        let mesh = Self::try_new(vertices, triangles, facets.first()?.thickness).ok()?;
        mesh.facets().eq(facets.iter().map(|facet| (*facet).clone())).then_some(mesh)
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Numbers of the vertices of each triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The facets, one for each triangle, in order.
    pub fn facets(&self) -> impl Iterator<Item = Facet> + '_ {
        (0..self.triangles.len()).map(|triangle| self.facet(triangle))
    }

    fn facet(&self, triangle: usize) -> Facet {
        let corners = self.corners(triangle);
        let normal = self.normal(triangle);
        let down = normal * -self.thickness;
        let vertices: Vec<DVec3> = corners.iter().copied().chain(corners.map(|corner| corner + down)).collect();
        let mut loops = vec![vec![0, 1, 2], vec![3, 5, 4]];
        loops.extend((0..3).map(|i| {
            let j = (i + 1) % 3;
            vec![j, i, i + 3, j + 3]
        }));
        let prism = ConvexHull::from_loops(vertices.into(), &loops);
        let beyond = std::array::from_fn(|i| {
            let Some(neighbour) = self.neighbours[triangle][i] else { return Beyond::Border };
            let outward = (corners[(i + 1) % 3] - corners[i]).cross(normal).normalize_or_zero();
            let other = self.normal(neighbour as usize);
            let (across, up) = (outward.dot(other), normal.dot(other));
            if across > UPRIGHT { Beyond::Ridge { across, up } } else { Beyond::Level }
        });
        Facet { prism, beyond, thickness: self.thickness }
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    fn normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

/// Vertices [m], and triangles over them: corners at the same place are one vertex, in the order in which they come.
pub fn join_corners(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut numbers: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut number = |corner: DVec3| {
        // Adding 0 makes −0 the same place as 0.
        let place = (corner + DVec3::ZERO).to_array().map(f64::to_bits);
        *numbers.entry(place).or_insert_with(|| {
            vertices.push(corner);
            vertices.len() as u32 - 1
        })
    };
    let triangles = triangles.into_iter().map(|corners| corners.map(&mut number)).collect();
    (vertices, triangles)
}

/// The triangle across each side.
fn neighbours(triangles: &[[u32; 3]]) -> Result<Box<[[Option<u32>; 3]]>, MeshError> {
    // All sides, in the order of their ends: the two of an edge stand next to each other.
    let mut sides: Vec<([u32; 2], bool, usize, usize)> = Vec::with_capacity(3 * triangles.len());
    for (i, triangle) in triangles.iter().enumerate() {
        for side in 0..3 {
            let (from, to) = (triangle[side], triangle[(side + 1) % 3]);
            sides.push(([from.min(to), from.max(to)], from > to, i, side));
        }
    }
    sides.sort_unstable();
    let mut neighbours = vec![[None; 3]; triangles.len()];
    for pair in sides.windows(2) {
        let [(ends, backwards, one, side), (other_ends, other_backwards, two, other_side)] = [pair[0], pair[1]];
        if ends != other_ends {
            continue;
        }
        if backwards == other_backwards {
            let [low, high] = ends;
            let (from, to) = if backwards { (high, low) } else { (low, high) };
            return Err(MeshError::SharedSide { first: one, second: two, from, to });
        }
        neighbours[one][side] = Some(two as u32);
        neighbours[two][other_side] = Some(one as u32);
    }
    Ok(neighbours.into())
}
