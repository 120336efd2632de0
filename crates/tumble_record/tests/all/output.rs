//! A run's files: all there, in one folder, with a summary that says what happened.

use std::fs;
use std::time::Duration;

use crate::common;
use glam::DVec3;
use tumble_math::{Inertia, Planar};
use tumble_record::{
    AuditRow, BodyState, Channel, Completeness, Fingerprint, FingerprintHasher, OutputError, OutputFolder, Recording,
    Summary, energy_drift, write_run,
};

const FILES: [&str; 9] = [
    "audit.csv",
    "contacts.csv",
    "energy.svg",
    "replay.html",
    "summary.json",
    "touches.csv",
    "trajectory.csv",
    "y-star.svg",
    "y.svg",
];

#[test]
fn run_leaves_all_its_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path().join("falling_rods"));
    let recording = common::falling_rods(0.1, 10);
    let summary = Summary::new(&recording, Duration::from_millis(50));
    let channels: Vec<Channel> = ["y:star", "y", "y:star"].map(|text| text.parse().expect("a channel")).into();
    for completeness in [Completeness::Whole, Completeness::Partial] {
        let paths = write_run(&out, completeness, &recording, &summary, &channels).expect("they can be written");
        let mut names: Vec<_> = paths.iter().map(|path| path.file_name().expect("a name").to_owned()).collect();
        names.sort();
        assert_eq!(names, FILES);
        assert!(paths.iter().all(|path| path.is_file() && path.starts_with(out.path(completeness))));
    }
    write_run(&out, Completeness::Whole, &recording, &summary, &[]).expect("they can be written");
    assert!(!out.path(Completeness::Partial).exists(), "a whole run removes what an interrupted one left");
}

#[test]
fn mistaken_channel_is_found_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path().join("out"));
    let recording = common::falling_rods(0.01, 10);
    let summary = Summary::new(&recording, Duration::ZERO);
    let channel = "y:nobody".parse().expect("a channel");
    let error = write_run(&out, Completeness::Whole, &recording, &summary, &[channel]).expect_err("no such body");
    assert!(matches!(error, OutputError::Channel(_)));
    assert!(!out.path(Completeness::Whole).exists());
}

#[test]
fn summary_has_its_fields_in_order_and_reads_back() {
    let recording = common::falling_rods(0.1, 10);
    let summary = Summary::new(&recording, Duration::from_millis(50));
    let mut bytes = Vec::new();
    summary.write(&mut bytes).expect("memory takes all");
    let text = String::from_utf8(bytes).expect("JSON is UTF-8");
    let keys: Vec<&str> = text.lines().filter_map(|line| line.trim().strip_prefix('"')?.split('"').next()).collect();
    let expected = "scene,contact,dt,bodies,steps,simulated_time,wall_time,steps_per_second,energy_drift,deepest_overlap,fingerprint";
    assert_eq!(keys.join(","), expected);
    assert_eq!(serde_json::from_str::<Summary>(&text).expect("it reads back"), summary);

    assert_eq!((summary.steps, summary.bodies, summary.steps_per_second), (100, 8, Some(2000.0)));
    let last = recording.samples.last().expect("a last sample");
    assert_eq!(summary.fingerprint, Some(recording.fingerprint(last)));
    assert!(text.contains(&format!("\"fingerprint\": \"{}\"", recording.fingerprint(last))));
}

#[test]
fn summary_of_nothing_has_no_figures() {
    let summary = Summary::new::<Planar>(&Recording::default(), Duration::ZERO);
    assert_eq!((summary.steps, summary.steps_per_second, summary.energy_drift), (0, None, None));
    assert_eq!((summary.deepest_overlap, summary.fingerprint), (None, None));
}

#[test]
fn energy_drift_is_relative_to_the_energy_in_play() {
    let row = |kinetic: f64, potential: f64| AuditRow {
        kinetic,
        potential,
        total: kinetic + potential,
        ..AuditRow::default()
    };
    let drift = |rows: Vec<AuditRow>| energy_drift::<Planar>(&Recording { audit: rows, ..Recording::default() });
    // 100 J fall, 1 J is lost: −1 %, wherever the potential is zero. All numbers are exact in binary.
    for zero in [0.0, 1024.0, -4096.0] {
        assert_eq!(drift(vec![row(0.0, zero + 100.0), row(100.0, zero), row(99.0, zero)]), Some(-0.01));
    }
    assert_eq!(drift(vec![row(0.0, 5.0), row(0.0, 5.0)]), Some(0.0), "at rest there is no drift");
}

#[test]
fn fingerprint_follows_ids_and_not_the_order_of_the_list() {
    let recording = common::falling_rods(0.05, 10);
    let mut turned = recording.clone();
    turned.bodies.reverse();
    turned.samples.iter_mut().for_each(|sample| sample.states.reverse());
    let fingerprints = |recording: &Recording| -> Vec<Fingerprint> {
        recording.samples.iter().map(|sample| recording.fingerprint(sample)).collect()
    };
    assert_eq!(fingerprints(&recording), fingerprints(&turned));
    let mut all = fingerprints(&recording);
    all.dedup();
    assert_eq!(all.len(), recording.samples.len(), "no two samples look alike");
}

#[test]
fn recording_reads_back_from_json() {
    let recording = common::falling_rods(0.05, 10);
    let text = serde_json::to_string(&recording).expect("all numbers are finite");
    let read: Recording = serde_json::from_str(&text).expect("it reads back");
    assert_eq!(read.bodies, recording.bodies);
    assert_eq!(read.samples.len(), recording.samples.len());
}

#[test]
fn file_that_cannot_be_replaced_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = OutputFolder::new(folder.path());
    fs::create_dir(folder.path().join("replay.html")).expect("a folder in its place");
    let recording = common::falling_rods(0.01, 10);
    let summary = Summary::new(&recording, Duration::ZERO);
    let error = write_run(&out, Completeness::Whole, &recording, &summary, &[]).expect_err("its place is taken");
    assert!(error.to_string().contains("replay.html"), "{error}");
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("an entry").file_name()).collect();
    assert_eq!(left, ["replay.html"], "nothing else appeared");
}

#[test]
fn run_of_space_leaves_its_files_and_its_sums_are_kept() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let out = OutputFolder::new(folder.path().join("assortment"));
    let recording = common::space::assortment(0.25, 5)?;
    let summary = Summary::new(&recording, Duration::from_millis(50));
    let channels: Vec<Channel> = ["z:ball", "wx:box", "momentum_z"].map(|text| text.parse().expect("a channel")).into();
    let paths = write_run(&out, Completeness::Whole, &recording, &summary, &channels)?;
    for name in ["trajectory.csv", "contacts.csv", "audit.csv", "z-ball.svg", "wx-box.svg", "momentum_z.svg"] {
        assert!(paths.iter().any(|path| path.ends_with(name)), "{name}");
    }
    assert_eq!(recording.gravity, DVec3::new(0.0, -9.81, 0.0));
    let (first, last) = (&recording.audit[0], &recording.audit[recording.audit.len() - 1]);
    assert!(last.contacts > 0 && recording.samples.iter().any(|sample| !sample.contacts.is_empty()));
    // Gravity, contacts and the integrator explain all of the change of energy; what is left is rounding of some 100 J.
    assert!(recording.audit.iter().all(|row| row.ledger.error.abs() < 1e-11), "{:?}", last.ledger);
    assert!(last.total < first.total, "impacts and friction take energy");
    for sample in &recording.samples {
        for contact in &sample.contacts {
            let friction = contact.friction_on_b();
            // Tangential to rounding, and within the cone of the default surface.
            assert!(friction.dot(contact.normal).abs() <= 1e-12 * (1.0 + friction.length()), "{contact:?}");
        }
    }
    let by_hand: f64 = recording
        .bodies
        .iter()
        .zip(&recording.samples[0].states)
        .filter(|(body, _)| body.kind == tumble_record::BodyKind::Dynamic)
        .map(|(body, state)| {
            let state = state.expect("all are there at the start");
            let spin = body.inertia.in_world(&state.pose().rotation).apply(state.angular_velocity);
            0.5 * (body.mass * state.velocity.length_squared() + state.angular_velocity.dot(spin))
        })
        .sum();
    // The same sum in another order.
    assert!((by_hand - first.kinetic).abs() < 1e-12 * by_hand, "{by_hand} {}", first.kinetic);
    Ok(())
}

#[test]
fn fingerprint_of_space_is_the_hash_of_its_numbers() -> Result<(), Box<dyn std::error::Error>> {
    let recording = common::space::assortment(0.01, 1)?;
    let sample = &recording.samples[2];
    let mut hasher = FingerprintHasher::new(sample.step);
    for (body, state) in recording.bodies.iter().zip(&sample.states) {
        let BodyState { position: x, orientation: q, velocity: v, angular_velocity: w } = state.expect("it is there");
        let numbers = [x.x, x.y, x.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z];
        hasher.body(body.id, &numbers);
    }
    assert_eq!(recording.fingerprint(sample), hasher.finish());
    Ok(())
}
