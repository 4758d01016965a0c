//! Figures of other programs on the same scene, brought along in a file.

use serde::{Deserialize, Serialize};
use std::{fs, io, path::Path};

/// Another program in one setting.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Beside {
    /// Program, version and setting.
    pub name: String,
    /// What was measured of it.
    pub figures: Vec<Figure>,
}

/// What was measured of another program at one size, on one thread.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Particles.
    pub particles: u64,
    /// Median time of a frame of 1/60 s, ms.
    pub ms: f64,
    /// Mean density error.
    pub error_mean: Option<f64>,
    /// 99th percentile of the density error.
    pub error_p99: Option<f64>,
}

/// Why there are no figures.
#[derive(Debug, thiserror::Error)]
pub enum BesideError {
    /// The file can't be read.
    #[error("can't be read: {0}")]
    Unread(#[from] io::Error),
    /// It is no list of figures.
    #[error(
        "{0}; allowed: [{{\"name\": …, \"figures\": [{{\"particles\": …, \"ms\": …, \"error_mean\": …, \"error_p99\": …}}]}}]"
    )]
    Malformed(#[from] serde_json::Error),
}

impl Beside {
    /// The programs in a JSON file.
    ///
    /// # Errors
    /// If it can't be read or is no list of figures.
    pub fn read(path: &Path) -> Result<Vec<Self>, BesideError> {
        Ok(serde_json::from_str(&fs::read_to_string(path)?)?)
    }
}
