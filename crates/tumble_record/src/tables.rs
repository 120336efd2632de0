//! Tables: what happened as CSV.
//!
//! A header, then one record per line, ended by a line feed; names are quoted as RFC 4180 asks. Numbers are the shortest
//! decimals that read back to the same bits. Vectors take a column per axis, in the plane and in space; what a column holds
//! is said at the field of the recording that it comes from.

use std::io::{self, Write};

use serde::Serialize;
use tumble_sim::Ledger;

use crate::dim::RecordDim;
use crate::recording::{AnchorRecord, BodyKind, Recording, TouchPhase};

/// Columns of `trajectory.csv`: `body` is a name, then come the fields of [`BodyState`](crate::BodyState).
pub fn trajectory_columns<D: RecordDim>() -> Vec<String> {
    let names = D::COLUMNS;
    join([&["step", "time", "body"], names.point, names.orientation, names.velocity, names.angular_velocity])
}

/// Columns of `contacts.csv`: `a` and `b` are names, the rest are the fields of [`ContactRecord`](crate::ContactRecord).
pub fn contact_columns<D: RecordDim>() -> Vec<String> {
    let names = D::COLUMNS;
    join([
        &["step", "time", "a", "b"],
        names.point,
        names.normal,
        &["separation", "normal_impulse"],
        names.tangent_impulse,
        &["kind"],
    ])
}

/// Columns of `audit.csv`: the fields of [`AuditRow`](crate::AuditRow), then those of [`Ledger`]. An empty field says that nothing was solved.
pub fn audit_columns<D: RecordDim>() -> Vec<String> {
    let names = D::COLUMNS;
    let mut columns = join([
        &["step", "time", "kinetic", "potential", "total"],
        names.momentum,
        names.angular_momentum,
        &["deepest_overlap", "contacts", "iterations", "residual"],
    ]);
    columns.extend(ledger_columns());
    columns
}

/// Columns of `joints.csv`: `joint` is a name, `a` and `b` are those of its bodies, empty for the world; the rest are the fields of
/// [`JointForce`](crate::JointForce).
pub fn joint_columns<D: RecordDim>() -> Vec<String> {
    let names = D::COLUMNS;
    join([&["step", "time", "joint", "kind", "a", "b"], names.point, names.force, names.torque])
}

/// Columns of `touches.csv`: `phase` is `begin` or `end`, the rest are the fields of [`Touch`](crate::Touch).
pub const TOUCH_COLUMNS: [&str; 6] = ["step", "time", "a", "b", "phase", "sensor"];

/// Writes `trajectory.csv`: one row per sample and moving body (not the static ones).
pub fn write_trajectory<D: RecordDim>(recording: &Recording<D>, out: impl Write) -> io::Result<()> {
    let rows = recording.samples.iter().flat_map(|sample| {
        let moving = recording.bodies.iter().enumerate().filter(|(_, body)| body.kind != BodyKind::Static);
        moving.filter_map(move |(index, body)| Some((sample.step, sample.time, &body.name, sample.state(index)?)))
    });
    write_table(trajectory_columns::<D>(), rows, out)
}

/// Writes `contacts.csv`: one row per sample and touching point.
pub fn write_contacts<D: RecordDim>(recording: &Recording<D>, out: impl Write) -> io::Result<()> {
    let rows = recording.samples.iter().flat_map(|sample| {
        sample.contacts.iter().map(move |contact| {
            let bodies = [contact.a, contact.b].map(|body| name(recording, body));
            let impulses = (contact.normal_impulse, contact.tangent_impulse);
            let place = (contact.point, contact.normal, contact.separation);
            (sample.step, sample.time, bodies, place, impulses, &contact.kind)
        })
    });
    write_table(contact_columns::<D>(), rows, out)
}

/// Writes `audit.csv`: one row per step.
pub fn write_audit<D: RecordDim>(recording: &Recording<D>, out: impl Write) -> io::Result<()> {
    write_table(audit_columns::<D>(), recording.audit.iter(), out)
}

/// Writes `joints.csv`: one row per joint and sample.
pub fn write_joints<D: RecordDim>(recording: &Recording<D>, out: impl Write) -> io::Result<()> {
    let body = |anchor: &AnchorRecord<D>| anchor.body.map_or("", |body| name(recording, body));
    let rows = recording.samples.iter().flat_map(|sample| {
        sample.joints.iter().filter_map(move |given| {
            let joint = recording.joints.get(given.joint)?;
            let bodies = [body(&joint.a), body(&joint.b)];
            Some((sample.step, sample.time, &joint.name, &joint.kind, bodies, (given.point, given.force, given.torque)))
        })
    });
    write_table(joint_columns::<D>(), rows, out)
}

/// Writes `touches.csv`: one row per message of touch.
pub fn write_touches<D: RecordDim>(recording: &Recording<D>, out: impl Write) -> io::Result<()> {
    let rows = recording.touches.iter().map(|touch| {
        let phase = match touch.phase {
            TouchPhase::Begin => "begin",
            TouchPhase::End => "end",
        };
        (touch.step, touch.time, name(recording, touch.a), name(recording, touch.b), phase, touch.sensor)
    });
    write_table(TOUCH_COLUMNS.map(str::to_owned).into(), rows, out)
}

/// Names of the fields of the ledger: csv writes them as the header of a table.
fn ledger_columns() -> Vec<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.serialize(Ledger::default()).expect("its fields are plain values");
    let table = writer.into_inner().expect("memory takes all");
    let header = table.split(|byte| *byte == b'\n').next().unwrap_or_default();
    String::from_utf8_lossy(header).split(',').map(str::to_owned).collect()
}

fn join<const N: usize>(groups: [&[&str]; N]) -> Vec<String> {
    groups.concat().into_iter().map(str::to_owned).collect()
}

/// Returns the name of a body, or an empty one for an index out of range.
fn name<D: RecordDim>(recording: &Recording<D>, body: usize) -> &str {
    recording.bodies.get(body).map_or("", |body| body.name.as_str())
}

/// Writes a header, even when no row follows, then the rows; what is nested in a row is written one after the other.
fn write_table<R: Serialize>(columns: Vec<String>, rows: impl Iterator<Item = R>, out: impl Write) -> io::Result<()> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    writer.write_record(columns)?;
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()
}
