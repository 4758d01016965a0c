//! A run from one tick to the next, and those who watch it.

use crate::{
    lab::headless::Headless,
    sim::{
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        state::Clock,
    },
};
use bevy::ecs::world::World;
use std::io;

/// Someone who looks at the world after each tick.
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
    /// Input: after how many ticks of the world which intent is due, in order.
    pub intents: Vec<(u64, Intent)>,
    /// Whether to the end of a recording: then what was done after its last tick, to a world that stood, is done, too.
    pub complete: bool,
}

/// Runs the plan, showing each tick to the observers.
pub fn run(headless: &mut Headless, plan: &Plan, observers: &mut [&mut dyn Observer]) -> io::Result<()> {
    let mut intents = plan.intents.iter().peekable();
    for tick in 0..plan.ticks {
        if tick == plan.warmup {
            headless.world_mut().resource_mut::<PassLedger>().clear();
            for observer in observers.iter_mut() {
                observer.after_warmup(headless.world());
            }
        }
        let now = headless.world().resource::<Clock>().tick;
        while let Some((_, intent)) = intents.next_if(|(due, _)| *due <= now) {
            headless.world_mut().resource_mut::<IntentQueue>().push(*intent);
        }
        headless.tick();
        for observer in observers.iter_mut() {
            observer.after_tick(headless.world())?;
        }
    }
    if plan.complete && intents.peek().is_some() {
        let world = headless.world_mut();
        intents.for_each(|(_, intent)| world.resource_mut::<IntentQueue>().push(*intent));
        let pace = std::mem::replace(&mut *world.resource_mut::<Pace>(), Pace { paused: true, ..Pace::default() });
        headless.tick();
        *headless.world_mut().resource_mut::<Pace>() = pace;
    }
    Ok(())
}
