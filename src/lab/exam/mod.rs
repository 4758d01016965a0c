//! The physics exam: answers that are known from theory or experiment, computed by the program as it is shipped, and
//! compared.
//!
//! ```text
//! cases ─► Case: scenes (assets/exam, assets/scenes) at a quality ─► World, tick by tick ─► Finding
//!                                     job: a case in one setting ─► Row ─► report (table, Markdown, JSON)
//! ```
//!
//! A case builds its world by the same doors as every scene (`scene::from_text`, `control::load`) and changes nothing in it
//! afterwards but what it says. It is a future that yields after each tick, so that whoever drives it can do something
//! else in between: count, stop, or draw a frame (`drive`). `desk` runs the exam for the game in the background.

mod case;
mod cases;
pub mod desk;
mod fit;
mod job;
mod report;
#[cfg(test)]
mod tests;
mod world;

pub use case::{CASES, Case};
pub use super::drive::finish;
pub use job::{Job, jobs, sit_all};
pub use report::{document, summary, table};
