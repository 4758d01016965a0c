//! The soak: a scene played for hours of simulated time by a player that follows a script, and looked at every second.
//! What may not happen in an hour shows in a day: memory that grows, particles that get lost one by one, energy that
//! creeps up.

mod player;
mod report;
mod run;

pub use report::Report;
pub use run::soak;
