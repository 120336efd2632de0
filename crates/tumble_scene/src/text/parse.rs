//! Reads RON into a tree, going on after mistakes where that makes sense.

use std::ops::Range;

use super::{Entry, Kind, Name, Node};
use crate::diagnostics::Diagnostic;

/// Levels of brackets that may stand inside each other; a scene needs about ten.
const DEEPEST: usize = 64;

/// Syntax mistakes after which reading stops, because what follows would be noise.
const MOST_MISTAKES: usize = 8;

/// Reads a text into a tree and a list of syntax mistakes. Without a first value there is no tree.
pub(crate) fn parse(text: &str) -> (Option<Node>, Vec<Diagnostic>) {
    let mut parser = Parser { text, at: 0, depth: 0, mistakes: Vec::new(), stopped: false };
    parser.skip_blanks();
    while parser.rest().starts_with("#![") && !parser.stopped {
        match parser.rest().find(']') {
            Some(length) => parser.at += length + 1,
            None => parser.stop(parser.here(), "this attribute never ends", "expected `]`", None),
        }
        parser.skip_blanks();
    }
    if parser.rest().is_empty() && !parser.stopped {
        parser.stop(
            0..0,
            "the file is empty",
            "nothing here",
            Some("the smallest scene is `(format: 1, duration: 1.0)`"),
        );
    }
    let root = (!parser.stopped).then(|| parser.value());
    parser.skip_blanks();
    if !parser.stopped && !parser.rest().is_empty() {
        let here = parser.here();
        parser.stop(here, "there is text after the end of the scene", "the scene ended before this", None);
    }
    (root, parser.mistakes)
}

struct Parser<'t> {
    text: &'t str,
    /// Next byte to read.
    at: usize,
    depth: usize,
    mistakes: Vec<Diagnostic>,
    /// Whether reading was given up.
    stopped: bool,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// The next character's bytes; at the end of the text nothing.
    fn here(&self) -> Range<usize> {
        self.at..self.at + self.peek().map_or(0, char::len_utf8)
    }

    fn mistake(&mut self, span: Range<usize>, message: &str, label: &str, help: Option<&str>) {
        let mut diagnostic = Diagnostic::error(message).at(span).labelled(label);
        if let Some(help) = help {
            diagnostic = diagnostic.help(help);
        }
        self.mistakes.push(diagnostic);
        self.stopped |= self.mistakes.len() >= MOST_MISTAKES;
    }

    fn stop(&mut self, span: Range<usize>, message: &str, label: &str, help: Option<&str>) {
        self.mistake(span, message, label, help);
        self.stopped = true;
    }

    fn skip_while(&mut self, keep: impl Fn(char) -> bool) {
        self.at += self.rest().find(|character| !keep(character)).unwrap_or(self.rest().len());
    }

    /// Skips white space and comments.
    fn skip_blanks(&mut self) {
        loop {
            self.skip_while(|character| {
                character.is_whitespace() || character == '\u{200E}' || character == '\u{200F}'
            });
            if self.rest().starts_with("//") {
                self.skip_while(|character| character != '\n');
            } else if self.rest().starts_with("/*") {
                self.skip_block_comment();
            } else {
                return;
            }
        }
    }

    /// Skips a comment between `/*` and `*/`, and those inside it.
    fn skip_block_comment(&mut self) {
        let start = self.at;
        let mut open = 0_usize;
        loop {
            if self.rest().starts_with("/*") {
                open += 1;
                self.at += 2;
            } else if self.rest().starts_with("*/") {
                open -= 1;
                self.at += 2;
            } else {
                match self.peek() {
                    Some(character) => self.at += character.len_utf8(),
                    None => {
                        self.stop(start..start + 2, "this comment never ends", "expected `*/` after this", None);
                        return;
                    }
                }
            }
            if open == 0 {
                return;
            }
        }
    }

    fn node(&self, start: usize, kind: Kind) -> Node {
        Node { span: start..self.at, kind, complete: !self.stopped }
    }

    fn value(&mut self) -> Node {
        let start = self.at;
        let Some(first) = self.peek() else {
            self.stop(start..start, "the file ends too early", "a value is missing here", None);
            return self.node(start, Kind::Other);
        };
        match first {
            '(' => self.parentheses(start, None),
            '[' => self.list(start),
            '{' => self.map(start),
            '"' => self.quoted(start),
            '\'' => self.character(start),
            '0'..='9' | '+' | '-' | '.' => self.number(start),
            _ if self.starts_prefixed_string() => self.quoted(start),
            _ if is_name_start(first) => {
                let name = self.name();
                self.skip_blanks();
                if self.peek() == Some('(') {
                    self.parentheses(start, Some(name))
                } else {
                    let end = name.span.end;
                    let mut node = self.node(start, Kind::Word(name.text));
                    node.span.end = end;
                    node
                }
            }
            _ => {
                let here = self.here();
                self.stop(here, "this is no value", "expected a number, a text, a word, `(`, `[` or `{`", None);
                self.node(start, Kind::Other)
            }
        }
    }

    fn name(&mut self) -> Name {
        if self.rest().starts_with("r#") {
            self.at += 2;
        }
        let start = self.at;
        self.skip_while(is_name_part);
        Name { span: start..self.at, text: self.text[start..self.at].to_owned() }
    }

    fn number(&mut self, start: usize) -> Node {
        self.skip_while(|character| matches!(character, '+' | '-'));
        self.skip_while(|character| is_name_part(character) || matches!(character, '.' | '+' | '-'));
        self.node(start, Kind::Number)
    }

    fn character(&mut self, start: usize) -> Node {
        let length =
            self.rest().char_indices().skip(2).find(|(_, character)| *character == '\'').map(|(index, _)| index);
        match length {
            Some(length) => self.at += length + 1,
            None => self.stop(
                start..start + 1,
                "this character never ends",
                "expected `'` after it",
                Some("texts stand in double quotes"),
            ),
        }
        self.node(start, Kind::Other)
    }

    fn starts_prefixed_string(&self) -> bool {
        let after = self.rest().trim_start_matches(['b', 'r']);
        let prefix = &self.rest()[..self.rest().len() - after.len()];
        matches!(prefix, "b" | "r" | "br")
            && (after.starts_with('"')
                || (prefix != "b" && after.trim_start_matches('#').starts_with('"') && after.starts_with('#')))
    }

    /// Reads a string, raw or not; its value is `ron`'s.
    fn quoted(&mut self, start: usize) -> Node {
        let is_bytes = self.rest().starts_with('b');
        self.skip_while(|character| character == 'b');
        let is_raw = self.rest().starts_with('r');
        self.skip_while(|character| character == 'r');
        let hashes_start = self.at;
        self.skip_while(|character| character == '#');
        let closing = format!("\"{}", &self.text[hashes_start..self.at]);
        self.at += 1;
        let mut end = None;
        if is_raw {
            end = self.rest().find(&closing).map(|index| self.at + index + closing.len());
        } else {
            let mut escaped = false;
            for (index, byte) in self.rest().bytes().enumerate() {
                match byte {
                    _ if escaped => escaped = false,
                    b'\\' => escaped = true,
                    b'"' => {
                        end = Some(self.at + index + 1);
                        break;
                    }
                    _ => {}
                }
            }
        }
        let Some(end) = end else {
            self.stop(start..start + 1, "this text never ends", &format!("expected `{closing}` after this"), None);
            return self.node(start, Kind::Text(String::new()));
        };
        self.at = end;
        if is_bytes {
            return self.node(start, Kind::Other);
        }
        match ron::from_str::<String>(&self.text[start..end]) {
            Ok(value) => self.node(start, Kind::Text(value)),
            Err(error) => {
                self.mistake(start..end, "this text cannot be read", &error.code.to_string(), None);
                self.node(start, Kind::Text(String::new()))
            }
        }
    }

    /// Goes one level deeper, unless that is too deep.
    fn descend(&mut self) {
        let bracket = self.here();
        self.at = bracket.end;
        self.depth += 1;
        if self.depth > DEEPEST {
            let message = format!("brackets stand more than {DEEPEST} levels deep");
            self.stop(bracket, &message, "one level too many", None);
        }
    }

    /// Reads what separates two items of a container. Returns whether another item follows.
    fn goes_on(&mut self, open: Range<usize>, close: char, is_first: bool) -> bool {
        self.skip_blanks();
        if self.stopped {
            return false;
        }
        let mut comma = is_first;
        if !is_first && self.peek() == Some(',') {
            self.at += 1;
            comma = true;
            self.skip_blanks();
        }
        let here = self.here();
        match self.peek() {
            _ if self.stopped => false,
            Some(character) if character == close => {
                self.at += 1;
                false
            }
            None => {
                let message = format!("the file ends before this `{}` is closed", &self.text[open.clone()]);
                self.stop(open, &message, &format!("expected `{close}` after this"), None);
                false
            }
            Some(')' | ']' | '}' | ',' | ':' | '=' | ';') => {
                let message = format!("expected `,` or `{close}`, found `{}`", &self.text[here.clone()]);
                self.stop(here, &message, &format!("`{close}` is what closes here"), None);
                if let Some(mistake) = self.mistakes.last_mut() {
                    mistake.also.push((open, "this is still open".into()));
                }
                false
            }
            Some(_) if comma => true,
            Some(_) => {
                let before = self.text[..self.at].trim_end();
                let last = before.chars().next_back().map_or(0, char::len_utf8);
                let span = before.len() - last..before.len();
                self.mistake(span, "a comma is missing", "expected `,` after this", None);
                !self.stopped
            }
        }
    }

    /// Reads the `:` between a name or key and its value.
    fn colon(&mut self) {
        self.skip_blanks();
        if self.stopped {
            return;
        }
        let here = self.here();
        match self.peek() {
            Some(':') => self.at += 1,
            Some('=') => {
                self.mistake(here, "a field is written with a colon", "expected `:`", Some("write `name: value`"));
                self.at += 1;
            }
            _ => self.stop(here, "a colon is missing", "expected `:`", Some("write `name: value`")),
        }
        self.skip_blanks();
    }

    fn list(&mut self, start: usize) -> Node {
        let mut items = Vec::new();
        self.descend();
        while !self.stopped && self.goes_on(start..start + 1, ']', items.is_empty()) {
            items.push(self.value());
        }
        self.depth -= 1;
        self.node(start, Kind::List(items))
    }

    fn map(&mut self, start: usize) -> Node {
        let mut entries = Vec::new();
        self.descend();
        while !self.stopped && self.goes_on(start..start + 1, '}', entries.is_empty()) {
            let key = self.value();
            self.colon();
            if !self.stopped {
                let value = self.value();
                entries.push(Entry { key, value });
            }
        }
        self.depth -= 1;
        self.node(start, Kind::Map(entries))
    }

    /// Reads what stands in parentheses: fields if the first thing is a name and a colon, else values.
    fn parentheses(&mut self, start: usize, name: Option<Name>) -> Node {
        let open = self.here();
        self.descend();
        self.skip_blanks();
        let has_fields = !self.stopped && self.starts_field();
        let mut fields = Vec::new();
        let mut items = Vec::new();
        while !self.stopped && self.goes_on(open.clone(), ')', fields.is_empty() && items.is_empty()) {
            if !has_fields {
                items.push(self.value());
            } else if self.peek().is_some_and(is_name_start) {
                let name = self.name();
                self.colon();
                if !self.stopped {
                    let value = self.value();
                    fields.push((name, value));
                }
            } else {
                let here = self.here();
                self.stop(here, "a field needs a name", "expected a field's name", Some("write `name: value`"));
            }
        }
        self.depth -= 1;
        self.node(start, if has_fields { Kind::Struct { name, fields } } else { Kind::Tuple { name, items } })
    }

    /// Whether a name and a colon (or by mistake an equals sign) come next.
    fn starts_field(&mut self) -> bool {
        if !self.peek().is_some_and(is_name_start) || self.starts_prefixed_string() {
            return false;
        }
        let before = self.at;
        let mistakes = self.mistakes.len();
        self.name();
        self.skip_blanks();
        let found = matches!(self.peek(), Some(':' | '='));
        // A comment that never ends is found again by the caller.
        self.mistakes.truncate(mistakes);
        self.stopped = false;
        self.at = before;
        found
    }
}

fn is_name_start(character: char) -> bool {
    character == '_' || character.is_alphabetic()
}

fn is_name_part(character: char) -> bool {
    character == '_' || character.is_alphanumeric()
}
