//! Figures of other programs on the same scene, brought along in a file.

use serde::{Deserialize, Serialize};
use std::{fs, path::Path};

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

impl Beside {
    /// The programs in a JSON file. The error says why there are none.
    pub fn read(path: &Path) -> Result<Vec<Self>, String> {
        let text = fs::read_to_string(path).map_err(|error| format!("can't be read: {error}"))?;
        let allowed =
            "[{\"name\": …, \"figures\": [{\"particles\": …, \"ms\": …, \"error_mean\": …, \"error_p99\": …}]}]";
        serde_json::from_str(&text).map_err(|error| format!("{error}; allowed: {allowed}"))
    }
}
