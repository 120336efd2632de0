//! From the words of the command line to scenes.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::{fs, io};

use tumble_scene::AnyLoaded;
use tumble_scene::diagnostics::Diagnostics;
use tumble_scene::shipped::{DEFAULT_SCENE, SHIPPED, Shipped};

use crate::failure::Failure;

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A file.
    File(PathBuf),
    /// It came with the program.
    Shipped(Shipped),
}

impl Source {
    /// The scene that runs when none is named.
    pub fn default_scene() -> Result<Self, Failure> {
        Self::of(Path::new(DEFAULT_SCENE))
    }

    /// What contains a `/` or ends in `.ron` is a file, everything else the name of a shipped scene.
    pub fn of(word: &Path) -> Result<Self, Failure> {
        if is_path(word) {
            return Ok(Self::File(word.to_owned()));
        }
        word.to_str().and_then(Shipped::named).map(Self::Shipped).ok_or_else(|| unknown(word))
    }

    /// What each word means where folders are allowed, in order: a shipped scene, a file, or all scene files in a folder.
    pub fn all_of(words: &[PathBuf]) -> Result<Vec<Self>, Failure> {
        let mut sources = Vec::new();
        for word in words {
            let shipped = word.to_str().filter(|_| !is_path(word)).and_then(Shipped::named);
            match shipped {
                Some(shipped) => sources.push(Self::Shipped(shipped)),
                None if word.is_dir() => {
                    let files = scene_files(word)?;
                    if files.is_empty() {
                        let message = format!("there is no scene (*.ron) in the folder \"{}\"", word.display());
                        return Err(Failure::Arguments(message));
                    }
                    sources.extend(files.into_iter().map(Self::File));
                }
                None => sources.push(Self::of(word)?),
            }
        }
        Ok(sources)
    }

    /// Reads the scene.
    pub fn load(&self) -> Result<AnyLoaded, Diagnostics> {
        match self {
            Self::File(path) => AnyLoaded::load(path),
            Self::Shipped(shipped) => shipped.load_any(),
        }
    }

    /// The name of the scene, which is that of its file without `.ron`.
    pub fn stem(&self) -> &OsStr {
        match self {
            Self::File(path) => path.file_stem().unwrap_or(OsStr::new("scene")),
            Self::Shipped(shipped) => OsStr::new(shipped.name),
        }
    }

    /// How messages call it: the path, or the name of a shipped scene.
    pub fn label(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Shipped(shipped) => shipped.name.to_owned(),
        }
    }
}

fn is_path(word: &Path) -> bool {
    word.components().count() > 1
        || word.to_string_lossy().contains(std::path::is_separator)
        || word.extension() == Some(OsStr::new("ron"))
}

fn unknown(word: &Path) -> Failure {
    let name = word.display();
    let near = word.to_str().map(Shipped::near).unwrap_or_default();
    let near = if near.is_empty() { String::new() } else { format!("; did you mean {}?", near.join(" or ")) };
    let names = SHIPPED.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ");
    let file =
        if word.exists() { format!("\n  for the file or folder of this name write ./{name}") } else { String::new() };
    Failure::Arguments(format!(
        "no scene that comes with the program is called \"{name}\"{near}\n  there is {names}{file}"
    ))
}

/// All scene files in a folder, at any depth, sorted.
fn scene_files(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let cannot =
        |error: io::Error| Failure::Arguments(format!("the folder \"{}\" cannot be read: {error}", folder.display()));
    let mut entries = fs::read_dir(folder).map_err(cannot)?.collect::<io::Result<Vec<_>>>().map_err(cannot)?;
    entries.sort_by_key(fs::DirEntry::file_name);
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.path();
        // Links to folders are not followed, so that no loop can arise.
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            files.extend(scene_files(&path)?);
        } else if path.extension() == Some(OsStr::new("ron")) && !path.is_dir() {
            files.push(path);
        }
    }
    Ok(files)
}
