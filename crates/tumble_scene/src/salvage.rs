//! What can still be judged of a scene whose text has mistakes, so that a user sees all of them at once.
//!
//! Settings and elements that hold no mistake are put together into a smaller scene. What is wrong there is wrong in the whole file too,
//! except for names, which may stand in a part that was left out.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::diagnostics::{Diagnostic, Severity};
use crate::format::{Dialect, Scene};
use crate::path::{ScenePath, Segment};
use crate::text::{self, Kind, Node, Shape};
use crate::write::grammar;

/// The sound part of a scene.
pub(crate) struct Salvage<D: Dialect> {
    /// The smaller scene.
    pub scene: Scene<D>,
    /// For each list, where its elements stand in the file.
    kept: BTreeMap<String, Vec<usize>>,
    /// Whether something was left out that could declare a name.
    lost_names: bool,
}

/// Stands for a duration that could not be read: no time is past the end.
const ENDLESS: &str = "1e300";

impl<D: Dialect> Salvage<D> {
    /// Puts together what holds no mistake.
    pub fn of(source: &str, root: &Node, mistakes: &[Range<usize>]) -> Option<Self> {
        let Kind::Struct { fields: written, .. } = &root.kind else { return None };
        let Shape::Struct(known) = &grammar::<D>().root else { return None };
        let mut starts: Vec<usize> = mistakes.iter().map(|span| span.start).collect();
        starts.sort_unstable();
        let is_sound = |node: &Node| {
            let next = starts.partition_point(|&start| start < node.span.start);
            node.complete && starts.get(next).is_none_or(|&start| start >= node.span.end)
        };
        let mut kept = BTreeMap::new();
        let mut lost_names = !root.complete;
        let mut fields: BTreeMap<&str, String> =
            BTreeMap::from([("format", "1".into()), ("dimension", D::WORD.into()), ("duration", ENDLESS.into())]);
        for (name, value) in written.iter().filter(|(name, _)| known.iter().any(|field| field.name == name.text)) {
            let text = match &value.kind {
                _ if is_sound(value) => source[value.span.clone()].to_owned(),
                Kind::List(items) => {
                    let sound = items.iter().enumerate().filter(|(_, item)| is_sound(item));
                    let (indices, texts): (Vec<usize>, Vec<&str>) =
                        sound.map(|(index, item)| (index, &source[item.span.clone()])).unzip();
                    kept.insert(name.text.clone(), indices);
                    format!("[{}]", texts.join(", "))
                }
                _ => {
                    lost_names |= matches!(name.text.as_str(), "materials" | "part_lists");
                    continue;
                }
            };
            fields.insert(&name.text, text);
        }
        lost_names |= ["bodies", "joints", "pairs", "materials_from"].iter().any(|list| kept.contains_key(*list));
        let text: String = fields.iter().map(|(name, value)| format!("{name}: {value},\n")).collect();
        let scene = text::read(&format!("({text})")).ok()?;
        Some(Self { scene, kept, lost_names })
    }

    /// The findings about the smaller scene that hold for the whole file, at their places there.
    pub fn carry_over(&self, findings: Vec<Diagnostic>) -> impl Iterator<Item = Diagnostic> {
        let certain =
            |finding: &Diagnostic| finding.severity == Severity::Error && !(finding.needs_all_names && self.lost_names);
        findings.into_iter().filter(certain).map(|finding| finding.moved(|path| self.place_in_file(path)))
    }

    fn place_in_file(&self, path: &ScenePath) -> ScenePath {
        let [Segment::Field(list), Segment::Index(index), ..] = path.segments() else { return path.clone() };
        match self.kept.get(list) {
            Some(kept) => path.with_element(kept[*index]),
            None => path.clone(),
        }
    }
}
