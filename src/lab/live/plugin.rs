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
    scene::effects::Pass,
    sim::{
        script,
        state::{Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{App, FixedUpdate, IntoScheduleConfigs, Plugin, Res, ResMut, Update},
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
            .add_systems(
                FixedUpdate,
                (sample_world, sample_second_world)
                    .chain()
                    .run_if(is_watched)
                    .after(Pass::Measure)
                    .before(autopilot::steer),
            )
            .add_systems(FixedUpdate, measures::start.before(script::run).run_if(measures::is_wanted))
            .add_systems(Update, (survey::run, measures::measure.run_if(measures::is_wanted)));
    }
}

/// Run condition: the error is shown or held.
fn is_watched(watched: Res<Watched>) -> bool {
    watched.0
}

/// Samples the world that is played.
fn sample_world(
    setup: Res<Setup>,
    clock: Res<Clock>,
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
    mut scratch: ResMut<Scratch>,
    mut error: ResMut<LiveError>,
) {
    if is_due(&clock, &error) {
        error.note(take(&mut scratch, &setup, &clock, &particles, &rock));
    }
}

/// Samples the second world of an A/B split.
fn sample_second_world(mut split: ResMut<Split>, mut scratch: ResMut<Scratch>) {
    let Some(world) = split.world_mut() else { return };
    let clock = *world.resource::<Clock>();
    if !is_due(&clock, world.resource::<LiveError>()) {
        return;
    }
    let (setup, particles, rock) =
        (world.resource::<Setup>(), world.resource::<ParticleStore>(), world.resource::<Rock>());
    let sample = take(&mut scratch, setup, &clock, particles, rock);
    world.resource_mut::<LiveError>().note(sample);
}

/// Whether the world has come to another tick, and to one at which it is sampled; the first sample waits for none, as a
/// world that stands comes to none.
fn is_due(clock: &Clock, error: &LiveError) -> bool {
    error.latest().is_none_or(|last| last.tick != clock.tick && clock.tick.is_multiple_of(SAMPLE_EVERY))
}

fn take(scratch: &mut Scratch, setup: &Setup, clock: &Clock, particles: &ParticleStore, rock: &Rock) -> ErrorSample {
    let start = Instant::now();
    let (size, rest) = (setup.blueprint.domain.size, f64::from(setup.blueprint.fluid.rest_density));
    let found = scratch.density_error(particles, rock, size, rest, clock.tick);
    ErrorSample {
        tick: clock.tick,
        mean: found.map(|error| error.mean as f32),
        p99: found.map(|error| error.p99 as f32),
        cost: start.elapsed(),
    }
}
