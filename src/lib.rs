//! tumble
