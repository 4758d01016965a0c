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

/// Settings of a scene, as the command line has them.
fn settings(of: &[(&str, &str)]) -> Vec<(String, String)> {
    of.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect()
}
