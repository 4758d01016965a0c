//! The windows of the physics exam and of the stability gauntlet.

mod exam;
mod gauntlet;
mod window;

pub use window::show;
