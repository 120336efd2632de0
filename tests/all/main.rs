//! The tests of `tumble` as one program, which links once; `determinism` stands apart, since it runs in both profiles.

mod embedded_scenes;
mod examples;
mod replay_in_browser;
mod shipped_scenes;
