//! The tests of `tumble_record` as one program, which links once.

mod channels;
mod common;
mod files;
mod output;
mod pictures;
mod replay;
mod tables;
