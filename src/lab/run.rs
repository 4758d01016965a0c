//! A run from one tick to the next, and its observers.

use crate::sim::{
    ledger::PassLedger,
    recording::{Entry, Input},
    simulation::Simulation,
};
use bevy::ecs::world::World;
use std::io;

/// Looks at the world after each tick.
pub trait Observer {
    /// The world after a tick.
    fn after_tick(&mut self, world: &World) -> io::Result<()>;

    /// The world at the moment from which on everything counts: after the last tick of the warm-up, or at the start.
    fn after_warmup(&mut self, _world: &World) {}
}

/// Looks at nothing.
impl Observer for () {
    fn after_tick(&mut self, _world: &World) -> io::Result<()> {
        Ok(())
    }
}

/// How far to run, and on what input.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Ticks to run.
    pub ticks: u64,
    /// Ticks of these that are left out of the times: the pass ledger begins after them.
    pub warmup: u64,
    /// Input, oldest first.
    pub input: Vec<Entry>,
    /// Whether to the end of a recording: then what was done after its last tick, to a world that stood, is done, too.
    pub complete: bool,
}

/// Runs the plan, showing each tick to the observers.
pub fn run(simulation: &mut Simulation, plan: &Plan, observers: &mut [&mut dyn Observer]) -> io::Result<()> {
    let mut input = Input::new(plan.input.clone());
    for tick in 0..plan.ticks {
        if tick == plan.warmup {
            simulation.world_mut().resource_mut::<PassLedger>().clear();
            for observer in observers.iter_mut() {
                observer.after_warmup(simulation.world());
            }
        }
        input.give(simulation.world_mut());
        simulation.tick();
        for observer in observers.iter_mut() {
            observer.after_tick(simulation.world())?;
        }
    }
    if plan.complete && input.give(simulation.world_mut()) > 0 {
        simulation.apply_edits();
    }
    Ok(())
}
