//! What lies on a face or on a flat end.
//!
//! ```text
//!       .-c---.          c  corner of the polygon over the disc
//!     .'  |    '.        x  side of the polygon across the rim
//!    o    |     o        o  place on the rim over the polygon: four of them, a quarter of a turn apart, the first one downhill
//!    |    |_____x__         (of a disc that lies flat, where they are on the body: they do not wander with rounding)
//!     '.      .'
//!       '-o--'
//! ```

use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use tumble_shape::ConvexHull;

use super::{Meeting, Other, RIM, Rims};
use crate::manifold::{ContactKind, FeatureId, SpatialManifold};
use crate::narrow::spatial::cut::{self, Cut, CutPoint, Source};
use crate::narrow::spatial::draft::{Draft, Feature, Owner, feature_id, vertex_id};
use crate::narrow::spatial::{face, reduce};

/// Share of the radius by which a place may be beyond an outline and still count as on it [1].
const SNAP: f64 = 1e-9;

/// Cosine of the steepest slope at which a face still counts as lying over a flat end; of steeper ones only corners count [1].
const STEEP: f64 = 1e-3;

/// A point on the incident surface.
#[derive(Clone, Copy)]
struct Spot {
    place: DVec3,
    height: f64,
    feature: FeatureId,
    kind: ContactKind,
}

type Spots = SmallVec<[Spot; 16]>;

/// A corner of a polygon, and the edge that begins there.
#[derive(Clone, Copy)]
struct Corner {
    place: DVec3,
    vertex: u32,
    edge: u32,
}

type Polygon = SmallVec<[Corner; 8]>;

/// Contact points on a face of hull a, but those below a height [m].
pub(super) fn on_face(meeting: &Meeting, hull: &ConvexHull, number: usize, deepest: f64) -> SpatialManifold {
    let (face, rims) = (&hull.faces()[number], meeting.rims);
    let height = |place: DVec3| face.normal.dot(place) - face.offset;
    let mut spots: Spots = match rims.end_facing(-face.normal) {
        Some(end) => {
            let polygon = corners(hull, number);
            let mut spots = disc_and_polygon(meeting, rims, end, &polygon, face.normal, Owner::B, None);
            spots.iter_mut().for_each(|spot| spot.height = height(spot.place));
            spots
        }
        None => {
            let line = rims.line_facing(-face.normal);
            cut::segment(hull, face, line)
                .iter()
                .map(|point| {
                    let (feature, kind) = match point.source {
                        Source::Crossing { reference, .. } => {
                            (feature_id(Feature::Edge(reference), Feature::Edge(super::SIDE)), ContactKind::EdgeEdge)
                        }
                        Source::Incident(end) | Source::Reference(end) => {
                            (vertex_id(Owner::B, 4 * end), ContactKind::VertexFace)
                        }
                    };
                    Spot { place: point.place, height: point.height, feature, kind }
                })
                .collect()
        }
    };
    spots.retain(|spot| spot.height >= deepest);
    manifold(meeting, Owner::A, face.normal, spots)
}

/// Contact points on a flat end of either shape.
pub(super) fn on_end(meeting: &Meeting, rims: &Rims, end: usize, owner: Owner) -> SpatialManifold {
    let (normal, centre, radius) = (rims.end_normal(end), rims.ends[end], rims.radii[end]);
    let height = |place: DVec3| normal.dot(place - centre);
    let incident = match owner {
        Owner::A => Other::Rims(meeting.rims),
        Owner::B => meeting.other,
    };
    let spots = match incident {
        Other::Hull(hull) => {
            let over = |number: usize| {
                let face = &hull.faces()[number];
                let slope = face.normal.dot(normal);
                let up = |place: DVec3| place + normal * ((face.offset - face.normal.dot(place)) / slope);
                let polygon = corners(hull, number);
                let mut spots = disc_and_polygon(meeting, rims, end, &polygon, normal, owner, Some(&up));
                if slope.abs() < STEEP {
                    let of_other = vertex_id(owner.other(), 0).corner();
                    spots.retain(|spot| spot.feature.corner() == of_other);
                }
                spots.iter_mut().for_each(|spot| spot.height = height(spot.place));
                spots
            };
            let squarest = over(face::facing(hull, normal));
            let lowest = over(face::facing_at_lowest(hull, normal).0);
            let low = |spots: &Spots| spots.iter().map(|spot| spot.height).fold(f64::INFINITY, f64::min);
            // The squarest face need not have the lowest corner.
            if low(&lowest) < low(&squarest) - meeting.pair.rounding() { lowest } else { squarest }
        }
        Other::Core(core) => {
            let ends = [core[0], core[core.len() - 1]];
            line_over_disc(ends, centre, normal, radius, core.len())
                .into_iter()
                .map(|(place, at)| {
                    let feature = match at {
                        At::End(end) => vertex_id(owner.other(), end),
                        At::Rim(which) => {
                            let rim = Feature::Edge(rim_crossing(end, which));
                            ordered(owner, rim, Feature::Edge(0))
                        }
                    };
                    Spot { place, height: height(place), feature, kind: kind(at) }
                })
                .collect()
        }
        Other::Rims(incident) => over_end(meeting, rims, end, owner, incident),
    };
    manifold(meeting, owner, normal, spots)
}

/// What of other rims lies over a flat end.
fn over_end(meeting: &Meeting, rims: &Rims, end: usize, owner: Owner, incident: &Rims) -> Spots {
    let (normal, centre, radius) = (rims.end_normal(end), rims.ends[end], rims.radii[end]);
    let height = |place: DVec3| normal.dot(place - centre);
    let mut spots = Spots::new();
    let Some(facing) = incident.end_facing(-normal) else {
        let line = incident.line_facing(-normal);
        for (place, at) in line_over_disc(line, centre, normal, radius, 2) {
            let feature = match at {
                At::End(end) => vertex_id(owner.other(), 4 * end),
                At::Rim(which) => ordered(owner, Feature::Edge(rim_crossing(end, which)), Feature::Edge(super::SIDE)),
            };
            spots.push(Spot { place, height: height(place), feature, kind: kind(at) });
        }
        return spots;
    };
    let flat = meeting.pair.preference();
    let snap = SNAP * (radius + incident.radii[facing]);
    let over = |place: DVec3| rims.axis.cross(place - centre).length() <= radius + snap;
    for (k, place) in places_on_rim(incident, facing, normal, flat).into_iter().enumerate() {
        if over(place) {
            let feature = vertex_id(owner.other(), (4 * facing + k) as u32);
            spots.push(Spot { place, height: height(place), feature, kind: ContactKind::VertexFace });
        }
    }
    let upright = incident.end_normal(facing);
    let up = |place: DVec3| place + normal * (upright.dot(incident.ends[facing] - place) / upright.dot(normal));
    let over_incident = |place: DVec3| place.distance(incident.ends[facing]) <= incident.radii[facing] + snap;
    let places = places_on_rim(rims, end, incident.end_normal(facing), flat).map(up);
    for (k, place) in places.into_iter().enumerate().filter(|(_, place)| over_incident(*place)) {
        // Right above one of the other's places it would say the same again.
        if spots.iter().all(|spot| spot.place.distance(place) > snap) {
            let feature = vertex_id(owner, (4 * end + k) as u32);
            spots.push(Spot { place, height: height(place), feature, kind: ContactKind::VertexFace });
        }
    }
    for (which, place) in crossings(centre, radius, incident.ends[facing], incident.radii[facing], normal) {
        // On the incident rim, whatever its slope.
        let out = incident.radial(up(place) - incident.ends[facing]);
        let place = incident.ends[facing] + out * incident.radii[facing];
        let (own, its) = (Feature::Edge(rim_crossing(end, which)), Feature::Edge(rim_crossing(facing, which)));
        spots.push(Spot {
            place,
            height: height(place),
            feature: ordered(owner, own, its),
            kind: ContactKind::EdgeEdge,
        });
    }
    spots
}

/// Where two circles cross, seen along the normal of the first: two places on the first, or none [m].
///
/// The second one is taken as a circle, which is true to the square of the angle between the two.
fn crossings(
    centre: DVec3,
    radius: f64,
    other: DVec3,
    other_radius: f64,
    normal: DVec3,
) -> SmallVec<[(u32, DVec3); 2]> {
    let flat = other - centre - normal * normal.dot(other - centre);
    let distance = flat.length();
    if distance >= radius + other_radius || distance <= (radius - other_radius).abs() {
        return SmallVec::new();
    }
    let along = 0.5 * (distance + (radius - other_radius) * (radius + other_radius) / distance);
    let aside = (radius * radius - along * along).max(0.0).sqrt();
    let (x_axis, y_axis) = (flat * (1.0 / distance), normal.cross(flat) * (1.0 / distance));
    let place = |side: f64| centre + x_axis * along + y_axis * (side * aside);
    SmallVec::from_buf([(0, place(-1.0)), (1, place(1.0))])
}

/// The corners of a face.
fn corners(hull: &ConvexHull, face: usize) -> Polygon {
    let sides = hull.sides(&hull.faces()[face]).iter();
    sides
        .map(|side| Corner { place: hull.vertices()[side.vertex as usize], vertex: side.vertex, edge: side.edge })
        .collect()
}

/// Four places on a rim, a quarter of a turn apart, the first one the lowest along a direction [m].
fn places_on_rim(rims: &Rims, end: usize, up: DVec3, flat: f64) -> [DVec3; 4] {
    let steepness = rims.axis.cross(up).length();
    let lies_flat = steepness * rims.radii[end] <= flat;
    let out = if lies_flat { rims.axis.any_orthonormal_vector() } else { -rims.radial(up) };
    let across = rims.axis.cross(out);
    [out, across, -out, -across].map(|arm| rims.ends[end] + arm * rims.radii[end])
}

/// The region that a disc and a polygon share, seen along a normal.
///
/// `owner` is whose disc it is; `up` brings a place on the disc to the polygon, where that is the incident one. Heights are left to the caller.
fn disc_and_polygon(
    meeting: &Meeting,
    rims: &Rims,
    end: usize,
    polygon: &Polygon,
    normal: DVec3,
    owner: Owner,
    up: Option<&dyn Fn(DVec3) -> DVec3>,
) -> Spots {
    let (centre, radius, upright) = (rims.ends[end], rims.radii[end], rims.end_normal(end));
    let snap = SNAP * radius;
    // Down (or up) along the normal onto the disc.
    let onto = |place: DVec3| place + normal * (upright.dot(centre - place) / upright.dot(normal));
    let flat: SmallVec<[DVec3; 8]> = polygon.iter().map(|corner| onto(corner.place)).collect();
    let count = flat.len();
    let area: DVec3 =
        (0..count).map(|i| flat[i].cross(flat[(i + 1) % count])).fold(DVec3::ZERO, |sum, part| sum + part);
    let inwards = upright * if area.dot(upright) < 0.0 { -1.0 } else { 1.0 };
    let mut spots = Spots::new();
    let mut push = |place: DVec3, feature: FeatureId, kind: ContactKind| {
        spots.push(Spot { place, height: 0.0, feature, kind });
    };
    let lift = |place: DVec3| up.map_or(place, |up| up(place));
    for (k, place) in places_on_rim(rims, end, normal, meeting.pair.preference()).into_iter().enumerate() {
        let inside = (0..count).all(|i| {
            let side = flat[(i + 1) % count] - flat[i];
            inwards.cross(side).dot(place - flat[i]) >= -snap * side.length()
        });
        if inside {
            push(lift(place), vertex_id(owner, (4 * end + k) as u32), ContactKind::VertexFace);
        }
    }
    for (i, corner) in polygon.iter().enumerate() {
        if flat[i].distance(centre) <= radius + snap {
            let place = if up.is_some() { corner.place } else { flat[i] };
            push(place, vertex_id(owner.other(), corner.vertex), ContactKind::VertexFace);
        }
        let line = [flat[i], flat[(i + 1) % count]];
        for (which, share) in shares_on_rim(line, centre, radius).into_iter().enumerate() {
            if share > 0.0 && share < 1.0 {
                let rim = Feature::Edge(rim_crossing(end, which as u32));
                push(
                    lift(line[0].lerp(line[1], share)),
                    ordered(owner, rim, Feature::Edge(corner.edge)),
                    ContactKind::EdgeEdge,
                );
            }
        }
    }
    spots
}

/// Where a line enters and leaves a ball around the centre of a rim, as shares of the way from its first end; NaN if it does not [1].
fn shares_on_rim(line: [DVec3; 2], centre: DVec3, radius: f64) -> [f64; 2] {
    let (along, from) = (line[1] - line[0], line[0] - centre);
    let squared = along.length_squared();
    let middle = -along.dot(from) / squared;
    let aside = along.cross(from).length_squared() / squared;
    let half = ((radius * radius - aside) / squared).sqrt();
    [middle - half, middle + half]
}

/// Where a place on a line over a disc is.
#[derive(Clone, Copy)]
enum At {
    End(u32),
    /// Over the rim: 0 where the line comes in, 1 where it leaves.
    Rim(u32),
}

fn kind(at: At) -> ContactKind {
    match at {
        At::End(_) => ContactKind::VertexFace,
        At::Rim(_) => ContactKind::EdgeEdge,
    }
}

/// The part of a line (or point) over a disc.
fn line_over_disc(
    line: [DVec3; 2],
    centre: DVec3,
    normal: DVec3,
    radius: f64,
    ends: usize,
) -> SmallVec<[(DVec3, At); 2]> {
    let snap = SNAP * radius;
    let over = |place: DVec3| normal.cross(place - centre).length() <= radius + snap;
    let mut found = SmallVec::new();
    for (end, place) in line.into_iter().enumerate().take(ends).filter(|(_, place)| over(*place)) {
        found.push((place, At::End(end as u32)));
    }
    if ends == 2 && found.len() < 2 {
        let flat = line.map(|place| place - normal * normal.dot(place - centre));
        for (which, share) in shares_on_rim(flat, centre, radius).into_iter().enumerate() {
            if share > 0.0 && share < 1.0 && found.len() < 2 {
                found.push((line[0].lerp(line[1], share), At::Rim(which as u32)));
            }
        }
    }
    found
}

/// Number of a crossing of a rim, as an edge.
fn rim_crossing(end: usize, which: u32) -> u32 {
    RIM + 2 + 2 * end as u32 + which
}

/// The id of a feature of the owner and one of the other shape.
fn ordered(owner: Owner, own: Feature, its: Feature) -> FeatureId {
    if owner == Owner::A { feature_id(own, its) } else { feature_id(its, own) }
}

/// The manifold of spots above a reference surface of one shape, at most four.
fn manifold(meeting: &Meeting, owner: Owner, normal: DVec3, mut spots: Spots) -> SpatialManifold {
    let Meeting { pair, radius, .. } = meeting;
    spots.retain(|spot| spot.height - radius <= pair.query.margin);
    let middle = spots.iter().fold(DVec3::ZERO, |sum, spot| sum + spot.place) * (1.0 / spots.len().max(1) as f64);
    let x_axis = normal.any_orthonormal_vector();
    let y_axis = normal.cross(x_axis);
    let angle = |spot: &Spot| {
        let arm = DVec2::new(x_axis.dot(spot.place - middle), y_axis.dot(spot.place - middle));
        tumble_math::trig::atan2(arm.y, arm.x)
    };
    spots.sort_by(|one, two| angle(one).total_cmp(&angle(two)));
    let mut cut: Cut = (0..spots.len() as u32)
        .map(|i| {
            let Spot { place, height, .. } = spots[i as usize];
            CutPoint { place, height, source: Source::Incident(i) }
        })
        .collect();
    reduce::to_four(&mut cut, normal, pair.preference());
    let along = if owner == Owner::A { normal } else { -normal };
    let mut draft = Draft::new(&pair.a_in_world, along, pair.query.margin);
    for point in &cut {
        let Source::Incident(i) = point.source else { continue };
        let (spot, separation) = (&spots[i as usize], point.height - radius);
        let kind = if *radius > 0.0 { ContactKind::RoundFace } else { spot.kind };
        draft.push(point.place - normal * (radius + 0.5 * separation), separation, spot.feature, kind);
    }
    draft.finish()
}
