//! `bench`: tables of what things cost.

mod effects;
mod frame;
mod heat;
mod neighbours;
mod scaling;
mod sleep;
mod threads;

pub(super) use effects::effects;
pub(super) use frame::frame;
pub(super) use heat::heat;
pub(super) use neighbours::neighbours;
pub(super) use scaling::scaling;
pub(super) use sleep::sleep;
pub(super) use threads::threads;

use crate::cli::progress;

/// A scene by its name, with settings of its own.
type SceneSettings = (&'static str, &'static [(&'static str, &'static str)]);

/// What is measured of each scene in turn, with a line that says which.
///
/// # Errors
/// The first that a measurement ends with.
fn of_each<T, E>(
    scenes: &[SceneSettings],
    mut measure: impl FnMut(&'static str, &[(String, String)]) -> Result<T, E>,
) -> Result<Vec<T>, E> {
    let line = progress::bar(scenes.len() as u64);
    let one = |(name, of): &SceneSettings| {
        line.set_message(*name);
        let settings: Vec<_> = of.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let measured = measure(name, &settings);
        line.inc(1);
        measured
    };
    scenes.iter().map(one).collect()
}
