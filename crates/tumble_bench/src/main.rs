//! Speed and memory of tumble: `cargo run --release -p tumble_bench`.
//!
//! With a scene it runs that and prints a line of CSV, as the programs of its peers do. Without one it answers [questions](questions::Question)
//! about single costs: machines are noisy, so each answer is a ratio of figures measured in turn within one run, and each figure is
//! the fastest of several rounds.

mod engine;
mod profile;
mod questions;

use std::error::Error;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use tumble_bench::memory::held_bytes;
use tumble_bench::options::{Scenes, print_lines, some_scenes};
use tumble_bench::run::{Run, run};
use tumble_bench::scenes::SCENES;
use tumble_bench::{AnyPlan, Line, RunOptions};
use tumble_sim::ContactModel;

use engine::{Tumble, TumbleError};
use profile::Profile;
use questions::Question;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// Speed and memory of tumble.
#[derive(Debug, Parser)]
#[command(after_help = after_help())]
struct Arguments {
    /// A question, a scene or a series of scenes; all questions but `simbenchmark` unless given.
    #[arg(value_name = "QUESTION|SCENE", value_parser = what)]
    what: Option<What>,
    /// How to run scenes; `--steps` also of `settle` (600 unless given).
    #[command(flatten)]
    options: RunOptions,
    /// Contact model; of scenes soft-step unless given, of `settle` soft-step and impulse.
    #[arg(long, value_parser = contact_model)]
    contact: Option<ContactModel>,
    /// Tell on standard error how long each phase of a step took (scenes).
    #[arg(long)]
    profile: bool,
    /// Scene of `simbenchmark`; all four unless given.
    #[arg(long)]
    scene: Option<String>,
    /// Smallest time step of `simbenchmark` [s].
    #[arg(long, default_value_t = 1e-4)]
    smallest_step: f64,
    /// Bodies of `settle`.
    #[arg(long, default_value_t = 2000)]
    bodies: usize,
    /// Rounds of each figure of a question; the fastest counts.
    #[arg(long, default_value_t = 5)]
    rounds: u32,
}

/// What the program was asked for.
#[derive(Clone, Debug)]
enum What {
    Question(Question),
    Scenes(Scenes),
}

fn what(word: &str) -> Result<What, String> {
    if let Ok(question) = Question::from_str(word, false) {
        return Ok(What::Question(question));
    }
    let questions = Question::value_variants().iter().filter_map(Question::to_possible_value);
    let questions: Vec<String> = questions.map(|value| value.get_name().to_owned()).collect();
    some_scenes(word).map(What::Scenes).map_err(|error| format!("{error}; questions are: {}", questions.join(", ")))
}

fn contact_model(word: &str) -> Result<ContactModel, String> {
    let known = || ContactModel::ALL.map(ContactModel::word).join(", ");
    ContactModel::ALL
        .into_iter()
        .find(|model| model.word() == word)
        .ok_or_else(|| format!("expected one of: {}", known()))
}

fn after_help() -> String {
    let mut help = String::from("Questions:\n");
    for value in Question::value_variants().iter().filter_map(Question::to_possible_value) {
        let about = value.get_help().map(ToString::to_string).unwrap_or_default();
        help += &format!("  {:<16} {about}\n", value.get_name());
    }
    help += "\nScenes, each a line of CSV; growth2d and growth3d are all sizes of a series:\n";
    for scene in SCENES {
        help += &format!("  {:<16} {}\n", scene.name, scene.about);
    }
    help
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done: Result<(), Box<dyn Error>> = match &arguments.what {
        Some(What::Scenes(scenes)) => {
            print_lines(scenes, &arguments.options, |plan| run_scene(&plan, &arguments)).map_err(Into::into)
        }
        Some(What::Question(question)) => question.answer(&arguments),
        None => {
            let quick = |question: &&Question| **question != Question::Simbenchmark;
            Question::value_variants().iter().filter(quick).try_for_each(|question| question.answer(&arguments))
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("tumble_bench: {error}");
            ExitCode::from(3)
        }
    }
}

fn run_scene(plan: &AnyPlan, arguments: &Arguments) -> Result<Line, TumbleError> {
    let contact = arguments.contact.unwrap_or(ContactModel::SoftStep);
    let profile = arguments.profile.then(Profile::default);
    let version = match contact {
        ContactModel::SoftStep => env!("CARGO_PKG_VERSION").to_owned(),
        other => format!("{}-{}", env!("CARGO_PKG_VERSION"), other.word()),
    };
    let RunOptions { threads, steps, .. } = arguments.options;
    let how = Run { engine: "tumble", version: &version, threads, steps, held_bytes: || held_bytes(ALLOCATOR) };
    let line = match plan {
        AnyPlan::Planar(plan) => run(plan, &how, |plan| Tumble::new(plan, contact, threads, profile.as_ref())),
        AnyPlan::Spatial(plan) => run(plan, &how, |plan| Tumble::new(plan, contact, threads, profile.as_ref())),
    }?;
    if let Some(profile) = profile {
        eprint!("{}\n{profile}", line.scene);
    }
    Ok(line)
}
