//! Numbers that are infinite or NaN. Files cannot contain them by the time they get here; scenes built in code can.

use serde_json::Value;

use crate::diagnostics::Diagnostic;
use crate::format::Scene;
use crate::path::ScenePath;
use crate::text::Shape;
use crate::write::SCENE;

/// Every number of a scene that is not finite. JSON has no such numbers, so they show as nulls where numbers must stand.
pub(super) fn check(scene: &Scene) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    if let Ok(value) = serde_json::to_value(scene) {
        walk(&value, &SCENE.root, &ScenePath::root(), &mut found);
    }
    found
}

fn walk(value: &Value, shape: &Shape, path: &ScenePath, found: &mut Vec<Diagnostic>) {
    match (SCENE.resolve(shape), value) {
        (Shape::Number | Shape::Either(_), Value::Null) => {
            let message = format!("{path} must be finite");
            found.push(Diagnostic::error(message).about(path.clone()).labelled("neither infinity nor NaN is a value"));
        }
        (Shape::Optional(inner), value) if !value.is_null() => walk(value, inner, path, found),
        (Shape::List(item), Value::Array(items)) => {
            for (index, value) in items.iter().enumerate() {
                walk(value, item, &path.index(index), found);
            }
        }
        (Shape::Tuple(shapes), Value::Array(items)) => {
            for (index, (value, shape)) in items.iter().zip(shapes).enumerate() {
                walk(value, shape, &path.index(index), found);
            }
        }
        (Shape::Map(shape), Value::Object(entries)) => {
            for (key, value) in entries {
                walk(value, shape, &path.key(key), found);
            }
        }
        (Shape::Struct(fields), Value::Object(object)) => {
            for field in fields {
                if let Some(value) = object.get(&field.name) {
                    walk(value, &field.shape, &path.field(&field.name), found);
                }
            }
        }
        // A variant with fields adds no step to the path.
        (Shape::Enum(variants), Value::Object(object)) => {
            for variant in variants {
                if let (Some(content), Some(value)) = (&variant.content, object.get(&variant.name)) {
                    walk(value, content, path, found);
                }
            }
        }
        (Shape::Either(shapes), Value::Array(_)) => {
            for shape in shapes.iter().filter(|shape| matches!(shape, Shape::Tuple(_) | Shape::List(_))) {
                walk(value, shape, path, found);
            }
        }
        _ => {}
    }
}
