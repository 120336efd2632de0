//! The tests of `tumble_solver` as one program, which links once.

mod common;
mod gaps_in_space;
mod joints;
mod resting_lcp;
mod soft_step;
mod spatial;
mod velocity_lcp;
