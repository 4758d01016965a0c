//! A second world beside the first, from a copy of its state: the other half of an A/B split, or one that is run ahead
//! to measure. It is made of the same plugin and the same schedules, with its own resources, and can be sent to another
//! thread.

use crate::{
    kernel::{
        params::{Preset, Quality},
        simd::InstructionSet,
    },
    sim::{
        SimulationPlugin, control,
        effects::Effects,
        save::{self, Saved},
        snapshot::Snapshot,
        state::{Setup, SolverState},
        workers::Workers,
    },
};
use bevy::prelude::{App, FixedUpdate, World};
use std::sync::Arc;

/// Everything that a second world starts from.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Scene and quality.
    pub setup: Setup,
    /// Wanted effects.
    pub effects: Effects,
    /// The state.
    pub state: Arc<Snapshot>,
    /// Instructions that the solver uses.
    pub instructions: InstructionSet,
}

impl Seed {
    /// Copies what `world` is.
    pub fn of(world: &World) -> Self {
        let mut effects = world.resource::<Effects>().clone();
        effects.start_over();
        Self {
            setup: world.resource::<Setup>().clone(),
            effects,
            state: Arc::new(control::freeze(world)),
            instructions: world.resource::<SolverState>().instructions,
        }
    }
}

/// A second world.
pub struct Twin {
    world: World,
}

impl Twin {
    /// The world of `seed`, for `workers` to run.
    pub fn new(seed: &Seed, workers: Workers) -> Self {
        let mut world = bare(workers);
        control::load(&mut world, seed.setup.blueprint.clone());
        world.insert_resource(seed.setup.clone());
        world.insert_resource(seed.effects.clone());
        control::thaw(&mut world, &seed.state);
        world.resource_mut::<SolverState>().instructions = seed.instructions;
        Self { world }
    }

    /// The world of a save file, for `workers` to run on the lanes of `instructions`.
    pub fn of_saved(saved: Saved, workers: Workers, instructions: InstructionSet) -> Self {
        let mut world = bare(workers);
        save::load(&mut world, saved);
        world.resource_mut::<SolverState>().instructions = instructions;
        Self { world }
    }

    /// The world, to read.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world, to change between ticks.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// Goes on at another quality.
    pub fn set_quality(&mut self, preset: Preset, quality: Quality) {
        control::set_quality(&mut self.world, preset, quality);
    }

    /// Runs one fixed update: a tick, or only the edits if its pace stands.
    pub fn tick(&mut self) {
        self.world.run_schedule(FixedUpdate);
        self.world.clear_trackers();
    }
}

/// The schedules of a simulation, and nothing to simulate yet.
fn bare(workers: Workers) -> World {
    let mut app = App::empty();
    app.add_plugins(SimulationPlugin).insert_resource(workers);
    std::mem::take(app.world_mut())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        lab::headless::Headless,
        scene::{self, effects::EffectModes},
    };

    fn waterfall() -> Headless {
        let blueprint = scene::load("waterfall").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        Headless::new(Arc::new(blueprint), Workers::default())
    }

    #[test]
    fn a_twin_goes_the_way_of_the_first_to_the_bit() {
        let mut first = waterfall();
        (0..30).for_each(|_| first.tick());
        let mut twin = Twin::new(&Seed::of(first.world()), Workers::single());
        assert_eq!(control::hash(twin.world()), control::hash(first.world()), "the copy differs");
        (0..30).for_each(|_| first.tick());
        (0..30).for_each(|_| twin.tick());
        assert_eq!(control::hash(twin.world()), control::hash(first.world()), "it went another way");
    }
}
