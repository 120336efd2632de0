//! A scene as text: RON in the layout people use, defaults left out.

use std::fmt::Write;
use std::sync::LazyLock;

use serde_json::Value;
use tumble_math::{Planar, Spatial};

use crate::dim::SceneDim;
use crate::format::{Dialect, Scene};
use crate::schema::schema_of;
use crate::text::{Field, Grammar, Shape};

/// What fits on one line is written on one line.
const WIDTH: usize = 110;

/// The grammar of the scenes of a dimension.
pub(crate) fn grammar<D: Dialect>() -> &'static Grammar {
    static PLANAR: LazyLock<Grammar> = LazyLock::new(|| Grammar::of_schema(&schema_of::<Planar>()));
    static SPATIAL: LazyLock<Grammar> = LazyLock::new(|| Grammar::of_schema(&schema_of::<Spatial>()));
    if D::WORD == Spatial::WORD { &SPATIAL } else { &PLANAR }
}

impl<D: SceneDim> Scene<D> {
    /// The scene as a RON file. Reading it gives an equal scene, provided that every number is finite.
    pub fn to_ron(&self) -> String {
        (D::scene_engine().write)(self)
    }
}

pub(crate) fn written<D: SceneDim>(scene: &Scene<D>) -> String {
    let value = serde_json::to_value(scene).expect("a scene is plain data");
    let grammar = grammar::<D>();
    let mut writer = Writer { grammar, out: String::new() };
    writer.value(&value, &grammar.root, 0, 0);
    writer.out.push('\n');
    writer.out
}

struct Writer {
    grammar: &'static Grammar,
    out: String,
}

impl Writer {
    /// Writes a value at a depth of indentation, on one line if it fits with what precedes it there.
    fn value(&mut self, value: &Value, shape: &Shape, depth: usize, before: usize) {
        let line = one_line(self.grammar, value, shape);
        if depth > 0 && 4 * depth + before + line.chars().count() < WIDTH {
            self.out.push_str(&line);
            return;
        }
        match (self.grammar.resolve(shape), value) {
            (Shape::Optional(inner), _) => self.value(value, inner, depth, before),
            (Shape::Struct(fields), Value::Object(object)) => {
                let written = written_fields(fields, object);
                self.block('(', ')', depth, written, |writer, (field, value)| {
                    let head = format!("{}: ", field.name);
                    writer.out.push_str(&head);
                    writer.value(value, &field.shape, depth + 1, head.len());
                });
            }
            (Shape::Map(shape), Value::Object(object)) => {
                self.block('{', '}', depth, object.iter().collect(), |writer, (key, value)| {
                    let head = format!("{key:?}: ");
                    writer.out.push_str(&head);
                    writer.value(value, shape, depth + 1, head.chars().count());
                });
            }
            (Shape::List(shape), Value::Array(items)) => {
                self.block('[', ']', depth, items.iter().collect(), |writer, item| {
                    writer.value(item, shape, depth + 1, 0)
                });
            }
            (Shape::Enum(variants), Value::Object(object)) => {
                let Some((name, content)) = object.iter().next() else { return };
                let shape =
                    variants.iter().find(|variant| variant.name == *name).and_then(|variant| variant.content.as_ref());
                self.out.push_str(name);
                match shape.map(|shape| (self.grammar.resolve(shape), shape)) {
                    Some((Shape::Struct(_), shape)) => self.value(content, shape, depth, WIDTH),
                    _ => self.out.push_str(&line[name.len()..]),
                }
            }
            (Shape::Either(shapes), _) => match shapes.iter().find(|shape| fits(self.grammar, value, shape)) {
                Some(shape) => self.value(value, shape, depth, before),
                None => self.out.push_str(&line),
            },
            _ => self.out.push_str(&line),
        }
    }

    /// Writes items on lines of their own between two brackets.
    fn block<T>(&mut self, open: char, close: char, depth: usize, items: Vec<T>, mut write: impl FnMut(&mut Self, T)) {
        self.out.push(open);
        if !items.is_empty() {
            self.out.push('\n');
        }
        let is_empty = items.is_empty();
        for item in items {
            self.indent(depth + 1);
            write(self, item);
            self.out.push_str(",\n");
        }
        if !is_empty {
            self.indent(depth);
        }
        self.out.push(close);
    }

    fn indent(&mut self, depth: usize) {
        self.out.extend(std::iter::repeat_n("    ", depth));
    }
}

/// Fields that differ from their defaults.
fn written_fields<'v>(fields: &'v [Field], object: &'v serde_json::Map<String, Value>) -> Vec<(&'v Field, &'v Value)> {
    let written = fields.iter().filter_map(|field| Some((field, object.get(&field.name)?)));
    written.filter(|(field, value)| field.default.as_ref() != Some(*value)).collect()
}

/// A value on one line.
fn one_line(grammar: &Grammar, value: &Value, shape: &Shape) -> String {
    match (grammar.resolve(shape), value) {
        (Shape::Optional(_), Value::Null) => "None".into(),
        (Shape::Optional(inner), _) => one_line(grammar, value, inner),
        (Shape::Struct(fields), Value::Object(object)) => {
            let fields = written_fields(fields, object);
            joined(
                '(',
                ')',
                fields
                    .iter()
                    .map(|(field, value)| format!("{}: {}", field.name, one_line(grammar, value, &field.shape))),
            )
        }
        (Shape::Map(shape), Value::Object(object)) => {
            joined('{', '}', object.iter().map(|(key, value)| format!("{key:?}: {}", one_line(grammar, value, shape))))
        }
        (Shape::List(shape), Value::Array(items)) => {
            joined('[', ']', items.iter().map(|item| one_line(grammar, item, shape)))
        }
        (Shape::Tuple(shapes), Value::Array(items)) => {
            joined('(', ')', items.iter().zip(shapes).map(|(item, shape)| one_line(grammar, item, shape)))
        }
        (Shape::Enum(variants), Value::Object(object)) => {
            let Some((name, content)) = object.iter().next() else { return String::new() };
            let shape =
                variants.iter().find(|variant| variant.name == *name).and_then(|variant| variant.content.as_ref());
            let content = shape.map(|shape| (grammar.resolve(shape), one_line(grammar, content, shape)));
            match content {
                Some((Shape::Struct(_) | Shape::Tuple(_), text)) => format!("{name}{text}"),
                Some((_, text)) => format!("{name}({text})"),
                None => name.clone(),
            }
        }
        (Shape::Enum(_), Value::String(word)) => word.clone(),
        (Shape::Either(shapes), _) => match shapes.iter().find(|shape| fits(grammar, value, shape)) {
            Some(shape) => one_line(grammar, value, shape),
            None => "None".into(),
        },
        (_, Value::String(text)) => format!("{text:?}"),
        (_, Value::Number(number)) => number.to_string(),
        (_, Value::Bool(flag)) => flag.to_string(),
        // Numbers that are not finite have no JSON; reading refuses them with a message.
        _ => "NaN".into(),
    }
}

fn fits(grammar: &Grammar, value: &Value, shape: &Shape) -> bool {
    matches!(
        (grammar.resolve(shape), value),
        (Shape::Number | Shape::Whole(_), Value::Number(_)) | (Shape::List(_) | Shape::Tuple(_), Value::Array(_))
    )
}

fn joined(open: char, close: char, items: impl Iterator<Item = String>) -> String {
    let mut line = String::from(open);
    for (position, item) in items.enumerate() {
        let comma = if position == 0 { "" } else { ", " };
        let _ = write!(line, "{comma}{item}");
    }
    line.push(close);
    line
}

/// A scene with every field, in one line: for programs, not for people.
pub(crate) fn plain<D: SceneDim>(scene: &Scene<D>) -> Result<String, String> {
    crate::text::options().to_string(scene).map_err(|error| error.to_string())
}

/// Reads what [`plain`] wrote.
pub(crate) fn of_plain<D: SceneDim>(text: &str) -> Result<Scene<D>, String> {
    crate::text::read(text).map_err(|error| error.code.to_string())
}
