//! Contact points that share a normal.
//!
//! ```text
//!        b          normal: unit vector from a to b
//!     ___|___       separation: along the normal, negative when overlapping
//!     \__^__/       point: midway between the two surfaces
//!  ______|______
//!        a
//! ```

use std::fmt;

use glam::{DVec2, DVec3};
use tumble_math::Vector;

use crate::narrow::spatial::AxisMemory;

/// Which kinds of feature meet at a contact point. The list is closed; the names are those of `contacts.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactKind {
    /// A sharp corner (or thin rod's end) on a side.
    VertexFace,
    /// A sharp corner on a sharp corner.
    VertexVertex,
    /// A disc or a rounded rod's end on a side.
    RoundFace,
    /// A disc or a rounded rod's end on a sharp corner.
    RoundVertex,
    /// Two discs or rounded ends.
    RoundRound,
    /// Two edges that cross in space.
    EdgeEdge,
}

impl ContactKind {
    /// All kinds, in order.
    pub const ALL: [Self; 6] =
        [Self::VertexFace, Self::VertexVertex, Self::RoundFace, Self::RoundVertex, Self::RoundRound, Self::EdgeEdge];

    /// Whether one of the two features is a side.
    pub const fn is_on_face(self) -> bool {
        matches!(self, Self::VertexFace | Self::RoundFace)
    }

    /// The stable name, such as `vertex-face`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::VertexFace => "vertex-face",
            Self::VertexVertex => "vertex-vertex",
            Self::RoundFace => "round-face",
            Self::RoundVertex => "round-vertex",
            Self::RoundRound => "round-round",
            Self::EdgeEdge => "edge-edge",
        }
    }
}

impl fmt::Display for ContactKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// Which corner of which shape made a point, so that the same physical point is known again in the next step.
///
/// The two highest bits say whose corner it is (a's, b's, one of each, or none: two edges that cross); two times fifteen bits hold
/// the numbers of the corners or edges. The side that a corner touches is left out: a point keeps its id when the two shapes swap
/// reference face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FeatureId(pub u32);

impl FeatureId {
    const INDEX_BITS: u32 = 15;
    const INDEX_MASK: u32 = (1 << Self::INDEX_BITS) - 1;

    /// Corner `vertex` of shape a on a side of b.
    pub const fn vertex_of_a(vertex: usize) -> Self {
        Self((vertex as u32 & Self::INDEX_MASK) << Self::INDEX_BITS)
    }

    /// Corner `vertex` of shape b on a side of a.
    pub const fn vertex_of_b(vertex: usize) -> Self {
        Self(1 << 30 | vertex as u32 & Self::INDEX_MASK)
    }

    /// Corner `vertex_a` of a on corner `vertex_b` of b.
    pub const fn vertices(vertex_a: usize, vertex_b: usize) -> Self {
        Self(2 << 30 | Self::vertex_of_a(vertex_a).0 | vertex_b as u32 & Self::INDEX_MASK)
    }

    /// Edge `edge_a` of a across edge `edge_b` of b.
    pub const fn edges(edge_a: usize, edge_b: usize) -> Self {
        Self(3 << 30 | Self::vertex_of_a(edge_a).0 | edge_b as u32 & Self::INDEX_MASK)
    }

    /// The id when a and b change places.
    pub(crate) const fn flipped(self) -> Self {
        let (a, b) = (self.0 >> Self::INDEX_BITS & Self::INDEX_MASK, self.0 & Self::INDEX_MASK);
        match self.0 >> 30 {
            0 => Self::vertex_of_b(a as usize),
            1 => Self::vertex_of_a(b as usize),
            tag => Self(tag << 30 | b << Self::INDEX_BITS | a),
        }
    }

    /// Whose corner it is.
    pub const fn corner(self) -> CornerOf {
        match self.0 >> 30 {
            0 => CornerOf::A,
            1 => CornerOf::B,
            _ => CornerOf::Both,
        }
    }

    /// The numbers of a's and b's corner, if it is one of each.
    pub const fn as_vertices(self) -> Option<(usize, usize)> {
        let (a, b) = (self.0 >> Self::INDEX_BITS & Self::INDEX_MASK, self.0 & Self::INDEX_MASK);
        if self.0 >> 30 == 2 { Some((a as usize, b as usize)) } else { None }
    }

    /// The numbers of a's and b's edge, if two edges cross.
    pub const fn as_edges(self) -> Option<(usize, usize)> {
        let (a, b) = (self.0 >> Self::INDEX_BITS & Self::INDEX_MASK, self.0 & Self::INDEX_MASK);
        if self.0 >> 30 == 3 { Some((a as usize, b as usize)) } else { None }
    }
}

/// Whose corner (or round) makes a contact point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerOf {
    /// Shape a's, on a side of b.
    A,
    /// Shape b's, on a side of a.
    B,
    /// One of each, or an edge of each.
    Both,
}

/// One point where two shapes touch, or nearly do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint<V> {
    /// Midway between the two surfaces, in world axes [m].
    pub point: V,
    /// Gap along the normal, negative when overlapping [m].
    pub separation: f64,
    /// Which features made it.
    pub feature: FeatureId,
    /// What kinds of features those are.
    pub kind: ContactKind,
}

/// What a manifold remembers for the next query, besides its points.
pub trait Memory: Copy {
    /// Nothing.
    const NONE: Self;
}

impl Memory for () {
    const NONE: Self = ();
}

/// Up to `N` contact points of a pair, sharing one normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manifold<V, const N: usize, M = ()> {
    /// Unit vector from a to b, in world axes. In a manifold without points: a direction along which the shapes are apart, if one
    /// is remembered, or zero.
    pub normal: V,
    points: [ContactPoint<V>; N],
    count: u8,
    /// What the next query may start from.
    memory: M,
}

/// The contact of two shapes of the plane: a point, or the two ends of a line.
pub type PlanarManifold = Manifold<DVec2, 2>;

/// The contact of two shapes of space: up to four points that span what carries.
pub type SpatialManifold = Manifold<DVec3, 4, AxisMemory>;

impl<V: Vector, const N: usize, M: Memory> Manifold<V, N, M> {
    const UNUSED: ContactPoint<V> =
        ContactPoint { point: V::ZERO, separation: 0.0, feature: FeatureId(0), kind: ContactKind::VertexFace };

    /// No contact.
    pub const EMPTY: Self = Self { normal: V::ZERO, points: [Self::UNUSED; N], count: 0, memory: M::NONE };

    /// A manifold to which points are added along this normal.
    #[inline]
    pub(crate) fn along(normal: V) -> Self {
        Self { normal, ..Self::EMPTY }
    }

    /// Adds a point in the order of feature ids; points beyond the capacity are dropped.
    #[inline]
    pub(crate) fn insert(&mut self, point: ContactPoint<V>) {
        let count = self.count as usize;
        if count == N {
            return;
        }
        let mut place = count;
        while place > 0 && point.feature < self.points[place - 1].feature {
            self.points[place] = self.points[place - 1];
            place -= 1;
        }
        self.points[place] = point;
        self.count += 1;
    }

    /// Moves the points to other places, along another normal: `place` tells the point and its separation by number.
    #[inline]
    pub fn carry(&mut self, normal: V, mut place: impl FnMut(usize) -> (V, f64)) {
        self.normal = normal;
        for (number, point) in self.points[..self.count as usize].iter_mut().enumerate() {
            (point.point, point.separation) = place(number);
        }
    }

    /// The same manifold with something to remember.
    #[inline]
    pub(crate) fn remembering(self, memory: M) -> Self {
        Self { memory, ..self }
    }

    /// Remembers something from now on.
    #[inline]
    pub(crate) fn remember(&mut self, memory: &M) {
        self.memory = *memory;
    }

    /// What it remembers.
    #[inline]
    pub(crate) fn memory(&self) -> &M {
        &self.memory
    }

    /// The points, in the order of their feature ids.
    #[inline]
    pub fn points(&self) -> &[ContactPoint<V>] {
        &self.points[..self.count as usize]
    }

    /// Whether there is no point.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The smallest separation of its points; `None` without points [m].
    pub fn deepest_separation(&self) -> Option<f64> {
        self.points().iter().map(|point| point.separation).reduce(f64::min)
    }

    /// The point made by a feature.
    pub fn point_of(&self, feature: FeatureId) -> Option<&ContactPoint<V>> {
        self.points().iter().find(|point| point.feature == feature)
    }
}

impl SpatialManifold {
    /// The same contact with a and b in each other's place. What is remembered is told in the order in which the pair was looked at,
    /// and stays.
    pub(crate) fn flipped(&self) -> Self {
        let mut flipped = Self::along(-self.normal).remembering(self.memory);
        for point in self.points() {
            flipped.insert(ContactPoint { feature: point.feature.flipped(), ..*point });
        }
        flipped
    }
}

impl<V: Vector, const N: usize, M: Memory> Default for Manifold<V, N, M> {
    fn default() -> Self {
        Self::EMPTY
    }
}
