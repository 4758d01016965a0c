//! Accuracy while a world is played: samples of the density error of the running world ([`sample`]), all other measures
//! of it on demand ([`measures`]), and the curve of error against time from its present state ([`survey`]). HUD and autopilot
//! read the resources ([`accuracy`], [`measures`]); the world itself is only read.

pub mod accuracy;
pub mod measures;
mod plugin;
pub mod sample;
pub mod survey;
#[cfg(test)]
mod tests;

pub use plugin::LivePlugin;
