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

/// The best axes of each sort.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) face_a: Axis,
    pub(super) face_b: Axis,
    /// The pair of edges, if it is better than both faces.
    pub(super) edges: Option<Axis>,
    pub(super) flush: FlushFaces,
}

impl Found {
    /// The largest separation over all directions [m].
    pub(super) fn best(&self) -> f64 {
        let faces = self.face_a.separation.max(self.face_b.separation);
        self.edges.map_or(faces, |edges| edges.separation)
    }

    /// The axis that decides: a's face, unless another is better by the preference.
    pub(super) fn choice(&self, limits: &Limits) -> Axis {
        let b_is_better = self.face_b.separation > self.face_a.separation + limits.preference;
        let face = if b_is_better { self.face_b } else { self.face_a };
        self.edges.filter(|edges| edges.separation > face.separation + limits.preference).unwrap_or(face)
    }
}

/// Outcome of looking for axes.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "it lives on the stack for a moment")]
pub(super) enum Search {
    /// Along this unit vector (from a to b, in the frame of a) the two are further apart than asked.
    Apart(DVec3),
    /// None separates them that far.
    Near(Found),
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
#[derive(Clone, Copy, Debug)]
pub(super) struct FlushFaces {
    normals: [DVec3; 4],
    count: usize,
    /// By how much all other faces are from lying flush [m].
    pub(super) clear: f64,
}

impl FlushFaces {
    pub(super) const NONE: Self = Self { normals: [DVec3::ZERO; 4], count: 0, clear: f64::INFINITY };

    /// Notes a face with its separation [m]; of more than four flush ones the rest is left out.
    #[inline]
    pub(super) fn note(&mut self, normal: DVec3, separation: f64, limits: &Limits) {
        if limits.flush == 0.0 {
            return;
        }
        let beyond = separation.abs() - limits.flush;
        if beyond > 0.0 {
            self.clear = self.clear.min(beyond);
        } else if self.count < self.normals.len() {
            self.normals[self.count] = normal;
            self.count += 1;
        }
    }

    /// Notes a face that is known to be deeper than flush, its separation at most `bound` [m].
    #[inline]
    pub(super) fn note_deep(&mut self, bound: f64, limits: &Limits) {
        if limits.flush > 0.0 {
            self.clear = self.clear.min(-bound - limits.flush);
        }
    }

    /// Whether one of them runs across an axis.
    pub(super) fn across(&self, axis: &Axis) -> bool {
        self.is_across(axis.normal)
    }

    /// Whether one of them runs across a unit vector.
    pub(super) fn is_across(&self, normal: DVec3) -> bool {
        self.normals[..self.count].iter().any(|flush| flush.dot(normal).abs() < ACROSS)
    }
}
