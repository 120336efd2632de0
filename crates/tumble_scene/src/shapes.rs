//! From parts to shapes and mass.

use glam::DVec2;
use tumble_math::Planar;
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, MassProperties, PlanarShape, Rod, ShapeError};

use crate::format::{BodyEntry, Part};

/// The shape of a part in the design frame; `None` for a list, which stands for several.
pub fn planar_shape(part: &Part) -> Result<Option<PlanarShape>, ShapeError> {
    Ok(Some(match part {
        Part::Rod(rod) => Rod::try_new(rod.from, rod.to, rod.radius)?.into(),
        Part::Disc(disc) => Disc::try_new(disc.at, disc.radius)?.into(),
        Part::Polygon(polygon) => ConvexPolygon::try_new(polygon.points.clone())?.into(),
        Part::Box(part) => ConvexPolygon::rectangle(part.at, part.size * 0.5, part.angle_degrees.to_radians())?.into(),
        Part::HalfPlane(plane) => HalfPlane::try_new(plane.normal, plane.offset)?.into(),
        Part::List(_) => return Ok(None),
    }))
}

/// Mass, centre of mass and inertia of a part in the design frame; `None` for half-planes, lists and parts without a proper shape.
pub fn part_mass(part: &Part) -> Option<MassProperties<Planar>> {
    let shape = planar_shape(part).ok()??;
    match part.density_and_mass() {
        (_, Some(mass)) => shape.mass_properties_of_mass(mass),
        (density, None) => shape.mass_properties(density.unwrap_or(1.0)),
    }
}

/// Mass, centre of mass and inertia of a body in the design frame, from its parts (lists filled in) and what it overrides.
///
/// An overridden mass scales the inertia of the parts with it; an overridden centre leaves the inertia as it is. `None` if there is
/// neither a part with mass nor an override of both mass and inertia.
pub fn body_mass(body: &BodyEntry, parts: &[Part]) -> Option<MassProperties<Planar>> {
    let masses: Vec<MassProperties<Planar>> = parts.iter().filter_map(part_mass).collect();
    let mut total = match (MassProperties::combine(masses), body.mass, body.inertia) {
        (Some(total), ..) => total,
        (None, Some(mass), Some(inertia)) => MassProperties { mass, centre: DVec2::ZERO, inertia },
        _ => return None,
    };
    if let Some(mass) = body.mass {
        total = MassProperties { mass, ..total.scaled(mass / total.mass) };
    }
    total.inertia = body.inertia.unwrap_or(total.inertia);
    total.centre = body.centre.unwrap_or(total.centre);
    Some(total)
}
