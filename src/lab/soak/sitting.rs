//! Who ran a soak.

use serde::{Deserialize, Serialize};

/// What one process did of a soak.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sitting {
    /// Minutes of the soak that were done before it.
    pub from: u64,
    /// The processor.
    pub processor: String,
    /// Threads.
    pub threads: usize,
    /// Instruction set.
    pub instructions: String,
    /// What it took, s of real time; of one that was stopped, up to what it kept last.
    pub seconds: f64,
}
