//! Runs the game, and saves what was played if that ends by a panic.

use crate::{
    game::{
        crash::{
            journal::{self, Journal, SharedJournal},
            recovery,
        },
        files, recording,
    },
    sim::{fault, recorder::Recorder, recording::End},
};
use bevy::app::App;
use std::{
    any::Any,
    panic::{self, AssertUnwindSafe},
    path::PathBuf,
};

/// What a crash left behind, in one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the game crashed: {what}; {saved}")]
pub struct Crash {
    /// What the panic said, and where.
    pub what: String,
    /// What was saved of the world, and where.
    pub saved: String,
}

/// The folder of journals: that of the user's data, so that a start from anywhere finds them.
pub fn folder() -> Option<PathBuf> {
    files::folders().pop().map(|folder| folder.join("running"))
}

/// Runs the app to its end. If that is a panic, saves what was played before it.
///
/// # Errors
/// After a panic.
pub fn run<T>(mut app: App, journals: Option<PathBuf>, run: impl FnOnce(App) -> T) -> Result<T, Crash> {
    let recorder = app.world_mut().get_resource_or_init::<Recorder>().clone();
    let folders = recording::folders(app.world());
    let journal = journals.and_then(|folder| {
        // Ours is locked before anything looks for those that are not.
        let journal = Journal::begin(&folder, recorder.clone());
        recovery::search(&mut app, folder);
        journal
    });
    if let Some(journal) = &journal {
        app.insert_resource(journal.clone());
        journal::follow(&mut app);
    }
    fault::watch(true);
    let ended = panic::catch_unwind(AssertUnwindSafe(|| run(app)));
    match ended {
        Ok(outcome) => {
            if let Some(journal) = journal {
                journal.forget();
            }
            Ok(outcome)
        }
        Err(payload) => Err(save(&*payload, &recorder, &folders, journal.as_ref())),
    }
}

/// Saves what was played before a panic.
fn save(
    payload: &(dyn Any + Send),
    recorder: &Recorder,
    folders: &[PathBuf],
    journal: Option<&SharedJournal>,
) -> Crash {
    let what = fault::describe(payload);
    let last_minute = recorder.last_minute(End::Crashed);
    let mut saved = match recording::write_new(folders, recorder, "-crash", &last_minute) {
        Ok(path) => format!("the last minute is in {}", path.display()),
        Err(error) => format!("the last minute is lost: {error}"),
    };
    match recording::write_to(folders, recorder, "-crash", End::Crashed) {
        Ok(Some(path)) => saved += &format!(", the recording in {}", path.display()),
        Ok(None) => {}
        Err(error) => saved += &format!(", the recording is lost: {error}"),
    }
    if journal.is_some_and(SharedJournal::close) {
        saved += "; the next start offers to restore the world";
    }
    Crash { what, saved }
}
