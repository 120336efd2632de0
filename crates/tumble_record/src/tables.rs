//! Tables: what happened as CSV.
//!
//! A header, then one record per line, ended by a line feed; names are quoted as RFC 4180 asks. Numbers are the shortest
//! decimals that read back to the same bits. The fields of a row are the columns, in this order.

use std::borrow::Cow;
use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use crate::ledger::SolverEnd;
use crate::recording::{AnchorRecord, BodyKind, Recording, TouchPhase};

/// A row of `trajectory.csv`: a moving body at a sampled step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryRow<'a> {
    /// Steps taken so far.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Name of the body.
    pub body: Cow<'a, str>,
    /// Centre of mass, horizontally [m].
    pub x: f64,
    /// Centre of mass, vertically [m].
    pub y: f64,
    /// Angle, accumulated over turns [rad].
    pub angle: f64,
    /// Velocity along x [m/s].
    pub vx: f64,
    /// Velocity along y [m/s].
    pub vy: f64,
    /// Rate of turning, counter-clockwise [rad/s].
    pub omega: f64,
}

/// A row of `contacts.csv`: a touching point at a sampled step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactRow<'a> {
    /// Steps taken so far.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Name of the body with the smaller id.
    pub a: Cow<'a, str>,
    /// Name of the other body.
    pub b: Cow<'a, str>,
    /// Contact point, horizontally [m].
    pub x: f64,
    /// Contact point, vertically [m].
    pub y: f64,
    /// Unit normal from a to b, along x [1].
    pub nx: f64,
    /// Unit normal from a to b, along y [1].
    pub ny: f64,
    /// Gap, negative when overlapping [m].
    pub separation: f64,
    /// Impulse on b along the normal, summed over the step [N·s].
    pub normal_impulse: f64,
    /// Impulse on b along (n_y, −n_x), summed over the step [N·s].
    pub tangent_impulse: f64,
    /// Kind of contact, from the collision layer's closed list.
    pub kind: Cow<'a, str>,
}

/// A row of `audit.csv`: sums over the world after a step. An empty field says that nothing was solved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AuditCsvRow {
    /// Steps taken so far.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Kinetic energy [J].
    pub kinetic: f64,
    /// Potential energy of gravity and springs [J].
    pub potential: f64,
    /// Kinetic plus potential energy [J].
    pub total: f64,
    /// Momentum along x [kg·m/s].
    pub momentum_x: f64,
    /// Momentum along y [kg·m/s].
    pub momentum_y: f64,
    /// Angular momentum about the origin [kg·m²/s].
    pub angular_momentum: f64,
    /// Largest overlap, 0 when none [m].
    pub deepest_overlap: f64,
    /// Number of touching points.
    pub contacts: u64,
    /// Sweeps of the contact solver.
    pub iterations: Option<u64>,
    /// What the contact solver left unsolved.
    pub residual: Option<f64>,
    /// Largest speed at which a contact that touches still closes [m/s].
    pub normal_violation: f64,
    /// Largest slip of a point that sticks [m/s].
    pub tangent_violation: f64,
    /// Work of gravity [J].
    pub work_gravity: f64,
    /// Work of springs, without their dampers [J].
    pub work_springs: f64,
    /// Work of drag, dampers of springs, applied forces and the user's forces [J].
    pub work_user: f64,
    /// Work of friction [J].
    pub work_friction: f64,
    /// Work along the normals of contacts [J].
    pub work_impacts: f64,
    /// Work of joints [J].
    pub work_joints: f64,
    /// Potential energy given by displacements that take out overlap [J].
    pub work_position_correction: f64,
    /// What moving with the velocities of the scheme gives besides [J].
    pub integrator_defect: f64,
    /// What no line of the books explains: round-off [J].
    pub ledger_error: f64,
    /// Contact points that push and stick.
    pub sticking: u64,
    /// Contact points that push and slide.
    pub sliding: u64,
    /// How the contact solver ended: `converged`, `not-converged`.
    pub solver_end: Option<SolverEnd>,
}

/// A row of `joints.csv`: a joint at a sampled step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRow<'a> {
    /// Steps taken so far.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Name of the joint.
    pub joint: Cow<'a, str>,
    /// What it lets the bodies do: `revolute`, `distance`, `fixed`, `prismatic`.
    pub kind: Cow<'a, str>,
    /// Name of its first body; empty for the world.
    pub a: Cow<'a, str>,
    /// Name of its second body; empty for the world.
    pub b: Cow<'a, str>,
    /// Its anchor on b, horizontally [m].
    pub x: f64,
    /// Its anchor on b, vertically [m].
    pub y: f64,
    /// Force on b at the anchor along x, mean over the step [N].
    pub fx: f64,
    /// Force on b at the anchor along y, mean over the step [N].
    pub fy: f64,
    /// Torque on b about the anchor, counter-clockwise, mean over the step [N·m].
    pub torque: f64,
}

/// A row of `touches.csv`: two bodies began or ceased to touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TouchRow<'a> {
    /// Step in which it was found.
    pub step: u64,
    /// Time at the end of that step [s].
    pub time: f64,
    /// Name of the body with the smaller id.
    pub a: Cow<'a, str>,
    /// Name of the other body.
    pub b: Cow<'a, str>,
    /// `begin` or `end`.
    pub phase: Cow<'a, str>,
    /// `true` where a sensor was involved, so that no force acts.
    pub sensor: bool,
}

/// Columns of `trajectory.csv`.
pub const TRAJECTORY_COLUMNS: [&str; 9] = ["step", "time", "body", "x", "y", "angle", "vx", "vy", "omega"];

/// Columns of `contacts.csv`.
pub const CONTACT_COLUMNS: [&str; 12] =
    ["step", "time", "a", "b", "x", "y", "nx", "ny", "separation", "normal_impulse", "tangent_impulse", "kind"];

/// Columns of `audit.csv`.
pub const AUDIT_COLUMNS: [&str; 26] = [
    "step",
    "time",
    "kinetic",
    "potential",
    "total",
    "momentum_x",
    "momentum_y",
    "angular_momentum",
    "deepest_overlap",
    "contacts",
    "iterations",
    "residual",
    "normal_violation",
    "tangent_violation",
    "work_gravity",
    "work_springs",
    "work_user",
    "work_friction",
    "work_impacts",
    "work_joints",
    "work_position_correction",
    "integrator_defect",
    "ledger_error",
    "sticking",
    "sliding",
    "solver_end",
];

/// Columns of `joints.csv`.
pub const JOINT_COLUMNS: [&str; 11] = ["step", "time", "joint", "kind", "a", "b", "x", "y", "fx", "fy", "torque"];

/// Columns of `touches.csv`.
pub const TOUCH_COLUMNS: [&str; 6] = ["step", "time", "a", "b", "phase", "sensor"];

/// Writes `trajectory.csv`: one row per sample and moving body (not the static ones).
pub fn write_trajectory(recording: &Recording, out: impl Write) -> io::Result<()> {
    let rows = recording.samples.iter().flat_map(|sample| {
        let moving = recording.bodies.iter().enumerate().filter(|(_, body)| body.kind != BodyKind::Static);
        moving.filter_map(move |(index, body)| {
            let [x, y, angle, vx, vy, omega] = sample.state(index)?.numbers();
            let body = Cow::from(&body.name);
            Some(TrajectoryRow { step: sample.step, time: sample.time, body, x, y, angle, vx, vy, omega })
        })
    });
    write_table(&TRAJECTORY_COLUMNS, rows, out)
}

/// Writes `contacts.csv`: one row per sample and touching point.
pub fn write_contacts(recording: &Recording, out: impl Write) -> io::Result<()> {
    let rows = recording.samples.iter().flat_map(|sample| {
        sample.contacts.iter().map(move |contact| ContactRow {
            step: sample.step,
            time: sample.time,
            a: name(recording, contact.a),
            b: name(recording, contact.b),
            x: contact.point.x,
            y: contact.point.y,
            nx: contact.normal.x,
            ny: contact.normal.y,
            separation: contact.separation,
            normal_impulse: contact.normal_impulse,
            tangent_impulse: contact.tangent_impulse,
            kind: Cow::from(&*contact.kind),
        })
    });
    write_table(&CONTACT_COLUMNS, rows, out)
}

/// Writes `audit.csv`: one row per step.
pub fn write_audit(recording: &Recording, out: impl Write) -> io::Result<()> {
    let rows = recording.audit.iter().map(|row| AuditCsvRow {
        step: row.step,
        time: row.time,
        kinetic: row.kinetic,
        potential: row.potential,
        total: row.total,
        momentum_x: row.momentum.x,
        momentum_y: row.momentum.y,
        angular_momentum: row.angular_momentum,
        deepest_overlap: row.deepest_overlap,
        contacts: row.contacts,
        iterations: row.iterations,
        residual: row.residual,
        normal_violation: row.ledger.normal_violation,
        tangent_violation: row.ledger.tangent_violation,
        work_gravity: row.ledger.work_gravity,
        work_springs: row.ledger.work_springs,
        work_user: row.ledger.work_user,
        work_friction: row.ledger.work_friction,
        work_impacts: row.ledger.work_impacts,
        work_joints: row.ledger.work_joints,
        work_position_correction: row.ledger.work_position_correction,
        integrator_defect: row.ledger.integrator_defect,
        ledger_error: row.ledger.ledger_error,
        sticking: row.ledger.sticking,
        sliding: row.ledger.sliding,
        solver_end: row.ledger.solver_end,
    });
    write_table(&AUDIT_COLUMNS, rows, out)
}

/// Writes `joints.csv`: one row per joint and sample.
pub fn write_joints(recording: &Recording, out: impl Write) -> io::Result<()> {
    let body = |anchor: &AnchorRecord| anchor.body.map_or(Cow::from(""), |body| name(recording, body));
    let rows = recording.samples.iter().flat_map(|sample| {
        sample.joints.iter().filter_map(move |given| {
            let joint = recording.joints.get(given.joint)?;
            Some(JointRow {
                step: sample.step,
                time: sample.time,
                joint: Cow::from(&joint.name),
                kind: Cow::from(&*joint.kind),
                a: body(&joint.a),
                b: body(&joint.b),
                x: given.point.x,
                y: given.point.y,
                fx: given.force.x,
                fy: given.force.y,
                torque: given.torque,
            })
        })
    });
    write_table(&JOINT_COLUMNS, rows, out)
}

/// Writes `touches.csv`: one row per message of touch.
pub fn write_touches(recording: &Recording, out: impl Write) -> io::Result<()> {
    let rows = recording.touches.iter().map(|touch| TouchRow {
        step: touch.step,
        time: touch.time,
        a: name(recording, touch.a),
        b: name(recording, touch.b),
        phase: Cow::from(match touch.phase {
            TouchPhase::Begin => "begin",
            TouchPhase::End => "end",
        }),
        sensor: touch.sensor,
    });
    write_table(&TOUCH_COLUMNS, rows, out)
}

/// Returns the name of a body, or an empty one for an index out of range.
fn name(recording: &Recording, body: usize) -> Cow<'_, str> {
    Cow::from(recording.bodies.get(body).map_or("", |body| body.name.as_str()))
}

/// Writes a header, even when no row follows, then the rows.
fn write_table<R: Serialize>(columns: &[&str], rows: impl Iterator<Item = R>, out: impl Write) -> io::Result<()> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    writer.write_record(columns)?;
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()
}
