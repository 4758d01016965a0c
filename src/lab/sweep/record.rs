//! What a run of a sweep leaves, in the journal and in the table.

use crate::lab::metrics::Accuracy;
use serde::{Deserialize, Serialize};

/// How exact a run was.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Particles at the end, rock included.
    pub particles: usize,
    /// Particles that were not finite, and particle-ticks outside the box or in rock.
    pub lost: u64,
    /// Highest energy of the particles against the start's, less 1 and less what swelling to the rest density takes;
    /// only in a closed scene.
    pub energy_gain: Option<f64>,
    /// Share of the liquid by which the converged run may itself stand elsewhere than the truth.
    pub floor: Option<f64>,
    /// What else was measured, with the distance to the converged run.
    pub accuracy: Accuracy,
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
