//! Materials, pairs of materials, and tables of both.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Coefficient;

/// A file of materials and pairs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialTable {
    /// Version of this format; 1 is the only one so far.
    pub format: u32,
    /// Where the figures come from. Default empty.
    #[serde(default)]
    pub about: String,
    /// Materials by name. A name that occurs in a pair is a material too.
    #[serde(default)]
    pub materials: BTreeMap<String, MaterialEntry>,
    /// Pairs of materials, in either order of the two names.
    #[serde(default)]
    pub pairs: Vec<PairEntry>,
}

/// What a material brings into pairs that no table lists.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialEntry {
    /// Coefficient of static friction μ_s [1]. Default the kinetic one, else that of the pair with itself, else 0.
    #[serde(default)]
    pub static_friction: Option<Coefficient>,
    /// Coefficient of kinetic friction μ_k [1]. Default the static one, else that of the pair with itself, else 0.
    #[serde(default)]
    pub kinetic_friction: Option<Coefficient>,
    /// Coefficient of restitution ε, from 0 to 1 [1]. Default 0.
    #[serde(default)]
    pub restitution: Option<f64>,
}

/// What happens between two materials.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairEntry {
    /// The two materials, in any order.
    pub between: (String, String),
    /// Friction of dry surfaces.
    #[serde(default)]
    pub dry: FrictionEntry,
    /// Friction of lubricated surfaces. If only one of the two states is given it stands for the other, with a notice.
    #[serde(default)]
    pub lubricated: FrictionEntry,
    /// Coefficient of restitution ε, from 0 to 1 [1]. Default the larger of the two materials'.
    #[serde(default)]
    pub restitution: Option<f64>,
}

/// Coulomb's two coefficients. If one is absent it takes the other, with a notice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionEntry {
    /// Coefficient of static friction μ_s [1].
    #[serde(default)]
    pub static_friction: Option<Coefficient>,
    /// Coefficient of kinetic friction μ_k [1].
    #[serde(default)]
    pub kinetic_friction: Option<Coefficient>,
    /// A remark, such as "wet". Default empty.
    #[serde(default)]
    pub note: String,
}

/// State of the surfaces that touch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Surface {
    /// Clean and dry.
    #[default]
    Dry,
    /// Lubricated or wet.
    Lubricated,
}

/// Which figure of a range is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Take {
    /// Its lower end.
    Low,
    /// Its middle.
    #[default]
    Midpoint,
    /// Its upper end.
    High,
}
