//! Challenges: what stands in `assets/challenges/*.ron`, read and checked.

mod file;
mod goal;
mod list;

pub use file::Challenge;
pub use goal::{Condition, HANDS, Means};
pub use list::{challenges, find};
