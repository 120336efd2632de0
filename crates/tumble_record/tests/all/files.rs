//! Files appear whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use tumble_record::{Completeness, FileAction, OutputFolder, write_file};

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder can be listed");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn good(text: &'static str) -> impl FnOnce(&mut dyn Write) -> io::Result<()> {
    move |out| out.write_all(text.as_bytes())
}

/// Writes half of the content, then fails as a full disk does.
fn disk_full(out: &mut dyn Write) -> io::Result<()> {
    out.write_all(&[b'x'; 200_000])?;
    Err(io::Error::from(io::ErrorKind::StorageFull))
}

#[test]
fn new_content_replaces_the_old() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.csv");
    for text in ["first", "second"] {
        write_file(&path, good(text)).expect("it can be written");
        assert_eq!(fs::read_to_string(&path).expect("it can be read"), text);
    }
    assert_eq!(names_in(folder.path()), ["a.csv"]);
}

#[test]
fn failure_halfway_keeps_the_earlier_file_and_leaves_no_trace() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.csv");
    write_file(&path, good("earlier")).expect("it can be written");
    let error = write_file(&path, disk_full).expect_err("the disk is full");
    assert_eq!(error.action, FileAction::Write);
    assert_eq!(error.reason.kind(), io::ErrorKind::StorageFull);
    assert!(error.to_string().starts_with(&format!("cannot write `{}`: ", path.display())), "{error}");
    assert_eq!(fs::read_to_string(&path).expect("it can be read"), "earlier");
    assert_eq!(names_in(folder.path()), ["a.csv"]);
}

#[test]
fn absent_folder_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("absent").join("a.csv");
    let error = write_file(&path, good("")).expect_err("the folder is absent");
    assert_eq!((error.action, error.reason.kind()), (FileAction::Write, io::ErrorKind::NotFound));
    assert!(error.to_string().contains("absent"), "{error}");
}

#[test]
fn folder_in_the_place_of_a_file_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.csv");
    fs::create_dir(&path).expect("a folder");
    let error = write_file(&path, good("")).expect_err("the place is taken");
    assert_eq!((error.action, error.reason.kind()), (FileAction::Replace, io::ErrorKind::IsADirectory));
    assert_eq!(names_in(folder.path()), ["a.csv"]);
}

#[test]
fn file_in_the_place_of_the_output_folder_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    fs::write(&path, "a file").expect("it can be written");
    let error = OutputFolder::new(&path).prepare(Completeness::Whole).err().expect("the place is taken");
    assert_eq!((error.action, &error.path), (FileAction::CreateFolder, &path));
}

#[test]
fn path_without_a_file_name_is_refused() {
    let error = write_file(Path::new("/"), good("")).expect_err("no name");
    assert_eq!(error.action, FileAction::Write);
}

#[test]
fn set_appears_together_and_creates_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path().join("deep/out"));
    let mut files = out.prepare(Completeness::Whole).expect("a set");
    files.add("a", good("a")).expect("it can be written");
    files.add("b", good("b")).expect("it can be written");
    let place = out.path(Completeness::Whole);
    assert!(!place.join("a").exists(), "nothing appears before all is written");
    assert_eq!(files.publish().expect("the set appears"), [place.join("a"), place.join("b")]);
    assert_eq!(names_in(&place), ["a", "b"]);
}

#[test]
fn one_bad_file_keeps_the_whole_earlier_set() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path());
    fs::write(folder.path().join("a"), "earlier").expect("it can be written");
    fs::create_dir(folder.path().join("b")).expect("a folder in the place of b");

    let mut files = out.prepare(Completeness::Whole).expect("a set");
    files.add("a", good("new")).expect("it can be written");
    files.add("b", good("new")).expect("it can be written");
    files.publish().expect_err("b cannot be replaced");
    assert_eq!(fs::read_to_string(folder.path().join("a")).expect("it can be read"), "earlier");

    let mut files = out.prepare(Completeness::Whole).expect("a set");
    files.add("a", good("new")).expect("it can be written");
    files.add("c", disk_full).expect_err("the disk is full");
    drop(files);
    assert_eq!(fs::read_to_string(folder.path().join("a")).expect("it can be read"), "earlier");
    assert_eq!(names_in(folder.path()), ["a", "b"]);
}

#[test]
fn interrupted_run_leaves_earlier_files_and_the_next_whole_run_removes_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path());
    let write = |completeness, names: &[&str]| {
        let mut files = out.prepare(completeness).expect("a set");
        names.iter().for_each(|name| files.add(name, good("text")).expect("it can be written"));
        files.publish().expect("the set appears");
    };
    write(Completeness::Whole, &["a"]);
    write(Completeness::Partial, &["a", "b"]);
    assert_eq!(names_in(folder.path()), ["a", "partial"]);
    write(Completeness::Partial, &["a", "c"]);
    assert_eq!(
        names_in(&folder.path().join("partial")),
        ["a", "c", "contents.txt"],
        "b of the first interrupted run is gone"
    );
    write(Completeness::Whole, &["a"]);
    assert_eq!(names_in(folder.path()), ["a"]);
}

#[test]
fn files_of_others_in_the_partial_folder_are_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path());
    let mut files = out.prepare(Completeness::Partial).expect("a set");
    files.add("a", good("text")).expect("it can be written");
    files.publish().expect("the set appears");
    fs::write(folder.path().join("partial/mine"), "mine").expect("it can be written");
    out.prepare(Completeness::Whole).expect("a set").publish().expect("the empty set appears");
    assert_eq!(names_in(&folder.path().join("partial")), ["mine"]);
}
