//! What a world is simulated on.

use super::values::{simd, threads};
use crate::kernel::simd::InstructionSet;
use clap::Args;

/// Threads and instruction set.
#[derive(Debug, Args)]
pub(in crate::cli) struct Machine {
    /// Threads of the simulation; they never change the result [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: Option<u64>,
    /// Instruction set of the simulation: auto, or a narrower one than the processor's best; it never changes the result
    #[arg(long, value_name = "SET", default_value = "auto", hide_default_value = true, value_parser = simd)]
    pub(in crate::cli) simd: InstructionSet,
}
