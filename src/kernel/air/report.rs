//! What a step of the air did.

use serde::{Deserialize, Serialize};

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AirReport {
    /// Substeps made; 0 if the air was quiet.
    pub substeps: u32,
    /// Most cells that a substep did: those of the tiles that are awake and around them; 0 if the air was quiet.
    pub cells: usize,
    /// Cells done in all substeps together.
    #[serde(skip)]
    pub worked: u64,
    /// Velocity components that were clamped, by tools since the last step or in this one.
    pub speed_clamps: u64,
    /// Substeps for which sound was slowed.
    #[serde(skip)]
    pub slowed: u64,
    /// Pressures that a tool asked for and that were clamped to 0 … `MAX_PRESSURE`, since the last step.
    pub pressure_clamps: u64,
    /// Mass of air for which new rock left no place, since the last step, d² at pressure 1.
    pub buried: f64,
}

/// Most that a count in a file may be: whatever is counted beside it, the sum is far from the end of the numbers.
const MOST_COUNTED: u64 = 1 << 53;

impl AirReport {
    /// Whether it holds what tools and new rock can leave for the next step, and nothing of a step.
    pub(super) fn is_of_tools(&self) -> bool {
        let Self { substeps, cells, worked, speed_clamps, slowed, pressure_clamps, buried } = *self;
        (substeps, cells, worked, slowed) == (0, 0, 0, 0)
            && speed_clamps.max(pressure_clamps) <= MOST_COUNTED
            && (0.0..=MOST_COUNTED as f64).contains(&buried)
    }
}
