//! The panels of the physics exam and of the stability gauntlet.

mod exam;
mod gauntlet;
pub mod window;
