//! `tumble test`: scenes and whether what they promise is so.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use tumble_scene::diagnostics::Color;
use tumble_scene::expect::Verdict;

use crate::args::{Overrides, TestArguments};
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::counted;
use crate::page::Page;
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
    let prepared = source.load().map_err(Failure::from);
    let prepared = prepared.and_then(|loaded| Prepared::new(source, loaded, overrides, None));
    match prepared {
        Ok(mut prepared) => {
            let run = prepared.run(Progress::Hidden);
            Tested::Ran { verdict: prepared.verdict(&run.recording), ending: run.ending }
        }
        Err(failure) => Tested::Refused { reason: failure.words(color) },
    }
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

/// Works on the items over all cores, and takes the results in the order of the items.
fn in_order<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync, mut take: impl FnMut(&T, R)) {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            let sender = sender.clone();
            scope.spawn(|| {
                let sender = sender;
                while let index = next.fetch_add(1, Ordering::Relaxed)
                    && let Some(item) = items.get(index)
                    && sender.send((index, work(item))).is_ok()
                {}
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut taken = 0;
        for (index, result) in receiver {
            waiting.insert(index, result);
            while let Some(result) = waiting.remove(&taken) {
                take(&items[taken], result);
                taken += 1;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_taken_in_order_however_long_each_takes() {
        let items: Vec<u64> = (0..40).collect();
        let mut taken = Vec::new();
        let work = |item: &u64| {
            thread::sleep(std::time::Duration::from_millis(if item.is_multiple_of(7) { 3 } else { 0 }));
            item * item
        };
        in_order(&items, work, |item, square| taken.push((*item, square)));
        assert_eq!(taken, items.iter().map(|item| (*item, item * item)).collect::<Vec<_>>());
    }
}
