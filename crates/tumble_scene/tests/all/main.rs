//! The tests of `tumble_scene` as one program, which links once.

mod batch;
mod check;
mod materials;
mod messages;
mod overlap;
mod robustness;
mod round_trip;
mod surfaces;
