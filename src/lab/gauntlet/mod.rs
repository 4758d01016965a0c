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

use crate::{
    kernel::params::Preset,
    lab::desk,
    scene::SceneError,
    sim::gauntlet::{Cases, Entry, Row},
};
use bevy::app::App;
pub use case::{CASES, Case, Size};
pub use job::{Job, jobs, run_all};
pub use report::{document, summary, table};
use std::sync::Arc;

/// Tells the game the cases, and runs them in the background when their desk wants it.
pub fn plugin(app: &mut App) {
    app.add_plugins(desk::plugin::<Job>).insert_resource(Cases(entries()));
}

/// The cases that can be watched: those of which the world tells all.
fn entries() -> Vec<Entry> {
    let watchable = CASES.iter().filter(|case| case.frames.is_none() && case.size != Size::Long);
    let entry = |case: &'static Case| Entry {
        name: case.name,
        title: case.title,
        what: case.what,
        start: Arc::new(|preset| case.blueprint(preset)),
        act: case.act,
    };
    watchable.map(entry).collect()
}

impl desk::Task for Job {
    type Row = Row;

    fn all(presets: &[Preset]) -> Vec<Self> {
        jobs(CASES, |case| case.size != Size::Long, presets)
    }

    fn title(&self) -> String {
        self.title()
    }

    async fn run(self) -> Result<Vec<Row>, SceneError> {
        Ok(vec![self.judge().await?])
    }
}
