//! Ctrl-C: the first one ends a run in good order, the second at once.

use std::sync::atomic::{AtomicBool, Ordering};

static WANTED: AtomicBool = AtomicBool::new(false);

/// Exit code of a program that was ended by Ctrl-C at once, as shells know it.
const ENDED_AT_ONCE: i32 = 130;

/// Begins to listen for Ctrl-C, and for the system's request to end.
pub fn listen() {
    let listening = ctrlc::set_handler(|| {
        if WANTED.swap(true, Ordering::Relaxed) {
            std::process::exit(ENDED_AT_ONCE);
        }
    });
    // Without a handler, Ctrl-C ends the program at once: a run can do without.
    drop(listening);
}

/// Whether the run should end.
pub fn is_wanted() -> bool {
    WANTED.load(Ordering::Relaxed)
}
