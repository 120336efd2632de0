//! What may stand where in a file, read from the JSON Schema of the format's types.
//!
//! The schema is the only declaration: `serde` reads by the same types, editors by the same schema, and messages and written
//! files follow it too.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde_json::Value;

/// A whole format.
#[derive(Debug)]
pub(crate) struct Grammar {
    /// The value of a file.
    pub root: Shape,
    types: BTreeMap<String, Shape>,
}

/// What a value must look like.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// A finite number.
    Number,
    /// A whole number from 0 to a largest one.
    Whole(u64),
    /// A text in quotes.
    Text,
    /// `true` or `false`.
    Flag,
    /// `[…]` of equal elements.
    List(Box<Shape>),
    /// `(…)` of a fixed number of values.
    Tuple(Vec<Shape>),
    /// `{ "key": … }`.
    Map(Box<Shape>),
    /// `(name: …)`, with the type's name where it has one.
    Struct(Vec<Field>),
    /// One of several words, some of them with content.
    Enum(Vec<Variant>),
    /// Any of several shapes.
    Either(Vec<Shape>),
    /// A value or nothing.
    Optional(Box<Shape>),
    /// A type that is declared elsewhere.
    Named(String),
}

/// A field of a struct.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub name: String,
    pub shape: Shape,
    /// The value of an absent field; none if it must be there.
    pub default: Option<Value>,
}

/// A word of an enum.
#[derive(Clone, Debug)]
pub(crate) struct Variant {
    pub name: String,
    /// What stands in its parentheses.
    pub content: Option<Shape>,
}

impl Grammar {
    /// The grammar of a type.
    pub fn of<T: JsonSchema>() -> Self {
        Self::of_schema(&schemars::schema_for!(T).to_value())
    }

    /// The grammar of a schema.
    pub fn of_schema(schema: &Value) -> Self {
        let types = match &schema["$defs"] {
            Value::Object(types) => types.iter().map(|(name, schema)| (name.clone(), Shape::of(schema))).collect(),
            _ => BTreeMap::new(),
        };
        Self { root: Shape::of(schema), types }
    }

    /// The shape behind a name.
    pub fn resolve<'g>(&'g self, shape: &'g Shape) -> &'g Shape {
        match shape {
            Shape::Named(name) => self.types.get(name).map_or(shape, |inner| self.resolve(inner)),
            _ => shape,
        }
    }

    /// What a value must be, in words.
    pub fn describe(&self, shape: &Shape) -> String {
        match self.resolve(shape) {
            Shape::Number => "a number".into(),
            Shape::Whole(_) => "a whole number".into(),
            Shape::Text => "a text in quotes".into(),
            Shape::Flag => "`true` or `false`".into(),
            Shape::List(_) => "a list `[…]`".into(),
            Shape::Tuple(items) => match (items.len(), items.iter().all(|item| matches!(item, Shape::Number))) {
                (2, true) => "two numbers `(x, y)`".into(),
                (3, true) => "three numbers `(x, y, z)`".into(),
                (count, _) => format!("{count} values in parentheses"),
            },
            Shape::Map(_) => "a map `{\"name\": …}`".into(),
            Shape::Struct(_) => "fields in parentheses `(name: value, …)`".into(),
            Shape::Enum(variants) => {
                let words: Vec<&str> = variants.iter().map(|variant| variant.name.as_str()).collect();
                format!("one of {}", words.join(", "))
            }
            Shape::Either(shapes) => {
                let words: Vec<String> = shapes.iter().map(|shape| self.describe(shape)).collect();
                words.join(", or ")
            }
            Shape::Optional(inner) => self.describe(inner),
            Shape::Named(name) => name.clone(),
        }
    }
}

impl Shape {
    fn of(schema: &Value) -> Self {
        if let Some(reference) = schema["$ref"].as_str() {
            return Self::Named(reference.trim_start_matches("#/$defs/").to_owned());
        }
        if let Some(variants) = schema["oneOf"].as_array() {
            return Self::Enum(variants.iter().flat_map(Variant::all_of).collect());
        }
        if let Some(choices) = schema["anyOf"].as_array() {
            let mut shapes: Vec<Self> =
                choices.iter().filter(|choice| choice["type"] != "null").map(Self::of).collect();
            let is_optional = shapes.len() < choices.len();
            let shape = if shapes.len() == 1 { shapes.remove(0) } else { Self::Either(shapes) };
            return if is_optional { Self::Optional(Box::new(shape)) } else { shape };
        }
        match &schema["type"] {
            Value::Array(types) => {
                let kind = types.iter().find(|kind| *kind != "null").and_then(Value::as_str).unwrap_or_default();
                Self::Optional(Box::new(Self::of_type(kind, schema)))
            }
            kind => Self::of_type(kind.as_str().unwrap_or_default(), schema),
        }
    }

    fn of_type(kind: &str, schema: &Value) -> Self {
        match kind {
            "number" => Self::Number,
            "integer" if schema["format"] == "uint32" => Self::Whole(u64::from(u32::MAX)),
            "integer" => Self::Whole(u64::MAX),
            "boolean" => Self::Flag,
            "string" if !schema["enum"].is_null() => Self::Enum(Variant::all_of(schema)),
            "array" => match schema["prefixItems"].as_array() {
                Some(items) => Self::Tuple(items.iter().map(Self::of).collect()),
                None => Self::List(Box::new(Self::of(&schema["items"]))),
            },
            "object" if schema["additionalProperties"].is_object() => {
                Self::Map(Box::new(Self::of(&schema["additionalProperties"])))
            }
            "object" => Self::Struct(Field::all_of(schema)),
            _ => Self::Text,
        }
    }
}

impl Field {
    fn all_of(schema: &Value) -> Vec<Self> {
        let required =
            |name: &str| schema["required"].as_array().is_some_and(|list| list.iter().any(|entry| entry == name));
        let Some(properties) = schema["properties"].as_object() else { return Vec::new() };
        let field = |(name, property): (&String, &Value)| Self {
            name: name.clone(),
            shape: Shape::of(property),
            default: (!required(name)).then(|| property["default"].clone()),
        };
        properties.iter().map(field).collect()
    }
}

impl Variant {
    /// The variants of one branch of a schema: words, or one word with content.
    fn all_of(schema: &Value) -> Vec<Self> {
        let word = |name: &Value| Self { name: name.as_str().unwrap_or_default().to_owned(), content: None };
        if let Some(words) = schema["enum"].as_array() {
            return words.iter().map(word).collect();
        }
        match schema["properties"].as_object() {
            Some(properties) => properties
                .iter()
                .map(|(name, content)| Self { name: name.clone(), content: Some(Shape::of(content)) })
                .collect(),
            None => vec![word(&schema["const"])],
        }
    }
}
