//! Contacts: entities that live while two parts are near, the systems that find them, and those that answer them.
//!
//! ```text
//! find_pairs ─▶ sync_pairs ─▶ find_contacts       DetectCollisions: bounds → pairs → manifolds → match
//!                                  │
//!            penalty forces ◀──────┼──────▶ velocity filter, position filter, one-by-one impulses
//! ```

mod approach;
mod bounds;
mod colliders;
mod detect;
mod found;
mod impact_time;
mod materials;
mod near;
mod pair;
mod penalty;
mod points;
mod problem;
mod resting;
mod reuse;
mod soft;
mod sync;
mod touch;
mod velocity;

pub use colliders::{Collider, Colliders, IgnoredPairs};
pub use detect::{BodyMotion, Detection, MOST_CONTACTS, find_pairs};
pub use impact_time::{ImpactTimes, MOST_PARTS, look_for_impacts};
pub use materials::Materials;
pub use pair::{ContactManifold, ContactMemory, ContactPair, PairKey, PointMemory};
pub use penalty::{PreviousEnds, apply_lecture_floor, apply_penalty_forces};
pub use points::find_contacts;
pub use problem::{ContactProblem, ContactReport};
pub use resting::{RestingModel, apply_resting_forces};
pub use reuse::{CarriedParts, ContactReuse};
pub use soft::{SoftModel, mend_soft_joints, take_soft_steps};
pub use sync::sync_pairs;
pub use touch::{Touch, TouchPhase};
pub use velocity::{PositionCorrections, VelocityModel, filter_positions, filter_velocities, resolve_impulses};

pub(crate) use colliders::prepare_colliders;
pub(crate) use impact_time::{Pass, is_taken};
pub(crate) use problem::BodyQuery;
pub(crate) use sync::renumber_pairs;

/// What slices of contacts rely on.
const IN_TABLES: &str = "the components of contacts lie in tables";
