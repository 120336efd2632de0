//! The tests of `tumble_bench` as one program, which links once.

mod judge;
mod program;
mod run;
mod scenes;
