//! Files ↔ worlds: the scene format, its mistakes, and what a scene promises.

pub mod format;
