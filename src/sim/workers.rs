//! The threads that the kernel may use.

use super::trial::Trial;
use crate::kernel::parallel::{are_awake, watched};
use bevy::{platform::time::Instant, prelude::Resource};
use std::{
    num::NonZero,
    sync::{Arc, LazyLock},
};

/// Fewer particles than this are done on one thread: keeping the others awake costs more than they save.
const WORTH_SHARING: usize = 500;

/// The same where the others are asleep: handing work over then costs as much as the passes over fewer.
const WORTH_WAKING: usize = 6_000;

/// The same where a particle takes a fraction of a nanosecond: entering the pool takes some ten microseconds.
const WORTH_SHARING_CHECKS: usize = 200_000;

/// Cores that this process may use. A page does not know, and takes no more threads than its browser says that there are.
static CORES: LazyLock<usize> = LazyLock::new(|| {
    let unknown = if cfg!(target_arch = "wasm32") { usize::MAX } else { 1 };
    std::thread::available_parallelism().map_or(unknown, NonZero::get)
});

/// A pool of threads for the kernel's passes. By default rayon's own, with one thread a core.
#[derive(Resource, Clone, Default)]
pub struct Workers {
    pool: Option<Arc<rayon::ThreadPool>>,
    /// Whether there is no pool: the calling thread does all.
    alone: bool,
    /// Whether ticks are shared out.
    trial: Arc<Trial>,
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
        Ok(Self { pool: Some(Arc::new(pool)), ..Self::default() })
    }

    /// No pool: the thread that asks does the work.
    pub fn single() -> Self {
        Self { alone: true, ..Self::default() }
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

    /// Runs the substeps of a tick like [`Workers::run_awake`], and takes their time to see now and then whether sharing them out
    /// pays.
    pub fn run_tick<T: Send>(&self, particles: usize, substeps: u32, work: impl FnOnce() -> T + Send) -> T {
        let threads = self.threads();
        if threads < 2 || particles < WORTH_SHARING {
            return self.run_awake(particles, work);
        }
        let start = Instant::now();
        let result = self.run_awake(particles, work);
        self.trial.note(particles * substeps as usize, start.elapsed(), threads);
        result
    }

    /// Runs `work` while the other threads stay awake for what it hands over in turn ([`Workers::run_for`]), if it is over enough
    /// particles and there is a core for each thread.
    pub fn run_awake<T: Send>(&self, particles: usize, work: impl FnOnce() -> T + Send) -> T {
        let is_worth_it = particles >= WORTH_SHARING && !self.trial.is_alone();
        if is_worth_it && (2..=*CORES).contains(&self.threads()) {
            self.run(|threads| watched(threads - 1, work))
        } else {
            self.run_for(particles, |_| work())
        }
    }

    /// [`Workers::run`] for work over `particles` particles: on one thread if they are few.
    pub fn run_for<T: Send>(&self, particles: usize, work: impl FnOnce(usize) -> T + Send) -> T {
        self.run_if(particles >= if are_awake() { WORTH_SHARING } else { WORTH_WAKING }, work)
    }

    /// [`Workers::run_for`] for a look at each particle.
    pub fn run_checks<T: Send>(&self, particles: usize, work: impl FnOnce(usize) -> T + Send) -> T {
        self.run_if(particles >= WORTH_SHARING_CHECKS, work)
    }

    /// [`Workers::run`] if the work is worth sharing and sharing is found to pay, else on this thread.
    pub fn run_if<T: Send>(&self, worth: bool, work: impl FnOnce(usize) -> T + Send) -> T {
        if worth && !self.trial.is_alone() { self.run(work) } else { work(1) }
    }
}
