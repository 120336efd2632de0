//! Which shapes are near, and where exactly they touch. Nothing here changes a velocity.
//!
//! - [`broad`]: [`BroadPhase`] keeps the set of pairs whose grown bounds overlap, at a cost that follows what moved;
//! - [`narrow`]: [`collide`](narrow::planar::collide) finds the contact points of one pair as a [`Manifold`];
//! - [`manifold`]: what a manifold is: points that share a normal, each with a separation, a feature id and a kind.

pub mod broad;
pub mod manifold;
pub mod narrow;

pub use broad::{BroadPhase, PairChanges, Volume};
pub use manifold::{ContactKind, ContactPoint, FeatureId, Manifold, PlanarManifold};
pub use narrow::planar::collide;
pub use narrow::{PlanarQuery, Query};
