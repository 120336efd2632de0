//! `tumble batch`: one scene many times, with numbers varied.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tumble_record::{FileAction, FileError, write_file};
use tumble_scene::{AnyLoaded, Batch, BatchRun, Loaded, SceneDim};

use crate::args::BatchArguments;
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::counted;
use crate::interrupt;
use crate::page::Page;
use crate::run::OUT;
use crate::simulate::Prepared;
use crate::source::Source;

/// Runs between two looks at the clock and at Ctrl-C are to take about this long.
const LOOK: Duration = Duration::from_millis(300);

/// Runs a scene many times, and writes a table of how the runs ended.
pub fn batch(arguments: &BatchArguments, page: &mut Page) -> Result<Exit, Failure> {
    let source = Source::of(&arguments.scene)?;
    match source.load()? {
        AnyLoaded::Planar(loaded) => batch_loaded(arguments, &source, loaded, page),
        AnyLoaded::Spatial(loaded) => batch_loaded(arguments, &source, loaded, page),
    }
}

fn batch_loaded<D: SceneDim>(
    arguments: &BatchArguments,
    source: &Source,
    loaded: Loaded<D>,
    page: &mut Page,
) -> Result<Exit, Failure> {
    if !loaded.warnings.is_empty() {
        tell(loaded.warnings.render(stderr_color()));
    }
    let prepared = Prepared::new(source, loaded, &arguments.overrides, None)?;
    let refused = |message: String| Failure::Arguments(message);
    let batch = Batch::new(&prepared.loaded, arguments.variations.clone(), arguments.seed)
        .map_err(|error| error.to_string())
        .and_then(|batch| batch.showing(arguments.shown.clone()))
        .map_err(refused)?;
    let out = arguments.out.clone().unwrap_or_else(|| Path::new(OUT).join(source.stem()).join("batch.csv"));
    // A place that cannot be written is told before the runs.
    if let Some(folder) = out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|reason| FileError::new(FileAction::CreateFolder, folder, reason))?;
    }
    interrupt::listen();

    let numbers = arguments.shard.of(arguments.runs);
    let started = Instant::now();
    let mut runs: Vec<BatchRun> = Vec::new();
    let (mut next, mut at_once) = (numbers.start, 16);
    while next < numbers.end && !interrupt::is_wanted() {
        let chunk = next..numbers.end.min(next.saturating_add(at_once));
        let began = Instant::now();
        next = chunk.end;
        runs.extend(batch.run_all(chunk, arguments.threads));
        let longer = LOOK.as_secs_f64() / began.elapsed().as_secs_f64().max(1e-6);
        at_once = ((at_once as f64 * longer.clamp(0.25, 4.0)) as u64).max(1);
    }
    let wall_time = started.elapsed().as_secs_f64();

    let is_whole = next == numbers.end;
    let place = if is_whole { out.clone() } else { partial(&out) };
    write_file(&place, |file| write_table(arguments, &runs, file).map_err(std::io::Error::other))?;
    if !is_whole {
        let message =
            format!("interrupted after {}\n  their rows are in {}", counted(runs.len() as u64, "run"), place.display());
        return Err(Failure::Run(message));
    }
    let steps: u64 = runs.iter().filter_map(|run| run.end.as_ref().ok()).map(|end| end.steps).sum();
    page.line(format!(
        "{} of {}: {} in {wall_time:.2} s, {:.0} steps a second",
        counted(runs.len() as u64, "run"),
        prepared.name,
        counted(steps, "step"),
        steps as f64 / wall_time.max(1e-9)
    ));
    page.line(format!("table: {}", out.display()));
    let failures: Vec<(u64, String)> =
        runs.iter().filter_map(|run| Some((run.number, run.end.as_ref().err()?.to_string()))).collect();
    let Some((number, reason)) = failures.first() else { return Ok(Exit::Fine) };
    let message = format!("{} failed; the first is run {number}: {reason}", counted(failures.len() as u64, "run"));
    Err(Failure::Run(message))
}

/// Where the rows of an interrupted batch go.
fn partial(out: &Path) -> PathBuf {
    let mut name = out.file_name().unwrap_or_default().to_owned();
    name.push(".partial");
    out.with_file_name(name)
}

fn write_table(arguments: &BatchArguments, runs: &[BatchRun], out: &mut dyn std::io::Write) -> csv::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let varied = arguments.variations.iter().map(|variation| variation.path.clone());
    let shown = arguments.shown.iter().map(ToString::to_string);
    let head = ["run".to_owned()].into_iter().chain(varied);
    let head = head.chain(["steps", "time", "fingerprint"].map(str::to_owned)).chain(shown).chain(["error".to_owned()]);
    table.write_record(head)?;
    for run in runs {
        let mut row = vec![run.number.to_string()];
        row.extend(run.values.iter().map(f64::to_string));
        match &run.end {
            Ok(end) => {
                row.extend([end.steps.to_string(), end.time.to_string(), end.fingerprint.to_string()]);
                row.extend(
                    end.shown.iter().map(|value| if value.is_nan() { String::new() } else { value.to_string() }),
                );
                row.push(String::new());
            }
            Err(failure) => {
                row.extend(std::iter::repeat_n(String::new(), 3 + arguments.shown.len()));
                row.push(failure.to_string());
            }
        }
        table.write_record(row)?;
    }
    table.flush()?;
    Ok(())
}
