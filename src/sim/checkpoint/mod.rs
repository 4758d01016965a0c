//! A world with all that it takes to go on from it: what undo, saves, recordings, crash recovery, the A/B split, surveys
//! and sweeps set out from; and its form as a save file.

pub(crate) mod check;
mod contents;
mod file;
mod mixing;
mod restore;
#[cfg(test)]
mod tests;

pub use restore::Checkpoint;
