//! From parts to shapes and mass.

use tumble_math::Linear;
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, MassProperties, PlanarShape, Rod, ShapeError};
use tumble_sim::Amount;

use crate::dim::SceneDim;
use crate::format::{BodyEntry, Part, PartEntry};

/// The shape of a part of the plane in the design frame; `None` for a list, which stands for several.
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

/// Mass, centre of mass and inertia of a part in the design frame; `None` for ground, lists and parts without a proper shape.
pub fn part_mass<D: SceneDim>(part: &D::Part) -> Option<MassProperties<D>> {
    let shapes = D::shapes(part).ok()?;
    D::mass_properties(shapes.first()?, amount(part))
}

/// How much of a part there is.
pub(crate) fn amount(part: &impl PartEntry) -> Amount {
    match part.shared().density_and_mass {
        (_, Some(mass)) => Amount::Mass(mass),
        (density, None) => Amount::Density(density.unwrap_or(1.0)),
    }
}

/// Mass, centre of mass and inertia of a body in the design frame, from its parts (lists filled in) and what it overrides.
///
/// An overridden mass scales the inertia of the parts with it; an overridden centre leaves the inertia as it is. `None` if there is
/// neither a part with mass nor an override of both mass and inertia.
pub fn body_mass<D: SceneDim>(body: &BodyEntry<D>, parts: &[D::Part]) -> Option<MassProperties<D>> {
    let masses: Vec<MassProperties<D>> = parts.iter().filter_map(part_mass::<D>).collect();
    let inertia = body.inertia.as_ref().map(D::inertia);
    let mut total = match (MassProperties::combine(masses), body.mass, inertia) {
        (Some(total), ..) => total,
        (None, Some(mass), Some(inertia)) => MassProperties { mass, centre: D::Vector::ZERO, inertia },
        _ => return None,
    };
    if let Some(mass) = body.mass {
        total = MassProperties { mass, ..total.scaled(mass / total.mass) };
    }
    total.inertia = inertia.unwrap_or(total.inertia);
    total.centre = body.centre.unwrap_or(total.centre);
    Some(total)
}
