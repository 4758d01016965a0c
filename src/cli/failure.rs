//! How a command ends if it does not end well: one line and an exit code.

use crate::{lab::experiment::ExperimentError, scene::SceneError, sim::new_file::Unwritten};
use std::{fmt, io, path::Path, process::ExitCode};

/// Why a command did not end well.
#[derive(Debug)]
pub(super) enum Failure {
    /// Bad usage or input: where, what is wrong, what is allowed.
    Usage(String),
    /// A check failed, or an output can't be written.
    Outcome(String),
}

impl Failure {
    /// An output that can't be written.
    pub(super) fn unwritten(path: &Path, error: io::Error) -> Self {
        Self::Outcome(Unwritten { path: path.to_owned(), error }.to_string())
    }

    /// The exit code of the program.
    pub(super) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Outcome(_) => 1,
            Self::Usage(_) => 2,
        })
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(line) | Self::Outcome(line) => formatter.write_str(line),
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<ExperimentError> for Failure {
    fn from(error: ExperimentError) -> Self {
        match error {
            ExperimentError::Scene(error) => error.into(),
            error => Self::Outcome(error.to_string()),
        }
    }
}

/// Refuses a warm-up that is as long as the run.
pub(super) fn check_warmup(warmup: u64, ticks: u64) -> Result<(), Failure> {
    if warmup < ticks {
        return Ok(());
    }
    let most = ticks - 1;
    Err(Failure::Usage(format!("--warmup {warmup} leaves nothing of the {ticks} ticks; allowed: 0 to {most}")))
}

/// The parser's complaint, which takes several lines, as one.
pub(super) fn condense(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let complaint: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        // "tip: to pass '--x' as a value, use '-- --x'": nothing here takes such a value.
        .filter(|line| !line.is_empty() && !line.starts_with("tip: to pass"))
        .collect();
    let complaint = complaint.join(" ");
    let complaint = complaint.strip_prefix("error: ").unwrap_or(&complaint);
    let usage = text.lines().find_map(|line| line.trim().strip_prefix("Usage: ")).unwrap_or("powder-master");
    let is_name = |word: &&str| word.starts_with(|letter: char| letter.is_ascii_lowercase());
    let command: Vec<&str> = usage.split(' ').take_while(is_name).collect();
    format!("{complaint} ({} --help says what there is)", command.join(" "))
}
