//! A run in words.

use std::path::PathBuf;

use tumble_record::{BodyKind, Completeness, OutputFolder, Recording, Summary};
use tumble_scene::SceneDim;
use tumble_scene::expect::{Status, Verdict};

use crate::figure::{Column, counted, figure, rough, table};
use crate::page::Page;

/// The numbers of a run as aligned lines.
pub fn numbers<D: SceneDim>(recording: &Recording<D>, summary: &Summary) -> Vec<String> {
    let moving = recording.bodies.iter().filter(|body| body.kind != BodyKind::Static).count();
    let peak = recording.audit.iter().map(|row| row.contacts).max().unwrap_or(0);
    let end = recording.audit.last().map_or(0, |row| row.contacts);
    let absent = || "none".to_owned();
    let rows = [
        ("bodies", format!("{}, {moving} of which can move", summary.bodies)),
        ("contact model", summary.contact.clone()),
        ("contacts", format!("{end} at the end, {peak} at the peak")),
        ("steps", format!("{} of {} s", summary.steps, summary.dt)),
        ("simulated time", format!("{} s", figure(summary.simulated_time))),
        ("wall time", format!("{} s", rough(summary.wall_time))),
        ("steps per second", summary.steps_per_second.map_or_else(absent, rough)),
        ("energy drift", summary.energy_drift.map_or_else(absent, |drift| format!("{} %", rough(100.0 * drift)))),
        ("deepest overlap", summary.deepest_overlap.map_or_else(absent, |depth| format!("{} m", rough(depth)))),
        ("fingerprint", summary.fingerprint.map_or_else(absent, |fingerprint| fingerprint.to_string())),
    ];
    table(&[Column::Left, Column::Left], &rows.map(|(name, value)| vec![name.to_owned(), value]))
}

/// Where the files are.
pub fn files(folder: &OutputFolder, completeness: Completeness, files: &[PathBuf]) -> String {
    let names: Vec<_> = files.iter().filter_map(|file| Some(file.file_name()?.to_string_lossy())).collect();
    format!("files in {}: {}", folder.path(completeness).display(), names.join(", "))
}

/// How many expectations came out in which way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    met: usize,
    failed: usize,
    skipped: usize,
}

impl Tally {
    /// Counts the outcomes of a verdict.
    pub fn of(verdict: &Verdict) -> Self {
        Self {
            met: verdict.count(Status::Met),
            failed: verdict.count(Status::Failed),
            skipped: verdict.count(Status::NotClaimed),
        }
    }

    /// Adds another count.
    pub fn add(&mut self, other: Self) {
        self.met += other.met;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }

    /// Whether none failed.
    pub fn passed(self) -> bool {
        self.failed == 0
    }

    /// `37 expectations: 36 ok, 1 FAILED`.
    pub fn words(self) -> String {
        let total = self.met + self.failed + self.skipped;
        if total == 0 {
            return "no expectations".to_owned();
        }
        let parts = [(self.met, "ok"), (self.failed, "FAILED"), (self.skipped, "skipped")];
        let parts: Vec<String> =
            parts.iter().filter(|(count, _)| *count > 0).map(|(count, word)| format!("{count} {word}")).collect();
        format!("{}: {}", counted(total as u64, "expectation"), parts.join(", "))
    }
}

/// Which outcomes are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// All.
    All,
    /// Those that failed.
    Failures,
}

/// Prints a line per outcome.
pub fn outcomes(page: &mut Page, verdict: &Verdict, shown: Shown) {
    let all = verdict.outcomes.iter();
    for outcome in all.filter(|outcome| shown == Shown::All || outcome.status == Status::Failed) {
        page.line(outcome);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tally_names_only_what_occurs() {
        let mut tally = Tally { met: 36, failed: 0, skipped: 0 };
        assert_eq!(tally.words(), "36 expectations: 36 ok");
        tally.add(Tally { met: 0, failed: 1, skipped: 2 });
        assert_eq!(tally.words(), "39 expectations: 36 ok, 1 FAILED, 2 skipped");
        assert!(!tally.passed());
        assert_eq!(Tally { met: 1, failed: 0, skipped: 0 }.words(), "1 expectation: 1 ok");
        assert_eq!(Tally::default().words(), "no expectations");
    }
}
