//! The autopilot: holds a time budget or an error bound by changing the quality while the world runs. It decides
//! ([`controller`]) among the levels of the [`ladder`], and gives its decision as an intent like any player's
//! ([`steering`]): a recording holds it, and a replay needs no autopilot.

pub mod advice;
pub mod controller;
pub mod ladder;
pub mod steering;
#[cfg(test)]
mod tests;
mod window;

pub use steering::{Autopilot, Goal, plugin, steer};
