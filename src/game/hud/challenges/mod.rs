//! What the HUD shows of a challenge: the strip while it runs, the verdict at its end, and stars.

pub mod stars;
pub mod strip;
pub mod verdict;
