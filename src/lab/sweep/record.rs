//! What a run of a sweep leaves, in the journal and in the table.

use crate::lab::coarse::Distance;
use serde::{Deserialize, Serialize};

/// How exact a run was. `None` where a value does not apply; means are over the samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Particles at the end, rock included.
    pub particles: usize,
    /// Mean density error.
    pub error_mean: Option<f64>,
    /// 99th percentile of the density error.
    pub error_p99: Option<f64>,
    /// Largest density error.
    pub error_max: Option<f64>,
    /// Mean density of the interior particles, 1 at rest density.
    pub density_mean: Option<f64>,
    /// Room that the liquid takes too much, as a share.
    pub volume_error: Option<f64>,
    /// The solver's own residual.
    pub residual: Option<f64>,
    /// Highest energy of the particles against the start's, less 1 and less what swelling to the target density takes;
    /// only in a closed scene.
    pub energy_gain: Option<f64>,
    /// Particles that were not finite, and particle-ticks outside the box or in rock.
    pub lost: u64,
    /// Distance to the reference.
    pub distance: Distance,
}

/// What a run left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Median time of a tick, ms.
    pub ms: f64,
    /// 95th percentile, ms.
    pub ms_p95: f64,
    /// Hash of the final state.
    pub hash: String,
    /// How exact it was; only the first run of a setting is sampled.
    pub found: Option<Found>,
}
