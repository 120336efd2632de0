//! Which shapes are near, and where exactly they touch. Nothing here changes a velocity.
//!
//! - [`broad`]: [`BroadPhase`] keeps the set of pairs whose grown bounds overlap, at a cost that follows what moved;
//! - [`narrow`]: [`collide`] finds the contact points of one pair as a [`Manifold`], [`collide_spatial`] those of a pair in space;
//! - [`arrival`]: when a gap closes;
//! - [`manifold`]: what a manifold is: points that share a normal, each with a separation, a feature id and a kind.
//!
//! ```
//! use glam::DVec2;
//! use tumble_collision::{PlanarQuery, collide};
//! use tumble_math::{PlanarRotation, Pose};
//! use tumble_shape::{HalfPlane, PlanarShape, Rod};
//!
//! let floor = PlanarShape::from(HalfPlane::try_new(DVec2::Y, 0.0)?);
//! let rod = PlanarShape::from(Rod::try_new(-DVec2::X, DVec2::X, 0.0)?);
//! let above = Pose { position: DVec2::new(3.0, 0.1), rotation: PlanarRotation::IDENTITY };
//!
//! let query = PlanarQuery { margin: 0.5, flush_tolerance: 0.01, previous: None };
//! let manifold = collide(&floor, &Pose::default(), &rod, &above, &query);
//! assert_eq!(manifold.normal, DVec2::Y);
//! assert_eq!(manifold.points().len(), 2);
//! assert_eq!(manifold.deepest_separation(), Some(0.1));
//! # Ok::<(), tumble_shape::ShapeError>(())
//! ```

pub mod arrival;
pub mod broad;
pub mod manifold;
pub mod narrow;

pub use arrival::{Gap, Search, first_arrival, parabola_arrival};
pub use broad::{BroadPhase, Crowded, OrientedBox, PairChanges, SpatialOrientedBox, TurningBox, Volume};
pub use manifold::{ContactKind, ContactPoint, CornerOf, FeatureId, Manifold, PlanarManifold, SpatialManifold};
pub use narrow::planar::collide;
pub use narrow::spatial::collide as collide_spatial;
pub use narrow::{PlanarQuery, Query, SpatialQuery};
