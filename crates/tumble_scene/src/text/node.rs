//! The tree.

use std::ops::Range;

use crate::path::{ScenePath, Segment};

/// A value in a text, and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    /// Bytes of the text.
    pub span: Range<usize>,
    /// What it is.
    pub kind: Kind,
    /// Whether the value was read to its end; if not, missing fields mean nothing.
    pub complete: bool,
}

/// An identifier in a text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Name {
    /// Bytes of the text.
    pub span: Range<usize>,
    /// The identifier.
    pub text: String,
}

/// A key and its value in a map.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    /// The key.
    pub key: Node,
    /// The value.
    pub value: Node,
}

/// What a value is, as far as its text shows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Kind {
    /// `1.5`, `-3`, `0xff`, `-inf`.
    Number,
    /// `"steel"`.
    Text(String),
    /// `'x'` or `b"x"`, which no scene needs.
    Other,
    /// `Dynamic`, `true`, `None`, `inf`.
    Word(String),
    /// `[a, b]`.
    List(Vec<Node>),
    /// `{ "a": b }`.
    Map(Vec<Entry>),
    /// `(a, b)` or `Name(a, b)`; also `()`.
    Tuple {
        /// The name in front.
        name: Option<Name>,
        /// What stands inside.
        items: Vec<Node>,
    },
    /// `(a: b)` or `Name(a: b)`.
    Struct {
        /// The name in front.
        name: Option<Name>,
        /// Fields in the order of the text.
        fields: Vec<(Name, Node)>,
    },
}

impl Node {
    /// The bytes a message about the whole value should point at: its name or first bracket, or all of a short value.
    pub fn head(&self) -> Range<usize> {
        match &self.kind {
            Kind::Tuple { name: Some(name), .. } | Kind::Struct { name: Some(name), .. } => name.span.clone(),
            Kind::List(_) | Kind::Map(_) | Kind::Tuple { .. } | Kind::Struct { .. } => {
                self.span.start..(self.span.start + 1).min(self.span.end)
            }
            _ => self.span.clone(),
        }
    }

    /// What it is, in words.
    pub fn describe(&self) -> String {
        match &self.kind {
            Kind::Number => "a number".into(),
            Kind::Text(_) => "a text in quotes".into(),
            Kind::Other => "a literal that scenes do not use".into(),
            Kind::Word(word) => format!("the word `{word}`"),
            Kind::List(_) => "a list".into(),
            Kind::Map(_) => "a map".into(),
            Kind::Tuple { name: Some(name), .. } | Kind::Struct { name: Some(name), .. } => {
                format!("`{}(…)`", name.text)
            }
            Kind::Tuple { name: None, items } if items.is_empty() => "`()`".into(),
            Kind::Tuple { name: None, items } if items.len() == 1 => "one value in parentheses".into(),
            Kind::Tuple { name: None, items } => format!("{} values in parentheses", items.len()),
            Kind::Struct { name: None, .. } => "named fields in parentheses".into(),
        }
    }

    /// The value inside `Some(…)`, or the node itself.
    pub fn without_some(&self) -> &Self {
        match &self.kind {
            Kind::Tuple { name: Some(name), items } if name.text == "Some" && items.len() == 1 => {
                items[0].without_some()
            }
            _ => self,
        }
    }

    /// The bytes of a place, or of the nearest place around it that the text mentions.
    pub fn locate(&self, path: &ScenePath) -> Range<usize> {
        let mut node = self.without_some();
        for segment in path.segments() {
            let child = match (segment, &node.kind) {
                (Segment::Field(wanted), Kind::Struct { fields, .. }) => {
                    fields.iter().find(|(name, _)| name.text == *wanted).map(|(_, value)| value)
                }
                (Segment::Index(index), Kind::List(items) | Kind::Tuple { items, .. }) => items.get(*index),
                (Segment::Key(wanted), Kind::Map(entries)) => entries
                    .iter()
                    .rev()
                    .find(|entry| matches!(&entry.key.kind, Kind::Text(key) if key == wanted))
                    .map(|entry| &entry.value),
                _ => None,
            };
            match child {
                Some(child) => node = child.without_some(),
                None => break,
            }
        }
        node.head()
    }
}
