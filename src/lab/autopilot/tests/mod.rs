//! The autopilot over plants of a known load, and in real scenes.

mod plants;
#[cfg(not(debug_assertions))]
mod worlds;
