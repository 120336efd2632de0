//! Diagnostics as text, in the manner of the Rust compiler.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Element, Group, Level, Origin, Renderer, Snippet};

use super::{Diagnostic, Diagnostics, Position, Severity};

/// Whether a text is coloured with terminal codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Color {
    /// For a terminal.
    Always,
    /// For files, pipes and tests.
    Never,
}

/// Diagnostics of one file that are written out; the rest is counted.
const MOST_SHOWN: usize = 50;

/// Bytes of a line that is quoted; of a longer one only the position is told.
const LONGEST_LINE: usize = 2000;

impl Diagnostics {
    /// All diagnostics as text: message, file, line, column, the line with a caret, and ways out.
    pub fn render(&self, color: Color) -> String {
        let renderer = match color {
            Color::Always => Renderer::styled(),
            Color::Never => Renderer::plain(),
        };
        let mut parts: Vec<String> =
            self.entries.iter().take(MOST_SHOWN).map(|entry| self.render_one(entry, &renderer)).collect();
        if self.entries.len() > MOST_SHOWN {
            parts.push(format!("and {} more in {}", self.entries.len() - MOST_SHOWN, self.origin));
        }
        parts.extend(self.others.iter().map(|other| other.render(color)));
        parts.join("\n\n")
    }

    fn render_one(&self, entry: &Diagnostic, renderer: &Renderer) -> String {
        let level = match entry.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let message = one_line(&entry.message);
        let mut group = Group::with_title(level.primary_title(message));
        match &entry.span {
            Some(span) => {
                let mut places = vec![(span, entry.label.as_str(), AnnotationKind::Primary)];
                places.extend(entry.also.iter().map(|(span, label)| (span, label.as_str(), AnnotationKind::Context)));
                for element in self.quote(&places) {
                    group = group.element(element);
                }
            }
            None => {
                let is_whole = entry.path.segments().is_empty();
                let place = if is_whole { self.origin.clone() } else { format!("{}: {}", self.origin, entry.path) };
                group = group.element(Origin::path(place));
                if !entry.label.is_empty() {
                    group = group.element(Level::NOTE.message(one_line(&entry.label)));
                }
            }
        }
        for help in &entry.help {
            group = group.element(Level::HELP.message(one_line(help)));
        }
        renderer.render(&[group])
    }

    /// The lines of some places, marked. Places on one line share it.
    fn quote<'d>(&'d self, places: &[(&Range<usize>, &'d str, AnnotationKind)]) -> Vec<Element<'d>> {
        let mut elements = Vec::new();
        let mut lines: Vec<Range<usize>> = Vec::new();
        for (span, ..) in places {
            let line = self.line_around(span.start);
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
        for line in lines {
            let position = Position::of(&self.text, line.start);
            let text = &self.text[line.clone()];
            let here = places.iter().filter(|(span, ..)| self.line_around(span.start) == line);
            if text.len() > LONGEST_LINE {
                for (span, ..) in here {
                    let column = Position::of(&self.text, span.start).column;
                    elements.push(Origin::path(&*self.origin).line(position.line).char_column(column).into());
                }
                continue;
            }
            let annotations = here.map(|(span, label, kind)| {
                let end = span.end.min(line.end);
                let range = span.start - line.start..end.max(span.start) - line.start;
                kind.span(range).label(one_line(label))
            });
            let snippet = Snippet::source(text).line_start(position.line).path(&*self.origin).fold(false);
            elements.push(snippet.annotations(annotations).into());
        }
        elements
    }

    /// The bytes of the line of a byte, without its line break.
    fn line_around(&self, byte: usize) -> Range<usize> {
        let byte = byte.min(self.text.len());
        let start = self.text[..byte].rfind('\n').map_or(0, |index| index + 1);
        let end = self.text[byte..].find('\n').map_or(self.text.len(), |index| byte + index);
        let line = self.text[start..end].trim_end_matches('\r');
        start..(start + line.len()).max(byte)
    }
}

/// A text without control characters, which could disturb a terminal.
fn one_line(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { '\u{FFFD}' } else { character }).collect()
}
