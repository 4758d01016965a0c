//! `play`: the game's window.

use crate::{
    cli::{args::PlayOptions, failure::Failure, output, start::Start, threads},
    scene::DEFAULT_SCENE,
    sim::recording::Recording,
};

/// Opens the game with a scene, a saved world or a recording; with none, the scene that was played last.
pub(super) fn play(scene: Option<&str>, options: &PlayOptions) -> Result<(), Failure> {
    let last = if scene.is_none() { last_scene(options) } else { None };
    let scene = scene.or(last.as_deref()).unwrap_or(DEFAULT_SCENE);
    output::check(options.record.as_deref().as_slice())?;
    let (start, recording) = Start::of_play(scene, options)?;
    threads::start_aside(options.machine.threads)?;
    open(scene, options, &start, recording)
}

#[cfg(feature = "app")]
fn open(scene: &str, options: &PlayOptions, start: &Start, recording: Option<Recording>) -> Result<(), Failure> {
    use crate::{
        game::{self, GameError, playback, script},
        lab::live::LivePlugin,
        sim::state::SolverState,
    };
    use bevy::app::AppExit;

    match game::run(scene, options.record.clone(), |app| {
        app.add_plugins(LivePlugin);
        start.checkpoint.restore(app.world_mut());
        app.world_mut().resource_mut::<SolverState>().instructions = options.machine.simd;
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
        Err(error @ GameError::Crashed(_)) => Err(Failure::Outcome(error.to_string())),
        Err(error) => Err(Failure::Usage(error.to_string())),
    }
}

/// The scene that was played last, unless parameters are given: they are those of the default one.
#[cfg(feature = "app")]
fn last_scene(options: &PlayOptions) -> Option<String> {
    let kept = crate::game::settings::Settings::of_user();
    kept.scene().filter(|_| options.settings.is_empty()).map(str::to_owned)
}

#[cfg(not(feature = "app"))]
fn last_scene(_: &PlayOptions) -> Option<String> {
    None
}

#[cfg(not(feature = "app"))]
fn open(scene: &str, _: &PlayOptions, _: &Start, _: Option<Recording>) -> Result<(), Failure> {
    Err(Failure::Usage(format!(
        "this build has no window (it lacks the cargo feature `app`); `powder-master run {scene}` works without one"
    )))
}
