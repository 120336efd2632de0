//! `audit.csv` under each contact model, through the real program.

use std::collections::BTreeMap;

use crate::support::Bench;

const COLUMNS: &str = "step,time,kinetic,potential,total,momentum_x,momentum_y,angular_momentum,deepest_overlap,contacts,iterations,\
    residual,normal_violation,tangent_violation,work_gravity,work_springs,work_user,work_friction,work_impacts,work_joints,\
    work_position_correction,integrator_defect,ledger_error,sticking,sliding,solver_end";

const MODELS: [&str; 5] = ["penalty", "impulse", "resting-lcp", "velocity-lcp", "soft-step"];

type Row = BTreeMap<String, String>;

/// The rows of an audit by column, after its header was checked.
fn audit(bench: &Bench, scene: &str, model: &str) -> Vec<Row> {
    let out = format!("{scene}-{model}");
    bench.tumble(["run", scene, "--contact", model, "--out", &out, "--quiet"]).code(0);
    let csv = bench.read(&format!("{out}/audit.csv"));
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some(COLUMNS));
    let row = |line: &str| COLUMNS.split(',').map(str::to_owned).zip(line.split(',').map(str::to_owned)).collect();
    lines.map(row).collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

/// Sum of a column.
fn sum(rows: &[Row], column: &str) -> f64 {
    rows.iter().map(|row| number(row, column)).sum()
}

#[test]
fn every_joule_is_booked_under_every_model() {
    let bench = Bench::new();
    // Friction and a user's force; springs, impacts and gravity.
    for scene in ["quiz_pushed_block", "newtons_cradle"] {
        for model in MODELS {
            let rows = audit(&bench, scene, model);
            let energy = rows.iter().map(|row| number(row, "total").abs()).fold(1.0, f64::max);
            // Round-off of sums of energies of this size: some hundred times 1e-16; soft steps sum impulses in single precision.
            let round_off = if model == "soft-step" { 1e-6 } else { 1e-14 };
            for pair in rows.windows(2) {
                let change = number(&pair[1], "total") - number(&pair[0], "total");
                let lines = ["work_user", "work_friction", "work_impacts", "work_joints"];
                let besides = ["work_position_correction", "integrator_defect"];
                let booked: f64 = lines.iter().chain(&besides).map(|column| number(&pair[1], column)).sum();
                assert!((change - booked).abs() < round_off * energy, "{scene} {model}: {:?}", pair[1]);
                assert!(number(&pair[1], "ledger_error").abs() < round_off * energy, "{scene} {model}: {:?}", pair[1]);
            }
        }
    }
}

#[test]
fn fields_are_empty_where_nothing_was_solved() {
    let bench = Bench::new();
    for model in MODELS {
        for (step, row) in audit(&bench, "quiz_pushed_block", model).iter().enumerate() {
            // The block rests on the floor from the first step on; penalty forces are no solution of anything.
            let solves = model != "penalty" && step > 0;
            let empty = ["iterations", "residual", "solver_end"].map(|column| row[column].is_empty());
            assert_eq!(empty, [!solves; 3], "{model}: {row:?}");
            assert!(row["solver_end"].is_empty() || row["solver_end"] == "converged", "{model}: {row:?}");
        }
    }
}

#[test]
fn a_block_sticks_until_it_slides() {
    let bench = Bench::new();
    for model in MODELS {
        let rows = audit(&bench, "quiz_pushed_block", model);
        // It breaks away at 5.886 s; Δt = 1 ms.
        for row in rows.iter().skip(100) {
            let sticks = number(row, "time") < 5.8;
            if sticks || number(row, "time") > 6.0 {
                let expected = if sticks { ["2", "0"] } else { ["0", "2"] };
                assert_eq!([&row["sticking"], &row["sliding"]], expected, "{model}: {row:?}");
            }
            // Penalty friction holds only against slip, up to 1 cm/s, and a step of (μ_s − μ_k) g more when it breaks away.
            // Soft steps let a point count as sticking until it slips faster than gravity makes it in a substep, g Δt/4.
            let slip = match model {
                "penalty" => 0.01 + 0.002,
                "soft-step" => 0.0025,
                _ => 1e-12,
            };
            assert!(number(row, "tangent_violation") <= slip, "{model}: {row:?}");
        }
        // All of the friction is between 5.886 s and 10 s: μ_k m g = 7.848 N over 28.21 m, and half a step of slip.
        // Soft steps let go 0.07 s later, since slow slip counts as sticking: 0.13 m/s and 0.5 m less at the end.
        let late = if model == "soft-step" { 4.2 } else { 0.0 };
        assert!((sum(&rows, "work_friction") + 221.4).abs() < 3.0 + late, "{model}: {}", sum(&rows, "work_friction"));
        // The push does the rest: ½ m v² = 273.4 J and what friction took.
        assert!((sum(&rows, "work_user") - 494.9).abs() < 7.0 + 2.0 * late, "{model}: {}", sum(&rows, "work_user"));
    }
}
