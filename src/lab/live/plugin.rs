//! Measures the world that is played: adds the samples, the other measures and the survey to an app.

use crate::{
    lab::{
        autopilot,
        live::{
            accuracy::{ErrorSample, LiveError, SAMPLE_EVERY, Survey, Watched},
            measures::{self, Measures},
            sample::Scratch,
            survey,
        },
        split::Split,
    },
    scene::passes::Pass,
    sim::{
        script,
        state::{Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{App, FixedUpdate, IntoScheduleConfigs, Mut, Plugin, Res, Update, World},
};

/// Measures the world that is played.
pub struct LivePlugin;

impl Plugin for LivePlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<LiveError>()
            .init_resource::<Watched>()
            .init_resource::<Survey>()
            .init_resource::<Measures>()
            .init_resource::<Split>()
            .init_resource::<Scratch>()
            .init_resource::<survey::Surveyor>()
            .add_systems(FixedUpdate, sample.run_if(is_watched).after(Pass::Measure).before(autopilot::steer))
            .add_systems(FixedUpdate, measures::start.before(script::run).run_if(measures::is_wanted))
            .add_systems(Update, (survey::run, measures::measure.run_if(measures::is_wanted)));
    }
}

/// Run condition: the error is shown or held.
fn is_watched(watched: Res<Watched>) -> bool {
    watched.0
}

/// Samples the world that is played, and the second world of an A/B split.
fn sample(world: &mut World) {
    world.resource_scope(|world, mut scratch: Mut<Scratch>| {
        sample_world(world, &mut scratch);
        world.resource_scope(|_, mut split: Mut<Split>| {
            if let Some(second) = split.world_mut() {
                sample_world(second, &mut scratch);
            }
        });
    });
}

/// Samples a world that has come to another tick, and to one at which it is sampled; the first sample waits for none, as a
/// world that stands comes to none.
fn sample_world(world: &mut World, scratch: &mut Scratch) {
    let tick = world.resource::<Clock>().tick;
    let last = world.resource::<LiveError>().latest();
    if last.is_some_and(|last| last.tick == tick || !tick.is_multiple_of(SAMPLE_EVERY)) {
        return;
    }
    let start = Instant::now();
    let blueprint = &world.resource::<Setup>().blueprint;
    let (size, rest) = (blueprint.domain.size, f64::from(blueprint.fluid.rest_density));
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let found = scratch.density_error(particles, rock, size, rest, tick);
    let sample = ErrorSample {
        tick,
        mean: found.map(|error| error.mean as f32),
        p99: found.map(|error| error.p99 as f32),
        interior: found.map_or(0, |error| error.interior),
        cost: start.elapsed(),
    };
    world.resource_mut::<LiveError>().note(sample);
}
