//! Whether and how fast the world runs.

use bevy::prelude::Resource;

/// Pause, single steps and speed.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Whether time stands still. Edits still happen.
    pub paused: bool,
    /// Ticks to run although it is paused.
    pub steps_due: u32,
    /// Simulated seconds for each real one that the player asked for, 1/16 … 4.
    pub speed: f32,
}

impl Default for Pace {
    fn default() -> Self {
        Self { paused: false, steps_due: 0, speed: 1.0 }
    }
}

impl Pace {
    /// Whether the next fixed update is a tick (not only edits).
    pub fn ticks(&self) -> bool {
        !self.paused || self.steps_due > 0
    }
}

/// Run condition: the world's time moves in this fixed update.
pub fn time_moves(pace: bevy::prelude::Res<Pace>) -> bool {
    pace.ticks()
}
