//! `play`: the game's window.

#[cfg(feature = "app")]
use crate::game::{self, GameOptions};
use crate::{
    cli::{args::PlayOptions, failure::Failure, threads},
    scene::{
        self,
        blueprint::{Blueprint, EffectModes},
    },
    sim::workers::Workers,
};
#[cfg(feature = "app")]
use bevy::app::AppExit;
#[cfg(feature = "app")]
use std::sync::Arc;

/// The scene without a name.
const DEFAULT_SCENE: &str = "waterfall";

/// Opens the game with a scene.
pub(super) fn play(scene: Option<&str>, options: &PlayOptions) -> Result<(), Failure> {
    let scene = scene::load(scene.unwrap_or(DEFAULT_SCENE))?;
    let blueprint = scene.build(&options.settings, options.quality, &EffectModes::new())?;
    open(blueprint, threads::workers(options.threads)?)
}

#[cfg(feature = "app")]
fn open(blueprint: Blueprint, workers: Workers) -> Result<(), Failure> {
    match game::run(Arc::new(blueprint), workers, GameOptions::default()) {
        Ok(AppExit::Success) => Ok(()),
        Ok(AppExit::Error(code)) => Err(Failure::Outcome(format!("the game ended with error {code}"))),
        Err(error) => Err(Failure::Usage(error.to_string())),
    }
}

#[cfg(not(feature = "app"))]
fn open(blueprint: Blueprint, _workers: Workers) -> Result<(), Failure> {
    Err(Failure::Usage(format!(
        "this build has no window (it lacks the cargo feature `app`); `powder-master run {}` works without one",
        blueprint.name
    )))
}
