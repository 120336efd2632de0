//! `tumble run`: a scene from its first step to its files.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use tumble_record::frames::{FrameSettings, write_frames};
use tumble_record::gltf::to_gltf;
use tumble_record::{
    Completeness, FileError, OutputFolder, Record, RecordDim, Recording, Summary, write_file, write_run,
};
use tumble_scene::{AnyLoaded, Loaded, SceneDim};

use crate::args::RunArguments;
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::one_line;
use crate::interrupt;
use crate::page::Page;
use crate::report::{self, Shown, Tally};
use crate::simulate::{Ending, Prepared, Progress, Run, thin};
use crate::source::Source;

/// Folder of the files of all runs, one folder per scene.
pub const OUT: &str = "out";

/// Runs a scene, writes its files and prints what came of it.
pub fn run(arguments: &RunArguments, page: &mut Page) -> Result<Exit, Failure> {
    let source = arguments.scene.as_deref().map_or_else(Source::default_scene, Source::of)?;
    match source.load()? {
        AnyLoaded::Planar(loaded) => run_loaded(arguments, &source, loaded, page),
        AnyLoaded::Spatial(loaded) => run_loaded(arguments, &source, loaded, page),
    }
}

fn run_loaded<D: SceneDim>(
    arguments: &RunArguments,
    source: &Source,
    loaded: Loaded<D>,
    page: &mut Page,
) -> Result<Exit, Failure> {
    if !arguments.quiet && !loaded.warnings.is_empty() {
        tell(loaded.warnings.render(stderr_color()));
    }
    let mut prepared = Prepared::new(source, loaded, &arguments.overrides, arguments.every)?;
    let threads = arguments.threads.map_or(1, NonZero::get);
    prepared.simulation.set_threads(threads).map_err(|error| Failure::Run(error.to_string()))?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new(OUT).join(source.stem()));
    let output = Output { folder: OutputFolder::new(folder), arguments };
    interrupt::listen();
    output.check(&mut prepared)?;

    let run = prepared.run(if arguments.quiet { Progress::Hidden } else { Progress::Shown });
    match &run.ending {
        Ending::Complete => output.complete(&prepared, run, page),
        Ending::Interrupted => {
            let time = prepared.simulation.time();
            output.partial(&prepared, run, &format!("interrupted at {time} s"))
        }
        Ending::Failed(error) => {
            let reason = format!("the run of {} failed: {error}", prepared.name);
            output.partial(&prepared, run, &reason)
        }
    }
}

/// Where the files go, and what is asked of them.
struct Output<'a> {
    folder: OutputFolder,
    arguments: &'a RunArguments,
}

impl Output<'_> {
    /// Refuses, before a long run, plots that cannot be drawn and a folder that cannot be made.
    fn check<D: SceneDim>(&self, prepared: &mut Prepared<D>) -> Result<(), Failure> {
        if let Some(recording) = prepared.simulation.recording() {
            self.arguments.plots.iter().try_for_each(|channel| channel.check(recording))?;
        }
        self.folder.prepare(Completeness::Whole).map(drop)?;
        Ok(())
    }

    /// Writes and tells what came of a run that came to its end.
    fn complete<D: SceneDim>(&self, prepared: &Prepared<D>, mut run: Run<D>, page: &mut Page) -> Result<Exit, Failure> {
        let verdict = prepared.verdict(&run.recording);
        let tally = Tally::of(&verdict);
        thin(&mut run.recording, prepared.every);
        let summary = Summary::new(&run.recording, run.wall_time);
        let plots = &self.arguments.plots;
        let mut files = match write_run(&self.folder, Completeness::Whole, &run.recording, &summary, plots) {
            Ok(files) => files,
            Err(error) => return self.partial(prepared, run, &error.to_string()),
        };
        files.extend(self.pictures(&run.recording, Completeness::Whole)?);
        if self.arguments.quiet {
            report::outcomes(page, &verdict, Shown::Failures);
        } else {
            page.line(title(&run.recording.scene, &run.recording.about));
            page.line("");
            report::numbers(&run.recording, &summary).iter().for_each(|line| page.line(line));
            page.line("");
            if !run.notices.is_empty() {
                run.notices.iter().for_each(|notice| page.line(format!("notice: {notice}")));
                page.line("");
            }
            if !verdict.outcomes.is_empty() {
                report::outcomes(page, &verdict, Shown::All);
                let aside = if self.arguments.overrides.are_none() { "" } else { " (the scene was overridden)" };
                page.line(format!("{}{aside}\n", tally.words()));
            }
            page.line(report::files(&self.folder, Completeness::Whole, &files));
        }
        let decides = self.arguments.overrides.are_none();
        Ok(if decides && !tally.passed() { Exit::ExpectationFailed } else { Exit::Fine })
    }

    /// Writes the pictures in space that were asked for, and returns where they are.
    fn pictures<D: RecordDim>(
        &self,
        recording: &Recording<D>,
        completeness: Completeness,
    ) -> Result<Vec<PathBuf>, FileError> {
        let folder = self.folder.path(completeness);
        let (mut places, mut written) = (Vec::new(), Vec::new());
        if self.arguments.gltf {
            places.push(folder.join("scene.gltf"));
            written.push(folder.join("scene.gltf"));
            write_file(&folder.join("scene.gltf"), |out| out.write_all(to_gltf(recording).as_bytes()))?;
        }
        if let Some(count) = self.arguments.frames {
            let settings = FrameSettings { count: count as usize, ..FrameSettings::default() };
            written.extend(write_frames(recording, settings, &folder)?);
            places.extend(["frames", "scene.gif"].map(|name| folder.join(name)));
        }
        if completeness == Completeness::Partial {
            self.folder.list_partial(&written)?;
        }
        Ok(places)
    }

    /// Writes the samples so far of a run that did not come to its end, or whose files cannot be written.
    fn partial<D: SceneDim>(&self, prepared: &Prepared<D>, mut run: Run<D>, reason: &str) -> Result<Exit, Failure> {
        thin(&mut run.recording, prepared.every);
        let summary = Summary::new(&run.recording, run.wall_time);
        let rescued = write_run(&self.folder, Completeness::Partial, &run.recording, &summary, &self.arguments.plots);
        let rescued = rescued
            .map_err(|error| error.to_string())
            .and_then(|_| self.pictures(&run.recording, Completeness::Partial).map_err(|error| error.to_string()));
        let rescue = match rescued {
            Ok(_) => {
                let samples = run.recording.samples.len();
                let folder = self.folder.path(Completeness::Partial);
                format!("the {samples} samples so far are in {}", folder.display())
            }
            Err(error) => format!("nor can the samples so far be kept: {error}"),
        };
        Err(Failure::Run(format!("{reason}\n  {rescue}")))
    }
}

/// The name of a scene and what it shows.
fn title(name: &str, about: &str) -> String {
    if about.is_empty() { name.to_owned() } else { format!("{name}: {}", one_line(about)) }
}
