//! Accuracy while a world is played: samples of the density error of the running world ([`sample`]), all other measures
//! of it on demand ([`measures`]), and the curve of error against time from its present state ([`survey`]) or, of
//! scenes that come with one, from the documents ([`shipped`]). HUD and autopilot read the resources ([`accuracy`],
//! [`measures`]); the world itself is only read.

pub mod accuracy;
mod legs;
pub mod measures;
mod plugin;
pub mod sample;
pub mod shipped;
pub mod survey;
#[cfg(test)]
mod tests;

pub use plugin::LivePlugin;
