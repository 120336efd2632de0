//! Files that appear whole or not at all.
//!
//! Content goes to a temporary name in the same folder and is flushed to the disk; only then does a rename, which is
//! atomic within a folder, put it under its own name. A failure leaves the earlier file as it was.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::{fmt, process};

/// A file that could not be written: what was tried, where, and why it failed.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} `{}`: {reason}", path.display())]
pub struct FileError {
    /// What was tried.
    pub action: FileAction,
    /// The file or folder.
    pub path: PathBuf,
    /// Why it failed.
    #[source]
    pub reason: io::Error,
}

/// What was tried with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileAction {
    /// Making a folder.
    CreateFolder,
    /// Writing content.
    Write,
    /// Putting finished content under its own name.
    Replace,
    /// Removing what an earlier run left.
    Remove,
}

impl fmt::Display for FileAction {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::CreateFolder => "create folder",
            Self::Write => "write",
            Self::Replace => "replace",
            Self::Remove => "remove",
        })
    }
}

impl FileError {
    /// What was tried with a file, and why it failed.
    pub fn new(action: FileAction, path: &Path, reason: io::Error) -> Self {
        Self { action, path: path.to_owned(), reason }
    }
}

/// Writes one file whole or not at all; its folder must exist.
pub fn write_file(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), FileError> {
    let prepared = PreparedFile::write(path, content)?;
    prepared.check_place()?;
    prepared.publish()
}

/// Content under a temporary name, waiting for its own; removed when dropped before that.
struct PreparedFile {
    temporary: PathBuf,
    place: PathBuf,
}

impl PreparedFile {
    /// Writes the content under a temporary name beside its place.
    fn write(place: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Self, FileError> {
        // The process and a counter keep apart those who write the same file at the same time.
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        let failed = |reason| FileError::new(FileAction::Write, place, reason);
        let name = place.file_name().ok_or_else(|| failed(io::Error::from(io::ErrorKind::InvalidFilename)))?;
        let count = COUNTER.fetch_add(1, Ordering::Relaxed);
        let temporary = place.with_file_name(format!(".{}.{}-{count}.tmp", name.to_string_lossy(), process::id()));

        let file = OpenOptions::new().write(true).create_new(true).open(&temporary).map_err(failed)?;
        let prepared = Self { temporary, place: place.to_owned() };
        fill(file, content).map_err(failed)?;
        Ok(prepared)
    }

    /// Refuses a place that no rename can take, before any file of a set is renamed.
    fn check_place(&self) -> Result<(), FileError> {
        if self.place.is_dir() {
            let reason = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(FileError::new(FileAction::Replace, &self.place, reason));
        }
        Ok(())
    }

    /// Puts the content under its own name.
    fn publish(self) -> Result<(), FileError> {
        fs::rename(&self.temporary, &self.place)
            .map_err(|reason| FileError::new(FileAction::Replace, &self.place, reason))
    }
}

impl Drop for PreparedFile {
    fn drop(&mut self) {
        // After a rename there is nothing left to remove, and nobody to tell if there is.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Writes content into a new file, down to the disk.
fn fill(file: File, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::with_capacity(1 << 16, file);
    content(&mut buffered)?;
    buffered.into_inner().map_err(|error| error.into_error())?.sync_all()
}

/// Whether a run came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completeness {
    /// It did: its files replace those of an earlier run, and what an interrupted run left is removed.
    Whole,
    /// It did not: its files go to the folder `partial`, and those of an earlier run stay.
    Partial,
}

/// Where the files of a run go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFolder {
    path: PathBuf,
}

/// List of the files in a `partial` folder, so that a later run removes these and nothing else.
const CONTENTS: &str = "contents.txt";

impl OutputFolder {
    /// Names a folder; it is created when files are prepared for it.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Returns the folder that holds the files of a whole or of an interrupted run.
    pub fn path(&self, completeness: Completeness) -> PathBuf {
        match completeness {
            Completeness::Whole => self.path.clone(),
            Completeness::Partial => self.path.join("partial"),
        }
    }

    /// Begins a set of files that are to appear together.
    pub fn prepare(&self, completeness: Completeness) -> Result<PreparedFiles, FileError> {
        let path = self.path(completeness);
        fs::create_dir_all(&path).map_err(|reason| FileError::new(FileAction::CreateFolder, &path, reason))?;
        Ok(PreparedFiles { folder: self.clone(), completeness, files: Vec::new() })
    }

    /// Puts files that were written into the `partial` folder by themselves on its list, so that a later run removes them too.
    pub fn list_partial(&self, files: &[PathBuf]) -> Result<(), FileError> {
        let partial = self.path(Completeness::Partial);
        let list = partial.join(CONTENTS);
        let mut contents = fs::read_to_string(&list).unwrap_or_default();
        for name in files.iter().filter_map(|file| file.strip_prefix(&partial).ok()?.to_str()) {
            contents = contents + name + "\n";
        }
        write_file(&list, |out| out.write_all(contents.as_bytes()))
    }

    /// Removes what an interrupted run left: the files on its list, then the list, then the folder if nothing else is in it.
    fn remove_partial(&self) -> Result<(), FileError> {
        let partial = self.path(Completeness::Partial);
        let list = partial.join(CONTENTS);
        let Ok(contents) = fs::read_to_string(&list) else { return Ok(()) };
        let is_inside = |name: &&str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        let listed = contents.lines().filter(|name| !name.is_empty()).filter(is_inside).map(|name| partial.join(name));
        let listed: Vec<PathBuf> = listed.collect();
        for file in listed.iter().chain([&list]) {
            match fs::remove_file(file) {
                Err(reason) if reason.kind() != io::ErrorKind::NotFound => {
                    return Err(FileError::new(FileAction::Remove, file, reason));
                }
                _ => {}
            }
        }
        // Somebody else's file keeps a folder alive.
        for folder in listed.iter().filter_map(|file| file.parent()).chain([&*partial]) {
            let _ = fs::remove_dir(folder);
        }
        Ok(())
    }
}

/// A set of files written under temporary names; dropped before [`publish`](Self::publish), it leaves no trace.
pub struct PreparedFiles {
    folder: OutputFolder,
    completeness: Completeness,
    files: Vec<PreparedFile>,
}

impl PreparedFiles {
    /// Writes the content of a file of this name under a temporary name.
    pub fn add(&mut self, name: &str, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), FileError> {
        let place = self.folder.path(self.completeness).join(name);
        self.files.push(PreparedFile::write(&place, content)?);
        Ok(())
    }

    /// Puts all files under their own names, and returns their paths.
    ///
    /// Every place is checked before the first rename. Should a rename fail all the same, the files before it are new,
    /// it and those after it are as they were; each is whole.
    pub fn publish(mut self) -> Result<Vec<PathBuf>, FileError> {
        let places: Vec<PathBuf> = self.files.iter().map(|file| file.place.clone()).collect();
        if self.completeness == Completeness::Partial {
            let names: Vec<_> = places.iter().filter_map(|place| place.file_name()?.to_str()).collect();
            let list = names.join("\n") + "\n";
            self.add(CONTENTS, |out| out.write_all(list.as_bytes()))?;
        }
        self.files.iter().try_for_each(PreparedFile::check_place)?;
        // A second interrupted run must not mix its files with those of the first; a whole one tidies up once it is safe.
        if self.completeness == Completeness::Partial {
            self.folder.remove_partial()?;
        }
        self.files.into_iter().try_for_each(PreparedFile::publish)?;
        if self.completeness == Completeness::Whole {
            self.folder.remove_partial()?;
        }
        Ok(places)
    }
}
