//! The scene format for editors and for people.

use crate::format::Scene;

/// JSON Schema of the scene format, with units and defaults in the descriptions.
pub fn schema() -> String {
    let schema = schemars::schema_for!(Scene);
    serde_json::to_string_pretty(&schema).expect("a schema is plain data")
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
        properties(&schema, "Scene", &mut found);
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
