//! The gallery's scenes, each soaked for some minutes at each quality.
//!
//! ```text
//! plan (scenes × qualities, shard) ─► job ─► soak on one thread ─► row ─► tally (table, verdict)
//!                                                                   └──► journal, to go on from
//! ```
//!
//! A row but for its time is a function of scene, quality, detail, seed and minutes alone: the same on every machine, in
//! every shard, on any number of threads.

mod plan;
mod row;
mod run;
mod tally;
#[cfg(test)]
mod tests;

pub use plan::{Job, Plan};
pub use row::Row;
pub use run::run;
pub use tally::Tally;
