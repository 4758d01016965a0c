//! Runs the substeps of a tick.

use crate::{
    kernel::units::TICK_SECONDS,
    sim::{schedule::Substep, state::ParticleStore, workers::Workers},
};
use bevy::{
    platform::time::Instant,
    prelude::{Resource, World},
};

/// What the gate decided for the tick.
#[derive(Resource, Clone, Copy, Debug)]
pub struct TickPlan {
    /// Substeps of this tick.
    pub substeps: u32,
    /// When the tick began.
    pub(super) started: Instant,
}

impl Default for TickPlan {
    fn default() -> Self {
        Self { substeps: 1, started: Instant::now() }
    }
}

impl TickPlan {
    /// Simulated time of a substep, s.
    pub fn substep_seconds(&self) -> f32 {
        TICK_SECONDS / self.substeps as f32
    }
}

/// Runs the substep schedule as often as the plan says.
pub(super) fn run_substeps(world: &mut World) {
    let substeps = world.resource::<TickPlan>().substeps;
    // Enters the pool once: the stages' own entries cost nothing from inside.
    let (workers, particles) = (world.resource::<Workers>().clone(), world.resource::<ParticleStore>().len());
    workers.run_tick(particles, || {
        for _ in 0..substeps {
            world.run_schedule(Substep);
        }
    });
}
