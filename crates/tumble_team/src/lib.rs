//! Threads that share the work of one step.
//!
//! Nothing that is computed may depend on how many they are. Both ways of sharing keep to that:
//!
//! - [`share`](Team::share): tasks that write to places of their own, in any order;
//! - [`together`](Team::together): one share each, hand in hand through phases that a [`Barrier`] keeps apart.
//!
//! A team of one is the calling thread itself: it allocates nothing and wakes nobody.

mod barrier;

use std::sync::{Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

pub use barrier::Barrier;

/// Threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {source}")]
pub struct TeamError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

/// Threads that share the work of one step.
#[derive(Debug, Default)]
pub struct Team {
    /// None for a team of one.
    pool: Option<ThreadPool>,
}

impl Team {
    /// The calling thread alone.
    pub const fn alone() -> Self {
        Self { pool: None }
    }

    /// A team of so many threads; 0 counts as 1.
    ///
    /// # Errors
    ///
    /// When the system refuses a thread.
    pub fn new(threads: usize) -> Result<Self, TeamError> {
        if threads <= 1 {
            return Ok(Self::alone());
        }
        let builder = ThreadPoolBuilder::new().num_threads(threads).thread_name(|k| format!("step-{k}"));
        let pool = builder.build().map_err(|source| TeamError { threads, source })?;
        Ok(Self { pool: Some(pool) })
    }

    /// Number of threads.
    pub fn size(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Runs `work` on one of the threads: always the same one, whose caches know the work of the step before.
    ///
    /// # Panics
    ///
    /// When the work does.
    pub fn enter<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        let Some(pool) = &self.pool else { return work() };
        let work = Mutex::new(Some(work));
        let results = pool.broadcast(|thread| {
            let first = thread.index() == 0;
            let work = if first { work.lock().unwrap_or_else(PoisonError::into_inner).take() } else { None };
            work.map(|work| work())
        });
        results.into_iter().flatten().next().expect("the first thread has worked")
    }

    /// Does every task on whichever thread is free. No task may depend on another.
    pub fn share<T: Send>(&self, tasks: impl Iterator<Item = T>, work: impl Fn(T) + Sync) {
        let Some(pool) = &self.pool else {
            tasks.for_each(work);
            return;
        };
        let work = &work;
        pool.in_place_scope(|scope| {
            for task in tasks {
                scope.spawn(move |_| work(task));
            }
        });
    }

    /// Works on every share at once, one thread each: at most as many shares as there are threads. The [`Barrier`] waits for all of them.
    ///
    /// # Panics
    ///
    /// When there are more shares than threads, or when the work on one panics: the others then panic at their next barrier.
    pub fn together<T: Send>(&self, mut shares: impl ExactSizeIterator<Item = T>, work: impl Fn(T, &Barrier) + Sync) {
        let count = shares.len();
        assert!(count <= self.size(), "{count} shares for {} threads", self.size());
        let barrier = Barrier::new(count);
        let Some(first) = shares.next() else { return };
        let (work, barrier) = (&work, &barrier);
        let guarded = move |share: T| {
            let guard = barrier.guard();
            work(share, barrier);
            guard.disarm();
        };
        match &self.pool {
            None => guarded(first),
            // Each of the other threads is idle, takes one share, and keeps it to the end.
            Some(pool) => pool.in_place_scope(|scope| {
                for share in shares {
                    scope.spawn(move |_| guarded(share));
                }
                guarded(first);
            }),
        }
    }
}
