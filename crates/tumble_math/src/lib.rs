//! Numbers for mechanics in the plane and in space. Nothing here has heard of a body.
//!
//! One trait, [`Dim`], says what differs between the two: [`Planar`] and [`Spatial`] choose the vector, the angular quantity, the
//! rotation and the inertia, and the two cross products of mechanics have two names, [`Dim::torque`] and [`Dim::spin`]. Code
//! written over `Dim` is written once.
//!
//! Every function gives the same bits on every machine: no fused multiply-add, and trigonometry only through [`trig`].

mod bounds;
mod dim;
mod inertia;
mod matrix;
mod pose;
mod principal;
mod rotation;
pub mod trig;
mod vector;

pub use bounds::Bounds;
pub use dim::{Dim, Planar, Spatial};
pub use inertia::{Inertia, SymmetricTensor};
pub use matrix::Matrix;
pub use pose::Pose;
pub use rotation::{PlanarRotation, Rotation, SpatialRotation};
pub use vector::{Angular, Linear, Vector};
