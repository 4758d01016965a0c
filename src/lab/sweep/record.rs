//! What a run of a sweep leaves, in the journal and in the table.

use crate::lab::{coarse::Distance, metrics::Accuracy, stats};
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
    /// How exact it was.
    pub found: Found,
}

impl Found {
    /// Share of the liquid that stands elsewhere than in the converged run.
    pub fn true_error(&self) -> Option<f64> {
        self.accuracy.distance?.share
    }

    /// What several runs of a setting found: their means, the largest of what is a largest, all that was lost. `None` without
    /// any.
    pub fn of_all(runs: &[&Self]) -> Option<Self> {
        let first = runs.first()?;
        let accuracies = || runs.iter().map(|run| &run.accuracy);
        let mean = |of: fn(&Accuracy) -> Option<f64>| stats::mean(accuracies().filter_map(of));
        let distances: Vec<Distance> = accuracies().filter_map(|accuracy| accuracy.distance).collect();
        let accuracy = Accuracy {
            samples: accuracies().map(|accuracy| accuracy.samples).sum(),
            density_error_mean: mean(|of| of.density_error_mean),
            density_error_p99: mean(|of| of.density_error_p99),
            density_error_max: stats::largest(accuracies().filter_map(|of| of.density_error_max)),
            density_mean: mean(|of| of.density_mean),
            residual: mean(|of| of.residual),
            volume_error: mean(|of| of.volume_error),
            distance: (!distances.is_empty()).then(|| Distance::mean(&distances)),
            ..Accuracy::default()
        };
        Some(Self {
            particles: first.particles,
            lost: runs.iter().map(|run| run.lost).sum(),
            energy_gain: stats::largest(runs.iter().filter_map(|run| run.energy_gain)),
            floor: first.floor,
            accuracy,
        })
    }
}
