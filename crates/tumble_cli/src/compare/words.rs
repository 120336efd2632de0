//! The comparison in words: a table, the sentence below it, and `compare.csv`.

use std::io::{self, Write};

use tumble_scene::format::{ContactModel, Dialect, Expectation, Scene};

use super::figures::Row;
use crate::figure::{Column, rough, table as aligned};

/// Part by which two figures may differ and still count as equally good [1].
const ALIKE: f64 = 0.01;

/// The same of times on the clock, which differ by as much from run to run [1].
const ALIKE_ON_THE_CLOCK: f64 = 0.1;

/// Overlap and creep below which nobody needs to be better [m], [m/min].
const ROUND_OFF: f64 = 1e-9;

/// The rows as aligned lines.
pub fn table(rows: &[Row], reference: Option<ContactModel>) -> Vec<String> {
    let cell = |value: Option<f64>| value.map_or("–".to_owned(), rough);
    let mut heads = vec!["model".to_owned(), "dt [s]".to_owned(), "expected".to_owned(), "error/tolerance".to_owned()];
    heads.extend(reference.map(|model| format!("off {} [m]", model.word())));
    heads.extend(["energy [%]", "overlap [m]", "residual", "creep [m/min]", "step [µs]"].map(str::to_owned));
    let mut lines = vec![heads];
    for row in rows {
        let expected = if row.failure.is_some() {
            "FAILED".to_owned()
        } else if row.claimed == 0 {
            "–".to_owned()
        } else {
            format!("{} of {}", row.met, row.claimed)
        };
        let dt = row.case.dt.to_string();
        let mut cells = vec![row.case.contact.word().to_owned(), dt, expected, cell(row.worst_ratio)];
        cells.extend(reference.map(|_| cell(row.reference_error)));
        let drift = row.energy_drift.map(|drift| 100.0 * drift);
        cells.extend([drift, row.deepest_overlap, row.residual, row.creep].map(cell));
        cells.push(rough(row.microseconds_per_step));
        lines.push(cells);
    }
    let mut columns = vec![Column::Right; lines[0].len()];
    columns[0] = Column::Left;
    aligned(&columns, &lines)
}

/// Which figures matter to a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promises {
    /// The scene says that energy is kept.
    KeptEnergy,
    /// Energy may be lost rightly.
    Other,
}

impl Promises {
    /// What a scene says about energy.
    pub fn of<D: Dialect>(scene: &Scene<D>) -> Self {
        let keeps = scene.expect.iter().any(|expectation| matches!(expectation, Expectation::EnergyKept(_)));
        if keeps { Self::KeptEnergy } else { Self::Other }
    }
}

/// A thing to be good at: what it is called, the figure that should be small, and how that is said.
struct Virtue {
    name: &'static str,
    figure: fn(&Row) -> Option<f64>,
    say: fn(&Row) -> String,
    /// Part by which a figure may be worse and still be as good [1].
    alike: f64,
    /// The figure below which nobody needs to be better.
    good_enough: f64,
}

impl Default for Virtue {
    fn default() -> Self {
        Self { name: "", figure: |_| None, say: |_| String::new(), alike: ALIKE, good_enough: 0.0 }
    }
}

/// Few of them kept count against a run, claimed or not; then how much of the tolerances is used.
fn unkept(row: &Row) -> Option<f64> {
    let missed = row.expectations - row.met;
    // Below a hundredth of a tolerance nobody needs to be better, and any ratio is better than one more expectation that is missed.
    let ratio = row.worst_ratio.unwrap_or(0.0).max(0.01);
    (row.claimed > 0).then(|| missed as f64 * 1e3 + ratio.min(999.0))
}

/// `a`, `a and b`, `a, b and c`.
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Which run is best for what.
pub fn best(rows: &[Row], with_step: bool, promises: Promises) -> String {
    let complete: Vec<&Row> = rows.iter().filter(|row| row.failure.is_none()).collect();
    match complete.as_slice() {
        [] => return "No run came to its end.".to_owned(),
        [_] if rows.len() == 1 => return "One run alone: there is nothing to compare.".to_owned(),
        [only] => return format!("Only {} came to its end: there is nothing to compare.", only.label(with_step)),
        _ => {}
    }
    let mut virtues = vec![
        Virtue {
            name: "the expectations",
            figure: unkept,
            say: |row| match row.worst_ratio {
                Some(ratio) => format!("{} of {}, worst at {} of its tolerance", row.met, row.claimed, rough(ratio)),
                None => format!("{} of {}", row.met, row.claimed),
            },
            ..Virtue::default()
        },
        Virtue {
            name: "being near the reference",
            figure: |row| row.reference_error,
            say: |row| format!("{} m", row.reference_error.map_or_else(String::new, rough)),
            ..Virtue::default()
        },
        Virtue {
            name: "no overlap",
            figure: |row| row.deepest_overlap,
            say: |row| format!("{} m", row.deepest_overlap.map_or_else(String::new, rough)),
            good_enough: ROUND_OFF,
            ..Virtue::default()
        },
        Virtue {
            name: "rest",
            figure: |row| row.creep,
            say: |row| format!("creeps by {} m/min", row.creep.map_or_else(String::new, rough)),
            good_enough: ROUND_OFF,
            ..Virtue::default()
        },
        Virtue {
            name: "speed",
            figure: |row| Some(row.microseconds_per_step),
            say: |row| format!("{} µs per step", rough(row.microseconds_per_step)),
            alike: ALIKE_ON_THE_CLOCK,
            ..Virtue::default()
        },
    ];
    if promises == Promises::KeptEnergy {
        let energy = Virtue {
            name: "keeping energy",
            figure: |row| row.energy_drift.map(f64::abs),
            say: |row| format!("{} %", row.energy_drift.map_or_else(String::new, |drift| rough(100.0 * drift))),
            ..Virtue::default()
        };
        virtues.insert(2, energy);
    }
    let claims: Vec<String> = virtues.iter().filter_map(|virtue| claim(virtue, &complete, with_step)).collect();
    format!("Best for {}.", claims.join("; for "))
}

/// `speed: impulse (3.1 µs per step)`; nothing for a figure that no run has.
fn claim(virtue: &Virtue, rows: &[&Row], with_step: bool) -> Option<String> {
    let least = rows.iter().filter_map(|row| (virtue.figure)(row)).reduce(f64::min)?;
    let enough = (least * (1.0 + virtue.alike)).max(virtue.good_enough);
    let is_best = |row: &&&Row| (virtue.figure)(row).is_some_and(|figure| figure <= enough);
    let best: Vec<&&Row> = rows.iter().filter(is_best).collect();
    // The worst of those that count as alike speaks for them.
    let worse = |one, other| if (virtue.figure)(one) >= (virtue.figure)(other) { one } else { other };
    let said = (virtue.say)(best.iter().copied().copied().reduce(worse)?);
    let names: Vec<String> = best.iter().map(|row| row.label(with_step)).collect();
    let names = if best.len() == rows.len() { "all alike".to_owned() } else { listed(&names) };
    Some(format!("{}: {names} ({said})", virtue.name))
}

/// Columns of `compare.csv`.
pub const COMPARE_COLUMNS: [&str; 13] = [
    "contact",
    "dt",
    "steps",
    "expectations_met",
    "expectations_claimed",
    "worst_ratio",
    "reference_error",
    "energy_drift",
    "deepest_overlap",
    "residual",
    "creep",
    "microseconds_per_step",
    "failure",
];

/// Writes `compare.csv`: one row per run, an empty field for what was not measured.
pub fn write_csv(rows: &[Row], out: impl Write) -> io::Result<()> {
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COMPARE_COLUMNS)?;
    for row in rows {
        writer.write_record([
            row.case.contact.word().to_owned(),
            row.case.dt.to_string(),
            row.steps.to_string(),
            row.met.to_string(),
            row.claimed.to_string(),
            cell(row.worst_ratio),
            cell(row.reference_error),
            cell(row.energy_drift),
            cell(row.deepest_overlap),
            cell(row.residual),
            cell(row.creep),
            row.microseconds_per_step.to_string(),
            row.failure.clone().unwrap_or_default(),
        ])?;
    }
    writer.flush()
}
