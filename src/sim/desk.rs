//! Where long work in the background and the game meet: the game asks for it and shows its rows, the lab does it and
//! writes them. Neither knows the other.

use crate::kernel::params::Preset;
use bevy::prelude::Resource;

/// How far the work has come.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Progress {
    /// Nobody has asked for it.
    #[default]
    Idle,
    /// It runs.
    Running {
        /// Jobs done: cases, each in one setting.
        done: usize,
        /// Jobs in all.
        of: usize,
        /// What is simulated now.
        now: String,
    },
    /// All rows are there.
    Done,
    /// It was stopped before its end.
    Stopped,
    /// It can't go on: why.
    Broken(String),
}

/// What the game wants, and what has come of it. Written by the game (`wanted`) and by the lab (the rest).
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Desk<R: Send + Sync + 'static> {
    /// The qualities at which it shall be done. Taking it back stops it; it is taken back at its end.
    pub wanted: Option<Vec<Preset>>,
    /// How far it has come.
    pub progress: Progress,
    /// The rows that are there, in the order in which they came.
    pub rows: Vec<R>,
}

impl<R: Send + Sync + 'static> Default for Desk<R> {
    fn default() -> Self {
        Self { wanted: None, progress: Progress::Idle, rows: Vec::new() }
    }
}
