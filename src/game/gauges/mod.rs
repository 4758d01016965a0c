//! Gauges of a player: set by key or button, found and moved by their marks, saved as a table. What they read is `lab::gauges`.

pub mod act;
pub mod desk;
pub mod grip;
