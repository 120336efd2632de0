//! Mistakes and warnings, with the place in the file they are about.

mod nearest;
mod render;

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

pub(crate) use nearest::{nearest, nearest_or_all};
pub use render::Color;

use crate::path::ScenePath;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The scene cannot be run.
    Error,
    /// The scene can be run, but may not mean what it says.
    Warning,
}

/// One mistake or warning.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, in a sentence that stands alone.
    pub message: String,
    /// What to see at the place it points at.
    pub label: String,
    /// The place, as bytes of the text; none for what is about a whole file.
    pub span: Option<Range<usize>>,
    /// The place in the scene, if it is about a value that was read well.
    pub path: ScenePath,
    /// Further places in the same text, each with what to see there.
    pub also: Vec<(Range<usize>, String)>,
    /// Ways out, such as the allowed names.
    pub help: Vec<String>,
    also_paths: Vec<(ScenePath, String)>,
    /// Whether it only holds if every name of the scene is known.
    pub(crate) needs_all_names: bool,
}

impl Diagnostic {
    /// A mistake.
    pub fn error(message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            message: message.into(),
            label: String::new(),
            span: None,
            path: ScenePath::root(),
            also: Vec::new(),
            help: Vec::new(),
            also_paths: Vec::new(),
            needs_all_names: false,
        }
    }

    /// A warning.
    pub fn warning(message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(message) }
    }

    /// Points at bytes of the text.
    pub fn at(mut self, span: Range<usize>) -> Self {
        self.span = Some(span);
        self
    }

    /// Points at a place in the scene, which becomes bytes once the text is known.
    pub fn about(mut self, path: ScenePath) -> Self {
        self.path = path;
        self
    }

    /// Says what to see at the place.
    pub fn labelled(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Points at a second place, as bytes of the text.
    pub fn also(mut self, span: Range<usize>, label: impl Into<String>) -> Self {
        self.also.push((span, label.into()));
        self
    }

    /// Points at a second place in the scene.
    pub fn also_about(mut self, path: ScenePath, label: impl Into<String>) -> Self {
        self.also_paths.push((path, label.into()));
        self
    }

    /// Adds a way out.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Changes places in the scene.
    pub(crate) fn moved(mut self, place: impl Fn(&ScenePath) -> ScenePath) -> Self {
        self.path = place(&self.path);
        for (path, _) in &mut self.also_paths {
            *path = place(path);
        }
        self
    }

    /// Turns places in the scene into bytes of its text.
    pub(crate) fn located(mut self, locate: impl Fn(&ScenePath) -> Range<usize>) -> Self {
        self.span = self.span.or_else(|| Some(locate(&self.path)));
        let further = std::mem::take(&mut self.also_paths);
        self.also.extend(further.into_iter().map(|(path, label)| (locate(&path), label)));
        self
    }
}

/// A line and column of a text, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column in characters.
    pub column: usize,
}

impl Position {
    /// The position of a byte of a text.
    pub fn of(text: &str, byte: usize) -> Self {
        let before = &text.as_bytes()[..byte.min(text.len())];
        let line_start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |index| index + 1);
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let column = 1 + String::from_utf8_lossy(&before[line_start..]).chars().count();
        Self { line, column }
    }

    /// The byte of a text at this position, or the text's end.
    pub(crate) fn byte_in(self, text: &str) -> usize {
        let start: usize = text.split_inclusive('\n').take(self.line.saturating_sub(1)).map(str::len).sum();
        let within = text[start..].char_indices().nth(self.column.saturating_sub(1)).map(|(index, _)| index);
        within.map_or(text.len(), |index| start + index)
    }
}

/// All mistakes and warnings of one file, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics {
    origin: String,
    text: Arc<str>,
    entries: Vec<Diagnostic>,
    /// Those of other files that this one uses.
    others: Vec<Diagnostics>,
}

impl Diagnostics {
    /// No diagnostics yet about a text that came from `origin`, usually a path.
    pub fn new(origin: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        Self { origin: origin.into(), text: text.into(), entries: Vec::new(), others: Vec::new() }
    }

    /// One diagnostic about a whole file.
    pub(crate) fn about_file(origin: impl Into<String>, diagnostic: Diagnostic) -> Self {
        let mut all = Self::new(origin, "");
        all.push(diagnostic);
        all
    }

    /// Adds a diagnostic.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.extend([diagnostic]);
    }

    /// Adds diagnostics.
    pub fn extend(&mut self, diagnostics: impl IntoIterator<Item = Diagnostic>) {
        self.entries.extend(diagnostics);
        self.entries.sort_by_key(|entry| entry.span.as_ref().map(|span| span.start));
    }

    /// Adds those of another file.
    pub(crate) fn append_file(&mut self, other: Self) {
        if !other.is_empty() {
            self.others.push(other);
        }
    }

    /// Where the text came from.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Every diagnostic, file by file.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        let mut all: Vec<&Diagnostic> = self.entries.iter().collect();
        all.extend(self.others.iter().flat_map(|other| &other.entries));
        all.into_iter()
    }

    /// Whether there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.others.is_empty()
    }

    /// Number of diagnostics.
    pub fn len(&self) -> usize {
        self.entries.len() + self.others.iter().map(Self::len).sum::<usize>()
    }

    /// Whether any of them keeps the scene from running.
    pub fn has_errors(&self) -> bool {
        self.iter().any(|entry| entry.severity == Severity::Error)
    }

    /// Line and column of a diagnostic of this file.
    pub fn position(&self, diagnostic: &Diagnostic) -> Option<Position> {
        diagnostic.span.as_ref().map(|span| Position::of(&self.text, span.start))
    }
}

/// Plain text without colours.
impl fmt::Display for Diagnostics {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(&self.render(Color::Never))
    }
}

impl std::error::Error for Diagnostics {}
