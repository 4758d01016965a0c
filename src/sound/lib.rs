//! From a handful of [`Controls`] to samples: no recording, no table of waves, no dependency. Knows no world, device or file;
//! the same controls give the same bits on every machine, since nothing here is rounded by a platform's library.
//!
//! ```text
//! Controls ─┬─► stream, wind, hiss, fire, boil, splash, blast    noise through filters (noise, filter)
//!           └─► splash, stream, boil, clatter, fire ─► grains    bubbles and snaps, 48 at most
//!                                   └────► mix ─► limiter ─► samples
//! ```
//!
//! All is made in blocks of [`block::LEN`] frames. Whatever a control sets follows it smoothly (`smooth`), so that a step of one
//! is no click. Rendering allocates nothing.

mod blast;
mod block;
mod boil;
mod clatter;
mod controls;
mod filter;
mod fire;
mod grains;
mod hiss;
mod limiter;
mod math;
mod noise;
mod smooth;
mod splash;
mod stream;
mod synthesiser;
mod wind;

#[cfg(test)]
mod tests;

pub use controls::{Control, Controls};
pub use grains::MOST_GRAINS;
pub use limiter::CEILING;
pub use synthesiser::{DEFAULT_RATE, Synthesiser};
