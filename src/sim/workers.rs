//! The threads that the kernel may use.

use crate::kernel::parallel::watched;
use bevy::prelude::Resource;
use std::{
    num::NonZero,
    sync::{Arc, LazyLock},
};

/// Fewer particles than this are done on one thread: handing them over costs more than it saves.
const WORTH_SHARING: usize = 6_000;

/// The same where a particle takes a fraction of a nanosecond: entering the pool takes some ten microseconds.
const WORTH_SHARING_CHECKS: usize = 200_000;

/// Cores that this process may use.
static CORES: LazyLock<usize> = LazyLock::new(|| std::thread::available_parallelism().map_or(1, NonZero::get));

/// A pool of threads for the kernel's passes. By default rayon's own, with one thread a core.
#[derive(Resource, Clone, Default)]
pub struct Workers {
    pool: Option<Arc<rayon::ThreadPool>>,
    /// Whether there is no pool: the calling thread does all.
    alone: bool,
}

impl Workers {
    /// A pool of exactly `threads` threads, at least 1.
    ///
    /// # Errors
    /// If the system gives no threads.
    pub fn new(threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build()?;
        // A thread that is still starting would slow a tick down.
        pool.broadcast(|_| ());
        Ok(Self { pool: Some(Arc::new(pool)), alone: false })
    }

    /// No pool: the thread that asks does the work.
    pub fn single() -> Self {
        Self { pool: None, alone: true }
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        if self.alone {
            return 1;
        }
        self.pool.as_ref().map_or_else(rayon::current_num_threads, |pool| pool.current_num_threads())
    }

    /// Runs `work` in the pool and tells it how many threads it may use.
    pub fn run<T: Send>(&self, work: impl FnOnce(usize) -> T + Send) -> T {
        match &self.pool {
            Some(pool) if pool.current_num_threads() == 1 => work(1),
            Some(pool) => pool.install(|| work(pool.current_num_threads())),
            None if self.alone || rayon::current_num_threads() == 1 => work(1),
            None => rayon::scope(|_| work(rayon::current_num_threads())),
        }
    }

    /// [`Workers::run_for`] for a whole tick's work, for which the other threads [stay awake](Self::keep_awake).
    pub fn run_tick<T: Send>(&self, particles: usize, work: impl FnOnce() -> T + Send) -> T {
        let keep_awake = self.keep_awake(particles);
        self.run_for(particles, |threads| watched(if keep_awake { threads - 1 } else { 0 }, work))
    }

    /// Whether the other threads stay awake in a tick of so many particles, so that handing work over is cheap: if there is a
    /// core for each.
    pub fn keep_awake(&self, particles: usize) -> bool {
        particles >= WORTH_SHARING && (2..=*CORES).contains(&self.threads())
    }

    /// [`Workers::run`] for work over `particles` particles: on one thread if they are few.
    pub fn run_for<T: Send>(&self, particles: usize, work: impl FnOnce(usize) -> T + Send) -> T {
        self.run_if(particles >= WORTH_SHARING, work)
    }

    /// [`Workers::run_for`] for a look at each particle.
    pub fn run_checks<T: Send>(&self, particles: usize, work: impl FnOnce(usize) -> T + Send) -> T {
        self.run_if(particles >= WORTH_SHARING_CHECKS, work)
    }

    /// [`Workers::run`] if the work is worth sharing, else on this thread.
    pub fn run_if<T: Send>(&self, worth: bool, work: impl FnOnce(usize) -> T + Send) -> T {
        if worth { self.run(work) } else { work(1) }
    }
}
