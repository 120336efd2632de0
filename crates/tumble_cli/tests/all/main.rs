//! The tests of `tumble_cli` as one program, which links once.

mod accuracy;
mod audit;
mod batch;
mod commands;
mod compare;
mod failed;
mod refused;
mod run;
mod support;
