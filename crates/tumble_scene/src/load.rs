//! From a file to a scene that can be run, or to all that is wrong with it.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use tumble_math::{Planar, Spatial};

use crate::diagnostics::{Diagnostic, Diagnostics, Position, nearest};
use crate::dim::SceneDim;
use crate::format::{Dialect, MaterialTable, Scene};
use crate::materials::MaterialLibrary;
use crate::path::ScenePath;
use crate::salvage::Salvage;
use crate::text::{self, Grammar, Kind, Node};
use crate::validate::{check_table, validate};
use crate::write::grammar;

/// Bytes that a scene file may have.
const LARGEST_FILE: u64 = 64 << 20;

/// A scene that was read and found free of mistakes.
#[derive(Clone, Debug)]
pub struct Loaded<D: SceneDim = Planar> {
    /// The scene.
    pub scene: Scene<D>,
    /// Materials of all tables that the scene uses.
    pub materials: MaterialLibrary,
    /// What may not mean what it says.
    pub warnings: Diagnostics,
    text: String,
    root: Node,
}

impl<D: SceneDim> Loaded<D> {
    /// Puts findings of a later check (such as bodies that overlap at the start) beside the text they are about.
    pub fn diagnose(&self, findings: impl IntoIterator<Item = Diagnostic>) -> Diagnostics {
        let mut diagnostics = Diagnostics::new(self.warnings.origin(), self.text.as_str());
        diagnostics.extend(findings.into_iter().map(|finding| finding.located(|path| self.root.locate(path))));
        diagnostics
    }

    /// Reads a scene of this dimension from a text. `origin` names the text in messages; paths inside the scene are relative to its folder.
    pub fn parse(text: &str, origin: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let origin = origin.as_ref();
        (D::scene_engine().read)(text, origin, Some(origin.parent().unwrap_or(Path::new(""))))
    }

    /// Reads a scene of this dimension from a file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        Self::parse(&read_file(path)?, path)
    }
}

/// Reads a scene whose files are in a folder; without a folder it reads no files.
pub(crate) fn read_scene<D: SceneDim>(
    text: &str,
    origin: &Path,
    folder: Option<&Path>,
) -> Result<Loaded<D>, Diagnostics> {
    // A byte order mark is no part of the text.
    let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
    if let Some(mistake) = other_dimension::<D>(text) {
        let mut mistakes = Diagnostics::new(origin.display().to_string(), text);
        mistakes.extend([mistake]);
        return Err(mistakes);
    }
    let (mut scene, root, mut diagnostics) = match read_checked::<Scene<D>>(text, grammar::<D>(), origin) {
        Ok(read) => read,
        Err(refusal) => {
            let Refusal { root, mut mistakes } = *refusal;
            if let Some(root) = root {
                mistakes.extend(further_mistakes::<D>(text, &root, &mistakes, folder));
            }
            return Err(mistakes);
        }
    };
    let mut tables = Vec::new();
    for (index, file) in scene.materials_from.iter().enumerate() {
        match load_table_in(folder, file) {
            Ok(table) => tables.push(table),
            Err(mistakes) => {
                let path = ScenePath::root().field("materials_from").index(index);
                let diagnostic = Diagnostic::error(format!("the material table \"{file}\" cannot be used"))
                    .about(path)
                    .labelled("named here");
                diagnostics.push(diagnostic.located(|path| root.locate(path)));
                diagnostics.append_file(mistakes);
            }
        }
    }
    let unread = read_part_files(&mut scene, folder);
    let is_unread = |finding: &Diagnostic| unread.iter().any(|(part, _)| finding.path == *part);
    let materials = MaterialLibrary::with_tables(&scene, &tables);
    // Without all tables every material could be unknown, so only what is certain is told.
    let are_tables_read = !diagnostics.has_errors();
    let findings = validate(&scene, &materials)
        .into_iter()
        .filter(|finding| (are_tables_read || !finding.needs_all_names) && !is_unread(finding));
    let findings: Vec<Diagnostic> = findings.collect();
    let findings = unread.into_iter().map(|(_, mistake)| mistake).chain(findings);
    diagnostics.extend(findings.map(|finding| finding.located(|path| root.locate(path))));
    if diagnostics.has_errors() {
        return Err(diagnostics);
    }
    Ok(Loaded { scene, materials, warnings: diagnostics, text: text.to_owned(), root })
}

impl Scene {
    /// Reads a scene of the plane from a text. `origin` names the text in messages; paths inside the scene are relative to its folder.
    pub fn parse(text: &str, origin: impl AsRef<Path>) -> Result<Loaded, Diagnostics> {
        Loaded::parse(text, origin)
    }

    /// Reads a scene of the plane from a file.
    pub fn load(path: impl AsRef<Path>) -> Result<Loaded, Diagnostics> {
        Loaded::load(path)
    }
}

impl<D: SceneDim> Scene<D> {
    /// Checks a scene that was built in code; gives its warnings.
    pub fn check(&self, materials: &MaterialLibrary) -> Result<Vec<Diagnostic>, Diagnostics> {
        let findings = validate(self, materials);
        let mut diagnostics = Diagnostics::new("the scene", "");
        diagnostics.extend(findings.iter().cloned());
        if diagnostics.has_errors() { Err(diagnostics) } else { Ok(findings) }
    }
}

/// A scene of either dimension that was read and found free of mistakes.
#[derive(Clone, Debug)]
pub enum AnyLoaded {
    /// Of the plane.
    Planar(Loaded<Planar>),
    /// Of space.
    Spatial(Loaded<Spatial>),
}

impl AnyLoaded {
    /// Reads a scene that comes with the program, which is in no folder.
    pub(crate) fn embedded(text: &str, origin: &str) -> Result<Self, Diagnostics> {
        let origin = Path::new(origin);
        Self::read(text, origin, None)
    }

    fn read(text: &str, origin: &Path, folder: Option<&Path>) -> Result<Self, Diagnostics> {
        if dimension_of(text).is_some_and(|(word, _)| word == Spatial::WORD) {
            (Spatial::scene_engine().read)(text, origin, folder).map(Self::Spatial)
        } else {
            (Planar::scene_engine().read)(text, origin, folder).map(Self::Planar)
        }
    }

    /// Reads a scene from a text, of whichever dimension it says. `origin` names the text in messages; paths inside the scene are relative to its
    /// folder.
    pub fn parse(text: &str, origin: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let origin = origin.as_ref();
        Self::read(text, origin, Some(origin.parent().unwrap_or(Path::new(""))))
    }

    /// Reads a scene from a file, of whichever dimension it says.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        Self::parse(&read_file(path)?, path)
    }
}

impl AnyLoaded {
    /// What the scene shows.
    pub fn about(&self) -> &str {
        match self {
            Self::Planar(loaded) => &loaded.scene.about,
            Self::Spatial(loaded) => &loaded.scene.about,
        }
    }
}

/// The dimension that a text says or nearly says, and where.
fn dimension_of(text: &str) -> Option<(&'static str, Range<usize>)> {
    let (root, _) = text::parse(text);
    let Some(Node { kind: Kind::Struct { fields, .. }, .. }) = root else { return None };
    let (_, value) = fields.into_iter().find(|(name, _)| name.text == "dimension")?;
    let (Kind::Word(word) | Kind::Text(word)) = &value.kind else { return None };
    Some((nearest(word, [Planar::WORD, Spatial::WORD])?, value.span))
}

/// Tells that a text says another dimension than this one.
fn other_dimension<D: SceneDim>(text: &str) -> Option<Diagnostic> {
    let (word, span) = dimension_of(text)?;
    let is_said = text[span.clone()] == *word;
    let message = format!("this scene is not {}", D::WORD);
    (is_said && word != D::WORD).then(|| {
        Diagnostic::error(message).at(span).labelled("said here").help("`AnyLoaded` reads scenes of either dimension")
    })
}

/// Mistakes in what the text's own mistakes leave of a scene.
fn further_mistakes<D: SceneDim>(
    text: &str,
    root: &Node,
    known: &Diagnostics,
    folder: Option<&Path>,
) -> Vec<Diagnostic> {
    let spans: Vec<Range<usize>> = known.iter().filter_map(|mistake| mistake.span.clone()).collect();
    let Some(mut salvage) = Salvage::<D>::of(text, root, &spans) else { return Vec::new() };
    let tables: Result<Vec<MaterialTable>, Diagnostics> =
        salvage.scene.materials_from.iter().map(|file| load_table_in(folder, file)).collect();
    let Ok(tables) = tables else { return Vec::new() };
    let library = MaterialLibrary::with_tables(&salvage.scene, &tables);
    let unread = read_part_files(&mut salvage.scene, folder);
    let mut findings = validate(&salvage.scene, &library);
    findings.retain(|finding| !unread.iter().any(|(part, _)| finding.path == *part));
    findings.extend(unread.into_iter().map(|(_, mistake)| mistake));
    let findings = salvage.carry_over(findings);
    findings.map(|finding| finding.located(|path| root.locate(path))).collect()
}

/// Puts the contents of files into the parts that name them; gives the places of those that cannot be used, and why.
fn read_part_files<D: SceneDim>(scene: &mut Scene<D>, folder: Option<&Path>) -> Vec<(ScenePath, Diagnostic)> {
    let root = ScenePath::root();
    let bodies = scene.bodies.iter_mut().enumerate();
    let of_bodies = bodies.map(|(body, entry)| (root.field("bodies").index(body).field("parts"), &mut entry.parts));
    let lists = scene.part_lists.iter_mut();
    let of_lists = lists.map(|(name, parts)| (root.field("part_lists").key(name), parts));
    let mut unread = Vec::new();
    for (list, parts) in of_bodies.chain(of_lists) {
        for (index, part) in parts.iter_mut().enumerate() {
            if let Err(error) = D::read_file(part, folder) {
                let path = list.index(index);
                let mistake = Diagnostic::error(error.to_string()).about(path.field("file")).labelled("named here");
                unread.push((path, mistake));
            }
        }
    }
    unread
}

fn load_table_in(folder: Option<&Path>, file: &str) -> Result<MaterialTable, Diagnostics> {
    let Some(folder) = folder else {
        let mistake = Diagnostic::error("this scene is in no folder, so it reads no files");
        return Err(Diagnostics::about_file(file, mistake));
    };
    load_table(&folder.join(file))
}

/// Reads a table of materials from a file.
pub fn load_table(path: &Path) -> Result<MaterialTable, Diagnostics> {
    let text = read_file(path)?;
    let read = read_checked(&text, &Grammar::of::<MaterialTable>(), path);
    let (table, root, mut diagnostics) = read.map_err(|refusal| refusal.mistakes)?;
    diagnostics.extend(check_table(&table).into_iter().map(|finding| finding.located(|path| root.locate(path))));
    if diagnostics.has_errors() { Err(diagnostics) } else { Ok(table) }
}

/// A text that is no value: its tree, as far as there is one, and its mistakes.
struct Refusal {
    root: Option<Node>,
    mistakes: Diagnostics,
}

/// Reads a value and its tree, or every mistake of its syntax and structure.
fn read_checked<T: DeserializeOwned + JsonSchema>(
    text: &str,
    grammar: &Grammar,
    origin: &Path,
) -> Result<(T, Node, Diagnostics), Box<Refusal>> {
    let mut diagnostics = Diagnostics::new(origin.display().to_string(), text);
    let (root, mistakes) = text::parse(text);
    diagnostics.extend(mistakes);
    if let Some(root) = &root {
        diagnostics.extend(text::check(text, root, grammar));
    }
    let root = match root {
        Some(root) if !diagnostics.has_errors() => root,
        root => return Err(Box::new(Refusal { root, mistakes: diagnostics })),
    };
    match text::read(text) {
        Ok(value) => Ok((value, root, diagnostics)),
        Err(error) => {
            let at =
                |position: ron::error::Position| Position { line: position.line, column: position.col }.byte_in(text);
            let start = at(error.span.start);
            let span = start..at(error.span.end).max(start);
            diagnostics.push(Diagnostic::error("this cannot be read").at(span).labelled(error.code.to_string()));
            Err(Box::new(Refusal { root: Some(root), mistakes: diagnostics }))
        }
    }
}

/// The text of a file, or why there is none.
fn read_file(path: &Path) -> Result<String, Diagnostics> {
    let refuse = |message: String| Diagnostics::about_file(path.display().to_string(), Diagnostic::error(message));
    if path.is_dir() {
        return Err(refuse(format!("\"{}\" is a folder, not a file", path.display())));
    }
    let cannot = |error: std::io::Error| refuse(format!("\"{}\" cannot be read: {error}", path.display()));
    let mut bytes = Vec::new();
    File::open(path).map_err(cannot)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(cannot)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(refuse(format!("\"{}\" is larger than {} MiB", path.display(), LARGEST_FILE >> 20)));
    }
    String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..good].iter().filter(|&&byte| byte == b'\n').count();
        refuse(format!("\"{}\" is not a text in UTF-8: see line {line}", path.display()))
    })
}
