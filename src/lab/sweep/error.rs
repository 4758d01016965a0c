//! What counts as the error of a setting.

use super::record::Found;
use crate::sim::checkpoint::Checkpoint;

/// What counts as the error of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorMeasure {
    /// The mean density error, which the game's panel and the autopilots go by, too.
    Density,
    /// Distance of the air's velocity to the reference's.
    Air,
}

/// Liquid that fills less of the box than this, where air moves, is there to show the air.
const LITTLE_LIQUID: f64 = 0.05;

impl ErrorMeasure {
    /// What the scene is about: its air if that moves and liquid fills less than a twentieth of the box.
    pub fn of(start: &Checkpoint) -> Self {
        let size = start.setup.domain.size;
        let filled = start.state.particles.len() as f64 / (f64::from(size.x) * f64::from(size.y));
        if start.has_air() && filled < LITTLE_LIQUID { Self::Air } else { Self::Density }
    }

    /// The error of a run, or of several together.
    pub fn of_found(self, found: &Found) -> Option<f64> {
        match self {
            Self::Density => found.accuracy.density_error_mean,
            Self::Air => found.accuracy.distance?.air,
        }
    }

    /// Name with its unit, for the axis.
    pub fn title(self) -> &'static str {
        match self {
            Self::Density => "mean density error",
            Self::Air => "distance of mean air velocity to the reference",
        }
    }
}
