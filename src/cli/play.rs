//! `play`: the game's window.

use crate::{
    cli::{args::PlayOptions, failure::Failure, threads},
    scene::{
        self,
        blueprint::{Blueprint, EffectModes},
    },
};

/// The scene without a name.
const DEFAULT_SCENE: &str = "waterfall";

/// Opens the game with a scene.
pub(super) fn play(scene: Option<&str>, options: &PlayOptions) -> Result<(), Failure> {
    let scene = scene::load(scene.unwrap_or(DEFAULT_SCENE))?;
    let blueprint = scene.build(&options.settings, options.quality, &EffectModes::new())?;
    threads::start(options.threads)?;
    open(blueprint)
}

#[cfg(feature = "app")]
fn open(blueprint: Blueprint) -> Result<(), Failure> {
    use crate::game::{self, GameOptions};
    use bevy::app::AppExit;

    match game::run(std::sync::Arc::new(blueprint), GameOptions::default()) {
        Ok(AppExit::Success) => Ok(()),
        Ok(AppExit::Error(code)) => Err(Failure::Outcome(format!("the game ended with error {code}"))),
        Err(error) => Err(Failure::Usage(error.to_string())),
    }
}

#[cfg(not(feature = "app"))]
fn open(blueprint: Blueprint) -> Result<(), Failure> {
    Err(Failure::Usage(format!(
        "this build has no window (it lacks the cargo feature `app`); `powder-master run {}` works without one",
        blueprint.name
    )))
}
