//! A figure of a table: one number, or the range that was measured.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Take;

/// A coefficient as tables give it: `0.61`, or a range such as `(0.74, 0.80)` [1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    /// Lower end of the range [1].
    pub low: f64,
    /// Upper end, equal to the lower one for a single figure [1].
    pub high: f64,
}

impl Coefficient {
    /// One number out of the range.
    pub fn take(self, take: Take) -> f64 {
        match take {
            Take::Low => self.low,
            Take::High => self.high,
            Take::Midpoint => 0.5 * (self.low + self.high),
        }
    }
}

impl From<f64> for Coefficient {
    fn from(value: f64) -> Self {
        Self { low: value, high: value }
    }
}

impl Serialize for Coefficient {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.low == self.high { self.low.serialize(serializer) } else { (self.low, self.high).serialize(serializer) }
    }
}

impl<'de> Deserialize<'de> for Coefficient {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrRange;
        impl<'de> Visitor<'de> for NumberOrRange {
            type Value = Coefficient;
            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a number, or a range such as (0.74, 0.80)")
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Coefficient, E> {
                Ok(value.into())
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Coefficient, E> {
                Ok((value as f64).into())
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Coefficient, E> {
                Ok((value as f64).into())
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Coefficient, A::Error> {
                let missing = |count| A::Error::invalid_length(count, &self);
                let low = elements.next_element()?.ok_or_else(|| missing(0))?;
                let high = elements.next_element()?.ok_or_else(|| missing(1))?;
                Ok(Coefficient { low, high })
            }
        }
        deserializer.deserialize_any(NumberOrRange)
    }
}

impl JsonSchema for Coefficient {
    fn schema_name() -> Cow<'static, str> {
        "Coefficient".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or a range (low, high) [1].",
            "anyOf": [
                { "type": "number" },
                { "type": "array", "prefixItems": [{ "type": "number" }, { "type": "number" }], "minItems": 2, "maxItems": 2 },
            ]
        })
    }
}
