//! What can go wrong, and the exit code that tells it.

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use tumble_record::{ChannelError, FileError, OutputError};
use tumble_scene::BuildError;
use tumble_scene::diagnostics::{Color, Diagnostics};

/// How the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: fine.
    Fine,
    /// 1: an expectation failed.
    ExpectationFailed,
    /// 2: wrong arguments or scene.
    Refused,
    /// 3: the run itself failed.
    RunFailed,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Fine => 0,
            Exit::ExpectationFailed => 1,
            Exit::Refused => 2,
            Exit::RunFailed => 3,
        })
    }
}

/// Why the program cannot do what it was asked to.
#[derive(Debug)]
pub enum Failure {
    /// Arguments that mean nothing.
    Arguments(String),
    /// A scene with mistakes.
    Scene(Diagnostics),
    /// A scene that cannot be built; its name comes first.
    Build(String, BuildError),
    /// A run that failed.
    Run(String),
}

impl Failure {
    /// Why this scene could not be built.
    pub fn of_build(scene: &str, error: BuildError) -> Self {
        match error {
            BuildError::Scene(diagnostics) => Self::Scene(diagnostics),
            other => Self::Build(scene.to_owned(), other),
        }
    }

    /// The exit code that tells it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Arguments(_) | Self::Scene(_) | Self::Build(..) => Exit::Refused,
            Self::Run(_) => Exit::RunFailed,
        }
    }

    /// The failure in words.
    pub fn words(&self, color: Color) -> String {
        match self {
            Self::Scene(diagnostics) => diagnostics.render(color),
            Self::Build(scene, error) => format!("error: {scene}: {error}"),
            Self::Arguments(message) | Self::Run(message) => format!("error: {message}"),
        }
    }

    /// Prints the failure to standard error; returns how the program ends.
    pub fn tell(&self) -> Exit {
        tell(self.words(stderr_color()));
        self.exit()
    }
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Scene(diagnostics)
    }
}

impl From<ChannelError> for Failure {
    fn from(error: ChannelError) -> Self {
        Self::Arguments(error.to_string())
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::Run(error.to_string())
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::File(error) => error.into(),
            OutputError::Channel(error) => error.into(),
        }
    }
}

/// Prints to standard error, if anybody listens.
pub fn tell(text: impl Display) {
    // Nowhere is left to complain when standard error is closed.
    let _ = writeln!(io::stderr(), "{text}");
}

/// Colours for a terminal, unless the user wants none (`NO_COLOR`).
pub fn stderr_color() -> Color {
    color_for(&io::stderr())
}

/// Colours for a terminal, unless the user wants none (`NO_COLOR`).
pub fn color_for(stream: &impl IsTerminal) -> Color {
    let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if stream.is_terminal() && !unwanted { Color::Always } else { Color::Never }
}
