//! The soak: a scene played for hours of simulated time by a player that follows a script, and looked at every second.
//! What may not happen in an hour shows in a day: memory that grows, matter or air that gets lost bit by bit, energy that
//! creeps up.

mod creep;
pub mod gallery;
mod journal;
mod memory;
mod period;
mod player;
mod report;
mod run;
mod sitting;
#[cfg(test)]
mod tests;
mod times;

pub use creep::Creep;
pub use journal::Entry;
pub use period::Totals;
pub use report::Report;
pub use run::Soak;
pub use sitting::Sitting;
