//! Solutions of challenges: files of strokes, and what plays them without a window. Each proves that its challenge can be won
//! with all stars, at every quality.

mod play;
mod solution;
#[cfg(test)]
mod tests;

pub use play::{Outcome, play};
pub use solution::{Solution, solution};
