//! tumble and its peers side by side: runs them in turn on the same scenes, takes the best round of each, and prints ratios in Markdown.
//!
//! What else the machine does falls on all of them alike, because within a round they run back to back.

mod results;
mod runners;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use tumble_bench::scenes::{self, Scene};

use results::Results;
use runners::RunnerError;

/// Scenes that are run unless others are asked for, with fewer steps than they have by themselves where these show the same.
const USUAL: [(&str, Option<u32>); 13] = [
    ("pyramid2d", Some(200)),
    ("many_pyramids2d", Some(60)),
    ("tumbler2d", Some(300)),
    ("rods2d", Some(300)),
    ("rain2d", Some(300)),
    ("junkyard2d", Some(300)),
    ("rod_one2d", None),
    ("pyramid3d", Some(80)),
    ("wall3d", Some(150)),
    ("balls3d", Some(200)),
    ("drop3d", Some(250)),
    ("tumbler3d", Some(250)),
    ("rod_one3d", None),
];

/// tumble and its peers on the same scenes, in turn.
#[derive(Debug, Parser)]
struct Arguments {
    /// Scenes or series of tumble_bench; all but the series unless given.
    scenes: Vec<String>,
    /// Numbers of threads, one after the other.
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2], value_parser = clap::value_parser!(u32).range(1..))]
    threads: Vec<u32>,
    /// Rounds; the best of each engine counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Steps of every run.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
    /// Program of tumble; the one that `cargo build --release -p tumble_bench` makes unless given.
    #[arg(long)]
    tumble: Option<PathBuf>,
    /// Folder with the programs of the peers; that of this program unless given.
    #[arg(long)]
    peers: Option<PathBuf>,
    /// Print every run's line on standard error.
    #[arg(long)]
    lines: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match compare(&arguments) {
        Ok(results) => {
            print!("{results}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("ratios: {error}");
            ExitCode::from(2)
        }
    }
}

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
enum CompareError {
    #[error(transparent)]
    Scene(#[from] scenes::UnknownScene),
    #[error(transparent)]
    Runner(#[from] RunnerError),
}

fn compare(arguments: &Arguments) -> Result<Results, CompareError> {
    let runners = runners::find(arguments.tumble.as_deref(), arguments.peers.as_deref())?;
    let scenes = scenes_to_run(arguments)?;
    let mut results = Results::default();
    for round in 1..=arguments.rounds {
        for (scene, steps) in &scenes {
            for threads in &arguments.threads {
                for runner in runners.iter().filter(|runner| runner.runs(scene)) {
                    let line = runner.run(scene, *threads, *steps)?;
                    if arguments.lines {
                        eprintln!("{line}");
                    }
                    results.add(line);
                }
            }
        }
        eprintln!("round {round} of {} done", arguments.rounds);
    }
    Ok(results)
}

fn scenes_to_run(arguments: &Arguments) -> Result<Vec<(Scene, Option<u32>)>, scenes::UnknownScene> {
    let usual_steps = |scene: &Scene| USUAL.iter().find(|(name, _)| *name == scene.name).and_then(|(_, steps)| *steps);
    let names: Vec<&str> = match &arguments.scenes[..] {
        [] => USUAL.iter().map(|(name, _)| *name).collect(),
        asked => asked.iter().map(String::as_str).collect(),
    };
    let mut scenes = Vec::new();
    for name in names {
        scenes.extend(scenes::find(name)?.into_iter().map(|scene| (scene, arguments.steps.or(usual_steps(&scene)))));
    }
    Ok(scenes)
}
