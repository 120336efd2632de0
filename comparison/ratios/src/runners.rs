//! The programs that are run.

use std::path::{Path, PathBuf};
use std::process::Command;

use tumble_bench::Line;
use tumble_bench::line::LineError;
use tumble_bench::scenes::Scene;

/// Which scenes a program knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Knows {
    Plane,
    Space,
    Both,
}

/// The peers: their programs and what they know.
const PEERS: [(&str, Knows); 4] = [
    ("peer_box2d", Knows::Plane),
    ("rapier2d", Knows::Plane),
    ("peer_box3d", Knows::Space),
    ("rapier3d", Knows::Space),
];

/// A program that runs scenes.
#[derive(Debug)]
pub struct Runner {
    program: PathBuf,
    knows: Knows,
}

/// Why a run has no result.
#[derive(Debug, thiserror::Error)]
pub enum RunnerError {
    /// The program is not where it should be.
    #[error("there is no {0}: build it first (see the README of the comparison)")]
    Missing(PathBuf),
    /// Nobody knows where this program is.
    #[error("this program does not know where it is: {0}")]
    Lost(std::io::Error),
    /// It could not be started.
    #[error("{program}: {error}")]
    Start {
        /// The program.
        program: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It ended with an error.
    #[error("{program} {scene}: {message}")]
    Failed {
        /// The program.
        program: PathBuf,
        /// The scene.
        scene: String,
        /// What it said.
        message: String,
    },
    /// Its line cannot be read.
    #[error("{program} {scene}: {error}")]
    Line {
        /// The program.
        program: PathBuf,
        /// The scene.
        scene: String,
        /// Why.
        error: LineError,
    },
}

/// tumble's program, and those of the peers that are built.
pub fn find(tumble: Option<&Path>, peers: Option<&Path>) -> Result<Vec<Runner>, RunnerError> {
    let this = std::env::current_exe().map_err(RunnerError::Lost)?;
    let folder = this.parent().unwrap_or(Path::new("."));
    // <root>/comparison/target/release, as cargo lays it out.
    let root = folder.ancestors().nth(3).unwrap_or(folder);
    let tumble = tumble.map_or_else(|| root.join("target/release/tumble_bench"), Path::to_path_buf);
    if !tumble.exists() {
        return Err(RunnerError::Missing(tumble));
    }
    let mut runners = vec![Runner { program: tumble, knows: Knows::Both }];
    for (name, knows) in PEERS {
        let program = peers.unwrap_or(folder).join(name);
        if program.exists() {
            runners.push(Runner { program, knows });
        } else {
            eprintln!("ratios: without {name}, which is not built");
        }
    }
    Ok(runners)
}

impl Runner {
    /// Whether it knows a scene.
    pub fn runs(&self, scene: &Scene) -> bool {
        let other = if scene.is_planar() { Knows::Space } else { Knows::Plane };
        self.knows != other
    }

    /// Runs a scene.
    pub fn run(&self, scene: &Scene, threads: u32, steps: Option<u32>) -> Result<Line, RunnerError> {
        let mut command = Command::new(&self.program);
        command.arg(scene.name).arg("--threads").arg(threads.to_string());
        if let Some(steps) = steps {
            command.arg("--steps").arg(steps.to_string());
        }
        let (program, scene) = (self.program.clone(), scene.name.to_owned());
        let output = command.output().map_err(|error| RunnerError::Start { program: program.clone(), error })?;
        let text = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            let message = format!("{}, {}", output.status, String::from_utf8_lossy(&output.stderr).trim());
            return Err(RunnerError::Failed { program, scene, message });
        }
        // Engines may have something to say before and after it.
        let found = text.lines().rev().find_map(|line| line.parse().ok());
        let last = text.lines().last().unwrap_or_default();
        found.map_or_else(|| last.parse().map_err(|error| RunnerError::Line { program, scene, error }), Ok)
    }
}
