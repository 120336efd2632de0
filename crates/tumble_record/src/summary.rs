//! The run in a dozen numbers: `summary.json`.

use std::io::{self, Write};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::dim::RecordDim;
use crate::fingerprint::Fingerprint;
use crate::recording::Recording;

/// `summary.json`; its fields in this order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Name of the contact model.
    pub contact: String,
    /// Length of a step [s].
    pub dt: f64,
    /// Number of bodies, static ones included.
    pub bodies: usize,
    /// Number of steps taken.
    pub steps: u64,
    /// Time that passed in the simulation [s].
    pub simulated_time: f64,
    /// Time that passed on the clock [s].
    pub wall_time: f64,
    /// Steps per second of wall time; none when no time was measured [1/s].
    pub steps_per_second: Option<f64>,
    /// See [`energy_drift`]; none without audit rows [1].
    pub energy_drift: Option<f64>,
    /// Largest overlap of the whole run; none without audit rows [m].
    pub deepest_overlap: Option<f64>,
    /// Fingerprint of the last sample; none without samples.
    pub fingerprint: Option<Fingerprint>,
}

impl Summary {
    /// Sums up a recording whose last sample is the last step.
    pub fn new<D: RecordDim>(recording: &Recording<D>, wall_time: Duration) -> Self {
        let last = recording.samples.last();
        let steps = last.map_or(0, |sample| sample.step);
        let wall_time = wall_time.as_secs_f64();
        Self {
            scene: recording.scene.clone(),
            contact: recording.contact.clone(),
            dt: recording.dt,
            bodies: recording.bodies.len(),
            steps,
            simulated_time: last.map_or(0.0, |sample| sample.time),
            wall_time,
            steps_per_second: (wall_time > 0.0).then(|| steps as f64 / wall_time),
            energy_drift: energy_drift(recording),
            deepest_overlap: recording.audit.iter().map(|row| row.deepest_overlap).reduce(f64::max),
            fingerprint: last.map(|sample| recording.fingerprint(sample)),
        }
    }

    /// Writes `summary.json`.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut out, self)?;
        out.write_all(b"\n")
    }
}

/// Returns how much total energy was gained (positive) or lost from the first audit row to the last, relative to the
/// energy that was in play [1]; none without audit rows.
///
/// In play is the larger of the largest kinetic energy and the range of the potential energy: unlike the total energy,
/// neither depends on where the potential is called zero. Friction, damping and inelastic impacts lose energy rightly.
pub fn energy_drift<D: RecordDim>(recording: &Recording<D>) -> Option<f64> {
    let (first, last) = (recording.audit.first()?, recording.audit.last()?);
    let kinetic = recording.audit.iter().map(|row| row.kinetic).fold(0.0, f64::max);
    let highest = recording.audit.iter().map(|row| row.potential).fold(f64::NEG_INFINITY, f64::max);
    let lowest = recording.audit.iter().map(|row| row.potential).fold(f64::INFINITY, f64::min);
    let in_play = kinetic.max(highest - lowest);
    let change = last.total - first.total;
    Some(if change == 0.0 { 0.0 } else { change / in_play })
}
