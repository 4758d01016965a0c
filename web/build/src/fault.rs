//! What can go wrong, and what to do about it.

use std::{io, path::Path};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// Something is not on this machine.
    #[error("missing: {what}\n{remedy}")]
    Missing {
        /// What.
        what: String,
        /// How to get it.
        remedy: String,
    },
    /// A step did not do its work.
    #[error("{0}")]
    Failed(String),
}

impl Fault {
    /// Something is not on this machine.
    pub fn missing(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Missing { what: what.into(), remedy: remedy.into() }
    }

    /// A step did not do its work.
    pub fn failed(why: impl Into<String>) -> Self {
        Self::Failed(why.into())
    }

    /// A file can't be read or written.
    pub fn file(path: &Path, error: io::Error) -> Self {
        Self::Failed(format!("{}: {error}", path.display()))
    }

    /// Exit code of the program.
    pub fn code(&self) -> u8 {
        match self {
            Self::Missing { .. } => 2,
            Self::Failed(_) => 1,
        }
    }
}
