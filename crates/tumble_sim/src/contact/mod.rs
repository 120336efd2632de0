//! Contacts: entities that live while two parts are near, the systems that find them, and those that answer them.
//!
//! ```text
//! find_pairs ─▶ sync_pairs ─▶ find_contacts       DetectCollisions: bounds → pairs → manifolds → match
//!                                  │
//!            penalty forces ◀──────┼──────▶ velocity filter, position filter, one-by-one impulses
//! ```

mod colliders;
mod detect;
mod impulse;
mod materials;
mod pair;
mod penalty;
mod problem;
mod touch;

pub use colliders::{Collider, Colliders, IgnoredPairs};
pub use detect::{Detection, find_contacts, find_pairs, sync_pairs};
pub use impulse::{PositionCorrections, filter_positions, filter_velocities, resolve_impulses};
pub use materials::Materials;
pub use pair::{ContactManifold, ContactMemory, ContactPair, PairKey, PointMemory};
pub use penalty::{PreviousEnds, apply_lecture_floor, apply_penalty_forces};
pub use problem::{ContactProblem, ContactReport};
pub use touch::{Touch, TouchPhase};

pub(crate) use colliders::prepare_colliders;
pub(crate) use detect::renumber_pairs;
