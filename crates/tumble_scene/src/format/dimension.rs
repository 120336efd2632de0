//! Whether a scene is of the plane or of space, and what the two say differently.

use std::borrow::Cow;
use std::fmt::Debug;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use tumble_math::{Dim, Planar, Spatial};

use super::{
    Claim, InertiaEntry, JointKind, JointKindEntry, Part, PartEntry, ScalarExpectation, SpatialJointKind, SpatialPart,
    VectorExpectation,
};

/// Anything that a field of a scene can hold.
pub trait Entry:
    Clone + Debug + Default + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
}

impl<T> Entry for T where
    T: Clone + Debug + Default + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
}

/// What scenes of the plane and of space write differently.
///
/// Most of the format is the same for both; what is not is a type of this trait. A field of type [`InPlane`](Self::InPlane) or
/// [`InSpace`](Self::InSpace) is [`Absent`] from the other dimension, whose files cannot have it.
pub trait Dialect:
    Dim<Vector: Serialize + DeserializeOwned, Angular: Serialize + DeserializeOwned, Inertia: Send + Sync>
{
    /// The word of the field `dimension`.
    const WORD: &'static str;
    /// Words of enums that are only for the other dimension, each with the enum's name.
    const FOREIGN_WORDS: &'static [(&'static str, &'static str)];

    /// How a vector is written.
    type VectorText: JsonSchema;
    /// How a rate of turn or a torque is written.
    type AngularText: JsonSchema;
    /// A value that is there in the plane only.
    type InPlane<T: Entry>: Entry;
    /// A value that is there in space only.
    type InSpace<T: Entry>: Entry;
    /// A shape of a body.
    type Part: PartEntry;
    /// Inertia given outright.
    type InertiaEntry: Clone + Debug + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static;
    /// What a joint lets two bodies do.
    type JointKind: JointKindEntry;
    /// Numbers of copies along each direction of a grid.
    type Counts: Entry + Copy + AsCounts;
    /// A claim about the rate of turn.
    type AngularExpectation: Entry + Claim;
}

/// Numbers of copies along each direction.
pub trait AsCounts {
    /// Along x, y and, in space, z.
    fn counts(&self) -> Vec<u32>;
}

impl AsCounts for (u32, u32) {
    fn counts(&self) -> Vec<u32> {
        vec![self.0, self.1]
    }
}

impl AsCounts for (u32, u32, u32) {
    fn counts(&self) -> Vec<u32> {
        vec![self.0, self.1, self.2]
    }
}

impl Dialect for Planar {
    const WORD: &'static str = "Planar";
    const FOREIGN_WORDS: &'static [(&'static str, &'static str)] = &[
        ("Axis", "Z"),
        ("JointForcePart", "Z"),
        ("Expectation", "Z"),
        ("Expectation", "VelocityZ"),
        ("Expectation", "AngularVelocityX"),
        ("Expectation", "AngularVelocityY"),
        ("Expectation", "AngularVelocityZ"),
        ("Expectation", "TurnRate"),
        ("Expectation", "Orientation"),
        ("Expectation", "Tilt"),
    ];

    type VectorText = (f64, f64);
    type AngularText = f64;
    type InPlane<T: Entry> = T;
    type InSpace<T: Entry> = Absent;
    type Part = Part;
    type InertiaEntry = f64;
    type JointKind = JointKind;
    type Counts = (u32, u32);
    type AngularExpectation = ScalarExpectation;
}

impl Dialect for Spatial {
    const WORD: &'static str = "Spatial";
    const FOREIGN_WORDS: &'static [(&'static str, &'static str)] = &[("Expectation", "Angle")];

    type VectorText = (f64, f64, f64);
    type AngularText = (f64, f64, f64);
    type InPlane<T: Entry> = Absent;
    type InSpace<T: Entry> = T;
    type Part = SpatialPart;
    type InertiaEntry = InertiaEntry;
    type JointKind = SpatialJointKind;
    type Counts = (u32, u32, u32);
    type AngularExpectation = VectorExpectation<Self>;
}

/// The value of a field that the scene's dimension does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Absent;

impl Serialize for Absent {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_unit()
    }
}

impl<'de> Deserialize<'de> for Absent {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // Programs write every field, this one as `()`; a person's file is held to the schema, which does not have it.
        let nothing = <()>::deserialize(deserializer).map(|()| Self);
        nothing.map_err(|_| D::Error::custom("scenes of this dimension have no such field"))
    }
}

/// The schema that nothing satisfies; fields that have it are taken out of the schema of scenes.
impl JsonSchema for Absent {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Absent".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "not": {} })
    }
}

/// The word that says whether a scene is of the plane or of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension<D>(PhantomData<D>);

impl<D: Dialect> Serialize for Dimension<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_unit_variant("Dimension", 0, D::WORD)
    }
}

impl<'de, D: Dialect> Deserialize<'de> for Dimension<D> {
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        #[derive(Deserialize)]
        #[serde(rename = "Dimension")]
        enum Word {
            Planar,
            Spatial,
        }
        let word = match Word::deserialize(deserializer)? {
            Word::Planar => Planar::WORD,
            Word::Spatial => Spatial::WORD,
        };
        if word == D::WORD { Ok(Self(PhantomData)) } else { Err(R::Error::custom(format!("it must be {}", D::WORD))) }
    }
}

impl<D: Dialect> JsonSchema for Dimension<D> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Dimension".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "enum": [Planar::WORD, Spatial::WORD] })
    }
}
