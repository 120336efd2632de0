//! Figures in the documentation are what the program measures.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::support::Bench;

/// What stands in the README before and after the table.
const BEGIN: &str = "<!-- the output of `tumble accuracy` -->\n";
const END: &str = "<!-- end of the output of `tumble accuracy` -->";

#[test]
fn the_table_in_the_readme_is_what_the_program_measures() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let readme = fs::read_to_string(readme).expect("the README");
    let table = readme.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).expect("both marks").0.trim();
    let bench = Bench::new();
    let measured = bench.tumble(["accuracy"]).code(0).stdout;
    // Figures are the same on every machine, so that the texts can be compared; where motion has changed, put the new table in.
    assert_eq!(table, measured.trim(), "the README is out of date; `tumble accuracy` prints\n{measured}");
}

/// Cells of a line of a Markdown table.
fn cells(line: &str) -> Vec<&str> {
    line.trim_matches('|').split('|').map(str::trim).collect()
}

#[test]
fn the_figures_of_the_model_pages_are_what_compare_measures() {
    let bench = Bench::new();
    let models = ["penalty", "impulse", "resting-lcp", "velocity-lcp", "soft-step"];
    let mut measured = BTreeMap::new();
    for model in models {
        let page = format!("../../docs/models/{}.md", model.replace('-', "_"));
        let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).expect("a page of the model");
        let (_, table) = page.split_once("| Scene | Δt [s] | expected |").expect("a table of figures");
        let rows: Vec<_> = table.lines().skip(2).take_while(|line| line.starts_with('|')).map(cells).collect();
        assert!(rows.len() >= 6, "{model}");
        for row in rows {
            let scene = row[0].trim_matches('`');
            let csv = measured.entry(scene.to_owned()).or_insert_with(|| {
                bench.tumble(["compare", scene, "--contact", &models.join(","), "--out", "here"]).code(0);
                bench.read("here/compare.csv")
            });
            let line = csv.lines().find(|line| line.starts_with(&format!("{model},"))).expect("a row of the model");
            let [_, dt, _, met, claimed, ratio, _, energy, overlap, residual, creep, ..] =
                line.split(',').collect::<Vec<_>>()[..]
            else {
                panic!("{line}");
            };
            let expected = if claimed == "0" { "–".to_owned() } else { format!("{met} of {claimed}") };
            assert_eq!([row[1], row[2]], [dt, &expected], "{model}, {scene}");
            let percent = energy.parse::<f64>().map_or(String::new(), |energy| (100.0 * energy).to_string());
            for (said, is) in row[3..].iter().zip([ratio, &percent, overlap, residual, creep]) {
                assert!(agree(said, is), "{model}, {scene}: the page says {said}, compare says {is}");
            }
        }
    }
}

/// Whether a page tells a figure truly: to three digits, and what is less than 1e-9 as that.
fn agree(said: &str, is: &str) -> bool {
    let Ok(is) = is.parse::<f64>() else { return said == "–" };
    match said.strip_prefix("< ").unwrap_or(said).parse::<f64>() {
        Ok(bound) if said.starts_with('<') => is.abs() < bound,
        Ok(said) => (said - is).abs() <= 0.006 * is.abs(),
        Err(_) => false,
    }
}
