//! Bodies: what they are made of, where they start, how they may move.

use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use tumble_math::{Linear, Planar};

use super::scene::one;
use super::{Dialect, OrientationEntry};

/// One body, or with `repeat` a family of equal bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct BodyEntry<D: Dialect = Planar> {
    /// Name of the body, unique in the scene; its rank among all names is the body's id.
    pub name: String,
    /// What moves it. Default Dynamic.
    #[serde(default)]
    pub kind: BodyKind,
    /// Where the origin of the design frame is in the world [m]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::VectorText")]
    pub at: D::Vector,
    /// Angle of the design frame, counter-clockwise [degrees]; in the plane. Default 0.
    #[serde(default)]
    pub angle_degrees: D::InPlane<f64>,
    /// How the design frame is turned; in space. Default not at all.
    #[serde(default)]
    pub orientation: D::InSpace<Option<OrientationEntry>>,
    /// Velocity of the centre of mass at the start, world axes [m/s]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::VectorText")]
    pub velocity: D::Vector,
    /// Rate of turn at the start, counter-clockwise in the plane, world axes in space [rad/s]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::AngularText")]
    pub angular_velocity: D::Angular,
    /// Shapes attached rigidly to each other, in the design frame.
    pub parts: Vec<D::Part>,
    /// Material of the parts that name none. Default "default", which is frictionless and does not bounce unless the scene defines it.
    #[serde(default)]
    pub material: Option<String>,
    /// Mass instead of the sum over the parts [kg]; must be positive.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Centre of mass in the design frame instead of that of the parts [m].
    #[serde(default)]
    #[schemars(with = "Option<D::VectorText>")]
    pub centre: Option<D::Vector>,
    /// Inertia about the centre of mass instead of that of the parts [kg·m²]; must be positive.
    #[serde(default)]
    pub inertia: Option<D::InertiaEntry>,
    /// Share of gravity that acts on the body [1]. Default 1.
    #[serde(default = "one")]
    pub gravity_scale: f64,
    /// Resistance of the surrounding medium. Default none.
    #[serde(default)]
    pub drag: Drag,
    /// Whether the body neither moves nor turns, like an infinite mass. Default false.
    #[serde(default)]
    pub pinned: bool,
    /// Axes along which the body never moves. Default none.
    #[serde(default)]
    pub locked: Vec<Axis>,
    /// Poses that a kinematic body passes through, in rising order of time; linear in between, held outside. Default none.
    #[serde(default)]
    pub keyframes: Vec<Keyframe<D>>,
    /// Names of bodies that this one passes through. The name of a repeated body means all of its copies. Default none.
    #[serde(default)]
    pub ignores: Vec<String>,
    /// Collision groups the body belongs to, by name or as bits. Default all.
    #[serde(default)]
    pub groups: Groups,
    /// Collision groups the body collides with; two bodies collide if each is in the other's list. Default all.
    #[serde(default)]
    pub collides_with: Groups,
    /// Makes many bodies of this one. Default none.
    #[serde(default)]
    pub repeat: Option<Repeat<D>>,
}

/// What moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum BodyKind {
    /// Moved by forces and contacts.
    #[default]
    Dynamic,
    /// Moved by its velocity or keyframes, whatever pushes against it.
    Kinematic,
    /// Never moves.
    Static,
}

/// An axis of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z, in space.
    Z,
    /// Turning, about every axis.
    Angle,
}

impl Axis {
    /// The axes of translation.
    pub const ALONG: [Self; 3] = [Self::X, Self::Y, Self::Z];
}

/// Resistance of the surrounding medium: F = −(linear + quadratic |v|) v, τ = −turning ω.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// Force per speed [N·s/m]. Default 0.
    #[serde(default)]
    pub linear: f64,
    /// Force per speed squared [N·s²/m²]. Default 0.
    #[serde(default)]
    pub quadratic: f64,
    /// Torque per rate of turn [N·m·s]. Default 0.
    #[serde(default)]
    pub turning: f64,
}

/// A pose at a time. In space the body turns evenly about one axis from one to the next, the shorter way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct Keyframe<D: Dialect = Planar> {
    /// When [s].
    pub time: f64,
    /// Where the origin of the design frame is then [m].
    #[schemars(with = "D::VectorText")]
    pub at: D::Vector,
    /// Angle of the design frame then, counted over turns [degrees]; in the plane. Default 0.
    #[serde(default)]
    pub angle_degrees: D::InPlane<f64>,
    /// How the design frame is turned then; in space. Default not at all.
    #[serde(default)]
    pub orientation: D::InSpace<Option<OrientationEntry>>,
}

/// Many bodies from one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub enum Repeat<D: Dialect = Planar> {
    /// Columns along x and rows along y, named `crate-0-3`: column 0, row 3. In space also along z: `crate-0-3-1`.
    Grid(RepeatGrid<D>),
    /// A row of bodies, named `crate-7`.
    Line(RepeatLine<D>),
}

/// Columns and rows of copies, in space in layers; the first copy stands where the body was placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct RepeatGrid<D: Dialect = Planar> {
    /// Number of columns and of rows, in space of copies along x, y and z [1].
    pub count: D::Counts,
    /// Distance between columns, and between rows; in space between neighbours along x, y and z [m].
    #[schemars(with = "D::VectorText")]
    pub spacing: D::Vector,
    /// Random displacement of each copy. Default none.
    #[serde(default)]
    pub jitter: Jitter<D>,
}

/// A row of copies; the first copy stands where the body was placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct RepeatLine<D: Dialect = Planar> {
    /// Number of copies [1].
    pub count: u32,
    /// From one copy to the next [m].
    #[schemars(with = "D::VectorText")]
    pub spacing: D::Vector,
    /// Random displacement of each copy. Default none.
    #[serde(default)]
    pub jitter: Jitter<D>,
}

/// Random displacement, uniform in ± the given amounts, from the scene's seed and the copy's name alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub struct Jitter<D: Dialect = Planar> {
    /// Largest displacement along each axis [m]. Default 0.
    #[serde(default)]
    #[schemars(with = "D::VectorText")]
    pub at: D::Vector,
    /// Largest turn, in space the largest component of the rotation vector [degrees]. Default 0.
    #[serde(default)]
    pub angle_degrees: f64,
}

/// A set of collision groups: `["walls", "balls"]`, or bits such as `0b101`. A scene uses names or bits, not both.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Groups {
    /// Groups by name; at most 32 different names in a scene.
    Names(Vec<String>),
    /// Groups as bits.
    Bits(u32),
}

impl Groups {
    /// Every group, named or not.
    pub const ALL: Self = Self::Bits(u32::MAX);

    /// Whether the two sets have a group in common; a scene that mixes names with bits is refused.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Bits(bits), Self::Bits(others)) => bits & others != 0,
            (Self::Names(names), Self::Names(others)) => names.iter().any(|name| others.contains(name)),
            (Self::Bits(bits), Self::Names(names)) | (Self::Names(names), Self::Bits(bits)) => {
                *bits != 0 && !names.is_empty()
            }
        }
    }
}

impl Default for Groups {
    fn default() -> Self {
        Self::ALL
    }
}

impl Serialize for Groups {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Names(names) => names.serialize(serializer),
            Self::Bits(bits) => bits.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Groups {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NamesOrBits;
        impl<'de> Visitor<'de> for NamesOrBits {
            type Value = Groups;
            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a list of group names, or bits")
            }
            fn visit_u64<E: Error>(self, bits: u64) -> Result<Groups, E> {
                u32::try_from(bits).map(Groups::Bits).map_err(|_| E::custom("there are 32 group bits"))
            }
            fn visit_i64<E: Error>(self, bits: i64) -> Result<Groups, E> {
                u32::try_from(bits).map(Groups::Bits).map_err(|_| E::custom("there are 32 group bits"))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Groups, A::Error> {
                let mut names = Vec::new();
                while let Some(name) = elements.next_element()? {
                    names.push(name);
                }
                Ok(Groups::Names(names))
            }
        }
        deserializer.deserialize_any(NamesOrBits)
    }
}

impl JsonSchema for Groups {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Groups".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Collision groups by name, or as bits.",
            "anyOf": [
                { "type": "array", "items": { "type": "string" } },
                { "type": "integer", "format": "uint32", "minimum": 0 },
            ]
        })
    }
}

/// A dynamic body without name and parts, at rest at the origin.
impl<D: Dialect> Default for BodyEntry<D> {
    fn default() -> Self {
        Self {
            name: String::new(),
            kind: BodyKind::default(),
            at: D::Vector::ZERO,
            angle_degrees: D::InPlane::default(),
            orientation: D::InSpace::default(),
            velocity: D::Vector::ZERO,
            angular_velocity: D::Angular::ZERO,
            parts: Vec::new(),
            material: None,
            mass: None,
            centre: None,
            inertia: None,
            gravity_scale: one(),
            drag: Drag::default(),
            pinned: false,
            locked: Vec::new(),
            keyframes: Vec::new(),
            ignores: Vec::new(),
            groups: Groups::default(),
            collides_with: Groups::default(),
            repeat: None,
        }
    }
}
