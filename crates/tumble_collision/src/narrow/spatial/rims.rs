//! Cylinder or cone and anything but a half-space.
//!
//! A cylinder or cone is the hull of two circles, its *rims*, one of which may be a tip. Two convex shapes are apart by
//!
//! ```text
//! s = max over unit m of s(m),    s(m) = min over the other of m · x − max over the rims of m · x
//! ```
//!
//! which below zero is minus the least depth. Where s is largest, two features face each other, and each pair of features allows few m.
//! All of those are tried, each measured over both whole shapes (`search.rs`): none can be too good, so the best one is the answer.
//!
//! | feature of the rims | on a vertex | on an edge | on a face |
//! |---|---|---|---|
//! | flat end | its normal | its normal | its normal, or the face's |
//! | side | radially outwards, leaning by the slope | square to the edge, leaning by the slope: a quadratic | the face's normal |
//! | rim or tip | from its closest point | square to the edge: closest point of an ellipse (`ellipse.rs`) | the face's normal |
//!
//! Side and side are a quadratic as well. A rim over a side or another rim has no closed form: stationary m are found by Newton's method
//! and bisection from sixteen places round the rim, to rounding (`curves.rs`).
//!
//! Points: a flat end on a face or another flat end touches along a region; its corners, the places where outlines cross, and four places a
//! quarter of a turn apart on the rim stand for it, at most four in all (`region.rs`). A side touches a face, an edge along it or
//! another side along it with the two ends of a line. Everything else is one point.

mod curves;
mod ellipse;
mod region;
mod search;

use glam::DVec3;
use tumble_shape::ConvexHull;

use self::search::{Found, OfOther, OfRims};
use super::Pair;
use super::closest::at_end;
use super::core::Solid;
use super::draft::{Draft, Feature, Owner, feature_id, kind_of};
use super::place::Place;
use super::{search as axes, segment};
use crate::manifold::{ContactKind, SpatialManifold};

/// Sine of the largest slope against the normal of a line that the side touches as a whole [1].
const LEVEL: f64 = 1e-2;

/// Number of the side as an edge, so that a point on it has an id.
const SIDE: u32 = 0;
/// Number of the first rim as an edge; the second one's is one more.
const RIM: u32 = 1;

/// A cylinder or a cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rims {
    /// Centres of the rims [m].
    ends: [DVec3; 2],
    /// Their radii; 0 for a tip [m].
    radii: [f64; 2],
    /// Unit vector from the first to the second.
    axis: DVec3,
    /// Cosine and sine of the angle by which normals of the side lean towards the second end.
    leaning: [f64; 2],
}

impl Rims {
    /// The shape in a frame.
    fn new(ends: [DVec3; 2], radii: [f64; 2], place: Option<&Place>) -> Self {
        let ends = place.map_or(ends, |place| ends.map(|end| place.point(end)));
        let (length, narrowing) = (ends[0].distance(ends[1]), radii[0] - radii[1]);
        let slant = (length * length + narrowing * narrowing).sqrt();
        let axis = (ends[1] - ends[0]) * (1.0 / length);
        Self { ends, radii, axis, leaning: [length / slant, narrowing / slant] }
    }

    /// The part of a direction across the axis.
    fn across(&self, direction: DVec3) -> DVec3 {
        direction - self.axis * self.axis.dot(direction)
    }

    /// Unit vector across the axis along a direction; any for a direction along the axis.
    fn radial(&self, direction: DVec3) -> DVec3 {
        let across = self.across(direction);
        // Once more, because the first time cancels digits of a direction near the axis.
        let unit = across.try_normalize().and_then(|unit| self.across(unit).try_normalize());
        unit.unwrap_or_else(|| self.axis.any_orthonormal_vector())
    }

    /// Largest direction · x over the shape [m].
    fn height(&self, direction: DVec3) -> f64 {
        let across = self.axis.cross(direction).length();
        let of = |end: usize| direction.dot(self.ends[end]) + self.radii[end] * across;
        of(0).max(of(1))
    }

    /// The end whose rim (or tip) is farthest in a direction.
    fn farthest_end(&self, direction: DVec3) -> usize {
        let across = self.axis.cross(direction).length();
        let of = |end: usize| direction.dot(self.ends[end]) + self.radii[end] * across;
        usize::from(of(1) > of(0))
    }

    /// The line on the side that faces a direction, from the first end to the second [m].
    fn line_facing(&self, direction: DVec3) -> [DVec3; 2] {
        let out = self.radial(direction);
        [0, 1].map(|end| self.ends[end] + out * self.radii[end])
    }

    /// The outward normal of the side at a unit vector across the axis.
    fn side_normal(&self, out: DVec3) -> DVec3 {
        out * self.leaning[0] + self.axis * self.leaning[1]
    }

    /// The outward normal of a flat end.
    fn end_normal(&self, end: usize) -> DVec3 {
        if end == 0 { -self.axis } else { self.axis }
    }

    /// The flat end that faces a unit vector more squarely than the side does.
    fn end_facing(&self, direction: DVec3) -> Option<usize> {
        let (along, across) = (self.axis.dot(direction), self.axis.cross(direction).length());
        let end = usize::from(along > 0.0);
        let side = self.leaning[0] * across + self.leaning[1] * along;
        (self.radii[end] > 0.0 && along.abs() >= side).then_some(end)
    }
}

/// The shape across from the rims, in the frame of a.
#[derive(Clone, Copy)]
enum Other<'a> {
    Hull(&'a ConvexHull),
    /// One or two vertices.
    Core(&'a [DVec3]),
    Rims(&'a Rims),
}

impl Other<'_> {
    /// Smallest direction · x over the shape [m].
    fn lowest(&self, direction: DVec3) -> f64 {
        match self {
            Self::Hull(hull) => axes::lowest(hull.vertices(), direction),
            Self::Core(core) => axes::lowest(core, direction),
            Self::Rims(rims) => -rims.height(-direction),
        }
    }

    fn edge(&self, edge: usize) -> [DVec3; 2] {
        match self {
            Self::Hull(hull) => hull.edges()[edge].vertices.map(|vertex| hull.vertices()[vertex as usize]),
            Self::Core(core) => [core[0], core[core.len() - 1]],
            Self::Rims(rims) => rims.ends,
        }
    }
}

/// A pair of rims b and another shape a, in the frame of a.
struct Meeting<'a> {
    pair: &'a Pair<'a>,
    rims: &'a Rims,
    other: Other<'a>,
    /// Radius of the other's rounding [m].
    radius: f64,
}

/// Contact points of shape a and b, a cylinder or cone.
pub(super) fn collide(pair: &Pair, a: &Solid, ends: [DVec3; 2], radii: [f64; 2]) -> SpatialManifold {
    let rims = Rims::new(ends, radii, Some(&pair.b_in_a));
    let meet = |other: Other, radius: f64| Meeting { pair, rims: &rims, other, radius }.collide();
    match a {
        Solid::Hull(hull, _) => meet(Other::Hull(hull), 0.0),
        Solid::Facet(facet) => meet(Other::Hull(facet.prism()), 0.0),
        Solid::Segment(ends, radius) => meet(Other::Core(*ends), *radius),
        Solid::Point(centre, radius) => meet(Other::Core(&[*centre]), *radius),
        Solid::Rims(ends, radii) => meet(Other::Rims(&Rims::new(*ends, *radii, None)), 0.0),
    }
}

/// What of rims b lies on the first face of hull a and not below a height [m], whichever axis is best.
pub(super) fn on_top(
    pair: &Pair,
    hull: &ConvexHull,
    ends: [DVec3; 2],
    radii: [f64; 2],
    deepest: f64,
) -> SpatialManifold {
    let rims = Rims::new(ends, radii, Some(&pair.b_in_a));
    region::on_face(&Meeting { pair, rims: &rims, other: Other::Hull(hull), radius: 0.0 }, hull, 0, deepest)
}

impl Meeting<'_> {
    fn collide(&self) -> SpatialManifold {
        let margin = self.pair.query.margin + self.radius;
        if let Some(normal) = self.pair.remembered_gap()
            && search::separation(self.rims, &self.other, -normal) > margin
        {
            return self.pair.apart(normal);
        }
        let (found, flush) = search::search(self);
        if found.separation > margin {
            return self.pair.apart(-found.out);
        }
        if self.radius == 0.0 && flush.is_across(-found.out) {
            return self.pair.apart(-found.out);
        }
        let on_region = match (found.of_rims, found.of_other) {
            (_, OfOther::Face(face)) => match self.other {
                Other::Hull(hull) => Some(region::on_face(self, hull, face, f64::NEG_INFINITY)),
                Other::Rims(other) => Some(region::on_end(self, other, face, Owner::A)),
                Other::Core(_) => None,
            },
            (OfRims::End(end), _) => Some(region::on_end(self, self.rims, end, Owner::B)),
            _ => None,
        };
        match on_region.filter(|manifold| self.reaches(manifold, &found)) {
            Some(manifold) => manifold,
            None => self.on_features(&found),
        }
    }

    /// Two features that pass each other: the ends of a line where they run along each other, else one point.
    fn on_features(&self, found: &Found) -> SpatialManifold {
        let radii = [self.radius, 0.0];
        if let Some(manifold) = self.along_side(found).filter(|manifold| self.reaches(manifold, found)) {
            return manifold;
        }
        let (mut of_rims, mut own) = self.own_feature(found);
        let (mut of_other, mut its) = self.other_feature(found);
        let across = found.out * found.separation;
        // On the border of a face or flat end: there is nothing but the one point that touches it.
        match (found.of_rims, found.of_other) {
            (_, OfOther::Face(_)) => {
                let end = self.rims.farthest_end(found.out);
                (of_rims, of_other) = (Feature::Vertex(4 * end as u32), Feature::Edge(0));
                its = own.map(|place| place + across);
            }
            (OfRims::End(_), _) => {
                of_rims = Feature::Edge(0);
                if let Other::Rims(rims) = self.other {
                    of_other = Feature::Vertex(4 * rims.farthest_end(-found.out) as u32);
                }
                own = its.map(|place| place - across);
            }
            _ => {}
        }
        let (t, s) = segment::closest(its, own);
        let (on_a, on_b) = (its[0].lerp(its[1], t), own[0].lerp(own[1], s));
        let middle = (on_a + on_b - found.out * self.radius) * 0.5;
        let mut draft = Draft::new(&self.pair.a_in_world, -found.out, self.pair.query.margin);
        let id = feature_id(of_other, of_rims);
        draft.push(middle, found.separation - self.radius, id, kind(of_other, of_rims, radii));
        draft.finish()
    }

    /// Whether a manifold has a point as deep as what was found.
    fn reaches(&self, manifold: &SpatialManifold, found: &Found) -> bool {
        let tolerance = self.pair.preference() + self.pair.rounding();
        manifold.deepest_separation().is_some_and(|deepest| deepest <= found.separation - self.radius + tolerance)
    }

    /// The two ends of the line in which the side meets an edge or another side that runs along it.
    fn along_side(&self, found: &Found) -> Option<SpatialManifold> {
        let radii = [self.radius, 0.0];
        let own = self.rims.line_facing(found.out);
        if !is_level(own, found.out) {
            return None;
        }
        let (of_other, ends, its) = self.line_beside(found, own)?;
        let stretch = segment::beside(its, own)?;
        let mut draft = Draft::new(&self.pair.a_in_world, -found.out, self.pair.query.margin);
        for (t, s) in stretch {
            let of_a = at_end(t).map_or(of_other, |end| ends[end]);
            let of_b = at_end(s).map_or(Feature::Edge(SIDE), |end| Feature::Vertex(4 * end as u32));
            let (on_a, on_b) = (its[0].lerp(its[1], t), own[0].lerp(own[1], s));
            draft.between(on_a, on_b, radii, feature_id(of_a, of_b), kind(of_a, of_b, radii));
        }
        Some(draft.finish())
    }

    /// An edge or side of the other shape that faces the rims and may run along their side: what it is, its ends, and where they are [m].
    fn line_beside(&self, found: &Found, own: [DVec3; 2]) -> Option<(Feature, [Feature; 2], [DVec3; 2])> {
        match self.other {
            Other::Hull(hull) => {
                let lowest = self.lowest_vertex(hull.vertices(), found.out) as u32;
                let touching = (0..hull.edges().len()).filter(|edge| hull.edges()[*edge].vertices.contains(&lowest));
                let mut lines = touching.map(|edge| (edge, self.other.edge(edge)));
                let (edge, line) =
                    lines.find(|(_, line)| is_level(*line, found.out) && segment::beside(*line, own).is_some())?;
                Some((Feature::Edge(edge as u32), hull.edges()[edge].vertices.map(Feature::Vertex), line))
            }
            Other::Core(core) => {
                let ends = [Feature::Vertex(0), Feature::Vertex(1)];
                (core.len() == 2).then_some((Feature::Edge(0), ends, self.other.edge(0)))
            }
            Other::Rims(rims) => {
                let line = rims.line_facing(-found.out);
                is_level(line, found.out).then_some((
                    Feature::Edge(SIDE),
                    [Feature::Vertex(0), Feature::Vertex(4)],
                    line,
                ))
            }
        }
    }

    /// The feature of the rims that faces outwards, and the line or point that it is [m].
    fn own_feature(&self, found: &Found) -> (Feature, [DVec3; 2]) {
        let line = self.rims.line_facing(found.out);
        if found.of_rims == OfRims::Side {
            return (Feature::Edge(SIDE), line);
        }
        let end = self.rims.farthest_end(found.out);
        (rim_or_tip(self.rims, end), [line[end]; 2])
    }

    /// The feature of the other shape that faces the rims, and the line or point that it is [m].
    fn other_feature(&self, found: &Found) -> (Feature, [DVec3; 2]) {
        match (self.other, found.of_other) {
            (Other::Hull(_) | Other::Core(_), OfOther::Edge(edge)) => {
                (Feature::Edge(edge as u32), self.other.edge(edge))
            }
            (Other::Rims(rims), OfOther::Side) => (Feature::Edge(SIDE), rims.line_facing(-found.out)),
            (Other::Rims(rims), _) => {
                let end = rims.farthest_end(-found.out);
                (rim_or_tip(rims, end), [rims.line_facing(-found.out)[end]; 2])
            }
            (Other::Hull(hull), _) => self.vertex(hull.vertices(), found.out),
            (Other::Core(core), _) => self.vertex(core, found.out),
        }
    }

    fn vertex(&self, vertices: &[DVec3], out: DVec3) -> (Feature, [DVec3; 2]) {
        let lowest = self.lowest_vertex(vertices, out);
        (Feature::Vertex(lowest as u32), [vertices[lowest]; 2])
    }

    fn lowest_vertex(&self, vertices: &[DVec3], out: DVec3) -> usize {
        let lower = |low, vertex| if out.dot(vertices[vertex]) < out.dot(vertices[low]) { vertex } else { low };
        (0..vertices.len()).fold(0, lower)
    }
}

/// A rim as an edge, or a tip as a vertex.
fn rim_or_tip(rims: &Rims, end: usize) -> Feature {
    if rims.radii[end] == 0.0 { Feature::Vertex(4 * end as u32) } else { Feature::Edge(RIM + end as u32) }
}

/// Whether a line runs square to a unit vector, nearly.
fn is_level(line: [DVec3; 2], normal: DVec3) -> bool {
    let along = line[1] - line[0];
    normal.dot(along).abs() <= LEVEL * along.length()
}

/// The kind of a point: what is round touches a side or flat end on a face, a rim on an edge.
fn kind(of_a: Feature, of_b: Feature, radii: [f64; 2]) -> ContactKind {
    match kind_of(of_a, of_b, radii) {
        ContactKind::RoundVertex if of_b == Feature::Edge(SIDE) => ContactKind::RoundFace,
        kind => kind,
    }
}
