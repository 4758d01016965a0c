//! What all experiments have in common: a sweep, the scaling, the effects and the binning table run every setting in
//! several rounds and compare the times.
//!
//! Rounds are interleaved: each runs every setting once and begins with another one, so that a disturbance of the machine
//! falls on a run and not on a setting. A run is deterministic: all runs of a setting must come to the same world.

mod error;
pub mod journal;
mod rounds;
mod run;

pub use error::ExperimentError;
pub use rounds::{Spread, interleaved};
pub use run::{Run, time};
