//! The replay of a shipped scene opens in a real browser, without a window; skipped loudly where none is installed.

use std::error::Error;
use std::path::PathBuf;
use std::process::Command;

use tumble::prelude::*;
use tumble::record::replay::write_replay;

/// A browser from the search path.
fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file())
}

#[test]
fn replay_of_a_shipped_scene_plays_in_a_browser() -> Result<(), Box<dyn Error>> {
    let Some(browser) = browser() else {
        eprintln!("SKIPPED: no chromium, chromium-browser or google-chrome on PATH; the replay was not opened");
        return Ok(());
    };
    let loaded = Shipped::named("homework_rods").ok_or("no such scene")?.load()?;
    let mut simulation = Simulation::from_loaded(&loaded)?;
    simulation.run_scene()?;
    let mut recording = simulation.take_recording().ok_or("nothing was recorded")?;
    recording.scene = "homework_rods".into();

    let folder = tempfile::tempdir()?;
    let page = folder.path().join("replay.html");
    write_replay(&recording, std::fs::File::create(&page)?)?;
    let output = Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--dump-dom"])
        .arg("--virtual-time-budget=2000")
        .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
        .arg(format!("file://{}#t=3", page.display()))
        .output()?;
    let document = String::from_utf8_lossy(&output.stdout);
    let attributes = [
        r#"data-ready="true""#.to_owned(),
        format!("data-bodies=\"{}\"", recording.bodies.len()),
        format!("data-samples=\"{}\"", recording.samples.len()),
        r#"data-time="3""#.to_owned(),
        "<title>homework_rods – replay</title>".to_owned(),
    ];
    for expected in attributes {
        assert!(document.contains(&expected), "{expected} is missing in a document of {} bytes", document.len());
    }
    Ok(())
}
