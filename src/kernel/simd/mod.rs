//! Lanes: one source for every width of vector registers, and the choice of the width at run time.
//!
//! A pass over particles is written once, generic over [`Lanes`]. Lanes are plain arrays; inside a function with
//! `#[target_feature]` the compiler turns them into vector registers. Every operation is the IEEE one on each lane (no
//! fused multiply-add, no estimates), so every width gives the same bits.

mod lanes;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod quads;
#[cfg(target_arch = "x86_64")]
mod registers;
mod set;

pub(crate) use lanes::{Array, Lanes, MOST_LANES, lane_starts, rounded, whole_below};
pub use set::InstructionSet;
pub(crate) use set::Pass;
