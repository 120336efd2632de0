//! The directions along which rims and another shape can be farthest apart, or least deep in each other.

use glam::DVec3;
use smallvec::SmallVec;

use super::{Meeting, Other, Rims, curves, ellipse};
use crate::narrow::spatial::axis::{FlushFaces, Limits};

/// Sine of the angle from which on two directions count as parallel [1].
const PARALLEL: f64 = 1e-12;

/// Difference of heights that counts as none, relative to the size of the pair [1].
const LEVEL: f64 = 1e-12;

/// What of the rims faces the other shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OfRims {
    /// A flat end.
    End(usize),
    Side,
    /// A rim or tip.
    Rim,
}

/// What of the other shape faces the rims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OfOther {
    /// A face, or a flat end of other rims.
    Face(usize),
    Edge(usize),
    /// A vertex, rim or tip.
    Vertex,
    /// The side of other rims.
    Side,
}

/// The best direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// Unit vector from the rims to the other shape.
    pub(super) out: DVec3,
    pub(super) separation: f64,
    pub(super) of_rims: OfRims,
    pub(super) of_other: OfOther,
}

/// s(m): by how much the other shape is farther out than the rims along a unit vector [m].
pub(super) fn separation(rims: &Rims, other: &Other, out: DVec3) -> f64 {
    other.lowest(out) - rims.height(out)
}

/// Searches all directions; also returns the faces that lie flush.
pub(super) fn search(meeting: &Meeting) -> (Found, FlushFaces) {
    let Meeting { pair, rims, other, radius } = meeting;
    let flush = if *radius == 0.0 { pair.flush() } else { 0.0 };
    let limits = Limits { margin: pair.query.margin + radius, preference: pair.preference(), flush };
    let level = limits.preference + LEVEL * pair.size;
    let mut search =
        Search { rims, other, limits, flush: FlushFaces::NONE, best: None, least: f64::NEG_INFINITY, level };
    search.faces();
    if search.least <= limits.margin {
        // Anything else has to be better than the faces by the preference.
        search.least += limits.preference;
        match other {
            Other::Hull(hull) => {
                let sharp = (0..hull.edges().len()).filter(|edge| hull.edges()[*edge].cosine < 1.0);
                sharp.for_each(|edge| search.edge(edge));
                hull.vertices().iter().for_each(|vertex| search.vertex(*vertex));
            }
            Other::Core(core) => {
                if core.len() == 2 && core[0] != core[1] {
                    search.edge(0);
                }
                core.iter().for_each(|vertex| search.vertex(*vertex));
            }
            Other::Rims(other) => search.curves(other),
        }
    }
    let best = search.best.unwrap_or(Found {
        out: rims.axis,
        separation: f64::INFINITY,
        of_rims: OfRims::Rim,
        of_other: OfOther::Vertex,
    });
    (best, search.flush)
}

struct Search<'a> {
    rims: &'a Rims,
    other: &'a Other<'a>,
    limits: Limits,
    flush: FlushFaces,
    best: Option<Found>,
    /// What another direction must be better than [m].
    least: f64,
    /// Difference of heights that rounding can make [m].
    level: f64,
}

impl Search<'_> {
    /// Looks at the normal of a face or flat end; `preferred` is by how much it must be better than those before [m].
    fn face(&mut self, out: DVec3, of_rims: OfRims, of_other: OfOther, preferred: f64) {
        let separation = separation(self.rims, self.other, out);
        self.flush.note(out, separation, &self.limits);
        if separation > self.least + preferred {
            (self.least, self.best) = (separation, Some(Found { out, separation, of_rims, of_other }));
        }
    }

    fn faces(&mut self) {
        match self.other {
            Other::Hull(hull) => {
                for (i, face) in hull.faces().iter().enumerate() {
                    self.face(-face.normal, OfRims::Rim, OfOther::Face(i), 0.0);
                }
            }
            Other::Core(_) => {}
            Other::Rims(other) => {
                for end in [0, 1].into_iter().filter(|end| other.radii[*end] > 0.0) {
                    self.face(-other.end_normal(end), OfRims::Rim, OfOther::Face(end), 0.0);
                }
            }
        }
        let preference = self.limits.preference;
        for end in [0, 1].into_iter().filter(|end| self.rims.radii[*end] > 0.0) {
            self.face(self.rims.end_normal(end), OfRims::End(end), OfOther::Vertex, preference);
        }
    }

    /// Looks at a direction that two features allow, of which the other's has a place [m].
    fn offer(&mut self, out: DVec3, of_rims: OfRims, of_other: OfOther, on_other: DVec3) {
        let height = self.rims.height(out);
        let at_most = out.dot(on_other) - height;
        // The rest of the other shape can only be lower.
        if at_most <= self.least || !out.is_finite() {
            return;
        }
        let separation = self.other.lowest(out) - height;
        // Where it is, another feature faces the rims, which has its turn.
        if separation > self.least && at_most <= separation + self.level {
            (self.least, self.best) = (separation, Some(Found { out, separation, of_rims, of_other }));
        }
    }

    fn vertex(&mut self, vertex: DVec3) {
        let rims = self.rims;
        let from_axis = rims.across(vertex - rims.ends[0]);
        let out = rims.radial(from_axis);
        self.offer(rims.side_normal(out), OfRims::Side, OfOther::Vertex, vertex);
        for end in 0..2 {
            let closest = rims.ends[end] + out * rims.radii[end];
            if let Some(out) = (vertex - closest).try_normalize() {
                self.offer(out, OfRims::Rim, OfOther::Vertex, vertex);
            }
        }
    }

    fn edge(&mut self, edge: usize) {
        let rims = self.rims;
        let [from, to] = self.other.edge(edge);
        let Some(along) = (to - from).try_normalize() else { return };
        for out in leaning(rims.axis, rims.leaning[1], along, 0.0) {
            self.offer(out, OfRims::Side, OfOther::Edge(edge), from);
        }
        for end in 0..2 {
            for out in ellipse::square_to_line(rims, end, from, along) {
                self.offer(out, OfRims::Rim, OfOther::Edge(edge), from);
            }
        }
    }

    fn curves(&mut self, other: &Rims) {
        let rims = self.rims;
        for tip in (0..2).filter(|end| other.radii[*end] == 0.0) {
            self.vertex(other.ends[tip]);
        }
        for tip in (0..2).filter(|end| rims.radii[*end] == 0.0).map(|end| rims.ends[end]) {
            let out = other.radial(tip - other.ends[0]);
            let places = [0, 1].map(|end| other.ends[end] + out * other.radii[end]);
            self.offer(-other.side_normal(out), OfRims::Rim, OfOther::Side, places[0]);
            for place in places {
                if let Some(out) = (place - tip).try_normalize() {
                    self.offer(out, OfRims::Rim, OfOther::Vertex, place);
                }
            }
        }
        let sides: SmallVec<[DVec3; 4]> =
            leaning(rims.axis, rims.leaning[1], other.axis, -other.leaning[1]).into_iter().collect();
        let beside = (0..2).map(|end| rims.side_normal(rims.radial(other.ends[end] - rims.ends[0])));
        for out in sides.into_iter().chain(beside) {
            let place = other.line_facing(-out)[0];
            self.offer(out, OfRims::Side, OfOther::Side, place);
        }
        for end in [0, 1].into_iter().filter(|end| other.radii[*end] > 0.0) {
            for out in curves::side_and_rim(rims, other, end) {
                let place = other.line_facing(-out)[end];
                self.offer(out, OfRims::Side, OfOther::Vertex, place);
            }
        }
        for end in [0, 1].into_iter().filter(|end| rims.radii[*end] > 0.0) {
            for out in curves::side_and_rim(other, rims, end).into_iter().map(|out| -out) {
                let place = other.line_facing(-out)[0];
                self.offer(out, OfRims::Rim, OfOther::Side, place);
            }
        }
        for own in [0, 1].into_iter().filter(|end| rims.radii[*end] > 0.0) {
            for its in [0, 1].into_iter().filter(|end| other.radii[*end] > 0.0) {
                for out in curves::rim_and_rim(rims, own, other, its) {
                    let place = other.line_facing(-out)[its];
                    self.offer(out, OfRims::Rim, OfOther::Vertex, place);
                }
            }
        }
    }
}

/// The unit vectors m with m · u = s and m · v = t, for unit vectors u and v that are not parallel.
///
/// ```text
/// m = a u + b v ± c u × v,    a = (s − k t)/(1 − k²),  b = (t − k s)/(1 − k²),  k = u · v
/// ```
fn leaning(u: DVec3, s: f64, v: DVec3, t: f64) -> SmallVec<[DVec3; 2]> {
    let square = u.cross(v);
    let sine_squared = square.length_squared();
    if sine_squared <= PARALLEL * PARALLEL {
        return SmallVec::new();
    }
    let k = u.dot(v);
    let flat = (u * (s - k * t) + v * (t - k * s)) * (1.0 / sine_squared);
    let left = 1.0 - flat.length_squared();
    if left < 0.0 {
        return SmallVec::new();
    }
    let up = square * (left / sine_squared).sqrt();
    SmallVec::from_buf([flat + up, flat - up])
}
