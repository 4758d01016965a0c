//! How many threads the kernel's passes run on.

use crate::cli::failure::Failure;

/// Gives the passes `threads` threads instead of one a processor. Once in a process, before the first tick.
pub(super) fn start(threads: Option<u64>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads as usize)
        .build_global()
        .map_err(|error| Failure::Outcome(format!("--threads {threads}: the threads can't be started: {error}")))
}
