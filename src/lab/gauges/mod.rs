//! Gauges: probes in the world, at a place or along a line. `place` where, `spot` what is measured around a place, `still` the
//! pressure of water that sleeps, `crossings` what goes through a line, `quantity` the table of what a reading says, `set` all
//! gauges of a world with what they read, `table` that as comma separated values.
//!
//! They read the world after a tick and change nothing of it. While there is none nothing is called, and nothing held.

pub mod crossings;
pub mod place;
pub mod quantity;
pub mod set;
pub mod spot;
mod still;
pub mod table;
#[cfg(test)]
mod tests;
