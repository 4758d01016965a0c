//! Why an experiment can't be made.

use crate::scene::SceneError;
use std::io;

/// Why an experiment ends early.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// The scene can't be built.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The system gives no threads.
    #[error("the threads can't be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The journal can't be written.
    #[error(transparent)]
    Journal(#[from] io::Error),
    /// Two runs of the same setting differ.
    #[error("{0}: two runs from the same start differ")]
    NotRepeatable(String),
}
