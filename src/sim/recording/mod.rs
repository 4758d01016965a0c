//! Recordings: states of a world, the input that it took from each of them on, and a mark of every tick.

mod file;
mod input;
mod keys;
mod segment;
#[cfg(test)]
mod tests;

pub use file::{RECORDING_ENDING, Writer};
pub use input::Input;
pub use keys::{KEY_TICKS, Spot, Stretch};
pub use segment::{End, Entry, Recording, Segment};
