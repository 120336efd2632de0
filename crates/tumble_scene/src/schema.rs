//! The scene format for editors and for people.

use std::collections::BTreeSet;

use schemars::schema_for;
use serde_json::{Map, Value, json};
use tumble_math::{Planar, Spatial};

use crate::format::{Dialect, Scene};

/// JSON Schema of the scene format, with units and defaults in the descriptions.
///
/// Files with `dimension: Spatial` are held to the definition `SpatialScene`, all others to `PlanarScene`. A definition that the two have
/// differently stands twice, that of space under its name with `Spatial` in front.
pub fn schema() -> String {
    let (mut planar, mut spatial) = (schema_of::<Planar>(), schema_of::<Spatial>());
    let mut definitions = take_definitions(&mut planar);
    definitions.insert("PlanarScene".into(), planar);
    let mut of_space = take_definitions(&mut spatial);
    of_space.insert("Scene".into(), spatial);
    let own: BTreeSet<String> = of_space
        .iter()
        .filter(|(name, definition)| definitions.get(*name) != Some(definition))
        .map(|(name, _)| name.clone())
        .collect();
    for (name, mut definition) in of_space {
        rename_references(&mut definition, &own);
        definitions.insert(name_of_space(name, &own), definition);
    }
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Scene",
        "description": "A scene of the plane, or with `dimension: Spatial` of space.",
        "if": { "properties": { "dimension": { "const": Spatial::WORD } }, "required": ["dimension"] },
        "then": { "$ref": "#/$defs/SpatialScene" },
        "else": { "$ref": "#/$defs/PlanarScene" },
        "$defs": definitions,
    });
    serde_json::to_string_pretty(&schema).expect("a schema is plain data")
}

/// Schema of the scenes of one dimension, without what only the other one has.
pub(crate) fn schema_of<D: Dialect>() -> Value {
    let mut schema = schema_for!(Scene<D>).to_value();
    remove_absent(&mut schema);
    for (name, word) in D::FOREIGN_WORDS {
        if let Some(words) = schema["$defs"][name]["oneOf"].as_array_mut() {
            words.retain(|variant| variant["const"] != *word && variant["properties"][word].is_null());
        }
    }
    if D::WORD == Spatial::WORD {
        // Without the word a file is read as one of the plane.
        if let Some(dimension) = schema["properties"]["dimension"].as_object_mut() {
            dimension.remove("default");
        }
        if let Some(required) = schema["required"].as_array_mut() {
            required.push("dimension".into());
        }
    }
    schema
}

/// Takes fields out that have the schema of [`Absent`](crate::format::Absent).
fn remove_absent(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            if let Some(Value::Object(properties)) = object.get_mut("properties") {
                properties.retain(|_, property| property["not"].is_null());
            }
            object.values_mut().for_each(remove_absent);
        }
        Value::Array(items) => items.iter_mut().for_each(remove_absent),
        _ => {}
    }
}

fn take_definitions(schema: &mut Value) -> Map<String, Value> {
    let Some(object) = schema.as_object_mut() else { return Map::new() };
    object.remove("$schema");
    match object.remove("$defs") {
        Some(Value::Object(definitions)) => definitions,
        _ => Map::new(),
    }
}

fn name_of_space(name: String, own: &BTreeSet<String>) -> String {
    if own.contains(&name) && !name.starts_with(Spatial::WORD) { format!("{}{name}", Spatial::WORD) } else { name }
}

fn rename_references(schema: &mut Value, own: &BTreeSet<String>) {
    const PLACE: &str = "#/$defs/";
    match schema {
        Value::Object(object) => {
            for (key, value) in object {
                match value {
                    Value::String(reference) if key == "$ref" => {
                        let name = reference.trim_start_matches(PLACE).to_owned();
                        *reference = format!("{PLACE}{}", name_of_space(name, own));
                    }
                    value => rename_references(value, own),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| rename_references(item, own)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    /// Every property of a schema with the path that leads to it.
    fn properties(schema: &Value, path: &str, found: &mut Vec<(String, Value)>) {
        if let Some(fields) = schema["properties"].as_object() {
            let is_variant = fields.len() == 1
                && schema["required"].as_array().is_some_and(|list| list.len() == 1)
                && schema["description"].is_string()
                && fields.values().all(|field| field["description"].is_null());
            for (name, field) in fields {
                let path = format!("{path}.{name}");
                if !is_variant {
                    found.push((path.clone(), field.clone()));
                }
                properties(field, &path, found);
            }
        }
        for branch in schema["oneOf"].as_array().into_iter().flatten() {
            properties(branch, path, found);
        }
    }

    #[test]
    fn every_field_is_described_and_says_its_default() {
        let schema: Value = serde_json::from_str(&schema()).expect("the schema is JSON");
        let mut found = Vec::new();
        for (name, definition) in schema["$defs"].as_object().expect("the schema has definitions") {
            properties(definition, name, &mut found);
        }
        assert!(found.len() > 150, "{}", found.len());
        for (path, field) in found {
            let description = field["description"].as_str().unwrap_or_default();
            assert!(!description.is_empty(), "{path} has no description");
            let is_number = field["type"] == "number" || field["type"][0] == "number";
            assert!(
                !is_number || description.contains('[') || description.contains("unit"),
                "{path} has no unit: {description}"
            );
        }
    }
}
