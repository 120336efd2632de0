//! Shapes and their mass. Nothing here has heard of a body.
//!
//! A shape lives in the frame of whatever carries it; a pose puts it into the world. Constructors are named `try_new` and refuse
//! degenerate geometry with a [`ShapeError`] that says why, so every shape that exists is a good one.
//!
//! ```text
//!  rod            disc          convex polygon       half-plane
//!
//!  from           .-"-.          3 ______ 2                ^ normal
//!    \           /  c  \          /      \          _______|_______ normal·p = offset
//!     \          \  r--/         /________\         ///////////////
//!      to         '-.-'         0          1        /// solid /////
//! ```
//!
//! - [`planar`]: [`Rod`], [`Disc`], [`ConvexPolygon`], [`HalfPlane`] and the enum over them, [`PlanarShape`];
//! - [`mass`]: [`MassProperties`] and the parallel-axis theorem, in the plane and in space.

pub mod error;
pub mod mass;
pub mod planar;

pub use error::ShapeError;
pub use mass::{MassDim, MassProperties};
pub use planar::{ConvexPolygon, Disc, HalfPlane, PlanarShape, Rod};
