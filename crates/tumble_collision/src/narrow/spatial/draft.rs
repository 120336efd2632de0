//! From places in a frame near the pair to a manifold in world axes.

use glam::DVec3;

use super::place::Place;
use crate::manifold::{ContactKind, ContactPoint, FeatureId, SpatialManifold};

/// Which shape of the pair something belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    A,
    B,
}

impl Owner {
    pub(super) fn other(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }
}

/// A feature of one shape: a vertex or an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feature {
    Vertex(u32),
    Edge(u32),
}

/// The id of a point made by a feature of a and one of b. A vertex on an edge is the vertex's.
pub(super) fn feature_id(of_a: Feature, of_b: Feature) -> FeatureId {
    match (of_a, of_b) {
        (Feature::Vertex(a), Feature::Vertex(b)) => FeatureId::vertices(a as usize, b as usize),
        (Feature::Vertex(a), Feature::Edge(_)) => FeatureId::vertex_of_a(a as usize),
        (Feature::Edge(_), Feature::Vertex(b)) => FeatureId::vertex_of_b(b as usize),
        (Feature::Edge(a), Feature::Edge(b)) => FeatureId::edges(a as usize, b as usize),
    }
}

/// The id of a vertex on a face of the other shape.
pub(super) fn vertex_id(of: Owner, vertex: u32) -> FeatureId {
    match of {
        Owner::A => FeatureId::vertex_of_a(vertex as usize),
        Owner::B => FeatureId::vertex_of_b(vertex as usize),
    }
}

/// The kind of a point made by such features, with the radii of the two shapes.
pub(super) fn kind_of(of_a: Feature, of_b: Feature, radii: [f64; 2]) -> ContactKind {
    match (radii[0] > 0.0, radii[1] > 0.0) {
        (true, true) => ContactKind::RoundRound,
        (false, false) => match (of_a, of_b) {
            (Feature::Vertex(_), Feature::Vertex(_)) => ContactKind::VertexVertex,
            (Feature::Edge(_), Feature::Edge(_)) => ContactKind::EdgeEdge,
            _ => ContactKind::VertexFace,
        },
        _ => ContactKind::RoundVertex,
    }
}

/// A manifold under way, with its points in the frame of one shape.
pub(super) struct Draft<'a> {
    frame: &'a Place,
    /// Unit vector from a to b, in that frame.
    normal: DVec3,
    margin: f64,
    manifold: SpatialManifold,
}

impl<'a> Draft<'a> {
    /// Begins a manifold along a normal from a to b, both in the same frame, for points up to a margin [m].
    #[inline]
    pub(super) fn new(frame: &'a Place, normal: DVec3, margin: f64) -> Self {
        Self { frame, normal, margin, manifold: SpatialManifold::along(frame.vector(normal)) }
    }

    /// Adds the point midway between two places on the cores [m], radii subtracted; left out beyond the margin.
    pub(super) fn between(&mut self, on_a: DVec3, on_b: DVec3, radii: [f64; 2], feature: FeatureId, kind: ContactKind) {
        let separation = self.normal.dot(on_b - on_a) - radii[0] - radii[1];
        let middle = (on_a + self.normal * radii[0] + on_b - self.normal * radii[1]) * 0.5;
        self.push(middle, separation, feature, kind);
    }

    /// Adds a point midway between the surfaces [m]; left out beyond the margin.
    #[inline]
    pub(super) fn push(&mut self, middle: DVec3, separation: f64, feature: FeatureId, kind: ContactKind) {
        if separation <= self.margin {
            self.manifold.insert(ContactPoint { point: self.frame.point(middle), separation, feature, kind });
        }
    }

    /// The manifold; without points it keeps the normal as a direction along which the shapes are apart.
    #[inline]
    pub(super) fn finish(self) -> SpatialManifold {
        self.manifold
    }
}
