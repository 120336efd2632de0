//! Separating axes between two polyhedra.

use glam::DVec3;

/// What makes a separating axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AxisOf {
    /// A face of a.
    FaceA(usize),
    /// A face of b.
    FaceB(usize),
    /// An edge of a and an edge of b.
    Edges(usize, usize),
}

/// A direction along which two shapes are apart, or least deep in each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) of: AxisOf,
    /// Unit vector from a to b, in the frame of a.
    pub(super) normal: DVec3,
    /// Gap along it [m].
    pub(super) separation: f64,
}

/// The axes that matter for a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    /// The face with the largest separation; of almost equal ones a's.
    pub(super) face: Axis,
    /// The pair of edges with the largest separation, if it is larger than the face's.
    pub(super) edges: Option<Axis>,
    /// Whether some face across the best axis is flush.
    pub(super) flush_across: bool,
}

impl Axes {
    /// The axis with the largest separation.
    pub(super) fn best(&self) -> &Axis {
        self.edges.as_ref().unwrap_or(&self.face)
    }
}

/// Outcome of looking for axes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Search {
    /// Along this unit vector (from a to b, in the frame of a) the two are further apart than asked.
    Apart(DVec3),
    /// None separates them that far.
    Near(Axes),
}

/// What a search for axes is asked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Separation beyond which the search may stop [m].
    pub(super) margin: f64,
    /// By how much b's face must be better than a's, and edges better than faces, so that they do not take turns [m].
    pub(super) preference: f64,
    /// Overlap that counts as flush; zero to leave it out [m].
    pub(super) flush: f64,
}

/// Cosine of the smallest angle between axes that run across each other [1].
const ACROSS: f64 = 0.5;

/// Remembers the few faces that lie flush, to compare them with the best axis once it is known.
#[derive(Default)]
pub(super) struct FlushFaces {
    normals: [DVec3; 8],
    count: usize,
}

impl FlushFaces {
    /// Notes a face with its separation [m]; of more than eight the rest is left out.
    #[inline]
    pub(super) fn note(&mut self, normal: DVec3, separation: f64, limits: &Limits) {
        if separation.abs() <= limits.flush && limits.flush > 0.0 && self.count < self.normals.len() {
            self.normals[self.count] = normal;
            self.count += 1;
        }
    }

    /// Whether one of them runs across an axis.
    pub(super) fn across(&self, axis: &Axis) -> bool {
        self.normals[..self.count].iter().any(|normal| normal.dot(axis.normal).abs() < ACROSS)
    }
}
