//! One timed run.

use crate::{
    lab::{
        run::{self, Observer, Plan},
        sampler::ms,
        stats,
    },
    sim::{control, ledger::PassLedger, simulation::Simulation},
};
use bevy::ecs::world::World;
use std::io;

/// What a run took and where it ended.
#[derive(Clone, Debug)]
pub struct Run {
    /// Time of each tick after the warm-up, ms.
    pub ms: Vec<f64>,
    /// Hash of the final state.
    pub hash: u64,
}

impl Run {
    /// A quantile of the times, ms.
    pub fn quantile(&self, q: f64) -> f64 {
        stats::quantile(&mut self.ms.clone(), q).unwrap_or(f64::NAN)
    }
}

/// Runs the plan, times its ticks and shows them to the other observers.
///
/// # Errors
/// If an observer can't go on.
pub fn time(simulation: &mut Simulation, plan: &Plan, others: &mut [&mut dyn Observer]) -> io::Result<Run> {
    let mut times = Times { left: plan.warmup, ms: Vec::new() };
    let mut observers: Vec<&mut dyn Observer> = vec![&mut times];
    for other in others {
        observers.push(*other);
    }
    run::run(simulation, plan, &mut observers)?;
    Ok(Run { ms: times.ms, hash: control::hash(simulation.world()) })
}

/// Notes the time of each tick after the warm-up.
struct Times {
    left: u64,
    ms: Vec<f64>,
}

impl Observer for Times {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        if self.left == 0 {
            self.ms.push(ms(world.resource::<PassLedger>().last_tick()));
        } else {
            self.left -= 1;
        }
        Ok(())
    }
}
