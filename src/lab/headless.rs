//! The simulation without a window: the game's own plugin in a bare app, stepped tick by tick.

use crate::{
    scene::blueprint::Blueprint,
    sim::{SimulationPlugin, control},
};
use bevy::{
    MinimalPlugins,
    app::{App, PluginGroup, ScheduleRunnerPlugin, TaskPoolOptions, TaskPoolPlugin},
    ecs::{
        schedule::{Schedules, SingleThreadedExecutor},
        world::World,
    },
    time::TimeUpdateStrategy,
};
use std::sync::Arc;

/// A world that waits for its next tick.
pub struct Headless {
    app: App,
}

impl Headless {
    /// The start of a scene.
    pub fn new(blueprint: Arc<Blueprint>) -> Self {
        let mut app = App::new();
        let pools = TaskPoolPlugin { task_pool_options: TaskPoolOptions::with_num_threads(1) };
        app.add_plugins(MinimalPlugins.build().disable::<ScheduleRunnerPlugin>().set(pools));
        app.add_plugins(SimulationPlugin);
        control::load(app.world_mut(), blueprint);
        app.insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        app.finish();
        app.cleanup();
        stay_on_this_thread(&mut app);
        // The clock's first update has no time in it and runs no tick.
        app.update();
        Self { app }
    }

    /// Runs one tick.
    pub fn tick(&mut self) {
        self.app.update();
    }

    /// The world, to read and to control.
    pub fn world(&self) -> &World {
        self.app.world()
    }

    /// The world, to change between ticks.
    pub fn world_mut(&mut self) -> &mut World {
        self.app.world_mut()
    }
}

/// Systems run on the calling thread, whatever the build, so that the kernel's parallel passes run in the caller's
/// thread pool. The stages of a tick are a chain: there is nothing to gain from several threads around them.
fn stay_on_this_thread(app: &mut App) {
    let mut schedules = app.world_mut().resource_mut::<Schedules>();
    for (_, schedule) in schedules.iter_mut() {
        schedule.set_executor(SingleThreadedExecutor::new());
    }
}
