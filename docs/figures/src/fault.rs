//! How a command ends if it does not end well: one line and an exit code.

use std::{fmt, io, path::Path};

/// Why a command did not end well.
#[derive(Debug)]
pub enum Fault {
    /// Bad usage or input: where, what is wrong, what is allowed.
    Usage(String),
    /// Figures could not be made or written.
    Outcome(String),
}

impl Fault {
    /// A file can't be read.
    pub fn unread(path: &Path, error: &io::Error) -> Self {
        Self::Usage(format!("{}: can't be read: {error}", path.display()))
    }

    /// A file can't be written.
    pub fn unwritten(path: &Path, error: &io::Error) -> Self {
        Self::Outcome(format!("{}: can't be written: {error}", path.display()))
    }

    /// The exit code of the program.
    pub fn code(&self) -> u8 {
        match self {
            Self::Outcome(_) => 1,
            Self::Usage(_) => 2,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(line) | Self::Outcome(line) => formatter.write_str(line),
        }
    }
}
