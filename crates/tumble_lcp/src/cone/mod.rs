//! Cone.
