//! How calm a tile has been.

use crate::units::TICK_SECONDS;
use serde::{Deserialize, Serialize};

/// Ticks from one look at what is awake to the next. Raising it makes looking cheaper and sleep come later.
pub const LOOK_TICKS: u64 = 8;
/// Looks in a row at which all of a body must be found calm: a second.
pub(super) const LOOKS: u8 = 8;
/// Weight of the last look in a tile's drift, so that it is a mean over about as many ticks as [`LOOKS`] takes.
const LAST_LOOK: f32 = 1.0 / LOOKS as f32;
/// Root mean square speed up to which the particles of a tile are calm, d a tick. In a pool at rest the solver leaves
/// 0.005 to 0.02, and in a tile that holds a few particles of its surface up to 0.05. Raising it lets water sleep that
/// visibly moves.
pub const JITTER: f32 = 0.06;
/// Mean speed of a tile over a second up to which it is calm, d a tick. It bounds the slow motion that sleep stops: waves,
/// eddies, a level that still sinks.
pub const DRIFT: f32 = 0.01;

/// How calm a tile has been.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Calm {
    /// Mean velocity over the last looks, d a tick.
    pub(super) drift: [f32; 2],
    /// Looks in a row at which its whole body was calm.
    pub(super) looks: u8,
}

/// What a look finds in a tile.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) count: u32,
    pub(super) momentum: [f32; 2],
    /// Σ v².
    pub(super) square: f32,
    /// Sum of the speeds at which particles are about to rise or sink among others, d/s.
    pub(super) rising: f32,
}

impl Tally {
    /// Follows the tile's drift; returns whether it is calm now.
    pub(super) fn judge(&self, calm: &mut Calm) -> bool {
        // d/s to d a tick.
        let per = TICK_SECONDS / self.count as f32;
        // The first look sets the mean: to begin at 0 would be to take a new tile for calm.
        let weight = if *calm == Calm::default() { 1.0 } else { LAST_LOOK };
        for (drift, momentum) in calm.drift.iter_mut().zip(self.momentum) {
            *drift += weight * (momentum * per - *drift);
        }
        let [x, y] = calm.drift;
        let is_sorted = self.rising * per <= DRIFT;
        is_sorted && self.square * per * TICK_SECONDS <= JITTER * JITTER && x * x + y * y <= DRIFT * DRIFT
    }
}
