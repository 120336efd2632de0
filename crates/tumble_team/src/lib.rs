//! Threads that share the work of one step.
//!
//! Nothing that is computed may depend on how many they are. Both ways of sharing keep to that:
//!
//! - [`share`](Team::share): tasks that write to places of their own, in any order;
//! - [`together`](Team::together): one share each, hand in hand through phases that a [`Barrier`] keeps apart.
//!
//! A team of one is the calling thread itself: it allocates nothing and wakes nobody.

mod barrier;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use barrier::PATIENCE;
use rayon::{ThreadPool, ThreadPoolBuilder, Yield};

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

    /// Runs `work` on one of the threads: always the same one, whose caches know the work of the step before. The others stay awake until it is done.
    ///
    /// # Panics
    ///
    /// When the work does.
    pub fn enter<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        let Some(pool) = &self.pool else { return work() };
        let (work, done) = (Mutex::new(Some(work)), AtomicBool::new(false));
        let results = pool.broadcast(|thread| {
            if thread.index() > 0 {
                help_until(&done);
                return None;
            }
            let _done = SetOnDrop(&done);
            let work = work.lock().unwrap_or_else(PoisonError::into_inner).take();
            work.map(|work| work())
        });
        results.into_iter().flatten().next().expect("the first thread has worked")
    }

    /// Does every task on whichever thread is free. No task may depend on another.
    ///
    /// Half of the threads begin with the first tasks and half with the last, so that from step to step most tasks meet the
    /// caches that know them.
    pub fn share<T: Send>(&self, tasks: impl Iterator<Item = T>, work: impl Fn(T) + Sync) {
        let Some(pool) = &self.pool else {
            tasks.for_each(work);
            return;
        };
        let tasks = Mutex::new(tasks.collect::<Vec<T>>().into_iter());
        let next = |from_end: bool| {
            let mut tasks = tasks.lock().unwrap_or_else(PoisonError::into_inner);
            if from_end { tasks.next_back() } else { tasks.next() }
        };
        let do_tasks = |thread: usize| {
            while let Some(task) = next(thread % 2 == 1) {
                work(task);
            }
        };
        let do_tasks = &do_tasks;
        pool.in_place_scope(|scope| {
            for thread in 1..pool.current_num_threads() {
                scope.spawn(move |_| do_tasks(thread));
            }
            do_tasks(0);
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

/// Does what there is to do until a flag is set. Looks often: between two pieces of shared work lie some microseconds.
fn help_until(done: &AtomicBool) {
    let mut looks = 0;
    while !done.load(Ordering::Acquire) {
        if rayon::yield_now() == Some(Yield::Executed) {
            looks = 0;
        } else if looks < PATIENCE {
            looks += 1;
            std::hint::spin_loop();
        } else {
            std::thread::yield_now();
        }
    }
}

/// Sets a flag however its holder ends.
struct SetOnDrop<'a>(&'a AtomicBool);

impl Drop for SetOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}
