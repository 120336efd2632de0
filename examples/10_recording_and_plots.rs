//! Recording. You will see a run summed up in numbers, and where its files are: tables, plots, and a replay to open in a browser.

use std::error::Error;
use std::time::Instant;

use tumble::prelude::*;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let loaded = Shipped::named("bouncing_rod").ok_or("no such scene")?.load()?;
    let mut simulation = Simulation::from_loaded(&loaded)?;
    simulation.record(loaded.scene.every)?;
    let clock = Instant::now();
    simulation.run_for(loaded.scene.duration)?;
    let wall_time = clock.elapsed();
    let mut recording = simulation.take_recording().ok_or("nothing was recorded")?;
    recording.scene = "bouncing_rod".into();
    recording.about = loaded.scene.about;

    let summary = Summary::new(&recording, wall_time);
    println!("{} bodies, {} steps, {} s simulated", summary.bodies, summary.steps, summary.simulated_time);
    let number = |value: Option<f64>| value.map_or("–".into(), |value| format!("{value:.3e}"));
    println!("energy drift {}, deepest overlap {} m", number(summary.energy_drift), number(summary.deepest_overlap));

    let height: Channel = "y:tilted".parse()?;
    let folder = OutputFolder::new("out/10_recording_and_plots");
    let files = write_run(&folder, Completeness::Whole, &recording, &summary, &[height])?;
    println!("\nfiles:");
    for file in &files {
        println!("  {}", file.display());
    }

    // Step 0 and every fifth step, for each of three moving bodies, and the heading.
    let trajectory = std::fs::read_to_string(folder.path(Completeness::Whole).join("trajectory.csv"))?;
    assert_eq!(trajectory.lines().count(), 1 + 3 * (1 + 4000 / 5));
    assert!(files.iter().any(|file| file.ends_with("replay.html")));
    assert!(files.iter().all(|file| file.is_file()));
    Ok(())
}
