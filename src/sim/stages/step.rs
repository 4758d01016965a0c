//! Runs the substeps of a tick.

use crate::{
    kernel::units::TICK_SECONDS,
    scene::effects::Effect,
    sim::{
        effects::Effects,
        state::{ParticleStore, SleepState, SolverState},
        workers::Workers,
    },
};
use bevy::{
    ecs::schedule::ScheduleLabel,
    platform::time::Instant,
    prelude::{Mut, Resource, World},
};

/// The schedule of one substep.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Substep;

/// What the gate found and decided for the tick.
#[derive(Resource, Clone, Copy, Debug)]
pub struct TickPlan {
    /// Substeps of this tick.
    pub substeps: u32,
    /// Speed of the fastest particle as the tick begins, d/s.
    pub(super) fastest: f32,
    /// Whether the air presses harder than a layer of the weakest of the rock bears.
    pub(super) presses: bool,
    /// When the tick began.
    pub(super) started: Instant,
}

impl Default for TickPlan {
    fn default() -> Self {
        Self { substeps: 1, fastest: 0.0, presses: false, started: Instant::now() }
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
    world.resource_scope(|world, mut sleep: Mut<SleepState>| {
        let mut particles = world.resource_mut::<ParticleStore>();
        sleep.set_aside(&mut particles);
        // What was poured or has come near in the last substep.
        sleep.wake_touched(&mut particles);
    });
    // Enters the pool once: the stages' own entries cost nothing from inside.
    let (workers, particles) = (world.resource::<Workers>().clone(), world.resource::<ParticleStore>().len());
    if particles == 0 && !world.resource::<Effects>().get(Effect::Air).running {
        put_back(world);
        return;
    }
    workers.run_tick(particles, substeps, || {
        for _ in 0..substeps {
            world.run_schedule(Substep);
        }
    });
    put_back(world);
}

/// The sleepers join those that are awake.
fn put_back(world: &mut World) {
    world.resource_scope(|world, mut sleep: Mut<SleepState>| {
        world.resource_scope(|world, mut solver: Mut<SolverState>| {
            sleep.put_back(&mut world.resource_mut::<ParticleStore>(), &mut solver.density);
        });
    });
}
