//! Running the real program in a folder of its own.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::cargo_bin;
use tempfile::TempDir;

/// A ball that falls 0.1 s onto nothing; its expectation is met.
pub const FALLING: &str = r#"(
    format: 1, about: "A ball falls.", duration: 0.1, gravity: (0, -10),
    bodies: [(name: "ball", parts: [Disc(radius: 0.5, mass: 2)])],
    expect: [VelocityY(of: "ball", at: 0.1, is: -1, within: 1e-9, because: "v = g t")],
)"#;

/// The same, with an expectation that is not met.
pub const BROKEN_PROMISE: &str = r#"(
    format: 1, duration: 0.1, gravity: (0, -10),
    bodies: [(name: "ball", parts: [Disc(radius: 0.5)])],
    expect: [VelocityY(of: "ball", at: 0.1, is: 1, within: 0.5, because: "balls fall up")],
)"#;

/// 1e308 N on 1e-3 kg overflow in the step that ends at 0.5 s.
pub const EXPLODING: &str = r#"(
    format: 1, duration: 1,
    bodies: [(name: "victim", parts: [Disc(radius: 0.5, mass: 1e-3)]), (name: "witness", at: (5, 0), parts: [Disc(radius: 1)])],
    forces: [(on: "victim", force: (1e308, 0), from: 0.5)],
    expect: [
        Y(of: "witness", at: 0.1, is: -0.05, within: 0.01, because: "free fall"),
        Y(of: "witness", at: 0.9, is: -4, within: 1, because: "free fall"),
    ],
)"#;

/// A folder that vanishes, and the program run in it.
pub struct Bench {
    folder: TempDir,
}

/// How a run of the program ended.
#[derive(Debug)]
pub struct Ended {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Bench {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("inside the folder")).expect("a folder");
        fs::write(&path, content).expect("a file");
        path
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Names in a folder, sorted.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name")).collect();
        names.sort();
        names
    }

    pub fn command(&self, arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Command {
        let mut command = Command::new(cargo_bin("tumble"));
        command.current_dir(self.folder.path()).args(arguments).stdin(Stdio::null()).env_remove("CLICOLOR_FORCE");
        command
    }

    pub fn tumble(&self, arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Ended {
        ended(self.command(arguments).output().expect("the program runs"))
    }
}

pub fn ended(output: Output) -> Ended {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program prints UTF-8");
    let ended =
        Ended { code: output.status.code().unwrap_or(-1), stdout: text(output.stdout), stderr: text(output.stderr) };
    assert!(!ended.stderr.contains("panicked"), "{ended:?}");
    ended
}

impl Ended {
    /// Checks the exit code.
    #[track_caller]
    pub fn code(self, code: i32) -> Self {
        assert_eq!(self.code, code, "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    /// Checks that standard error says this.
    #[track_caller]
    pub fn complains(self, words: &str) -> Self {
        assert!(self.stderr.contains(words), "no `{words}` in:\n{}", self.stderr);
        self
    }

    /// Checks that standard output says this.
    #[track_caller]
    pub fn says(self, words: &str) -> Self {
        assert!(self.stdout.contains(words), "no `{words}` in:\n{}", self.stdout);
        self
    }

    /// What stands behind a name in the table of numbers.
    #[track_caller]
    pub fn number(&self, name: &str) -> String {
        let line = self.stdout.lines().find_map(|line| line.strip_prefix(name));
        line.unwrap_or_else(|| panic!("no `{name}` in:\n{}", self.stdout)).trim().to_owned()
    }
}
