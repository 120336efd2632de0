//! The table of bodies: every body in the order of its id, so that the order of spawning touches no arithmetic.

use std::collections::HashMap;

use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;
use tumble_math::{Inertia, Linear, Rotation};
use tumble_shape::MassProperties;

use super::mass::{
    BodyInertia, CentreOverride, InertiaOverride, InverseInertia, InverseMass, LockedAxes, Mass, MassOverride, Pinned,
    inverse_mass,
};
use super::{AngularVelocity, BodyId, BodyKind, LinearVelocity, Orientation, Position};
use crate::error::BodyError;
use crate::geometry::Geometry;
use crate::part::{Amount, Part, Parts};

/// Rank of a body in the [`BodyTable`].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BodyIndex(pub u32);

/// One body of the table.
#[derive(Clone, Debug)]
pub struct BodyEntry {
    /// Its entity.
    pub entity: Entity,
    /// Its identity.
    pub id: BodyId,
    /// Its name; `body-<id>` where none was given.
    pub name: String,
    /// What moves it.
    pub kind: BodyKind,
}

/// All bodies, in the order of their ids.
#[derive(Resource, Clone, Debug, Default)]
pub struct BodyTable {
    entries: Vec<BodyEntry>,
    by_name: HashMap<String, u32>,
}

impl BodyTable {
    /// All bodies, in the order of their ids.
    pub fn entries(&self) -> &[BodyEntry] {
        &self.entries
    }

    /// Rank of the body with a name.
    pub fn index_of(&self, name: &str) -> Option<u32> {
        self.by_name.get(name).copied()
    }

    /// The body of a rank.
    pub fn entry(&self, index: u32) -> &BodyEntry {
        &self.entries[index as usize]
    }
}

/// Where the frame in which the parts are written lies in the body frame, whose origin is the centre of mass [m].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PartFrame<V: Send + Sync + 'static>(pub V);

/// Gives every body an id, a place in the table, and mass from its parts.
pub(crate) fn prepare_bodies<D: Geometry>(world: &mut World) -> Result<(), BodyError> {
    assign_ids::<D>(world);
    let table = build_table::<D>(world)?;
    for (index, entry) in table.entries.iter().enumerate() {
        prepare_mass::<D>(world, entry)?;
        world.entity_mut(entry.entity).insert(BodyIndex(index as u32));
    }
    world.insert_resource(table);
    Ok(())
}

fn assign_ids<D: Geometry>(world: &mut World) {
    let mut taken = world.query_filtered::<&BodyId, With<Position<D::Vector>>>();
    let next = taken.iter(world).map(|id| id.0 + 1).max().unwrap_or(0);
    let mut nameless = world.query_filtered::<Entity, (With<Position<D::Vector>>, Without<BodyId>)>();
    let nameless: Vec<Entity> = nameless.iter(world).collect();
    for (id, entity) in (next..).zip(nameless) {
        world.entity_mut(entity).insert(BodyId(id));
    }
}

fn build_table<D: Geometry>(world: &mut World) -> Result<BodyTable, BodyError> {
    let mut bodies = world.query_filtered::<(Entity, &BodyId, &BodyKind, Option<&Name>), With<Position<D::Vector>>>();
    let mut entries: Vec<BodyEntry> = bodies
        .iter(world)
        .map(|(entity, id, kind, name)| {
            let name = name.map_or_else(|| format!("body-{}", id.0), |name| name.as_str().to_owned());
            BodyEntry { entity, id: *id, name, kind: *kind }
        })
        .collect();
    entries.sort_by_key(|entry| entry.id);
    if let Some(pair) = entries.windows(2).find(|pair| pair[0].id == pair[1].id) {
        let (first, second) = (pair[0].name.clone(), pair[1].name.clone());
        return Err(BodyError::SameId { first, second, id: pair[0].id.0 });
    }
    let mut by_name = HashMap::with_capacity(entries.len());
    for (index, entry) in entries.iter().enumerate() {
        if by_name.insert(entry.name.clone(), index as u32).is_some() {
            return Err(BodyError::SameName { name: entry.name.clone() });
        }
    }
    Ok(BodyTable { entries, by_name })
}

/// Mass properties given outright.
struct Given<D: Geometry> {
    mass: Option<f64>,
    centre: Option<D::Vector>,
    inertia: Option<D::Inertia>,
}

/// Mass from the parts (R4, R5) or as given, and the move from the parts' frame to the centre of mass.
fn prepare_mass<D: Geometry>(world: &mut World, entry: &BodyEntry) -> Result<(), BodyError> {
    let body = world.entity(entry.entity);
    let given = Given::<D> {
        mass: body.get::<MassOverride>().map(|mass| mass.0),
        centre: body.get::<CentreOverride<D::Vector>>().map(|centre| centre.0),
        inertia: body.get::<InertiaOverride<D::Inertia>>().map(|inertia| inertia.0),
    };
    let pinned = body.get::<Pinned>().copied();
    let locked = body.get::<LockedAxes<D::Vector>>().copied();
    check_given::<D>(&given, &entry.name)?;

    let properties = if entry.kind == BodyKind::Dynamic {
        dynamic_mass::<D>(world, entry, &given)?
    } else {
        // Bodies that forces do not move keep the frame in which their parts are written.
        let centre = given.centre.unwrap_or(D::Vector::ZERO);
        MassProperties { mass: 0.0, centre, inertia: D::Inertia::ZERO }
    };
    let (inverse_mass, inverse_inertia) =
        inverse_mass::<D>(entry.kind, properties.mass, &properties.inertia, pinned.as_ref(), locked.as_ref());
    let turns = locked.is_none_or(|locked| locked.rotation == super::Lock::Free) && pinned.is_none();
    if entry.kind == BodyKind::Dynamic && turns && inverse_inertia == D::Inertia::ZERO {
        return Err(BodyError::NoInertia { body: entry.name.clone() });
    }

    let mut body = world.entity_mut(entry.entity);
    let origin = -properties.centre;
    let old_origin = body.get::<PartFrame<D::Vector>>().map_or(D::Vector::ZERO, |frame| frame.0);
    if origin != old_origin {
        let shift = body.get::<Orientation<D::Rotation>>().map(|rotation| rotation.0.rotate(old_origin - origin));
        if let (Some(shift), Some(mut position)) = (shift, body.get_mut::<Position<D::Vector>>()) {
            position.0 += shift;
        }
    }
    if entry.kind == BodyKind::Static {
        body.insert((LinearVelocity(D::Vector::ZERO), AngularVelocity(D::Angular::ZERO)));
    }
    body.insert((
        PartFrame(origin),
        Mass(properties.mass),
        BodyInertia(properties.inertia),
        InverseMass(inverse_mass),
        InverseInertia(inverse_inertia),
    ));
    Ok(())
}

fn dynamic_mass<D: Geometry>(
    world: &World,
    entry: &BodyEntry,
    given: &Given<D>,
) -> Result<MassProperties<D>, BodyError> {
    let mut of_parts = Vec::new();
    let parts = world.get::<Parts>(entry.entity).into_iter().flat_map(|parts| parts.iter());
    for part in parts.filter_map(|part| world.get::<Part<D>>(part)) {
        let (Amount::Density(value) | Amount::Mass(value)) = part.amount;
        if !value.is_finite() || value < 0.0 {
            return Err(BodyError::NotPositive { body: entry.name.clone(), quantity: "density of a part", value });
        }
        let Some(properties) = D::mass_properties(&part.shape, part.amount) else {
            return Err(BodyError::Unbounded { body: entry.name.clone() });
        };
        of_parts.push(properties);
    }
    let summed = MassProperties::<D>::combine(of_parts);
    let no_mass = || BodyError::NoMass { body: entry.name.clone() };
    let mass = given.mass.or(summed.map(|sum| sum.mass)).ok_or_else(no_mass)?;
    let centre = given.centre.or(summed.map(|sum| sum.centre)).unwrap_or(D::Vector::ZERO);
    // A mass given outright rescales the parts' inertia; a centre given outright leaves it, about that centre.
    let of_parts = summed.map(|sum| sum.inertia.scaled(mass / sum.mass));
    let inertia = given.inertia.or(of_parts).unwrap_or(D::Inertia::ZERO);
    Ok(MassProperties { mass, centre, inertia })
}

fn check_given<D: Geometry>(given: &Given<D>, name: &str) -> Result<(), BodyError> {
    if let Some(mass) = given.mass.filter(|mass| !(*mass > 0.0 && mass.is_finite())) {
        return Err(BodyError::NotPositive { body: name.to_owned(), quantity: "mass", value: mass });
    }
    if given.inertia.is_some_and(|inertia| inertia.try_inverse().is_none()) {
        return Err(BodyError::NoInertia { body: name.to_owned() });
    }
    Ok(())
}
