//! All files of a run, written together.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::channel::{Channel, ChannelError};
use crate::dim::RecordDim;
use crate::files::{Completeness, FileError, OutputFolder};
use crate::plot::Plot;
use crate::recording::Recording;
use crate::replay::write_replay;
use crate::summary::Summary;
use crate::tables::{write_audit, write_contacts, write_joints, write_touches, write_trajectory};

/// Why the files of a run are not there.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A file could not be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A plot was asked for that this recording cannot show.
    #[error(transparent)]
    Channel(#[from] ChannelError),
}

/// Writes the files of a run into a folder, and returns their paths.
///
/// These are `trajectory.csv`, `contacts.csv`, `audit.csv`, `touches.csv`, `joints.csv` if there are joints, `summary.json`, `energy.svg`, `replay.html`
/// and one SVG per channel, named by [`Channel::file_stem`]. A whole run replaces the files of an earlier one; a partial
/// one goes to the folder `partial` beside them.
pub fn write_run<D: RecordDim>(
    folder: &OutputFolder,
    completeness: Completeness,
    recording: &Recording<D>,
    summary: &Summary,
    channels: &[Channel],
) -> Result<Vec<PathBuf>, OutputError> {
    // By name, so that a channel asked for twice is drawn once.
    let mut plots = BTreeMap::from([("energy.svg".to_owned(), Plot::energy(recording))]);
    for channel in channels {
        plots.insert(format!("{}.svg", channel.file_stem()), Plot::channel(recording, channel)?);
    }
    let mut files = folder.prepare(completeness)?;
    files.add("trajectory.csv", |out| write_trajectory(recording, out))?;
    files.add("contacts.csv", |out| write_contacts(recording, out))?;
    files.add("audit.csv", |out| write_audit(recording, out))?;
    files.add("touches.csv", |out| write_touches(recording, out))?;
    if !recording.joints.is_empty() {
        files.add("joints.csv", |out| write_joints(recording, out))?;
    }
    files.add("summary.json", |out| summary.write(out))?;
    for (name, plot) in &plots {
        files.add(name, |out| out.write_all(plot.to_svg().as_bytes()))?;
    }
    files.add("replay.html", |out| write_replay(recording, out))?;
    Ok(files.publish()?)
}
