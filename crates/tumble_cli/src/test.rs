//! `tumble test`: scenes and whether what they promise is so.

use tumble_scene::diagnostics::Color;
use tumble_scene::expect::Verdict;
use tumble_scene::{AnyLoaded, Loaded, SceneDim};

use crate::args::{Overrides, TestArguments};
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::counted;
use crate::page::Page;
use crate::parallel::in_order;
use crate::report::{self, Shown, Tally};
use crate::simulate::{Ending, Prepared, Progress};
use crate::source::Source;

/// Runs every scene and prints a line per expectation.
pub fn test(arguments: &TestArguments, page: &mut Page) -> Result<Exit, Failure> {
    let sources = Source::all_of(&arguments.paths)?;
    let overrides = Overrides { contact: arguments.contact, ..Overrides::default() };
    let mut totals = Totals { scenes: sources.len(), ..Totals::default() };
    in_order(&sources, |source| try_out(source, &overrides), |source, tested| totals.take(source, tested, page));
    page.line(totals.words());
    Ok(totals.exit())
}

/// What came of a scene.
enum Tested {
    /// It ran, as far as it got.
    Ran { verdict: Verdict, ending: Ending },
    /// It could not run; the reason in words.
    Refused { reason: String },
}

fn try_out(source: &Source, overrides: &Overrides) -> Tested {
    let color: Color = stderr_color();
    let tested = match source.load() {
        Ok(AnyLoaded::Planar(loaded)) => try_out_loaded(source, loaded, overrides),
        Ok(AnyLoaded::Spatial(loaded)) => try_out_loaded(source, loaded, overrides),
        Err(mistakes) => Err(mistakes.into()),
    };
    tested.unwrap_or_else(|failure| Tested::Refused { reason: failure.words(color) })
}

fn try_out_loaded<D: SceneDim>(source: &Source, loaded: Loaded<D>, overrides: &Overrides) -> Result<Tested, Failure> {
    let mut prepared = Prepared::new(source, loaded, overrides, None)?;
    let run = prepared.run(Progress::Hidden);
    Ok(Tested::Ran { verdict: prepared.verdict(&run.recording), ending: run.ending })
}

/// What came of all scenes.
#[derive(Default)]
struct Totals {
    scenes: usize,
    refused: usize,
    failed_runs: usize,
    tally: Tally,
}

impl Totals {
    /// Prints and counts what came of a scene.
    fn take(&mut self, source: &Source, tested: Tested, page: &mut Page) {
        page.line(source.label());
        match tested {
            Tested::Refused { reason } => {
                self.refused += 1;
                page.line("FAILED  the scene cannot be run");
                tell(reason);
            }
            Tested::Ran { verdict, ending } => {
                if let Ending::Failed(error) = ending {
                    self.failed_runs += 1;
                    page.line(format!("FAILED  the run: {error}"));
                }
                if verdict.outcomes.is_empty() {
                    page.line("nothing is expected");
                }
                report::outcomes(page, &verdict, Shown::All);
                self.tally.add(Tally::of(&verdict));
            }
        }
        page.line("");
    }

    fn words(&self) -> String {
        let mut words = format!("{} in {}", self.tally.words(), counted(self.scenes as u64, "scene"));
        for (count, what) in [(self.refused, "scenes that cannot be run"), (self.failed_runs, "runs that failed")] {
            if count > 0 {
                words += &format!("; {what}: {count}");
            }
        }
        words
    }

    fn exit(&self) -> Exit {
        match self {
            Self { refused: 1.., .. } => Exit::Refused,
            Self { failed_runs: 1.., .. } => Exit::RunFailed,
            _ if self.tally.passed() => Exit::Fine,
            _ => Exit::ExpectationFailed,
        }
    }
}
