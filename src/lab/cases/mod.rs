//! What the physics exam and the stability gauntlet have in common: cases that are simulated at several qualities, judged,
//! and reported.
//!
//! ```text
//! Case × Setting ─► Job ─► Row (verdict, figures) ─► report: table, JSON, Markdown (the command)
//!                                                └─► JobQueue (F6 and F7 in the game)
//! ```

mod case;
mod job;
mod merge;
mod queue;
mod read;
mod report;
mod row;
mod setting;
mod shard;
mod simulation;

pub use case::{About, Case, Column, Size, Suite};
pub use job::{Job, jobs, run_all};
pub use merge::read_rows;
pub use queue::{JobQueue, Progress, plugin};
pub use read::Text;
pub(super) use read::{figure_or_nan, line, read, reason};
pub use report::{about_detail, document, failure, summary, table};
pub use row::{Figures, Row, Verdict};
pub use setting::{Over, Setting};
pub use shard::Shard;
pub use simulation::{CaseSimulation, Stopwatch};
