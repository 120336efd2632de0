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
//! - [`spatial`]: spheres, rods, capsules, boxes, convex hulls, cylinders, cones, half-spaces and [`SpatialShape`];
//! - [`mass`]: [`MassProperties`] and the parallel-axis theorem, in the plane and in space.
//!
//! ```
//! use glam::DVec2;
//! use tumble_shape::{MassProperties, PlanarShape, Rod};
//!
//! // An L of two rods, 1 kg/m each.
//! let foot = PlanarShape::from(Rod::try_new(DVec2::ZERO, DVec2::new(2.0, 0.0), 0.0)?);
//! let stem = PlanarShape::from(Rod::try_new(DVec2::ZERO, DVec2::new(0.0, 1.0), 0.0)?);
//! let whole = MassProperties::combine([foot, stem].iter().filter_map(|rod| rod.mass_properties(1.0)));
//! assert_eq!(whole.unwrap().mass, 3.0);
//! # Ok::<(), tumble_shape::ShapeError>(())
//! ```

pub mod error;
mod given;
pub mod mass;
pub mod planar;
pub mod spatial;

pub use error::ShapeError;
pub use given::MassError;
pub use mass::{MassDim, MassProperties};
pub use planar::{ConvexPolygon, Disc, HalfPlane, PlanarShape, Rod};
pub use spatial::{
    Capsule, Cone, ConvexHull, Cuboid, Cylinder, Facet, HalfSpace, MeshError, SpatialRod, SpatialShape,
    SpatialShapeError, Sphere, TriangleMesh, join_corners,
};
