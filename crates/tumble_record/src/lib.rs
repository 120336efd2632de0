//! What happened: plain data about a finished run, and everything that is made of it.
//!
//! A [`Recording`] holds the bodies with their shapes, samples of their states and contacts, one audit row per step and
//! the messages of touch. [`Record`] fills it while a simulation runs. From it come
//!
//! - tables: [`tables`] writes `trajectory.csv`, `contacts.csv`, `audit.csv`, `touches.csv` and, for scenes with joints, `joints.csv`,
//! - numbers: [`Summary`] is `summary.json`, [`Fingerprint`] condenses a state into 32 hex digits,
//! - curves: a [`Channel`] names a quantity (`y:ball`), [`plot`] draws it,
//! - pictures that move: [`replay`] is one HTML file that opens offline, [`gltf`] an animation for viewers of models, [`frames`] are PNG files and a GIF,
//! - files: [`OutputFolder`] makes all of them appear whole or not at all.
//!
//! SI units, world frame unless said otherwise; angles in radians, accumulated over turns.

mod channel;
mod dim;
mod files;
mod fingerprint;
mod fittings;
pub mod frames;
pub mod gltf;
mod joints;
pub mod mesh;
mod names;
mod output;
pub mod plot;
mod recorder;
mod recording;
pub mod replay;
mod sampling;
mod springs;
mod stage;
mod summary;
pub mod tables;
mod thin;

pub use channel::{
    BodyQuantity, Channel, ChannelError, JointQuantity, MOST_CURVES, Series, WorldQuantity, body_quantity_names,
    joint_quantity_names, world_names,
};
pub use dim::{Columns, Geometry, Home, Plain, RecordDim, SpatialGeometry, TurnAxis};
pub use files::{Completeness, FileAction, FileError, OutputFolder, PreparedFiles, write_file};
pub use fingerprint::{Fingerprint, FingerprintHasher, ParseFingerprintError};
pub use output::{OutputError, write_run};
pub use recorder::Record;
pub use recording::{
    AnchorRecord, AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, JointForce, JointRecord, Recording, Sample,
    ShapeRecord, SpringRecord, Touch, TouchPhase,
};
pub use sampling::Sampling;
pub use summary::{Summary, energy_drift};
