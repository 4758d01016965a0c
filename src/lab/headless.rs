//! The simulation without a window: the game's own plugin in a bare app, stepped tick by tick.

use crate::{
    scene::blueprint::Blueprint,
    sim::{SimulationPlugin, control, workers::Workers},
};
use bevy::{
    MinimalPlugins,
    app::{App, PluginGroup, Plugins, ScheduleRunnerPlugin},
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
    /// The start of a scene, for `workers` to run.
    pub fn new(blueprint: Arc<Blueprint>, workers: Workers) -> Self {
        Self::begin(workers, |world| control::load(world, blueprint))
    }

    /// The world that `load` makes, for `workers` to run.
    pub fn begin(workers: Workers, load: impl FnOnce(&mut World)) -> Self {
        Self::begin_with(workers, (), load)
    }

    /// The world that `load` makes, with more plugins.
    pub fn begin_with<M>(workers: Workers, plugins: impl Plugins<M>, load: impl FnOnce(&mut World)) -> Self {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins.build().disable::<ScheduleRunnerPlugin>(), SimulationPlugin));
        app.add_plugins(plugins);
        app.insert_resource(workers).insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        load(app.world_mut());
        app.finish();
        app.cleanup();
        // Beside the tick there is hardly anything to run.
        for (_, schedule) in app.world_mut().resource_mut::<Schedules>().iter_mut() {
            schedule.set_executor(SingleThreadedExecutor::new());
        }
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
