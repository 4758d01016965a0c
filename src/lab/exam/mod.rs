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
//! else in between: count, stop, or draw a frame (`drive`). In the game it runs in the background
//! (`lab::desk`).

mod case;
mod cases;
mod fit;
mod job;
mod report;
#[cfg(test)]
mod tests;
mod world;

pub use super::drive::finish;
use crate::{kernel::params::Preset, lab::desk, scene::SceneError, sim::exam::Row};
use bevy::app::App;
pub use case::{CASES, Case};
pub use job::{Job, jobs, sit_all};
pub use report::{document, summary, table};

/// Sits the exam in the background when its desk wants one.
pub fn plugin(app: &mut App) {
    app.add_plugins(desk::plugin::<Job>);
}

impl desk::Task for Job {
    type Row = Row;

    fn all(presets: &[Preset]) -> Vec<Self> {
        jobs(CASES, |_| true, presets)
    }

    fn title(&self) -> String {
        self.title()
    }

    async fn run(self) -> Result<Vec<Row>, SceneError> {
        self.sit().await
    }
}
