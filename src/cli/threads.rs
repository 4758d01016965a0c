//! How many threads the kernel's passes run on.

use crate::{cli::failure::Failure, sim::workers::Workers};

/// `threads` threads, or as many as there are processors.
pub(super) fn workers(threads: Option<u64>) -> Result<Workers, Failure> {
    let Some(threads) = threads else { return Ok(Workers::default()) };
    Workers::new(threads as usize)
        .map_err(|error| Failure::Outcome(format!("--threads {threads}: the threads can't be started: {error}")))
}
