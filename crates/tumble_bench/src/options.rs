//! What all programs that run scenes can be asked on the command line.

use clap::Args;

use crate::line::Line;
use crate::scenes::{self, AnyPlan, Scene};

/// How to run scenes.
#[derive(Clone, Copy, Debug, Args)]
pub struct RunOptions {
    /// Threads that the engine may use.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub threads: u32,
    /// Steps of a run; each scene has a number of its own.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: Option<u32>,
    /// Print the names of the columns first.
    #[arg(long)]
    pub header: bool,
}

/// What a peer of tumble is asked: some scenes, and how to run them.
#[derive(Clone, Debug, clap::Parser)]
pub struct PeerArguments {
    /// A scene of tumble_bench, or a series.
    #[arg(value_name = "SCENE", value_parser = some_scenes)]
    pub scenes: Scenes,
    /// How to run them.
    #[command(flatten)]
    pub options: RunOptions,
    /// Which solver settings: substeps, or iterations that do as much; the engine's default unless given.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub substeps: Option<u32>,
}

/// A scene, or all sizes of a series.
#[derive(Clone, Debug)]
pub struct Scenes(pub Vec<Scene>);

/// Reads the name of a scene or series.
///
/// # Errors
///
/// When there is none of that name.
pub fn some_scenes(name: &str) -> Result<Scenes, scenes::UnknownScene> {
    scenes::find(name).map(Scenes)
}

/// Runs every scene and prints its line.
///
/// # Errors
///
/// When one of them fails.
pub fn print_lines<E>(
    scenes: &Scenes,
    options: &RunOptions,
    mut run: impl FnMut(AnyPlan) -> Result<Line, E>,
) -> Result<(), E> {
    if options.header {
        println!("{}", Line::HEADER);
    }
    for scene in &scenes.0 {
        println!("{}", run(scene.plan())?);
    }
    Ok(())
}
