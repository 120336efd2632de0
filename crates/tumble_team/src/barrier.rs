//! A point that all members of a team reach before any goes on.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// So many looks before a waiting thread lets others run.
pub(crate) const PATIENCE: u32 = 4096;

/// A point that all members of a team reach before any goes on: what they wrote before, all can read after.
///
/// Waiting threads spin, since phases of a step are some microseconds long.
#[derive(Debug)]
pub struct Barrier {
    members: usize,
    arrived: AtomicUsize,
    generation: AtomicUsize,
    broken: AtomicBool,
}

impl Barrier {
    pub(crate) fn new(members: usize) -> Self {
        Self { members, arrived: AtomicUsize::new(0), generation: AtomicUsize::new(0), broken: AtomicBool::new(false) }
    }

    /// Waits until every member has come here.
    ///
    /// # Panics
    ///
    /// When another member panicked and will never come.
    #[inline]
    pub fn wait(&self) {
        if self.members > 1 {
            self.wait_for_others();
        }
    }

    fn wait_for_others(&self) {
        let generation = self.generation.load(Ordering::Acquire);
        if self.arrived.fetch_add(1, Ordering::AcqRel) + 1 == self.members {
            self.arrived.store(0, Ordering::Relaxed);
            self.generation.store(generation.wrapping_add(1), Ordering::Release);
            return;
        }
        let mut looks = 0;
        while self.generation.load(Ordering::Acquire) == generation {
            assert!(!self.broken.load(Ordering::Relaxed), "another thread of the team panicked");
            looks += 1;
            if looks < PATIENCE {
                std::hint::spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
    }

    /// Tells the others if the holder panics.
    pub(crate) fn guard(&self) -> Guard<'_> {
        Guard { barrier: self }
    }
}

/// Breaks the barrier when it is dropped before it is disarmed.
pub(crate) struct Guard<'a> {
    barrier: &'a Barrier,
}

impl Guard<'_> {
    pub(crate) fn disarm(self) {
        std::mem::forget(self);
    }
}

impl Drop for Guard<'_> {
    fn drop(&mut self) {
        self.barrier.broken.store(true, Ordering::Relaxed);
    }
}
