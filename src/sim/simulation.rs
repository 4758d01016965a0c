//! The only runner of a world below the game: the plugin and the schedules that the game has, without window, frames or
//! clock, stepped tick by tick. It can be sent to another thread.

use crate::{
    kernel::{
        params::{Preset, Quality},
        simd::InstructionSet,
    },
    scene::blueprint::Blueprint,
    sim::{
        SimulationPlugin,
        checkpoint::Checkpoint,
        control,
        intent::{Intent, IntentQueue},
        pace::Pace,
        state::{Setup, SolverState},
        workers::Workers,
    },
};
use bevy::{
    app::{App, FixedUpdate, Plugins, Update},
    ecs::{
        component::Mutable,
        resource::Resource,
        schedule::{Schedules, SingleThreadedExecutor},
        world::World,
    },
};
use std::sync::Arc;

/// A world that waits for its next tick.
pub struct Simulation {
    world: World,
    /// Whether a plugin does something beside the ticks.
    has_frames: bool,
}

impl Simulation {
    /// The start of a scene, for `workers` to run.
    pub fn new(blueprint: Arc<Blueprint>, workers: Workers) -> Self {
        Self::resume(&Checkpoint::of_scene(blueprint), workers)
    }

    /// Goes on from a checkpoint.
    pub fn resume(checkpoint: &Checkpoint, workers: Workers) -> Self {
        Self::with_plugins(checkpoint, workers, ())
    }

    /// Goes on from a checkpoint with more plugins. What they add to `Update` runs once after each tick.
    pub fn with_plugins<M>(checkpoint: &Checkpoint, workers: Workers, plugins: impl Plugins<M>) -> Self {
        let mut app = App::empty();
        app.add_plugins(SimulationPlugin).add_plugins(plugins).insert_resource(workers);
        app.finish();
        app.cleanup();
        let mut world = std::mem::take(app.world_mut());
        let mut schedules = world.resource_mut::<Schedules>();
        let has_frames = schedules.contains(Update);
        for (_, schedule) in schedules.iter_mut() {
            schedule.set_executor(SingleThreadedExecutor::new());
        }
        checkpoint.restore(&mut world);
        Self { world, has_frames }
    }

    /// Uses the lanes of `instructions` from here on.
    pub fn with_instructions(mut self, instructions: InstructionSet) -> Self {
        self.get_mut::<SolverState>().instructions = instructions;
        self
    }

    /// Runs one fixed update: a tick, or only the edits if its pace stands.
    pub fn tick(&mut self) {
        self.world.run_schedule(FixedUpdate);
        if self.has_frames {
            self.world.run_schedule(Update);
        }
        self.world.clear_trackers();
    }

    /// Runs so many ticks.
    pub fn run(&mut self, ticks: u32) -> &mut Self {
        (0..ticks).for_each(|_| self.tick());
        self
    }

    /// Carries out the intents that wait, without a tick.
    pub fn apply_edits(&mut self) {
        let paused = Pace { paused: true, steps_due: 0, ..Pace::default() };
        let pace = std::mem::replace(self.get_mut::<Pace>(), paused);
        self.tick();
        *self.get_mut::<Pace>() = pace;
    }

    /// Queues an intent for the next tick.
    pub fn push(&mut self, intent: Intent) -> &mut Self {
        self.get_mut::<IntentQueue>().push(intent);
        self
    }

    /// Goes on at another quality. To a preset of another detail all is resampled, and waiting intents are forgotten.
    ///
    /// # Errors
    /// If the world does not fit the preset's detail: one line that says why, and what is allowed.
    pub fn set_quality(&mut self, preset: Preset, quality: Quality) -> Result<(), String> {
        if preset.detail() == self.get::<Setup>().preset.detail() {
            control::set_quality(&mut self.world, preset, quality);
            return Ok(());
        }
        Checkpoint::of(&self.world).at_quality(preset, quality)?.restore(&mut self.world);
        Ok(())
    }

    /// Hash of the state.
    pub fn hash(&self) -> u64 {
        control::hash(&self.world)
    }

    /// A resource of the world.
    pub fn get<R: Resource>(&self) -> &R {
        self.world.resource::<R>()
    }

    /// A resource of the world, to change it between ticks.
    pub fn get_mut<R: Resource<Mutability = Mutable>>(&mut self) -> &mut R {
        self.world.resource_mut::<R>().into_inner()
    }

    /// The world, to read.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world, to change between ticks.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }
}
