//! Numbers that are infinite or NaN. Files cannot contain them by the time they get here; scenes built in code can.

use crate::diagnostics::Diagnostic;
use crate::format::{Dialect, Scene};
use crate::path::ScenePath;
use crate::text::{Kind, Node, parse};

/// Every number of a scene that is not finite, found in its text: RON writes them as words, which no enum uses.
pub(super) fn check<D: Dialect>(scene: &Scene<D>) -> Vec<Diagnostic> {
    let Ok(text) = ron::to_string(scene) else { return Vec::new() };
    let mut found = Vec::new();
    if let (Some(root), _) = parse(&text) {
        walk(&text, &root, &ScenePath::root(), &mut found);
    }
    found
}

fn walk(text: &str, node: &Node, path: &ScenePath, found: &mut Vec<Diagnostic>) {
    let node = node.without_some();
    match &node.kind {
        Kind::Word(word) if !matches!(word.as_str(), "inf" | "NaN") => {}
        Kind::Number if !text[node.span.clone()].ends_with(['f', 'N']) => {}
        Kind::Word(_) | Kind::Number => {
            let message = format!("{path} must be finite");
            found.push(Diagnostic::error(message).about(path.clone()).labelled("neither infinity nor NaN is a value"));
        }
        Kind::List(items) | Kind::Tuple { items, .. } => {
            for (index, item) in items.iter().enumerate() {
                walk(text, item, &path.index(index), found);
            }
        }
        Kind::Struct { fields, .. } => {
            for (name, value) in fields {
                walk(text, value, &path.field(&name.text), found);
            }
        }
        Kind::Map(entries) => {
            for entry in entries {
                if let Kind::Text(key) = &entry.key.kind {
                    walk(text, &entry.value, &path.key(key), found);
                }
            }
        }
        Kind::Text(_) | Kind::Other => {}
    }
}
