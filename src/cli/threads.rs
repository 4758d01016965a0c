//! How many threads the kernel's passes run on.

use crate::cli::failure::Failure;

/// Gives the passes `threads` threads instead of one a processor. The calling thread, on which the ticks must run, is one
/// of them: so no tick waits for another to wake up. Once in a process, before the first tick.
pub(super) fn start(threads: Option<u64>) -> Result<(), Failure> {
    build(threads, rayon::ThreadPoolBuilder::new().use_current_thread())
}

/// The same for a game, whose ticks run on any thread.
pub(super) fn start_aside(threads: Option<u64>) -> Result<(), Failure> {
    build(threads, rayon::ThreadPoolBuilder::new())
}

fn build(threads: Option<u64>, pool: rayon::ThreadPoolBuilder) -> Result<(), Failure> {
    // 0 is one a processor.
    pool.num_threads(threads.unwrap_or(0) as usize).build_global().map_err(|error| {
        let wish = threads.map_or_else(String::new, |threads| format!("--threads {threads}: "));
        Failure::Outcome(format!("{wish}the threads can't be started: {error}"))
    })
}
