//! The pass ledger: what each stage of a tick cost. Written by the stages, read by the HUD and `--metrics`.

use bevy::prelude::Resource;
use std::time::Duration;

/// A stage of the tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// Intents change the world.
    Edit,
    /// Taps and outlets.
    Sources,
    /// The air moves.
    Air,
    /// Gravity.
    Gravity,
    /// Particles drag the air.
    Feedback,
    /// The air drags particles.
    Drag,
    /// The pressure predictor.
    Pressure,
    /// Positions are predicted and swept against rock and box.
    Predict,
    /// Particles are sorted into bins.
    Bin,
    /// The density constraint moves particles.
    Solve,
    /// Velocities follow from the moves.
    Velocity,
    /// XSPH viscosity.
    Viscosity,
    /// Vorticity confinement.
    Vorticity,
    /// Who sleeps, who wakes.
    Sleep,
    /// Checks at the end of the tick.
    Measure,
}

impl Pass {
    /// All passes in the order of the tick.
    pub const ALL: [Self; 15] = [
        Self::Edit,
        Self::Sources,
        Self::Air,
        Self::Gravity,
        Self::Feedback,
        Self::Drag,
        Self::Pressure,
        Self::Predict,
        Self::Bin,
        Self::Solve,
        Self::Velocity,
        Self::Viscosity,
        Self::Vorticity,
        Self::Sleep,
        Self::Measure,
    ];

    /// Name in metrics and on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Edit => "edit",
            Self::Sources => "sources",
            Self::Air => "air",
            Self::Gravity => "gravity",
            Self::Feedback => "air_feedback",
            Self::Drag => "drag",
            Self::Pressure => "pressure",
            Self::Predict => "predict",
            Self::Bin => "bin",
            Self::Solve => "solve",
            Self::Velocity => "velocity",
            Self::Viscosity => "viscosity",
            Self::Vorticity => "vorticity",
            Self::Sleep => "sleep",
            Self::Measure => "measure",
        }
    }
}

/// Ticks of which the times are kept for medians.
const HISTORY: usize = 64;

/// What one pass cost.
#[derive(Clone, Debug, Default)]
pub struct PassRecord {
    /// Calls since the ledger was cleared.
    pub calls: u64,
    /// Time in all since then.
    pub total: Duration,
    current: Duration,
    recent: Vec<Duration>,
}

impl PassRecord {
    /// Median time a tick over the last ticks (64 at most) since the ledger was cleared.
    pub fn median(&self) -> Duration {
        median(&self.recent)
    }
}

/// Cost of every pass and of the ticks as a whole.
#[derive(Resource, Clone, Debug)]
pub struct PassLedger {
    records: [PassRecord; Pass::ALL.len()],
    tick: PassRecord,
}

impl Default for PassLedger {
    fn default() -> Self {
        Self { records: std::array::from_fn(|_| PassRecord::default()), tick: PassRecord::default() }
    }
}

impl PassLedger {
    /// Notes a call of `pass`.
    pub fn note(&mut self, pass: Pass, time: Duration) {
        let record = &mut self.records[pass as usize];
        record.calls += 1;
        record.total += time;
        record.current += time;
    }

    /// The record of `pass`.
    pub fn record(&self, pass: Pass) -> &PassRecord {
        &self.records[pass as usize]
    }

    /// The record of whole ticks.
    pub fn tick(&self) -> &PassRecord {
        &self.tick
    }

    /// Closes a tick that took `time` in all.
    pub fn end_tick(&mut self, time: Duration) {
        let slot = self.tick.calls as usize % HISTORY;
        self.tick.calls += 1;
        self.tick.total += time;
        self.tick.current = time;
        for record in self.records.iter_mut().chain([&mut self.tick]) {
            if record.recent.len() <= slot {
                record.recent.push(record.current);
            } else {
                record.recent[slot] = record.current;
            }
            record.current = Duration::ZERO;
        }
    }

    /// Time of the last tick.
    pub fn last_tick(&self) -> Duration {
        let newest = (self.tick.calls as usize + HISTORY - 1) % HISTORY;
        self.tick.recent.get(newest).copied().unwrap_or_default()
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}

fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}
