//! Lanes: one source for every width of vector registers, and the choice of the width at run time.
//!
//! A pass over particles is written once, generic over [`Lanes`]. On x86-64 and in the browser lanes are registers by name,
//! elsewhere plain arrays that the compiler turns into what registers there are. Every operation is the IEEE one on each lane
//! (no fused multiply-add, no estimates), so every width gives the same bits.

mod lanes;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod quads;
#[cfg(target_arch = "x86_64")]
mod registers;
mod set;
#[cfg(test)]
mod tests;

pub(crate) use lanes::{Array, Lanes, MOST_LANES, each_lane, lane_starts, padded, truncated, whole_below};
pub use set::InstructionSet;
pub(crate) use set::Pass;
