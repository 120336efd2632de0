//! Surfaces by pair of materials.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use tumble_solver::Surface;

use crate::part::MaterialId;

/// Materials by name, and the surface that each pair of them makes.
///
/// The first material, `default`, is frictionless and does not bounce until it is [set](Materials::set).
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Materials {
    own: Vec<(String, Surface)>,
    pairs: BTreeMap<(MaterialId, MaterialId), Surface>,
}

impl Default for Materials {
    fn default() -> Self {
        Self { own: vec![("default".to_owned(), Surface::default())], pairs: BTreeMap::new() }
    }
}

impl Materials {
    /// Sets the surface that a material makes with itself, adding the material when it is new.
    pub fn set(&mut self, name: &str, surface: Surface) -> MaterialId {
        match self.find(name) {
            Some(id) => {
                self.own[id.0 as usize].1 = surface;
                id
            }
            None => {
                self.own.push((name.to_owned(), surface));
                MaterialId((self.own.len() - 1) as u16)
            }
        }
    }

    /// Sets the surface of a pair, in either order.
    pub fn set_pair(&mut self, one: MaterialId, other: MaterialId, surface: Surface) {
        self.pairs.insert((one.min(other), one.max(other)), surface);
    }

    /// The material of a name.
    pub fn find(&self, name: &str) -> Option<MaterialId> {
        self.own.iter().position(|(known, _)| known == name).map(|index| MaterialId(index as u16))
    }

    /// The name of a material.
    pub fn name(&self, id: MaterialId) -> &str {
        &self.own[id.0 as usize].0
    }

    /// All materials with the surface that each makes with itself.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Surface)> {
        self.own.iter().map(|(name, surface)| (name.as_str(), *surface))
    }

    /// All pairs that were set.
    pub fn pairs(&self) -> impl Iterator<Item = (MaterialId, MaterialId, Surface)> {
        self.pairs.iter().map(|(&(one, other), &surface)| (one, other, surface))
    }

    /// The surface of a pair; for pairs not set, the geometric mean of the frictions and the larger restitution.
    pub fn surface(&self, one: MaterialId, other: MaterialId) -> Surface {
        let combined = || {
            let (a, b) = (self.own[one.0 as usize].1, self.own[other.0 as usize].1);
            if one == other {
                return a;
            }
            Surface {
                static_friction: (a.static_friction * b.static_friction).sqrt(),
                kinetic_friction: (a.kinetic_friction * b.kinetic_friction).sqrt(),
                restitution: a.restitution.max(b.restitution),
            }
        };
        self.pairs.get(&(one.min(other), one.max(other))).copied().unwrap_or_else(combined)
    }
}
