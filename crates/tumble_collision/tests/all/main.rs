//! The tests of `tumble_collision` as one program, which links once.

mod broad_phase;
mod common;
mod cylinders_and_cones;
mod ghost_bumps;
mod ground;
mod narrow_planar;
mod narrow_spatial;
mod oriented_box;
mod spatial;
mod spatial_oracle;
mod thin_rods;
