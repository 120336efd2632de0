//! The face (or segment) that faces a reference face, cut to the prism above it.
//!
//! ```text
//!          ______________            o  corner of the incident face: a vertex on the reference face
//!     ____/___o______    /           x  an incident edge over a reference edge: edges that cross
//!    |   /    :      x  /            v  corner of the reference face: a vertex below the incident face
//!    |  /_____:______:_/
//!    |________v______|   reference
//! ```
//!
//! Sutherland and Hodgman (1974), side by side of the reference face, with a memory of what made each corner and each edge.

use glam::DVec3;
use smallvec::SmallVec;
use tumble_shape::ConvexHull;
use tumble_shape::spatial::{Face, Side};

use super::place::Place;

/// Share of a side's length by which a corner may lie beyond it and still count as on it [1].
///
/// Boxes of one width stacked exactly have corners right above each other; rounding must not change which corner makes the point.
const SNAP: f64 = 1e-9;

/// What made a corner of the cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// A vertex of the incident shape.
    Incident(u32),
    /// A vertex of the reference shape.
    Reference(u32),
    /// An edge of the incident shape over one of the reference shape.
    Crossing { incident: u32, reference: u32 },
}

/// A corner of the cut, in the frame of the reference shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct CutPoint {
    /// On the incident core [m].
    pub(super) place: DVec3,
    /// Height above the reference face [m].
    pub(super) height: f64,
    pub(super) source: Source,
}

/// Corners of the cut, counter-clockwise about the incident face.
pub(super) type Cut = SmallVec<[CutPoint; 8]>;

/// What an edge of the polygon under way lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    IncidentEdge(u32),
    /// Number of the side of the reference face.
    ReferenceSide(usize),
}

/// A corner and the edge that begins there.
#[derive(Clone, Copy, Debug)]
struct Corner {
    place: DVec3,
    source: Source,
    on: On,
    /// How far it is beyond the side at hand [m].
    beyond: f64,
}

type Polygon = SmallVec<[Corner; 10]>;

/// Cuts a face of another hull, whose frame stands in the reference hull's, to the prism above a face.
pub(super) fn polygon(reference: &ConvexHull, face: &Face, incident: &ConvexHull, facing: &Face, place: &Place) -> Cut {
    let corners = incident.sides(facing).iter().map(|side| Corner {
        place: place.point(incident.vertices()[side.vertex as usize]),
        source: Source::Incident(side.vertex),
        on: On::IncidentEdge(side.edge),
        beyond: 0.0,
    });
    let mut polygon: Polygon = corners.collect();
    let sides = reference.sides(face);
    for (k, side) in sides.iter().enumerate() {
        let end = sides[if k + 1 == sides.len() { 0 } else { k + 1 }].vertex;
        let vertices = reference.vertices();
        let snap = SNAP * (vertices[end as usize] - vertices[side.vertex as usize]).abs().max_element();
        for corner in &mut polygon {
            corner.beyond = side.outward.dot(corner.place) - side.offset;
        }
        // Often nothing is to be cut off.
        if polygon.iter().all(|corner| corner.beyond <= snap) {
            continue;
        }
        let mut kept = Polygon::new();
        let Some(mut from) = polygon.last() else { break };
        for to in &polygon {
            let (from_beyond, to_beyond) = (from.beyond, to.beyond);
            let crossing = || {
                let share = from_beyond / (from_beyond - to_beyond);
                let source = match from.on {
                    On::IncidentEdge(incident) => Source::Crossing { incident, reference: side.edge },
                    // Two sides of the reference face meet at a corner of it: at the start of the later one, but for the last and first.
                    On::ReferenceSide(first) if k - first == 1 || first != 0 => Source::Reference(side.vertex),
                    On::ReferenceSide(_) => Source::Reference(end),
                };
                (from.place + (to.place - from.place) * share, source)
            };
            if from_beyond <= snap && to_beyond > snap {
                // Leaves; a corner on the border is itself the place where it does.
                if from_beyond < -snap {
                    let (place, source) = crossing();
                    kept.push(Corner { place, source, on: On::ReferenceSide(k), beyond: 0.0 });
                } else if let Some(last) = kept.last_mut() {
                    last.on = On::ReferenceSide(k);
                }
            } else if from_beyond > snap && to_beyond < -snap {
                let (place, source) = crossing();
                kept.push(Corner { place, source, on: from.on, beyond: 0.0 });
            }
            if to_beyond <= snap {
                kept.push(*to);
            }
            from = to;
        }
        // The first corner of the list was last as well: where the border was left there, the edge on it is known only now.
        if from.beyond.abs() <= snap
            && polygon[0].beyond > snap
            && let Some(last) = kept.last_mut()
        {
            last.on = On::ReferenceSide(k);
        }
        polygon = kept;
        if polygon.is_empty() {
            break;
        }
    }
    polygon
        .into_iter()
        .map(|Corner { place, source, .. }| CutPoint { place, height: face.normal.dot(place) - face.offset, source })
        .collect()
}

/// The same corners of a cut as before, in the present poses, into an empty one; `None` if one of them is no corner of the cut any more.
///
/// A corner of the cut can only appear where another one stops to be one, so that a cut whose corners all stay has no new ones.
pub(super) fn again(
    reference: &ConvexHull,
    face: &Face,
    incident: &ConvexHull,
    facing: &Face,
    place: &Place,
    sources: &[Source],
    cut: &mut Cut,
) -> Option<()> {
    let sides = reference.sides(face);
    let snap = SNAP * reference.inner_radius();
    let beyond = |side: &Side, place: DVec3| side.outward.dot(place) - side.offset;
    let vertex = |i: u32| incident.vertices().get(i as usize).map(|&vertex| place.point(vertex));
    for &source in sources {
        let place = match source {
            Source::Incident(i) => {
                let place = vertex(i)?;
                sides.iter().all(|side| beyond(side, place) <= snap).then_some(place)?
            }
            Source::Crossing { incident: edge, reference: side } => {
                let [from, to] = incident.edges().get(edge as usize)?.vertices.map(vertex);
                let (from, to) = (from?, to?);
                let crossed = sides.iter().find(|other| other.edge == side)?;
                let (start, end) = (beyond(crossed, from), beyond(crossed, to));
                if start * end >= 0.0 {
                    return None;
                }
                let place = from + (to - from) * (start / (start - end));
                let inside = |other: &Side| other.edge == side || beyond(other, place) <= snap;
                sides.iter().all(inside).then_some(place)?
            }
            Source::Reference(i) => {
                // Up from the corner to the plane of the incident face.
                let corner = *reference.vertices().get(i as usize)?;
                let own = place.unturned(corner - place.origin);
                let up = place.unturned(face.normal);
                let own = own + up * ((facing.offset - facing.normal.dot(own)) / facing.normal.dot(up));
                let inside = |side: &Side| beyond(side, own) <= snap;
                incident.sides(facing).iter().all(inside).then_some(place.point(own))?
            }
        };
        cut.push(CutPoint { place, height: face.normal.dot(place) - face.offset, source });
    }
    Some(())
}

/// Cuts a segment, given in the frame of the reference hull, to the prism above a face; its ends are vertices 0 and 1 of edge 0.
pub(super) fn segment(reference: &ConvexHull, face: &Face, ends: [DVec3; 2]) -> Cut {
    let along = ends[1] - ends[0];
    let length = along.length();
    // Shares of the way between the ends, and the side that cuts there.
    let (mut start, mut end) = ((0.0, None), (1.0, None));
    for side in reference.sides(face) {
        let (beyond, slope) = (side.outward.dot(ends[0]) - side.offset, side.outward.dot(along));
        if slope.abs() <= SNAP * length {
            if beyond > SNAP * length {
                return Cut::new();
            }
            continue;
        }
        let share = -beyond / slope;
        if slope < 0.0 && share > start.0 + SNAP {
            start = (share, Some(side.edge));
        } else if slope > 0.0 && share < end.0 - SNAP {
            end = (share, Some(side.edge));
        }
    }
    if start.0 > end.0 + SNAP {
        return Cut::new();
    }
    let point = |(share, edge): (f64, Option<u32>), vertex: u32| {
        let place = ends[0] + along * share;
        let crossing = |reference| Source::Crossing { incident: 0, reference };
        let source = edge.map_or(Source::Incident(vertex), crossing);
        CutPoint { place, height: face.normal.dot(place) - face.offset, source }
    };
    Cut::from_slice(&[point(start, 0), point(end, 1)])
}

/// Cuts a single point to the prism above a face: it is vertex 0.
pub(super) fn point(reference: &ConvexHull, face: &Face, place: DVec3) -> Cut {
    let inside = |side: &Side| side.outward.dot(place) - side.offset <= 0.0;
    let point = CutPoint { place, height: face.normal.dot(place) - face.offset, source: Source::Incident(0) };
    if reference.sides(face).iter().all(inside) { Cut::from_slice(&[point]) } else { Cut::new() }
}
