//! The stability gauntlet: every way in which a solver of this kind is known to fail, run by the program as it is shipped
//! at every quality, and judged by one judge.
//!
//! ```text
//! cases ─► Case: a scene, what is done to it, the rules ─► World, tick by tick ─► judge ─► Row
//!                                       job: a case at a quality ─► Row ─► report (table, Markdown, JSON)
//! ```
//!
//! A case builds its world by the same door as every scene (`scene::from_text`, `control::load`). What is done to it before
//! each tick is a script (`sim::script`), which runs headless here and in the game where a case is watched.

mod case;
mod cases;
mod job;
mod judge;
mod report;
#[cfg(test)]
mod tests;

pub use case::{CASES, Case, Size};
pub use job::{Job, jobs, run_all};
pub use report::{document, summary, table};
