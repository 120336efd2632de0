//! The replay opens in a real browser and shows what was recorded.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common;
use tumble_math::{Planar, Spatial};
use tumble_record::replay::{MOST_CONTACTS, MOST_POSES, write_replay};
use tumble_record::{BodyKind, BodyRecord, BodyState, RecordDim, Recording, Sample};

fn html<D: RecordDim>(recording: &Recording<D>) -> String {
    let mut bytes = Vec::new();
    write_replay(recording, &mut bytes).expect("memory takes all");
    String::from_utf8(bytes).expect("the page is UTF-8")
}

/// Returns a browser from the search path.
fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file())
}

/// Opens a page in a browser without a window, and returns the document as it stands after the scripts ran.
fn document_after_scripts(browser: &Path, page: &Path, hash: &str) -> String {
    let profile = tempfile::tempdir().expect("a folder");
    let output = Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-background-networking", "--dump-dom"])
        // WebGL without a graphics card.
        .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        .arg("--virtual-time-budget=2000")
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}{hash}", page.display()))
        .output()
        .expect("the browser starts");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Returns the opening tag of the body element.
fn body_tag(document: &str) -> &str {
    let start = document.find("<body").unwrap_or_else(|| panic!("no body in {} bytes", document.len()));
    &document[start..start + document[start..].find('>').expect("the tag ends")]
}

#[test]
fn replay_opens_in_a_browser_and_goes_to_the_time_in_its_address() {
    let Some(browser) = browser() else {
        eprintln!("SKIPPED: no chromium, chromium-browser or google-chrome on PATH; the replay was not opened");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("replay.html");
    let recording = common::falling_rods(2.0, 10);
    std::fs::write(&page, html(&recording)).expect("it can be written");

    let document = document_after_scripts(&browser, &page, "#t=1.5");
    let tag = body_tag(&document);
    for attribute in ["data-ready=\"true\"", "data-bodies=\"8\"", "data-samples=\"201\"", "data-time=\"1.5\""] {
        assert!(tag.contains(attribute), "{attribute} is missing in {tag}");
    }
    assert!(document.contains("<title>falling_rods – replay</title>"), "the title names the scene");
    let row = recording.audit.iter().find(|row| row.step == 1500).expect("an audit row per step");
    assert!(document.contains(&format!("<dd>{}</dd>", row.contacts)), "contact points at that time are shown");

    // A recording of nothing at all must open as well.
    std::fs::write(&page, html::<Planar>(&Recording::default())).expect("it can be written");
    let document = document_after_scripts(&browser, &page, "");
    let tag = body_tag(&document);
    assert!(tag.contains("data-ready=\"true\"") && tag.contains("data-samples=\"0\""), "{tag}");
}

#[test]
fn replay_of_space_opens_in_a_browser_with_light_and_without() {
    let Some(browser) = browser() else {
        eprintln!("SKIPPED: no chromium, chromium-browser or google-chrome on PATH; the replay was not opened");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("replay.html");
    let recording = common::space::assortment(1.0, 4).expect("a sound world");
    let whole = html(&recording);
    std::fs::write(&page, &whole).expect("it can be written");
    let document = document_after_scripts(&browser, &page, "#t=0.8");
    let tag = body_tag(&document);
    for attribute in ["data-ready=\"true\"", "data-bodies=\"12\"", "data-samples=\"51\"", "data-time=\"0.8\""] {
        assert!(tag.contains(attribute), "{attribute} is missing in {tag}");
    }
    assert!(document.contains("id=\"light\"") && !document.contains("id=\"missing\""), "WebGL draws");
    let row = recording.audit.iter().find(|row| row.step == 160).expect("an audit row per step");
    assert!(row.contacts > 0 && document.contains(&format!("<dd>{}</dd>", row.contacts)), "contact points are shown");

    // Where the browser has no WebGL the page says so, and the rest of it works.
    let blind = whole.replace("getContext(\"webgl2\"", "getContext(\"no such thing\"");
    std::fs::write(&page, blind).expect("it can be written");
    let document = document_after_scripts(&browser, &page, "");
    assert!(body_tag(&document).contains("data-ready=\"true\"") && document.contains("id=\"missing\""));

    std::fs::write(&page, html::<Spatial>(&Recording::default())).expect("it can be written");
    let document = document_after_scripts(&browser, &page, "");
    assert!(body_tag(&document).contains("data-ready=\"true\""), "{}", body_tag(&document));
}

#[test]
fn names_cannot_break_out_of_the_data() {
    let hostile = "</script><script>alert(1)</script><!-- {{SCRIPT}} {{STYLE}}";
    let mut recording = common::falling_rods(0.01, 10);
    recording.scene = hostile.to_owned();
    recording.bodies[0].name = hostile.to_owned();
    let (with, without) = (html(&recording), html(&common::falling_rods(0.01, 10)));
    for markup in ["</script>", "<script", "<!--"] {
        assert_eq!(with.matches(markup).count(), without.matches(markup).count(), "{markup}");
    }
    assert_eq!(without.matches("</script>").count(), 2, "data and script");
    assert!(with.contains("{{SCRIPT}}"), "a name that looks like a mark of the template stays a name");
}

#[test]
fn page_asks_for_nothing_from_outside() {
    let space = common::space::assortment(0.01, 1).expect("a sound world");
    let page = html(&common::falling_rods(0.01, 10)) + &html(&space);
    for outside in ["http://", "https://", "src=", "href=", "@import", "url(", "fetch("] {
        assert!(!page.contains(outside), "`{outside}` would leave the file");
    }
}

/// A recording with so many samples and bodies, all at rest.
fn crowd(samples: usize, bodies: usize, contacts: usize) -> Recording {
    let mut recording = common::falling_rods(3.0, 1000);
    let contact = recording.samples.last().expect("a last sample").contacts.first().expect("a contact").clone();
    let body = |index: usize| BodyRecord {
        id: index as u64,
        name: format!("body-{index}"),
        kind: BodyKind::Dynamic,
        mass: 1.0,
        inertia: 1.0,
        shapes: recording.bodies[0].shapes.clone(),
    };
    recording.bodies = (0..bodies).map(body).collect();
    recording.samples = (0..samples)
        .map(|index| Sample {
            step: index as u64,
            time: index as f64 * 0.01,
            states: vec![Some(BodyState::default()); bodies],
            contacts: vec![contact.clone(); contacts],
            joints: Vec::new(),
        })
        .collect();
    recording
}

/// Returns the samples that were kept, by their step numbers.
fn kept_steps(page: &str) -> Vec<u64> {
    let (_, rest) = page.split_once("\"steps\":[").expect("steps");
    let (list, _) = rest.split_once(']').expect("an end");
    list.split(',').map(|step| step.parse().expect("a number")).collect()
}

#[test]
fn long_recordings_are_thinned_evenly_below_thirty_megabytes() {
    for (samples, bodies, contacts) in [(4001, 1000, 0), (4001, 2, 500), (1501, 2000, 700)] {
        let page = html(&crowd(samples, bodies, contacts));
        let steps = kept_steps(&page);
        assert!(page.len() < 30_000_000, "{} bytes", page.len());
        // One sample may go beyond the cap: the last one, which is always kept.
        assert!((steps.len() - 1) * bodies <= MOST_POSES && (steps.len() - 1) * contacts <= MOST_CONTACTS);
        assert_eq!((steps[0], steps[steps.len() - 1]), (0, samples as u64 - 1), "first and last are kept");
        let stride = steps[1] - steps[0];
        assert!(stride > 1, "something was left out");
        assert!(steps[..steps.len() - 1].windows(2).all(|pair| pair[1] - pair[0] == stride), "evenly");
    }
}

#[test]
fn short_recordings_are_kept_whole() {
    assert_eq!(kept_steps(&html(&crowd(500, 10, 4))), (0..500).collect::<Vec<u64>>());
}
