//! The random gauntlet: worlds from the whole space of what scene files allow, under random hands, judged by every rule.
//!
//! ```text
//! dice (seed, index) ─► scene (contents, tuning) ─► world ◄─ hands
//!                                                     │
//!                              case, as a file ◄──────┤
//!                                                     ▼  tick by tick
//!                     tally (the worst of each rule) ◄─ examine (rule) ─► shrink: what fails, smaller
//! ```
//!
//! A world is a function of seed and index alone: whatever runs it, on however many threads or machines, finds the same.

mod case;
mod contents;
mod dice;
mod examine;
mod hands;
mod run;
mod scene;
mod shrink;
mod tally;
#[cfg(test)]
mod tests;
mod tuning;
mod world;

pub use crate::lab::gauntlet::{
    judged::Found,
    rule::{Finding, Measured, Rule},
};
pub use case::Case;
pub use examine::examine;
pub use run::{Plan, run};
pub use tally::{Failure, RuleTally, Tally, Worst};
pub use world::World;
