//! Compares a tree with the grammar and collects every mistake: unknown, missing and repeated fields, wrong kinds of value, unknown words,
//! numbers that are not finite.

use super::{Field, Grammar, Kind, Name, Node, Shape, Variant};
use crate::diagnostics::{Diagnostic, nearest};

/// Every mistake of a tree.
pub(crate) fn check(text: &str, root: &Node, grammar: &Grammar) -> Vec<Diagnostic> {
    let mut checker = Checker { text, grammar, mistakes: Vec::new() };
    checker.value(root, &grammar.root, "the scene");
    checker.mistakes
}

struct Checker<'c> {
    text: &'c str,
    grammar: &'c Grammar,
    mistakes: Vec<Diagnostic>,
}

impl Checker<'_> {
    fn mistake(&mut self, diagnostic: Diagnostic) {
        self.mistakes.push(diagnostic);
    }

    /// Checks one value; `what` names it in messages.
    fn value(&mut self, node: &Node, shape: &Shape, what: &str) {
        if !node.complete && matches!(node.kind, Kind::Other | Kind::Text(_)) {
            return;
        }
        match (self.grammar.resolve(shape), &node.kind) {
            (Shape::Optional(_), Kind::Word(word)) if word == "None" => {}
            (Shape::Optional(inner), _) => self.value(node.without_some(), inner, what),
            (Shape::Number, Kind::Number) => self.number(node, what),
            (Shape::Number, Kind::Word(word)) if matches!(word.as_str(), "inf" | "NaN" | "inff64" | "NaNf64") => {
                self.not_finite(node, what);
            }
            (Shape::Whole(largest), Kind::Number) => self.whole(node, *largest, what),
            (Shape::Text, Kind::Text(_)) => {}
            (Shape::Flag, Kind::Word(word)) if word == "true" || word == "false" => {}
            (Shape::List(item), Kind::List(items)) => {
                for node in items {
                    self.value(node, item, &format!("an element of {what}"));
                }
            }
            (Shape::Tuple(shapes), Kind::Tuple { name: None, items }) => self.items(node, items, shapes, what),
            (Shape::Map(shape), Kind::Map(entries)) => self.map(entries, shape, what),
            (Shape::Struct(fields), Kind::Struct { name, fields: written }) => {
                self.no_name(name.as_ref(), what);
                self.fields(node, written, fields, what);
            }
            (Shape::Struct(fields), Kind::Tuple { name, items }) if items.is_empty() => {
                self.no_name(name.as_ref(), what);
                self.fields(node, &[], fields, what);
            }
            (Shape::Enum(variants), _) => self.word(node, variants, what),
            (Shape::Either(shapes), _) => match shapes.iter().find(|shape| self.resembles(node, shape)) {
                Some(shape) => self.value(node, shape, what),
                None => self.wrong_kind(node, shape, what),
            },
            _ => self.wrong_kind(node, shape, what),
        }
    }

    fn resembles(&self, node: &Node, shape: &Shape) -> bool {
        matches!(
            (self.grammar.resolve(shape), &node.kind),
            (Shape::Number | Shape::Whole(_), Kind::Number)
                | (Shape::List(_), Kind::List(_))
                | (Shape::Tuple(_), Kind::Tuple { .. })
        ) || matches!((shape, &node.kind), (Shape::Number, Kind::Word(word)) if word == "inf" || word == "NaN")
    }

    fn wrong_kind(&mut self, node: &Node, shape: &Shape, what: &str) {
        let expected = self.grammar.describe(shape);
        let mut diagnostic = Diagnostic::error(format!("{what} must be {expected}"))
            .at(node.head())
            .labelled(format!("found {}", node.describe()));
        match (self.grammar.resolve(shape), &node.kind) {
            (Shape::Text, Kind::Word(word)) => diagnostic = diagnostic.help(format!("write \"{word}\" in quotes")),
            (Shape::Tuple(_), Kind::List(_)) => {
                diagnostic = diagnostic.help("use parentheses instead of square brackets")
            }
            (Shape::List(_), Kind::Tuple { .. } | Kind::Struct { .. }) => {
                diagnostic = diagnostic.help("put square brackets around it: `[…]`");
            }
            (Shape::Number | Shape::Whole(_), Kind::Text(_)) => {
                diagnostic = diagnostic.help("write the number without quotes")
            }
            _ => {}
        }
        self.mistake(diagnostic);
    }

    fn not_finite(&mut self, node: &Node, what: &str) {
        let diagnostic = Diagnostic::error(format!("{what} must be finite"))
            .at(node.head())
            .labelled("neither infinity nor NaN is a value");
        self.mistake(diagnostic);
    }

    fn number(&mut self, node: &Node, what: &str) {
        match ron::from_str::<f64>(&self.text[node.span.clone()]) {
            Ok(value) if value.is_finite() => {}
            Ok(_) => self.not_finite(node, what),
            Err(_) => {
                let diagnostic = Diagnostic::error(format!("{what} must be a number"))
                    .at(node.head())
                    .labelled("this is not written as numbers are")
                    .help("numbers look like `2`, `-0.5` or `1e-3`");
                self.mistake(diagnostic);
            }
        }
    }

    fn whole(&mut self, node: &Node, largest: u64, what: &str) {
        if ron::from_str::<u64>(&self.text[node.span.clone()]).is_ok_and(|value| value <= largest) {
            return;
        }
        let diagnostic = Diagnostic::error(format!("{what} must be a whole number"))
            .at(node.head())
            .labelled(format!("expected a whole number from 0 to {largest}"));
        self.mistake(diagnostic);
    }

    fn items(&mut self, node: &Node, items: &[Node], shapes: &[Shape], what: &str) {
        if node.complete && items.len() != shapes.len() {
            let expected = self.grammar.describe(&Shape::Tuple(shapes.to_vec()));
            let diagnostic = Diagnostic::error(format!("{what} must be {expected}"))
                .at(node.span.clone())
                .labelled(format!("found {}", node.describe()));
            self.mistake(diagnostic);
        }
        for (item, shape) in items.iter().zip(shapes) {
            self.value(item, shape, what);
        }
    }

    fn map(&mut self, entries: &[super::Entry], shape: &Shape, what: &str) {
        for (position, entry) in entries.iter().enumerate() {
            let Kind::Text(key) = &entry.key.kind else {
                self.wrong_kind(&entry.key, &Shape::Text, &format!("a name in {what}"));
                continue;
            };
            let is_same = |other: &&super::Entry| matches!(&other.key.kind, Kind::Text(text) if text == key);
            if let Some(first) = entries[..position].iter().find(is_same) {
                let diagnostic = Diagnostic::error(format!("\"{key}\" stands twice in {what}"))
                    .at(entry.key.head())
                    .labelled("again here")
                    .also(first.key.head(), "first here");
                self.mistake(diagnostic);
            }
            self.value(&entry.value, shape, &format!("\"{key}\""));
        }
    }

    /// Structs are written without their name, except that of a variant.
    fn no_name(&mut self, name: Option<&Name>, what: &str) {
        if let Some(name) = name.filter(|name| name.text != "Scene" && name.text != "MaterialTable") {
            let diagnostic = Diagnostic::error(format!("{what} is written without a name"))
                .at(name.span.clone())
                .labelled("remove this")
                .help("write only the parentheses: `(name: value, …)`");
            self.mistake(diagnostic);
        }
    }

    fn fields(&mut self, node: &Node, written: &[(Name, Node)], fields: &[Field], what: &str) {
        for (position, (name, value)) in written.iter().enumerate() {
            if let Some((first, _)) = written[..position].iter().find(|(other, _)| other.text == name.text) {
                let diagnostic = Diagnostic::error(format!("`{}` stands twice in {what}", name.text))
                    .at(name.span.clone())
                    .labelled("again here")
                    .also(first.span.clone(), "first here");
                self.mistake(diagnostic);
            }
            match fields.iter().find(|field| field.name == name.text) {
                Some(field) => self.value(value, &field.shape, &format!("`{}`", name.text)),
                None => self.unknown_field(name, fields, what),
            }
        }
        if !node.complete {
            return;
        }
        let is_missing =
            |field: &&Field| field.default.is_none() && written.iter().all(|(name, _)| name.text != field.name);
        let missing: Vec<String> = fields.iter().filter(is_missing).map(|field| format!("`{}`", field.name)).collect();
        if !missing.is_empty() {
            let list = missing.join(" and ");
            let diagnostic = Diagnostic::error(format!("{what} needs {list}"))
                .at(node.head())
                .labelled(format!("{list} {} missing here", if missing.len() == 1 { "is" } else { "are" }));
            self.mistake(diagnostic);
        }
    }

    fn unknown_field(&mut self, name: &Name, fields: &[Field], what: &str) {
        let allowed: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
        let mut diagnostic = Diagnostic::error(format!("{what} has no field `{}`", name.text)).at(name.span.clone());
        diagnostic = match nearest(&name.text, allowed.iter().copied()) {
            Some(near) => diagnostic.labelled(format!("did you mean `{near}`?")),
            None => diagnostic.labelled("unknown field"),
        };
        self.mistake(diagnostic.help(format!("allowed are {}", allowed.join(", "))));
    }

    /// Checks a value that must be one of several words.
    fn word(&mut self, node: &Node, variants: &[Variant], what: &str) {
        let (word, span) = match &node.kind {
            Kind::Word(word) => (word, node.span.clone()),
            Kind::Tuple { name: Some(name), .. } | Kind::Struct { name: Some(name), .. } => {
                (&name.text, name.span.clone())
            }
            Kind::Text(word) if variants.iter().any(|variant| variant.name == *word) => {
                let diagnostic = Diagnostic::error(format!("{what} is a word, not a text"))
                    .at(node.span.clone())
                    .labelled("found a text in quotes")
                    .help(format!("write {word} without quotes"));
                return self.mistake(diagnostic);
            }
            _ => return self.wrong_kind(node, &Shape::Enum(variants.to_vec()), what),
        };
        let Some(variant) = variants.iter().find(|variant| variant.name == *word) else {
            let allowed: Vec<&str> = variants.iter().map(|variant| variant.name.as_str()).collect();
            let mut diagnostic = Diagnostic::error(format!("{what} cannot be `{word}`")).at(span);
            diagnostic = match nearest(word, allowed.iter().copied()) {
                Some(near) => diagnostic.labelled(format!("did you mean `{near}`?")),
                None => diagnostic.labelled("unknown word"),
            };
            return self.mistake(diagnostic.help(format!("allowed are {}", allowed.join(", "))));
        };
        match &variant.content {
            None if matches!(node.kind, Kind::Word(_)) => {}
            None => {
                let diagnostic = Diagnostic::error(format!("`{word}` stands alone"))
                    .at(span)
                    .labelled("without parentheses, please");
                self.mistake(diagnostic);
            }
            Some(content) => self.content(node, word, content),
        }
    }

    /// Checks what stands in the parentheses of a word.
    fn content(&mut self, node: &Node, word: &str, content: &Shape) {
        let what = format!("`{word}`");
        match (self.grammar.resolve(content), &node.kind) {
            (Shape::Struct(fields), Kind::Struct { fields: written, .. }) => self.fields(node, written, fields, &what),
            (Shape::Struct(fields), Kind::Tuple { items, .. }) if items.is_empty() => {
                self.fields(node, &[], fields, &what)
            }
            (Shape::Tuple(shapes), Kind::Tuple { items, .. }) => self.items(node, items, shapes, &what),
            (Shape::Struct(_), _) => {
                let diagnostic = Diagnostic::error(format!("{what} has fields"))
                    .at(node.head())
                    .labelled(format!("write `{word}(name: value, …)`"));
                self.mistake(diagnostic);
            }
            (_, Kind::Tuple { items, .. }) if items.len() == 1 => self.value(&items[0], content, &what),
            _ => {
                let diagnostic =
                    Diagnostic::error(format!("{what} needs {} in its parentheses", self.grammar.describe(content)))
                        .at(node.head())
                        .labelled("expected it here");
                self.mistake(diagnostic);
            }
        }
    }
}
