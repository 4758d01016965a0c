//! `play`: the game's window.

use crate::{
    cli::{args::PlayOptions, failure::Failure, output, start::Start, threads},
    sim::recording::Recording,
};
use bevy::ecs::world::World;

/// The scene without a name.
const DEFAULT_SCENE: &str = "waterfall";

/// Opens the game with a scene, a saved world or a recording.
pub(super) fn play(scene: Option<&str>, options: &PlayOptions) -> Result<(), Failure> {
    let scene = scene.unwrap_or(DEFAULT_SCENE);
    output::check(options.record.as_deref().as_slice())?;
    let (start, recording) = Start::of_play(scene, options)?;
    threads::start_aside(options.machine.threads)?;
    let load = |world: &mut World| start.load(world, options.machine.simd);
    open(scene, options, recording, load)
}

#[cfg(feature = "app")]
fn open(
    scene: &str,
    options: &PlayOptions,
    recording: Option<Recording>,
    load: impl FnOnce(&mut World),
) -> Result<(), Failure> {
    use crate::{
        game::{self, GameError, playback, script},
        lab::live::LivePlugin,
    };
    use bevy::app::AppExit;

    match game::run(scene, options.record.clone(), |app| {
        app.add_plugins(LivePlugin);
        load(app.world_mut());
        if let Some(recording) = recording {
            playback::begin(app.world_mut(), recording);
        }
        if options.hook {
            app.add_plugins(script::plugin);
            script::answer_stdin();
        }
    }) {
        Ok(AppExit::Success) => Ok(()),
        Ok(AppExit::Error(code)) => Err(Failure::Outcome(format!("the game ended with error {code}"))),
        Err(error @ GameError::Crashed { .. }) => Err(Failure::Outcome(error.to_string())),
        Err(error) => Err(Failure::Usage(error.to_string())),
    }
}

#[cfg(not(feature = "app"))]
fn open(scene: &str, _: &PlayOptions, _: Option<Recording>, _: impl FnOnce(&mut World)) -> Result<(), Failure> {
    Err(Failure::Usage(format!(
        "this build has no window (it lacks the cargo feature `app`); `powder-master run {scene}` works without one"
    )))
}
