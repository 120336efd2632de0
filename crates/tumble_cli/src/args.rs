//! The command line.

use std::num::NonZero;
use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, value_parser};
use tumble_record::{Channel, body_quantity_names, joint_quantity_names, world_names};
use tumble_scene::Variation;
use tumble_scene::format::ContactModel;

/// Rigid bodies in contact, simulated headless: exact, exchangeable, reproducible.
///
/// Without a command, the scene `homework_rods` runs: an L, a T and a star of rods dropped on a floor.
#[derive(Debug, Parser)]
#[command(name = "tumble", version, propagate_version = true, max_term_width = 100, after_help = EXIT_CODES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  fine
  1  an expectation failed
  2  wrong arguments, or a scene with mistakes
  3  the run itself failed or was interrupted, or its files could not be written";

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene, and write down what happened
    Run(RunArguments),
    /// List the scenes that come with the program
    Scenes,
    /// Look for mistakes and print masses and friction, without running anything
    Check(CheckArguments),
    /// Run scenes and tell which of their expectations hold
    Test(TestArguments),
    /// Run a scene under several contact models and step sizes, side by side
    Compare(CompareArguments),
    /// Run a scene many times with some of its numbers varied, and tell how each run ended
    Batch(BatchArguments),
    /// Print how far each contact model is from closed forms, as the table in the README
    Accuracy,
    /// Print the JSON Schema of the scene format
    Schema,
}

/// Run a scene.
#[derive(Args, Debug, Default)]
#[command(after_help = after_run_help())]
pub struct RunArguments {
    /// A scene file, or the name of a shipped scene (see `tumble scenes`); default: homework_rods
    ///
    /// What contains a `/` or ends in `.ron` is a file, everything else the name of a shipped scene.
    #[arg(value_name = "SCENE")]
    pub scene: Option<PathBuf>,
    /// Folder for the files; default: out/<scene name>
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub overrides: Overrides,
    /// Write the trajectory and the contacts of every N-th step only; the first and the last are always there
    ///
    /// Sums (audit.csv) are of every step and expectations look at the steps they need all the same.
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..), allow_negative_numbers = true)]
    pub every: Option<u32>,
    /// Draw a quantity over time, such as `total` or `y:ball`; may be repeated
    #[arg(long = "plot", value_name = "CHANNEL[:BODY]")]
    pub plots: Vec<Channel>,
    /// Also write scene.gltf, an animation that viewers of models open
    #[arg(long)]
    pub gltf: bool,
    /// Also draw N pictures, evenly spaced over the run: frames/0000.png, … and scene.gif
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..), allow_negative_numbers = true)]
    pub frames: Option<u32>,
    /// Number of threads that share the steps of large scenes under soft-step; default: 1. The bits are the same whatever it is
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZero<usize>>,
    /// Print only failed expectations and errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// What the command line says in the scene's place.
#[derive(Args, Clone, Debug, Default)]
pub struct Overrides {
    /// Another contact model than the scene's
    #[arg(long, value_name = "MODEL", value_parser = contact_model())]
    pub contact: Option<ContactModel>,
    /// Another time step than the scene's [s]
    #[arg(long, value_name = "S", value_parser = seconds, allow_hyphen_values = true)]
    pub dt: Option<f64>,
    /// Another duration than the scene's [s]
    #[arg(long, value_name = "S", value_parser = seconds, allow_hyphen_values = true)]
    pub duration: Option<f64>,
}

impl Overrides {
    /// Whether the scene runs as it was written.
    pub fn are_none(&self) -> bool {
        self.contact.is_none() && self.dt.is_none() && self.duration.is_none()
    }
}

/// Check scenes.
#[derive(Args, Debug)]
pub struct CheckArguments {
    /// Scene files, or names of shipped scenes
    #[arg(value_name = "SCENE", required = true)]
    pub scenes: Vec<PathBuf>,
}

/// Test scenes.
#[derive(Args, Debug)]
pub struct TestArguments {
    /// Scene files, folders with scene files (*.ron) at any depth, or names of shipped scenes
    #[arg(value_name = "PATH", required = true)]
    pub paths: Vec<PathBuf>,
    /// Run under this contact model, and ask only for the expectations claimed for it
    #[arg(long, value_name = "MODEL", value_parser = contact_model())]
    pub contact: Option<ContactModel>,
}

/// Compare contact models and step sizes.
#[derive(Args, Debug)]
#[command(after_help = after_compare_help())]
pub struct CompareArguments {
    /// A scene file, or the name of a shipped scene (see `tumble scenes`)
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Contact models; default: all for which the scene claims something, or simply all if it claims nothing
    #[arg(long, value_name = "MODEL,…", value_delimiter = ',', value_parser = contact_model())]
    pub contact: Vec<ContactModel>,
    /// Time steps [s], up to four for several models, drawn from broad to fine; default: the scene's
    #[arg(long, value_name = "S,…", value_delimiter = ',', value_parser = seconds, allow_hyphen_values = true)]
    pub dt: Vec<f64>,
    /// Measure how far bodies are from where this model has them, with a sixteenth of the smallest step;
    /// default: the scene's own model if nothing is expected, else none
    #[arg(long, value_name = "MODEL", value_parser = contact_model())]
    pub reference: Option<ContactModel>,
    /// The quantity that is drawn for all runs, such as `y:ball`; default: total
    #[arg(long, value_name = "CHANNEL[:BODY]")]
    pub plot: Option<Channel>,
    /// Folder for the files; default: out/<scene name>/compare
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Run a scene many times.
#[derive(Args, Debug)]
#[command(after_help = after_batch_help())]
pub struct BatchArguments {
    /// A scene file, or the name of a shipped scene (see `tumble scenes`)
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Number of runs
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..), allow_negative_numbers = true)]
    pub runs: u64,
    /// Draw a number of the scene anew for each run, uniformly from A up to B; may be repeated
    ///
    /// PATH leads to the number by names of fields, bodies, joints and materials, and by x, y, z, with dots between them:
    /// bodies.rod.velocity.x, gravity.y, materials.wood.static_friction; numbers count the places of other lists from 0:
    /// bodies.rod.parts.0.density.
    #[arg(long = "vary", value_name = "PATH=A..B")]
    pub variations: Vec<Variation>,
    /// Chooses the random numbers: run i draws from stream i of this seed, whichever others run
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// Also write the last value of a quantity, such as `y:ball`; may be repeated
    #[arg(long = "show", value_name = "CHANNEL[:BODY]")]
    pub shown: Vec<Channel>,
    /// File for the table; default: out/<scene name>/batch.csv
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Only the I-th of K parts of the runs, I from 1 to K; the tables of all parts one after the other are that of all runs
    #[arg(long, value_name = "I/K", default_value = "1/1")]
    pub shard: Shard,
    /// Number of threads; default: one per core
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<NonZero<usize>>,
    #[command(flatten)]
    pub overrides: Overrides,
}

/// A part of the runs of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which part, counted from 1.
    part: u64,
    /// Number of parts.
    of: u64,
}

impl Shard {
    /// The runs of this part; parts are as large as each other, to one run.
    pub fn of(self, runs: u64) -> Range<u64> {
        let until = |part: u64| (u128::from(runs) * u128::from(part) / u128::from(self.of)) as u64;
        until(self.part - 1)..until(self.part)
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text.split_once('/').and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((part, of)) if (1..=of).contains(&part) => Ok(Self { part, of }),
            _ => Err("it must be I/K with I from 1 to K, such as 2/8"),
        }
    }
}

fn contact_model() -> impl TypedValueParser<Value = ContactModel> {
    PossibleValuesParser::new(ContactModel::ALL.map(ContactModel::word))
        .try_map(|word| ContactModel::from_word(&word).ok_or("unknown contact model"))
}

/// Reads a positive number of seconds.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        Ok(_) => Err("it must be positive and finite".to_owned()),
        Err(_) => Err("it must be a number of seconds, such as 0.01".to_owned()),
    }
}

/// More threads than this are a mistake: starting them would take longer than any run.
const MOST_THREADS: usize = 256;

/// Reads a number of threads.
fn threads(text: &str) -> Result<NonZero<usize>, String> {
    let number = text.parse().ok().and_then(NonZero::new).filter(|number| number.get() <= MOST_THREADS);
    number.ok_or_else(|| format!("it must be a number from 1 to {MOST_THREADS}"))
}

fn channels() -> String {
    format!(
        "Channels of the world: {}\nChannels of a body (CHANNEL:BODY): {}\nChannels of a joint (CHANNEL:JOINT): {}",
        world_names().join(", "),
        body_quantity_names().join(", "),
        joint_quantity_names().join(", ")
    )
}

fn after_compare_help() -> String {
    format!(
        "Columns: expectations that hold, of those claimed for the model; the largest part of its tolerance that one of them uses;\n\
         energy gained or lost, of the energy in play; deepest overlap; largest residual of the contact solver, in its own measure;\n\
         drift of the bodies that the scene expects at rest, over the last tenth of the run; time per step, recording included.\n\n\
         Files: compare.csv (the table) and compare.svg (the curves), whole or not at all. A failed expectation does not fail the\n\
         comparison; of a run that fails the table says so, and the exit code is 3 only if no run came to its end.\n\n{}\n\n{EXIT_CODES}",
        channels()
    )
}

fn after_batch_help() -> String {
    format!(
        "Columns: run, the varied numbers, steps, time, fingerprint (that of the same scene run by itself), the quantities shown, and\n\
         error: why a run has failed. The table appears whole; when interrupted, the rows so far are in FILE.partial.\n\
         Expectations are not looked at. The exit code is 3 if a run failed.\n\n{}\n\n{EXIT_CODES}",
        channels()
    )
}

fn after_run_help() -> String {
    format!(
        "Files: trajectory.csv, contacts.csv, audit.csv, touches.csv, joints.csv (of scenes with joints), summary.json, energy.svg, replay.html, and an SVG per plot;\n\
         with --gltf scene.gltf, with --frames frames/0000.png, … and scene.gif.\n\
         They appear whole or not at all; of a run that fails or is interrupted, DIR/partial/ holds the samples so far.\n\n\
         With --contact, --dt or --duration the expectations are told, but a failed one does not fail the run.\n\n\
         {}\nWithout :BODY or :JOINT, a channel shows every moving body or joint.\n\n{EXIT_CODES}",
        channels()
    )
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn shards_are_all_runs_once_and_about_as_large() {
        for (runs, of) in [(10, 3), (2, 5), (7, 7), (u64::MAX, 2)] {
            let mut next = 0;
            for part in 1..=of {
                let range = format!("{part}/{of}").parse::<Shard>().unwrap().of(runs);
                assert_eq!(range.start, next);
                assert!((runs / of..=runs / of + 1).contains(&(range.end - range.start)));
                next = range.end;
            }
            assert_eq!(next, runs);
        }
        for wrong in ["", "1", "0/2", "3/2", "1/0", "-1/2", "a/b"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn seconds_are_positive_and_finite() {
        assert_eq!(seconds("0.25"), Ok(0.25));
        for wrong in ["0", "-0", "-1", "NaN", "inf", "-inf", "1e400", "", "1s", "0,5"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
