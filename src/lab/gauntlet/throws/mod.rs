//! What a player can throw at a world of their own, and how the world takes it: hard cases come as intents, tick by tick, and a copy
//! of the world is judged by every rule while the world itself is watched.

mod list;
mod stress_test;
#[cfg(test)]
mod tests;

pub use list::{THROWS, Throw};
pub use stress_test::{Progress, SECONDS, StressTest, plugin};
