//! The autopilot over plants of a known load, and in real scenes.

#[cfg(not(debug_assertions))]
mod flights;
mod plants;
