//! The tests of `tumble_shape` as one program, which links once.

mod common;
mod convex_hull;
mod mass_of_rod_bodies;
mod shapes;
mod solid_mass;
